"""Landmarks by MediaPipe and from files."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import pdeface
from pdeface.errors import InputError
from pdeface.scan import find_landmarks, fit_scan, load_landmarks, make_scan, measure, read_scan
from pdeface.scan.alignment import align
from pdeface.scan.landmark_file import MULTI_PIE, known_places


@pytest.fixture(scope="module")
def head(shared_data: Path):
    pytest.importorskip("trimesh", reason="needs the extra 'scan'")
    return read_scan(shared_data / "data" / "makehuman" / "male_asian_young.obj")


UPRIGHT = np.eye(3)
TURNS = {
    "upright": UPRIGHT,
    "upside down": np.diag([-1.0, -1.0, 1.0]),
    "z up": np.array([[1.0, 0, 0], [0, 0, -1.0], [0, 1.0, 0]]),
    "from behind": np.diag([-1.0, 1.0, -1.0]),
    "anyhow": Rotation.from_euler("xyz", (40, 115, -70), degrees=True).as_matrix(),
}


@pytest.mark.parametrize("turn", TURNS)
def test_the_face_is_found_whichever_way_up(head, model, turn: str) -> None:
    scan = head.moved(TURNS[turn], 40.0, np.array([3.0, -8.0, 2.0]))
    found = align(find_landmarks(scan, model))
    angle = np.degrees(Rotation.from_matrix(found.rotation @ TURNS[turn]).magnitude())
    assert angle < 12.0
    assert 40.0 * found.scale == pytest.approx(1.0, abs=0.12)


def test_a_head_inside_out_is_fitted(head, model) -> None:
    measures = measure(fit_scan(head.inside_out(), model=model))
    assert measures.to_scan.rms < 0.25
    assert measures.normal < 4.0


def test_no_face_is_one_line(model) -> None:
    x, y = np.meshgrid(np.linspace(-1, 1, 40), np.linspace(-1, 1, 40))
    sheet = make_scan(np.stack([x.ravel(), y.ravel(), 0.2 * np.sin(3 * x * y).ravel()], 1))
    with pytest.raises(InputError, match="no face is found") as caught:
        find_landmarks(sheet, model)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("name", ["ball", "ring"])
def test_a_ball_and_a_ring_are_no_faces(name: str, model) -> None:
    creation = pytest.importorskip("trimesh.creation", reason="needs the extra 'scan'")
    mesh = creation.icosphere(4, 0.1) if name == "ball" else creation.torus(0.1, 0.04)
    with pytest.raises(InputError, match="no face is found"):
        find_landmarks(make_scan(np.array(mesh.vertices), np.array(mesh.faces)), model)


def test_landmarks_from_a_file(tmp_path: Path) -> None:
    surface = pdeface.neutral("55x92").surface()
    places = known_places()
    content = {n: surface(*places[n][:2]).tolist() for n in ("37", "40", "43", "46", "nose_tip")}
    path = tmp_path / "points.json"
    path.write_text(json.dumps(content))
    marks = load_landmarks(path)
    assert marks.points.shape == (5, 3)
    assert align(marks, 1.0).error < 0.5e-3
    listed = [surface(*places[str(n + 1)][:2]).tolist() for n in range(len(MULTI_PIE))]
    path.write_text(json.dumps([*listed[:-1], None]))
    assert len(load_landmarks(path).points) == len(MULTI_PIE) - 1


@pytest.mark.parametrize(
    ("content", "says"),
    [
        ("", "as JSON"),
        ("[]", "must hold an object"),
        ("3", "must hold an object"),
        ('{"elbow": [1, 2, 3]}', "names the point 'elbow'"),
        ('{"69": [1, 2, 3]}', "names the point '69'"),
        ('{"37": [1, 2]}', "three numbers"),
        ('{"37": [1, 2, NaN]}', "three numbers"),
        ('{"37": [1, 2, "x"]}', "three numbers"),
        ('{"37": [1, 2, 3]}', "at least 4 points"),
        ('{"37": [0,0,0], "40": [1,0,0], "43": [2,0,0], "46": [3,0,0]}', "not on one line"),
    ],
)
def test_a_file_that_is_none_is_refused(content: str, says: str, tmp_path: Path) -> None:
    path = tmp_path / "points.json"
    path.write_text(content)
    with pytest.raises(InputError, match=says) as caught:
        load_landmarks(path)
    assert "\n" not in str(caught.value)


def test_no_file_of_landmarks(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="found no file"):
        load_landmarks(tmp_path / "points.json")
