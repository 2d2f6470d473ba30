"""Every part: a surface through its curves, moved linearly, seen from its outer side."""

from __future__ import annotations

import numpy as np
import pytest

from pdeface.anatomy import OPENINGS, PARTS, SAMPLES, Anatomy, Outline, placed
from pdeface.curves import curve_parameters
from pdeface.errors import InputError

MIRROR = np.array([-1.0, 1.0, 1.0])
WEIGHTS = {"jawOpen": 0.7, "jawLeft": 0.2, "tongueOut": 0.5, "eyeLookUpLeft": 0.4}


def displacements(seed: int) -> Outline:
    rng = np.random.default_rng(seed)
    return Outline(*(rng.normal(scale=1e-3, size=(2, SAMPLES, 3)) for _ in OPENINGS))


@pytest.mark.parametrize("name", PARTS)
def test_the_surface_meets_every_curve(neutral: Anatomy, name: str) -> None:
    curves = neutral.curves(name)
    assert curves.shape == (*PARTS[name].shape, 3)
    u, v = np.linspace(0.0, 1.0, curves.shape[0]), curve_parameters(curves.shape[1])
    met = PARTS[name].surface(curves)(u[:, None], v)
    np.testing.assert_allclose(met, curves, atol=1e-12)


@pytest.mark.parametrize("name", PARTS)
def test_the_uv_mesh_samples_the_surface_and_closes(neutral: Anatomy, name: str) -> None:
    part, curves = PARTS[name], neutral.curves(name)
    vertices = part.positions(curves).reshape(part.rows, part.columns, 3)
    np.testing.assert_allclose(vertices[:, 0], vertices[:, -1], atol=1e-12)
    row, column = part.rows // 3, part.columns // 3
    u, v = row / (part.rows - 1), 2.0 * np.pi * column / (part.columns - 1)
    np.testing.assert_allclose(vertices[row, column], part.surface(curves)(u, v), atol=1e-12)
    lengths = np.linalg.norm(part.normals(curves), axis=1)
    np.testing.assert_allclose(lengths, 1.0, atol=1e-9)


@pytest.mark.parametrize("name", PARTS)
def test_displacements_are_linear(neutral: Anatomy, name: str) -> None:
    first, second = displacements(0), displacements(1)
    total = Outline(
        *(2.0 * np.array(getattr(first, n)) - np.array(getattr(second, n)) for n in OPENINGS)
    )
    expected = 2.0 * neutral.moved(name, first, WEIGHTS) - neutral.moved(name, second, {})
    weights = {key: 2.0 * value for key, value in WEIGHTS.items()}
    np.testing.assert_allclose(neutral.moved(name, total, weights), expected, atol=1e-12)


@pytest.mark.parametrize("name", ["left_eyeball", "upper_teeth", "lower_teeth", "tongue"])
def test_closed_parts_look_outwards(neutral: Anatomy, name: str) -> None:
    """The volume by the divergence theorem is positive if the normals point out of it."""
    part = PARTS[name]
    vertices = part.positions(neutral.curves(name))
    vertices = vertices - vertices.mean(axis=0)
    a, b, c = vertices[part.grid.triangles].transpose(1, 0, 2)
    volume = np.einsum("ti,ti->", a, np.cross(b, c)) / 6.0
    box = np.ptp(vertices, axis=0).prod()
    assert 0.05 * box < volume < box
    assert (_along_triangles(part.name, neutral) > 0.0).mean() > 0.999


@pytest.mark.parametrize("name", ["mouth", "right_lids"])
def test_the_seen_side_of_a_rim_looks_into_the_opening(neutral: Anatomy, name: str) -> None:
    part, curves = PARTS[name], neutral.curves(name)
    loop = curves[0]
    normals = part.normals(curves).reshape(part.rows, part.columns, 3)
    # The lips part most behind the place where they touch.
    row = 1 if name == "right_lids" else part.rows // 2
    above, below = part.columns // 4, 3 * part.columns // 4
    assert loop[loop.shape[0] // 4, 1] > loop[3 * loop.shape[0] // 4, 1]
    assert normals[row, above, 1] < 0.0 < normals[row, below, 1]


@pytest.mark.parametrize("name", ["left_eyeball", "left_lids", "mouth", "lower_teeth", "tongue"])
def test_a_symmetric_face_has_symmetric_parts(rest: Outline, name: str) -> None:
    reflected = {n: np.array(getattr(rest, n))[:, ::-1] * MIRROR for n in OPENINGS}
    mouth = 0.5 * (np.array(rest.mouth) + reflected["mouth"])
    anatomy = placed(Outline(reflected["left_eye"], rest.left_eye, mouth))
    other = name.replace("left", "right")
    mine, theirs = (PARTS[n].surface(anatomy.curves(n)) for n in (name, other))
    u, v = np.meshgrid(np.linspace(0.0, 1.0, 11), np.linspace(0.0, 2.0 * np.pi, 17))
    # Teeth run from right to left in u, all others in v.
    mirrored = theirs(1.0 - u, v) if name.endswith("teeth") else theirs(u, np.pi - v)
    np.testing.assert_allclose(mine(u, v), mirrored * MIRROR, atol=1e-8)


def test_unknown_parts_and_outlines_are_refused(neutral: Anatomy, rest: Outline) -> None:
    with pytest.raises(InputError, match="the parts are right_eyeball"):
        neutral.curves("ear")
    with pytest.raises(InputError, match=r"two margins of \(41, 3\) points"):
        Outline(np.zeros((2, 5, 3)), rest.left_eye, rest.mouth)
    with pytest.raises(InputError, match="must be finite"):
        Outline(np.full((2, SAMPLES, 3), np.nan), rest.left_eye, rest.mouth)


def _along_triangles(name: str, anatomy: Anatomy) -> np.ndarray:
    """Cosine of each vertex normal with the triangles that meet there."""
    part = PARTS[name]
    vertices, normals = part.positions(anatomy.curves(name)), part.normals(anatomy.curves(name))
    a, b, c = vertices[part.grid.triangles].transpose(1, 0, 2)
    flat = np.cross(b - a, c - a)
    mean = normals[part.grid.triangles].mean(axis=1)
    return np.einsum("ti,ti->t", flat, mean)[np.linalg.norm(flat, axis=1) > 1e-12]
