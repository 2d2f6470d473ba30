"""The shape that is fitted is nearer to the person than the neutral face is."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import pdeface
from pdeface.photo import PhotoFace, find_faces, fit_shape
from pdeface.photo.anchors import anchors
from pdeface.photo.camera import PARAMETERS, PhotoCamera
from pdeface.photo.found import LANDMARKS
from pdeface.template import feature_points

SEEDS = range(5001, 5005)
"""People on whom nothing was calibrated."""


def turned(angle: float) -> np.ndarray:
    """Rotation to the subject's left."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]])


def seen(face: pdeface.Face, camera: PhotoCamera, scores: dict[str, float]) -> PhotoFace:
    """What a detector without any error would find."""
    u, v = anchors().uv.T
    marks = np.column_stack([camera.project(face.surface()(u, v)), np.zeros(LANDMARKS)])
    pose = np.eye(4)
    pose[:3, :3] = camera.rotation
    return PhotoFace(marks, scores, pose, (800, 1000))


def apart(first: pdeface.Face, second: pdeface.Face) -> float:
    """Mean distance of two faces' front, metres, one moved, turned and scaled onto the other."""
    meshes = [face.mesh(55, 81).vertices.reshape(55, 81, 3) for face in (first, second)]
    a, b = (mesh[:, 8:-8].reshape(-1, 3) for mesh in meshes)
    a, b = a - a.mean(axis=0), b - b.mean(axis=0)
    left, sizes, right = np.linalg.svd(b.T @ a)
    moved = a @ (left @ right).T * sizes.sum() / (a**2).sum()
    return float(np.linalg.norm(moved - b, axis=1).mean())


@pytest.fixture
def camera() -> PhotoCamera:
    return PhotoCamera(turned(0.2), 2500.0, np.array([400.0, 520.0]))


def test_landmarks_lie_where_their_features_are() -> None:
    places, uv = feature_points(), anchors().uv
    for number, name in ((4, "nose_tip"), (61, "right_mouth_corner"), (291, "left_mouth_corner")):
        assert np.abs(uv[number] - places[name]).max() < 0.06
    assert ((uv[:, 0] >= 0) & (uv[:, 0] <= 1) & (uv[:, 1] >= 0) & (uv[:, 1] <= np.pi)).all()
    assert (anchors().spread > 0).all()


def test_derivatives_are_those_of_the_projection(camera) -> None:
    rng = np.random.default_rng(0)
    points, direction = 0.08 * rng.normal(size=(2, 20, 3))
    step = 1e-6
    moved = (camera.project(points + step * direction) - camera.project(points)) / step
    np.testing.assert_allclose(camera.moves(points, direction), moved, rtol=1e-3, atol=1e-2)
    for own, change in zip(camera.own_moves(points), np.eye(PARAMETERS), strict=True):
        moved = (camera.stepped(step * change).project(points) - camera.project(points)) / step
        np.testing.assert_allclose(own, moved, rtol=1e-3, atol=1e-2)


def test_the_neutral_face_is_found_neutral(camera) -> None:
    shape = fit_shape(seen(pdeface.neutral(), camera, {}))
    assert max(map(abs, shape.identity.values())) < 0.02
    assert max(shape.expression.values()) < 0.02
    assert shape.error < 1e-3
    np.testing.assert_allclose(shape.camera.rotation, camera.rotation, atol=1e-3)
    assert shape.camera.scale == pytest.approx(camera.scale, rel=1e-3)


def test_an_expression_does_not_become_a_shape(camera) -> None:
    smile = {"mouthSmileLeft": 0.8, "mouthSmileRight": 0.8, "jawOpen": 0.3}
    shape = fit_shape(seen(pdeface.neutral().set(**smile), camera, smile))
    assert apart(pdeface.neutral().with_weights(shape.identity), pdeface.neutral()) < 3e-4
    assert shape.expression["mouthSmileLeft"] == pytest.approx(0.8, abs=0.1)


def test_a_person_is_nearer_than_the_neutral_face(camera) -> None:
    for seed in SEEDS:
        person = pdeface.random(seed)
        found = pdeface.neutral().with_weights(fit_shape(seen(person, camera, {})).identity)
        assert apart(found, person) < 0.7 * apart(pdeface.neutral(), person)


def test_a_few_wrong_landmarks_do_little_harm(camera) -> None:
    right = seen(pdeface.random(SEEDS[0]), camera, {})
    marks = right.landmarks.copy()
    marks[::40, 0] += 0.5 * right.eye_distance
    faces = [
        pdeface.neutral().with_weights(fit_shape(found).identity)
        for found in (right, replace(right, landmarks=marks))
    ]
    assert apart(*faces) < 5e-4


def test_weights_stay_in_their_range(collins) -> None:
    wild = collins.landmarks * (1.6, 1.0, 1.0)
    shape = fit_shape(replace(collins, landmarks=wild))
    assert max(map(abs, shape.identity.values())) <= 3.0
    pdeface.neutral().with_weights({**shape.identity, **shape.expression})


def test_people_in_pictures_are_nearer_than_the_neutral_face(model) -> None:
    pytest.importorskip("vtk", reason="needs the extra 'render'")
    from pdeface.photo.build.renders import people

    fitted, neutral = [], []
    for rendered in people(len(SEEDS), SEEDS[0]):
        person = rendered.face
        (found,) = find_faces(rendered.picture, model)
        shape = fit_shape(found)
        assert shape.error < 0.04
        fitted.append(apart(pdeface.neutral().with_weights(shape.identity), person))
        neutral.append(apart(pdeface.neutral(), person))
    assert np.mean(fitted) < 0.95 * np.mean(neutral)


@pytest.mark.parametrize("aside", [30.0, -30.0])
def test_a_head_in_a_picture_is_turned_as_it_was(model, aside) -> None:
    """A camera on the subject's left sees a head that looks to its right."""
    pytest.importorskip("vtk", reason="needs the extra 'render'")
    from pdeface.pictures import render
    from pdeface.texture import portrait, uv_texture

    face = pdeface.neutral().with_texture(uv_texture(*portrait()).image)
    (found,) = find_faces(render(face, view=aside, size=(480, 600)), model)
    assert np.degrees(found.yaw) == pytest.approx(-aside, abs=6.0)
