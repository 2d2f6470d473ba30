"""The network is shown what MediaPipe shows it, and its traits turn with the face."""

from __future__ import annotations

import zipfile

import numpy as np
import pytest

pytest.importorskip("mediapipe", reason="needs the extra 'photo'")
pytest.importorskip("scipy", reason="needs the extra 'template'")
from PIL import Image

from pdeface.errors import InputError
from pdeface.photo import portrait_face
from pdeface.photo.build.spoiling import spoiled
from pdeface.photo.network import INNER, SIDE, Network, square
from pdeface.photo.traits import find_traits, reading
from pdeface.texture import portrait


@pytest.fixture(scope="module")
def network(model) -> Network:
    return Network(model)


def test_what_ships_has_the_shapes_it_says() -> None:
    known = reading()
    assert known.centre.shape == known.spread.shape == (INNER,)
    assert known.weights.shape == (INNER, 50)
    assert known.weights.dtype == np.int8
    assert (np.abs(known.weights).max(axis=0) == 127).all()
    assert (known.spread > 0.0).all()
    assert set(known.signs) == {-1.0, 1.0}


def test_the_square_is_level_and_holds_the_face() -> None:
    photo, face = portrait()[0], portrait_face()
    seen = square(photo, face.landmarks)
    assert seen.shape == (SIDE, SIDE, 3)
    turned = np.rot90(photo)  # to the left: x, y become y, width - 1 - x
    marks = face.landmarks.copy()
    marks[:, 0], marks[:, 1] = face.landmarks[:, 1], photo.shape[1] - 1 - face.landmarks[:, 0]
    away = np.abs(seen.astype(int) - square(turned, marks))
    assert np.mean(away) < 1.0


def test_a_larger_photo_is_the_same_square() -> None:
    photo, face = portrait()[0], portrait_face()
    size = (5 * photo.shape[1], 5 * photo.shape[0])
    large = np.asarray(Image.fromarray(photo).resize(size, Image.Resampling.BICUBIC))
    marks = 5.0 * face.landmarks + 2.0
    away = np.abs(square(photo, face.landmarks).astype(int) - square(large, marks))
    assert np.mean(away) < 2.0


def test_the_square_is_what_mediapipe_shows_its_network(photo, collins, model) -> None:
    """From it the network's last layer makes the landmarks that MediaPipe finds."""
    cv2 = pytest.importorskip("cv2")
    with zipfile.ZipFile(model) as file:
        data = np.frombuffer(file.read("face_landmarks_detector.tflite"), np.uint8)
    net = cv2.dnn.readNetFromTFLite(data)
    net.setInput(cv2.dnn.blobFromImage(square(photo, collins.landmarks), 1.0 / 255.0))
    marks = net.forward("Identity").reshape(-1, 3)[:, :2]
    own = collins.landmarks[:, :2] - collins.landmarks[:, :2].mean(axis=0)
    found = marks - marks.mean(axis=0)
    x, y = collins.across
    found = found @ np.array([[x, y], [-y, x]])
    scale = np.linalg.norm(own) / np.linalg.norm(found)
    away = np.linalg.norm(scale * found - own, axis=1).mean()
    assert away < 0.02 * collins.eye_distance


def test_a_mirrored_photo_has_mirrored_traits(network) -> None:
    photo, face = portrait()[0], portrait_face()
    marks = face.landmarks * (-1.0, 1.0, 1.0) + (photo.shape[1], 0.0, 0.0)
    # The outer corners of the eyes, by which the square is turned, change places.
    marks[[33, 263]] = marks[[263, 33]]
    own, mirrored = (
        find_traits(network, pixels, places)
        for pixels, places in ((photo, face.landmarks), (photo[:, ::-1], marks))
    )
    np.testing.assert_allclose(mirrored, own * reading().signs, atol=0.25)
    assert np.linalg.norm(own - mirrored * reading().signs) < 0.2 * np.linalg.norm(own)


def test_faces_that_are_found_have_traits(collins) -> None:
    assert collins.traits is not None
    np.testing.assert_allclose(collins.traits, portrait_face().traits, atol=0.05)
    assert np.abs(collins.traits).max() < 4.0


def test_traits_outlive_what_spoils_a_photo(network) -> None:
    photo, face = portrait()[0], portrait_face()
    own = find_traits(network, photo, face.landmarks)
    for seed in range(4):
        # Askew as well: by up to seven pixels of 256.
        worse = find_traits(network, spoiled(photo, np.random.default_rng(seed)), face.landmarks)
        likeness = own @ worse / np.linalg.norm(own) / np.linalg.norm(worse)
        assert likeness > 0.6


def test_spoiling_keeps_the_shape_and_changes_the_picture() -> None:
    photo = portrait()[0]
    worse = spoiled(photo, np.random.default_rng(0))
    assert worse.shape == photo.shape
    assert worse.dtype == np.uint8
    assert 1.0 < np.abs(worse.astype(int) - photo).mean() < 80.0


@pytest.mark.parametrize("content", [b"", b"no model", b"PK" + bytes(40)])
def test_what_is_no_model_is_an_error(tmp_path, content: bytes) -> None:
    path = tmp_path / "face_landmarker.task"
    path.write_bytes(content)
    with pytest.raises(InputError, match=r"face_landmarker\.task"):
        Network(path)
