"""Margins: a field beside openings, and lids that meet on the mesh at every blink."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import pdeface
from pdeface import template
from pdeface.controls.measured import STILL
from pdeface.controls.seams import nearest
from pdeface.face import Face
from pdeface.margins import REACH, MarginField
from pdeface.parts import FaceParts
from pdeface.uvmesh import UVMesh

CLOSED = 2e-4
"""Metres between lids that are shut."""

COMPANY = st.fixed_dictionaries(
    {
        name: st.floats(0.0, 1.0)
        for name in (
            *("eyeWideLeft", "eyeSquintLeft", "eyeLookUpLeft", "eyeLookDownLeft"),
            *("eyeLookInLeft", "eyeLookOutLeft", "eyeBlinkRight", "jawOpen", "cheekSquintLeft"),
        )
    }
)


def margins(face: Face, size: tuple[int, int], which: int = 1) -> np.ndarray:
    """(2, C, 3) nodes of a mesh on the upper and the lower margin of an opening."""
    cut, vertices = face.uv_mesh(*size).cuts[which], face.mesh(*size).vertices
    return np.array([vertices[row * size[1] + cut.columns] for row in (cut.upper, cut.lower)])


def gap(face: Face, size: tuple[int, int]) -> float:
    """How far apart the edges of the left lids are at most, on either of them."""
    edges = margins(face, size)
    t = np.linspace(0.0, 1.0, 12)[:, None, None]
    dense = [(edge[:-1] + t * np.diff(edge, axis=0)).reshape(-1, 3) for edge in edges]
    away = [nearest(edges[1 - i], dense[i]) - dense[i] for i in (0, 1)]
    return float(np.linalg.norm(np.concatenate(away), axis=1).max())


@pytest.mark.parametrize("level", ["28x46", "55x92"])
@pytest.mark.parametrize("size", [(28, 41), (61, 97), (109, 161)], ids=str)
@settings(max_examples=10, deadline=None)
@given(seed=st.none() | st.integers(0, 1000), company=COMPANY)
def test_a_full_blink_closes_the_eye_of_anyone_in_any_company(level, size, seed, company) -> None:
    face = pdeface.neutral(level) if seed is None else pdeface.random(seed, level)
    assert gap(face.set(**company, eyeBlinkLeft=1.0), size) < CLOSED


@settings(max_examples=10, deadline=None)
@given(seed=st.integers(0, 1000), company=COMPANY, blink=st.floats(0.0, 1.0))
def test_a_blink_closes_in_proportion_on_the_mesh(seed, company, blink) -> None:
    face, size = pdeface.random(seed).set(**company), (28, 41)
    opened, now = (
        np.subtract(*margins(face.set(eyeBlinkLeft=each), size)) for each in (0.0, blink)
    )
    np.testing.assert_allclose(now, (1.0 - blink) * opened, atol=1e-4)


@pytest.mark.parametrize("size", [(28, 41), (109, 161)], ids=str)
def test_a_field_is_its_margins_displacement_and_fades_to_nothing(size: tuple[int, int]) -> None:
    mesh = UVMesh(*size, openings=template.openings())
    field = MarginField(mesh)
    moved = np.zeros((mesh.vertex_count, 3))
    displacement = np.zeros(STILL.shape)
    displacement[1, 0] = [0.0, 1.0, 2.0]
    moved[field.nodes] = field.displacements(displacement)[0]
    cut = mesh.cuts[1]
    np.testing.assert_allclose(
        moved[(cut.upper * size[1] + cut.columns)[1:-1]][:, 1:],
        [[1.0, 2.0]] * (len(cut.columns) - 2),
    )
    u, v = mesh.nodes.T
    still = (u < min(cut.opening.upper) - REACH) | (u > max(cut.opening.upper))
    still |= (v <= cut.opening.corners[0]) | (v >= cut.opening.corners[1])
    assert not moved[still].any()
    assert not np.delete(moved, field.nodes, axis=0).any()


def test_derivatives_of_a_field_are_its_differences() -> None:
    """On nodes along a column and a row, of a mesh so fine that differences are derivatives."""
    size = (2161, 2401)
    mesh = UVMesh(*size, openings=template.openings()[1:2])
    field = MarginField(mesh)
    displacement = np.zeros((1, *STILL.shape[1:]))
    across = np.linspace(0.0, np.pi, STILL.shape[2])
    displacement[0] = np.sin(np.stack([across, 2 * across, 3 * across], axis=1))
    values = np.zeros((3, mesh.vertex_count, 3))
    values[:, field.nodes] = field.displacements(displacement)
    value, by_u, by_v = values.reshape(3, *size, 3)
    cut = mesh.cuts[0]
    column = cut.columns[len(cut.columns) // 3]
    rows = np.arange(cut.upper[len(cut.columns) // 3] - 180, cut.upper[len(cut.columns) // 3] - 2)
    step_u, step_v = 1.0 / (size[0] - 1), np.pi / (size[1] - 1)
    found_u = (value[rows + 1, column] - value[rows - 1, column]) / (2 * step_u)
    found_v = (value[rows, column + 1] - value[rows, column - 1]) / (2 * step_v)
    np.testing.assert_allclose(by_u[rows, column], found_u, atol=2e-3 * np.abs(by_u).max())
    np.testing.assert_allclose(by_v[rows, column], found_v, atol=5e-2 * np.abs(found_v).max())


def test_a_blink_leaves_cheek_and_lips_alone() -> None:
    size = (109, 161)
    face = pdeface.random(4)
    moved = face.set(eyeBlinkLeft=1.0).displacement.margins
    assert moved[1].any()
    assert not moved[[0, 2]].any()
    field = MarginField(face.uv_mesh(*size))
    changed = field.places[field.displacements(moved)[0].any(axis=1)]
    assert changed[:, 0].max() < template.row_u("nose_tip")
    assert changed[:, 1].min() > np.pi / 2


def test_the_rims_follow_the_margins() -> None:
    face = pdeface.random(2).set(eyeBlinkLeft=1.0, eyeWideLeft=1.0)
    rim = FaceParts(face).curves("left_lids")[0]
    upper, lower = rim[:32], rim[32:][::-1]
    away = np.linalg.norm(nearest(lower, upper) - upper, axis=1)
    assert away[2:-2].max() < 1e-3
    shut = margins(face, (109, 161))[0]
    assert np.linalg.norm(nearest(shut, rim) - rim, axis=1).max() < 4e-4
