"""The studio used by hand in a real browser: state and pixels."""

from __future__ import annotations

import json
import math
import os
import shutil
import subprocess
import sys
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

import pdeface
from pdeface.controls import CONTROLS
from pdeface.formats import part_on_mesh
from pdeface.motion import read
from pdeface.parts import FaceParts
from pdeface.photo.camera import PhotoCamera
from pdeface.studio import assets
from pdeface.texture import portrait

HERE = Path(__file__).parent
PROGRAMS = ("chromium", "chromium-browser", "google-chrome")
TILT = 0.2
"""Radians by which the camera's person tips her head."""

MODEL = Path("models", "face_landmarker.task")
SEEN = 200
"""Pixels, of some 300,000."""

ALIKE = 1e-5
"""Metres, between the page's sum in single precision and the library."""


def missing() -> str | None:
    """What is not there to run a browser, and how to get it."""
    if shutil.which("node") is None:
        return "Node.js is not installed"
    if not (HERE.parent / "browser" / "node_modules" / "playwright-core").is_dir():
        return "Playwright is not installed; run: npm ci --prefix tests/browser"
    if not any(map(shutil.which, PROGRAMS)):
        return f"no browser is installed; one of {', '.join(PROGRAMS)} is needed"
    try:
        assets.folder()
    except pdeface.PDEFaceError as error:
        return str(error)
    return None


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("studio")


@pytest.fixture(scope="module")
def person() -> pdeface.Face:
    rows, columns = np.indices((64, 64))
    texture = np.stack([200 - rows, 150 + columns // 2, 120 + rows // 2], axis=-1)
    return pdeface.neutral().with_name("Ada").with_texture(texture.astype(np.uint8))


@pytest.fixture(scope="module")
def report(folder: Path, person: pdeface.Face) -> dict[str, Any]:
    """What the one visit of the browser found."""
    if reason := missing():
        if os.environ.get("CI", "").lower() == "true":
            pytest.fail(reason)
        pytest.skip(reason)
    browser = next(filter(None, map(shutil.which, PROGRAMS)))
    person.save(folder / "ada.pdeface")
    source = [str(folder / "ada.pdeface"), str(folder)]
    command = ["node", str(HERE / "browser.mjs"), browser, sys.executable, *source]
    pdeface.export(person, folder / "scan.ply", mesh=(109, 161))
    write_camera(folder / "camera.y4m")
    model = Path(os.environ.get("PDEFACE_SHARED") or HERE.parents[2] / "shared") / MODEL
    told = {"PDEFACE_MODEL": str(model)} if model.is_file() else {}
    answer = subprocess.run(
        command, capture_output=True, text=True, check=False, timeout=1200,
        env={**os.environ, **told},
    )  # fmt: skip
    assert answer.returncode == 0, answer.stderr
    found: dict[str, Any] = json.loads(answer.stdout)
    return found


def skin(face: pdeface.Face) -> np.ndarray:
    return face.mesh(28, 41).vertices


def test_nothing_is_complained_of_and_nothing_asked_of_the_network(report) -> None:
    assert report["complaints"] == []


def test_the_first_screen_says_what_is_where_once(report) -> None:
    tour = report["tour"]
    boxes = np.array(tour["boxes"])
    assert len(boxes) == tour["again"] == 5
    assert boxes.min() >= 0
    assert (boxes[:, 2] <= tour["view"]["width"]).all()
    assert (boxes[:, 3] <= tour["view"]["height"]).all()
    for n, one in enumerate(boxes):
        for other in boxes[n + 1 :]:
            across = min(one[2], other[2]) - max(one[0], other[0])
            down = min(one[3], other[3]) - max(one[1], other[1])
            assert min(across, down) <= 0
    assert tour["left"] == 0
    assert report["recovered"]["again"] == 0


def test_every_way_of_showing_looks_different(report) -> None:
    modes = report["modes"]
    assert modes["covered"] > 20_000
    assert modes["back"] == 0
    ways = ("Shaded", "Curvature", "Wireframe", "UV mesh", "Curves")
    assert {way: modes[way] for way in ways if modes[way] < 1000} == {}


def test_the_paper_s_join_is_shown_as_well(report) -> None:
    found = report["modes"]["patchwise"]
    assert found["seen"] > SEEN
    paper = pdeface.neutral().mesh(28, 41, join="patchwise").vertices
    np.testing.assert_allclose(np.reshape(found["skin"], (-1, 3)), paper, atol=ALIKE)


def test_the_camera_moves_by_keys_and_by_dragging(report) -> None:
    views = report["views"]
    assert views.pop("orthographic") is True
    assert {name: count for name, count in views.items() if count < 1000} == {}


def test_a_gesture_on_a_slider_is_one_step(report) -> None:
    slider = report["slider"]
    assert slider["weight"] == pytest.approx(0.8, abs=0.08)
    assert (slider["held"], slider["one"]) == (0, 1)
    assert slider["moved"] > SEEN


def test_undo_and_redo_bring_back_what_was_seen(report) -> None:
    assert report["slider"]["undone"] == [0, 0]
    assert report["slider"]["redone"] == report["slider"]["weight"]


def test_numbers_are_exact_and_a_double_click_resets(report) -> None:
    assert report["slider"]["exact"] == 0.4
    assert report["slider"]["reset"] == 0


def test_the_page_s_own_sum_is_the_library_s_surface(report, person) -> None:
    linear = report["slider"]["linear"]
    assert len(linear["weights"]) == 4
    found = np.reshape(linear["skin"], (-1, 3))
    expected = skin(person.with_weights(linear["weights"]))
    np.testing.assert_allclose(found, expected, atol=ALIKE)
    assert np.abs(expected - skin(person)).max() > 100 * ALIKE


def test_a_wide_eye_blinks_shut(report, person) -> None:
    """The server's word, with lids in contact, takes the place of the sum."""
    contact = report["contact"]
    assert contact["weights"]["eyeBlinkLeft"] == 1
    found = np.reshape(contact["skin"], (-1, 3))
    np.testing.assert_allclose(found, skin(person.with_weights(contact["weights"])), atol=ALIKE)


def test_lids_and_lips_keep_company_while_the_page_moves_them_alone(report, person) -> None:
    company = report["company"]
    done = person.with_weights(company["weights"])
    np.testing.assert_allclose(np.reshape(company["skin"], (-1, 3)), skin(done), atol=5e-5)
    # The eye looks down as far as it is told, whatever the lid leaves of it: 6 mm of its front.
    # Where the eye is in another person the page knows only about.
    eye = part_on_mesh(FaceParts.parts["left_eyeball"], 28)
    expected = eye.positions(FaceParts(done).curves("left_eyeball"))
    np.testing.assert_allclose(np.reshape(company["eye"], (-1, 3)), expected, atol=5e-4)


def test_what_concerns_many_controls_at_once(report) -> None:
    controls = report["controls"]
    assert set(controls["resetExpression"]) == {"identity03"}
    assert controls["preset"]["mouthSmileLeft"] == 0.75
    assert controls["random"] > 40
    assert controls["resetShape"] == []


def test_search_finds_and_symmetry_pairs(report) -> None:
    controls = report["controls"]
    assert controls["searched"] == ["eyeBlinkLeft"]
    left, right = controls["symmetric"]
    assert left == right > 0
    left, right = controls["oneSided"]
    assert left > right > 0
    assert controls["bothShown"] == 2


def test_theme_and_help(report) -> None:
    assert report["controls"]["theme"] in ("dark", "light")
    assert report["controls"]["help"] > 20


def test_a_clip_plays_and_leaves_no_trace(report) -> None:
    motion = report["motion"]
    assert motion["name"] == "blink"
    assert motion["playing"] is False
    assert motion["again"] == [True, True], "the space bar plays, whatever was clicked before"
    assert motion["shut"] > SEEN
    assert motion["jaw"] == 0
    assert motion["turned"]
    assert motion["back"] == 0
    assert motion["weights"] == {}


def test_a_dragged_curve_is_the_library_s_surface(report) -> None:
    sculpt = report["sculpt"]
    live, exact = np.array(sculpt["live"]), np.array(sculpt["exact"])
    np.testing.assert_allclose(live, exact, atol=ALIKE)
    assert sculpt["moved"] > SEEN
    assert sculpt["undone"] == 0
    assert sculpt["label"] == "Curve 21"


def test_a_curve_is_dragged_as_a_whole(report) -> None:
    whole = report["sculpt"]["whole"]
    np.testing.assert_allclose(whole["live"], whole["exact"], atol=ALIKE)
    moved = np.subtract(whole["after"], whole["before"]).reshape(28, 46, 3)[:, :23]
    length = np.linalg.norm(moved, axis=2)
    assert length[20].min() > 1e-3
    np.testing.assert_allclose(length, length[:, :1].repeat(23, axis=1), atol=2e-6)
    assert (np.diff(length[17:21, 0]) > 0).all()
    assert (np.diff(length[20:24, 0]) < 0).all()
    assert length[:16].max() == 0


def test_controls_are_muted_heard_alone_and_locked(report) -> None:
    marks = report["marks"]
    assert marks["kept"] == 0.6
    assert (marks["muted"], marks["solo"], marks["group"]) == (0, 0, 0)
    assert marks["heard"] > SEEN
    assert marks["locked"] and marks["unlocked"]
    assert marks["reset"] == {"jawOpen": 0.6}
    assert marks["copied"] == 0.5


def test_points_of_a_photo_make_a_texture(report) -> None:
    photo = report["photo"]
    assert photo["points"] >= 25
    assert photo["moved"] == pytest.approx(2.75)  # of 256 pixels: ten steps of a quarter, and one
    assert photo["loupe"]
    assert photo["dragged"] < photo["moved"]
    assert photo["mesh"] == 2 * 7 * 6
    ways = np.array(photo["projected"], int), np.array(photo["warped"], int)
    assert 2 < np.abs(ways[0] - ways[1]).mean() < 60
    assert photo["seen"] > 5000


def test_the_photo_lies_behind_the_face_where_its_camera_saw_it(report) -> None:
    behind = report["behind"]
    camera = behind["photo"]["camera"]
    known = PhotoCamera(
        np.reshape(camera["rotation"], (3, 3)),
        camera["scale"],
        np.array(camera["centre"]),
        camera["distance"],
    )
    for moment in ("before", "after"):
        seen = np.array(behind[moment])
        np.testing.assert_allclose(seen[:, 3:], known.project(seen[:, :3]), atol=0.02)
    assert behind["turned"] > SEEN
    assert behind["opacity"] == "0.25"
    assert behind["calm"] > SEEN
    assert (behind["back"], behind["hidden"]) == (0, True)


def test_no_serious_barrier_is_found(report) -> None:
    assert report["barriers"]["passed"] > 15
    assert report["barriers"]["found"] == []


def test_before_and_after_and_a_film(report, folder: Path) -> None:
    assert report["shown"]["compared"] > SEEN
    assert report["shown"]["back"] == 0
    film = (folder / "blink.webm").read_bytes()
    assert film.startswith(b"\x1a\x45\xdf\xa3")
    assert len(film) > 2000


@pytest.mark.usefixtures("model")
def test_the_webcam_moves_the_face_and_is_kept_as_a_clip(report, folder: Path) -> None:
    camera = report["camera"]
    assert camera["smile"] > 0.4
    assert camera["moved"] > SEEN
    rolls, mirrored = np.array(camera["seen"]).T
    assert np.ptp(rolls) == pytest.approx(TILT, abs=0.05)
    np.testing.assert_allclose(mirrored, -rolls, atol=1e-6)
    assert (camera["back"], camera["ended"]) == (0, True)
    track = read(folder / "take.json")
    assert camera["file"] == "take-1.json"
    assert list(track.names) == camera["clip"]["names"]
    assert set(track.names) <= {n for n, c in CONTROLS.items() if c.kind == "expression"}
    smile = track.weights_of(["mouthSmileLeft"])
    assert smile.max() > 0.4
    assert smile[-1] < 0.1  # after this face was said to be the neutral one
    assert np.ptp(track.head[:, 2]) == pytest.approx(TILT, abs=0.05)


def write_camera(path: Path) -> None:
    """What the camera sees: two seconds of the portrait upright, two of it tilted, and again."""
    photo = Image.fromarray(portrait()[0]).resize((480, 480))
    pictures = []
    for angle in (0.0, math.degrees(TILT)):
        picture = Image.new("RGB", (640, 480), (120, 120, 120))
        picture.paste(photo.rotate(angle, Image.Resampling.BICUBIC, fillcolor=(120,) * 3), (80, 0))
        light, blue, red = picture.convert("YCbCr").split()
        halves = [plane.resize((320, 240)).tobytes() for plane in (blue, red)]
        pictures.append(b"FRAME\n" + light.tobytes() + b"".join(halves))
    with path.open("wb") as file:
        file.write(b"YUV4MPEG2 W640 H480 F10:1 Ip A1:1 C420jpeg\n")
        for picture in pictures:
            file.writelines([picture] * 20)


@pytest.mark.usefixtures("model")
def test_a_scan_is_fitted_and_measured(report) -> None:
    scan = report["scan"]
    assert scan["steps"] > 4
    assert (scan["name"], scan["mode"]) == ("person", "distance")
    rounds, faces, moved = zip(*scan["watched"], strict=True)
    assert max(rounds) > 15, "the face was seen on its way"
    assert [face for n, face in zip(rounds, faces, strict=True) if n < max(rounds) and face] == []
    assert max(moved) > 5000
    assert scan["left"] == [True, 0]
    assert "RMS 0." in scan["legend"]
    near, far = (np.array(scan[moment]) for moment in ("away", "farther"))
    assert np.median(near[near >= 0]) < 0.1
    assert (far - near).max() > 0.5, "the nose is longer than on the scan, in millimetres"
    assert scan["coloured"] > SEEN
    assert scan["unveiled"] == 0
    assert (scan["after"], scan["offered"]) == ("textured", False)


def test_a_clip_is_filmed_frame_by_frame(report, folder: Path, ffmpeg: str) -> None:
    assert report["shown"]["clip"] == "Ada-blink.mp4"
    assert report["shown"]["size"][0] == report["shown"]["size"][1]
    frames = decoded(ffmpeg, folder / "clip.mp4", (480, 600))
    assert len(frames) == 30
    skin = frames[0] != frames[0][0, 0]
    assert 0.2 < skin.mean() < 0.8
    # The lids close and open: the eyes differ in the middle of the film and are back at its end.
    away = [np.abs(frame.astype(int) - frames[0]).mean() for frame in frames]
    assert max(away[3:20]) > 4 * max(away[1], away[-1])


def test_a_turntable_turns_all_the_way_round(report, folder: Path, ffmpeg: str) -> None:
    assert report["shown"]["turn"] == "Ada-turntable.mp4"
    assert report["shown"]["turnedBack"] == pytest.approx(0, abs=1e-6)
    frames = decoded(ffmpeg, folder / "turn.mp4", (480, 600))
    assert len(frames) == 6 * 30
    back = frames[0][0, 0].astype(int)
    solid = np.array([np.abs(frame.astype(int) - back).max(axis=2) > 24 for frame in frames])
    areas = solid.mean(axis=(1, 2))
    assert areas.min() > 0.1
    # What is seen from one side is seen from the other as in a mirror; from the front and from
    # behind much, from the sides less.
    for degrees in (40, 90, 130):
        one, other = solid[degrees // 2], solid[180 - degrees // 2][:, ::-1]
        assert (one ^ other).mean() < 0.02 * areas.max()
    assert areas[45] < 0.8 * areas[0]
    assert areas[90] > 0.9 * areas[0]
    # It turns on and on, at one speed, and from the last picture into the first.
    steps = [np.abs(a.astype(int) - b).mean() for a, b in pairwise([*frames, frames[0]])]
    assert min(steps) > 0.2 * np.median(steps)
    assert steps[-1] < 1.5 * max(steps[:-1])


def decoded(ffmpeg: str, path: Path, size: tuple[int, int]) -> np.ndarray:
    command = [ffmpeg, "-v", "error", "-i", str(path), "-f", "rawvideo", "-pix_fmt", "rgb24", "-"]
    raw = subprocess.run(command, capture_output=True, check=True).stdout
    return np.frombuffer(raw, np.uint8).reshape(-1, size[1], size[0], 3)


def test_saved_and_exported_files_are_what_was_shown(report, folder: Path) -> None:
    files = report["files"]
    assert (files["saved"], files["glb"], files["still"]) == ("Ada.pdeface", "Ada.glb", "Ada.png")
    saved = pdeface.load(folder / "saved.pdeface")
    assert dict(saved.weights) == {"noseWidth": 0.5, "jawOpen": 0.25}
    assert (folder / "out.glb").read_bytes().startswith(b"glTF")
    with Image.open(folder / "still.png") as still:
        alpha = np.asarray(still.convert("RGBA"))[..., 3]
    assert (alpha == 0).any()
    assert (alpha == 255).any()


def test_files_are_opened_and_refused_by_what_they_are(report) -> None:
    files = report["files"]
    assert files["opened"] == ["Cy", {"browInnerUp": 1}]
    assert "got something else" in files["refused"]
    assert files["blended"] == ["Blend 25 %", {"browInnerUp": 0.75, "noseWidth": 0.25}]
    assert files["recording"][0] == "take"
    assert files["recording"][1] > 0.4


def test_sliders_live_on_without_the_server_and_it_is_told_anew(report) -> None:
    alone = report["alone"]
    assert alone["moved"] > SEEN
    assert "start pdeface studio again" in alone["told"]
    assert alone["weights"]["noseLength"] == 0.5


def test_a_lost_graphics_card_is_told_of_and_comes_back(report) -> None:
    assert report["lost"] == {"told": True, "back": 0}


def test_a_reload_loses_nothing(report) -> None:
    assert report["recovered"]["after"] == report["recovered"]["before"]
    assert report["recovered"]["before"][0] > 5


@pytest.mark.usefixtures("model")
def test_what_is_worked_on_is_waited_for_over_a_reload(report) -> None:
    assert report["waited"] == {"name": "again", "label": "Open again.ply"}


def test_fingers_turn_zoom_and_move_the_stage(report) -> None:
    stage = report["touch"]["stage"]
    before, turned, pinched, moved = (stage[n] for n in ("before", "turned", "pinched", "moved"))
    assert min(each["changed"] for each in (turned, pinched, moved)) > 1000
    assert turned["azimuth"] - before["azimuth"] < -0.3
    assert turned["distance"] == pytest.approx(before["distance"])
    assert turned["target"] == pytest.approx(before["target"])
    assert pinched["distance"] < 0.75 * before["distance"]
    assert pinched["azimuth"] == pytest.approx(turned["azimuth"], abs=0.02)
    assert moved["distance"] == pytest.approx(pinched["distance"], rel=0.02)
    # The fingers go down 70 pixels and the face with them: the camera looks at a place above it.
    # The first of six moves says only that there are two fingers.
    metres = 2.0 * pinched["distance"] * math.tan(math.radians(11.0)) / pinched["height"]
    up = moved["target"][1] - pinched["target"][1]
    assert up == pytest.approx(70 * metres, rel=0.25)


def test_a_finger_drags_a_point_of_a_curve_and_nothing_turns(report) -> None:
    sculpt = report["touch"]["sculpt"]
    assert sculpt["label"].startswith("Curve")
    assert sculpt["turned"] == 0
    down = sculpt["live"]["y"] - sculpt["before"]["y"]
    assert down == pytest.approx(30, abs=3)
    assert sculpt["after"]["y"] == pytest.approx(sculpt["live"]["y"], abs=0.5)


def test_fingers_magnify_and_move_the_photo_and_drag_its_points(report) -> None:
    photo = report["touch"]["photo"]
    whole, pinched, moved = (np.array(photo[n]) for n in ("whole", "pinched", "moved"))
    assert whole[:2] == pytest.approx(0)
    assert pinched[2] == pytest.approx(whole[2] / 2.5, rel=0.05)
    pixel = pinched[2] / photo["wide"]
    np.testing.assert_allclose(moved - pinched, [-30 * pixel, -40 * pixel, 0, 0], atol=2 * pixel)
    assert photo["over"][2] == pytest.approx(photo["face"][2] / 2.0, rel=0.05)
    assert photo["loupe"] and photo["gone"]
    pixel = photo["face"][2] / photo["wide"]
    by = np.subtract(photo["dragged"], photo["point"])
    np.testing.assert_allclose(by, [20 * pixel, 10 * pixel], atol=1.5 * pixel)
    assert photo["still"] == photo["face"]


def test_fingers_magnify_and_move_the_photo_behind_the_face(report) -> None:
    behind = report["touch"]["behind"]
    assert behind["magnified"] == pytest.approx(2.0, rel=0.02)
    assert behind["moved"] == pytest.approx([30, 20], abs=1)


def test_everything_is_within_reach_on_a_tablet(report) -> None:
    assert report["touch"]["layout"] == [[], []]
