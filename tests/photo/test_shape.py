"""The shape that is fitted is nearer to the person than the neutral face is."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial import cKDTree

import pdeface
from pdeface.controls import CONTROLS
from pdeface.curves import mirror_points
from pdeface.errors import InputError
from pdeface.photo import PhotoFace, find_faces, fit_shape, fit_shapes
from pdeface.photo.anchors import anchors
from pdeface.photo.camera import PARAMETERS, PhotoCamera
from pdeface.photo.fitting import MESH_LANDMARKS, fit_view
from pdeface.photo.found import LANDMARKS
from pdeface.photo.unfolding import moved, unfolded
from pdeface.template import feature_points

SEEDS = range(5001, 5006)
"""People of whom nothing was learnt."""


def turned(angle: float) -> np.ndarray:
    """Rotation to the subject's left."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]])


def landmarks(face: pdeface.Face) -> np.ndarray:
    return face.surface()(*anchors().uv[:MESH_LANDMARKS].T)


def seen(face: pdeface.Face, camera: PhotoCamera, scores: dict[str, float]) -> PhotoFace:
    """What a detector without any error would find."""
    u, v = anchors().uv.T
    marks = np.column_stack([camera.project(face.surface()(u, v)), np.zeros(LANDMARKS)])
    pose = np.eye(4)
    pose[:3, :3] = camera.rotation
    return PhotoFace(marks, scores, pose, (800, 1000))


def front(face: pdeface.Face) -> np.ndarray:
    return face.mesh(55, 81).vertices.reshape(55, 81, 3)[:, 8:-8].reshape(-1, 3)


def aligned(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """The points moved, turned and scaled onto the others."""
    middle, target = a.mean(axis=0), b.mean(axis=0)
    left, sizes, right = np.linalg.svd((b - target).T @ (a - middle))
    scale = sizes.sum() / ((a - middle) ** 2).sum()
    return scale * (a - middle) @ (left @ right).T + target


def from_surface(face: pdeface.Face, truth: pdeface.Face) -> float:
    """Mean distance of a face's front from the nearest place on the true surface, metres."""
    mesh = truth.mesh(163, 241)
    points = aligned(front(face), front(truth))
    _, nearest = cKDTree(mesh.vertices).query(points)
    away = points - mesh.vertices[nearest]
    return float(np.abs(np.einsum("ni,ni->n", away, mesh.normals[nearest])).mean())


def apart(first: pdeface.Face, second: pdeface.Face) -> float:
    """Mean distance of two faces' front, metres, one moved, turned and scaled onto the other."""
    a, b = front(first), front(second)
    return float(np.linalg.norm(aligned(a, b) - b, axis=1).mean())


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


def test_the_camera_and_a_smile_of_a_known_person_are_found(camera) -> None:
    smile = {"mouthSmileLeft": 0.8, "mouthSmileRight": 0.8, "jawOpen": 0.3}
    person = pdeface.random(SEEDS[0])
    view = seen(person.with_weights({**person.weights, **smile}), camera, smile)
    fit = fit_view(view, landmarks(person))
    np.testing.assert_allclose(fit.camera.rotation, camera.rotation, atol=2e-3)
    assert fit.camera.scale == pytest.approx(camera.scale, rel=2e-3)
    off = camera.project(fit.points) - view.landmarks[:MESH_LANDMARKS, :2]
    assert np.sqrt((off**2).sum(axis=1).mean()) < 0.005 * view.eye_distance


def test_a_focal_length_says_how_far_away_the_camera_is(camera) -> None:
    near = replace(camera, distance=0.4)
    person = pdeface.neutral()
    fit = fit_view(seen(person, near, {}), landmarks(person), near.scale * near.distance)
    assert fit.camera.distance == pytest.approx(0.4, rel=0.01)
    assert fit_view(seen(person, near, {}), landmarks(person)).camera.distance == 1.0


def test_a_few_wrong_landmarks_do_little_harm(collins) -> None:
    marks = collins.landmarks.copy()
    marks[::40, 0] += 0.3 * collins.eye_distance
    faces = [fit_shape(found).face for found in (collins, replace(collins, landmarks=marks))]
    assert apart(*faces) < apart(faces[0], pdeface.neutral())


def test_weights_stay_in_their_range(collins) -> None:
    shape = fit_shape(replace(collins, landmarks=collins.landmarks * (1.6, 1.0, 1.0)))
    assert max(map(abs, shape.identity.values())) <= 3.0
    pdeface.neutral().with_weights({**shape.identity, **shape.expression})


def test_the_residual_brings_the_portrait_onto_its_landmarks(collins) -> None:
    shape = fit_shape(collins)
    face = shape.face.with_weights({**shape.identity, **shape.expression})
    off = shape.camera.project(landmarks(face)) - collins.landmarks[:MESH_LANDMARKS, :2]
    assert np.median(np.linalg.norm(off, axis=1)) < 0.015 * collins.eye_distance
    assert shape.error < 0.015
    bare = pdeface.neutral().with_weights(shape.identity)
    assert 0.0 < from_surface(shape.face, bare) < 1e-3
    assert np.array_equal(shape.face.weights, bare.weights)


def test_the_residual_is_the_same_at_every_level(collins) -> None:
    shape = fit_shape(collins)
    meshes = []
    for level in ("28x46", "55x92"):
        start = pdeface.neutral(level)
        bare = start.with_weights(shape.identity).mesh(55, 81, openings="none").vertices
        meshes.append(shape.worn_by(start).mesh(55, 81, openings="none").vertices - bare)
    assert np.abs(meshes[0]).max() > 1e-3
    assert np.abs(meshes[0] - meshes[1]).max() < 1e-4


def test_the_residual_folds_nothing(collins) -> None:
    shape = fit_shape(collins)
    bare = pdeface.neutral().with_weights(shape.identity)
    one, other = (f.mesh(109, 163, openings="none").normals for f in (bare, shape.face))
    upright = np.einsum("ni,ni->n", one, other).reshape(109, 163)
    lips = slice(68, 81)
    assert np.delete(upright, lips, axis=0).min() > 0.3


def test_the_residual_leaves_the_size_of_the_features(collins) -> None:
    """Of eyes, nose and mouth together; where each of them is, it changes."""
    shape = fit_shape(collins)
    bare = pdeface.neutral().with_weights(shape.identity)
    one, other = (landmarks(face)[[33, 133, 362, 263, 2, 61, 291]] for face in (bare, shape.face))
    assert np.linalg.norm(other - one, axis=1).max() > 5e-4
    middle = one - one.mean(axis=0)
    grown = np.sum(middle * (other - one)) / np.sum(middle**2)
    assert abs(grown) < 2e-3


def test_a_displacement_that_folds_is_less_only_where_it_does() -> None:
    """A push down the cheek folds it; the chin, far away, goes where it was to go."""
    face = pdeface.neutral()
    points = face.curves.points[:, : face.curves.shape[1] // 2]

    def bump(u: float, v: float, width: float, push: tuple[float, float, float]) -> np.ndarray:
        middle = face.surface()(np.array([u]), np.array([v]))
        away = np.linalg.norm(points - middle, axis=-1)
        return np.exp(-0.5 * (away / width) ** 2)[..., None] * np.array(push)

    def upright(residual: np.ndarray) -> float:
        meshes = [f.mesh(109, 163, openings="none") for f in (face, moved(face, residual))]
        rows = np.einsum("ni,ni->n", *(m.normals for m in meshes)).reshape(109, 163)
        return float(np.delete(rows, slice(68, 81), axis=0).min())

    cheek = bump(0.45, np.pi / 2 + 0.7, 0.006, (0.0, -0.03, 0.0))
    chin = bump(0.9, np.pi / 2, 0.008, (0.0, 0.0, 0.002))
    given = mirror_points(cheek + chin)
    assert upright(given) < 0.0
    found = unfolded(face, cheek + chin)
    assert upright(found) > 0.3
    sizes = [np.linalg.norm(each, axis=-1) for each in (given, found)]
    at_cheek, at_chin = (np.linalg.norm(mirror_points(b), axis=-1) > 1e-3 for b in (cheek, chin))
    assert 0.0 < sizes[1][at_cheek].max() < 0.8 * sizes[0][at_cheek].max()
    np.testing.assert_allclose(found[at_chin], given[at_chin], atol=2e-5)


def test_photos_that_agree_leave_less_at_the_mean(collins) -> None:
    once = fit_shape(collins)
    twice = fit_shapes([collins, collins])
    assert twice[0].identity == twice[1].identity
    sizes = [np.linalg.norm(list(s.identity.values())) for s in (once, twice[0])]
    assert sizes[0] < sizes[1]


def test_what_is_no_photo_is_refused(collins) -> None:
    with pytest.raises(InputError, match="faces"):
        fit_shapes([])
    with pytest.raises(InputError, match="focal length"):
        fit_shapes([collins], [50.0, 35.0])
    with pytest.raises(InputError, match="positive"):
        fit_shape(collins, -35.0)


def test_heads_in_pictures_are_nearer_than_the_neutral_face(model, shared_data) -> None:
    """And in three pictures nearer still; heads of the population that it was learnt from."""
    pytest.importorskip("vtk", reason="needs the extra 'render'")
    from pdeface.photo.build.heads import HeadSpace
    from pdeface.photo.build.scenes import Scene, photograph
    from pdeface.photo.build.skins import random_skin
    from pdeface.pictures.raster_vtk import Canvas

    space, canvas = HeadSpace(shared_data / "data" / "ict_facekit"), Canvas()
    names = [name for name, control in CONTROLS.items() if control.kind == "identity"]
    rows = []
    for seed in SEEDS:
        rng = np.random.default_rng(seed)
        weights, skin = rng.normal(size=space.modes), random_skin(rng)
        weights[: len(names)] = weights[: len(names)].clip(-3.0, 3.0)
        truth = pdeface.neutral().with_weights(dict(zip(names, weights.tolist(), strict=False)))
        views = []
        for yaw in (0.0, -30.0, 30.0):
            picture = photograph(space.head(weights), skin, Scene(yaw=yaw), canvas)
            views += find_faces(picture, model)[:1]
        one, three = fit_shape(views[0]), fit_shapes(views)[0]
        assert one.error < 0.015
        faces = pdeface.neutral(), one.face, three.face
        rows.append([from_surface(face, truth) for face in faces])
    neutral, one_photo, three_photos = np.mean(rows, axis=0)
    assert one_photo < 0.85 * neutral
    assert three_photos < one_photo


@pytest.mark.parametrize("aside", [30.0, -30.0])
def test_a_head_in_a_picture_is_turned_as_it_was(model, aside) -> None:
    """A camera on the subject's left sees a head that looks to its right."""
    pytest.importorskip("vtk", reason="needs the extra 'render'")
    from pdeface.pictures import render
    from pdeface.texture import portrait, uv_texture

    face = pdeface.neutral().with_texture(uv_texture(*portrait()).image)
    (found,) = find_faces(render(face, view=aside, size=(480, 600)), model)
    assert np.degrees(found.yaw) == pytest.approx(-aside, abs=6.0)


def test_the_residual_is_the_same_displacement_at_every_level() -> None:
    from pdeface.photo.bundled import portrait_face

    shape = fit_shape(portrait_face())
    without = replace(shape, residual=np.zeros_like(shape.residual))
    moves = [
        shape.worn_by(pdeface.neutral(level)).mesh(55, 81, openings="none").vertices
        - without.worn_by(pdeface.neutral(level)).mesh(55, 81, openings="none").vertices
        for level in ("28x46", "55x92", "109x184")
    ]
    size = np.linalg.norm(moves[0], axis=1)
    assert size.max() > 0.5e-3
    for move in moves[1:]:
        off = np.linalg.norm(move - moves[0], axis=1)
        assert off.max() < 0.25e-3 and off.mean() < 0.02 * size.max()
