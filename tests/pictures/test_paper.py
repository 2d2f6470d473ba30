from __future__ import annotations

import importlib
import re
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import pdeface
from pdeface import texture
from pdeface.controls.shape import SHAPE_CONTROLS
from pdeface.curves import BoundaryCurves
from pdeface.errors import InputError
from pdeface.face import Face, neutral
from pdeface.pictures.paper import PAGE, paper
from pdeface.pictures.paper.diagram import Box, Chart
from pdeface.pictures.paper.figure1 import four_curves, largest_gap, surfaces
from pdeface.pictures.paper.figure3 import creases
from pdeface.pictures.paper.figure4 import ARROWS, boxes
from pdeface.pictures.paper.figure5 import window_around
from pdeface.pictures.paper.figure6 import largest_miss
from pdeface.pictures.paper.figure8 import extremes, folded_cells, moved_by
from pdeface.pictures.paper.figure9 import BLINK, moved_by_side
from pdeface.pictures.paper.overlay import Overlay, mesh_lines
from pdeface.texture import UVTexture, portrait, uv_texture

from .conftest import head_points

NUMBERS = (1, 2, 3, 4, 5, 6, 8, 9)


@pytest.fixture(scope="module")
def redrawn(tmp_path_factory: pytest.TempPathFactory) -> tuple[list[Path], list[str]]:
    told: list[str] = []
    folder = tmp_path_factory.mktemp("paper") / "new" / "folder"
    return paper(folder, progress=told.append), told


@pytest.fixture(scope="module")
def steps() -> UVTexture:
    return uv_texture(*portrait())


def test_every_figure_is_a_file_and_the_page_names_it(
    redrawn: tuple[list[Path], list[str]],
) -> None:
    files, told = redrawn
    assert [path.name for path in files] == [*(f"figure-{n}.png" for n in NUMBERS), PAGE]
    assert sorted(path.name for path in files[0].parent.iterdir()) == sorted(
        path.name for path in files
    )
    text = files[-1].read_text(encoding="utf-8")
    for number in NUMBERS:
        assert f"## Fig. {number}\n" in text
        assert f"](figure-{number}.png)" in text
    assert text.count("**Agrees**") == text.count("**Differs**") == len(NUMBERS)
    assert [int(re.findall(r"\d+", line)[0]) for line in told] == list(NUMBERS)


def test_no_panel_of_a_figure_is_blank(redrawn: tuple[list[Path], list[str]]) -> None:
    for path in redrawn[0][:-1]:
        image = np.asarray(Image.open(path).convert("L")).astype(float)
        assert image.shape[0] >= 800
        assert image.shape[1] >= 1000
        for part in np.array_split(image, 3, axis=1):
            assert part.std() > 8.0


def test_bloor_and_wilson_miss_two_curves_and_the_face_form_none() -> None:
    curves = four_curves()
    blend, through = surfaces(curves)
    assert largest_gap(through, curves) < 1e-12
    assert largest_gap(blend, curves) > 0.005
    for end, curve in ((0.0, 0), (1.0, 3)):
        v = (np.arange(curves.shape[1]) + 0.5) * 2 * np.pi / curves.shape[1]
        np.testing.assert_allclose(blend(end, v), curves[curve], atol=1e-12)


def test_the_patchwise_join_has_creases_and_the_smooth_one_none() -> None:
    face = Face(BoundaryCurves.from_half(head_points(28), 0.0))
    assert creases(face, "smooth").max() < 1e-5
    assert creases(face, "patchwise").max() > 0.05
    assert creases(face, "patchwise").size == 8 * 181


def test_the_grid_fits_eyes_and_mouth_and_misses_the_rest(steps: UVTexture) -> None:
    """What Fig. 6(b) shows: eye centres on the grid, mouth corners on its horizontal."""
    placed = steps.grid(steps.targets[..., 0], steps.targets[..., 1])
    eyes = steps.points.array[1, [1, 3]]
    apart = np.linalg.norm(eyes[1] - eyes[0])
    assert np.abs(placed[1, [1, 3]].mean(axis=0) - eyes.mean(axis=0)).max() < 0.02 * apart
    assert largest_miss(steps) > 0.05 * apart


def test_the_flowchart_names_code_that_there_is(steps: UVTexture) -> None:
    named = [box.code for box in boxes(neutral(), steps).values() if box.code]
    assert len(named) > 10
    for code in named:
        first, *rest = code.split(".")
        found = getattr(pdeface, first, None) or getattr(texture, first, None)
        found = found or importlib.import_module(f"pdeface.{first}")
        for name in rest:
            fields = getattr(found, "__dataclass_fields__", {})
            found = fields[name] if name in fields else getattr(found, name)


def test_the_flowchart_leads_from_curves_and_photo_to_the_textured_face(steps: UVTexture) -> None:
    placed = boxes(neutral(), steps)
    after: dict[str, set[str]] = {name: set() for name in placed}
    for start, out, end, into in ARROWS:
        after[start].add(end)
        assert placed[start].side(out) != placed[end].side(into)
    assert [name for name, ends in after.items() if not ends] == ["file", "picture"]

    def reached(name: str, seen: frozenset[str] = frozenset()) -> frozenset[str]:
        for end in after[name] - seen:
            seen = reached(end, seen | {end})
        return seen

    for start in ("curves", "photo", "uvmesh"):
        assert {"face", "file", "picture"} <= reached(start)
    assert set(placed) == {"photo", "uvmesh"} | reached("curves") | reached("photo")


def test_an_arrow_ends_where_its_box_begins() -> None:
    box = Box("text", "", (150.0, 60.0), (100.0, 40.0), "data")
    chart = Chart((220, 120))
    chart.arrow([(20.0, 60.0), box.side("left")])
    chart.box(box)
    image = chart.image().astype(int)
    assert (image[60, 25] < 140).all()
    assert (image[60, 97] < 140).all()
    assert image[45, 110].min() < 255
    assert image[100, 150].tolist() == [255, 255, 255]


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_all_sliders_at_their_ends_exaggerate_the_face_and_fold_nothing(sign: float) -> None:
    face = neutral()
    weights = {name: sign * end for name, end in extremes(face.curves).items()}
    assert {abs(end) for end in weights.values()} == {1.0}
    assert set(weights) == set(SHAPE_CONTROLS)
    far = face.with_weights(weights)
    assert moved_by(far).max() > 0.02
    assert folded_cells(far.mesh()) == folded_cells(far.mesh(109, 161)) == 0


def test_no_slider_at_its_other_end_would_change_the_profile_more() -> None:
    face = neutral()
    ends = extremes(face.curves)

    def change(weights: dict[str, float]) -> float:
        """What the best affine map of the profile leaves of the displacement."""
        before, after = (
            f.curves.half[..., 1:].reshape(-1, 2)
            for f in (face, Face(face.with_weights(weights).moved_curves))
        )
        design = np.column_stack([np.ones(len(before)), before])
        return float(np.linalg.lstsq(design, after - before)[1].sum())

    best = change(ends)
    assert all(change({**ends, name: -end}) <= best for name, end in ends.items())


def test_a_folded_cell_is_counted() -> None:
    mesh = neutral().mesh()
    assert folded_cells(mesh) == 0
    mesh.vertices.reshape(28, 41, 3)[10, 20] = mesh.vertices.reshape(28, 41, 3)[10, 23]
    assert folded_cells(mesh) > 0


def test_only_the_right_eye_blinks() -> None:
    face = neutral()
    right, left = moved_by_side(face, face.with_weights(BLINK))
    assert right > 5.0
    assert left < 0.5


def test_a_face_of_other_curves_is_refused(tmp_path: Path, head: Face) -> None:
    with pytest.raises(InputError, match="28 curves"):
        paper(tmp_path, head)
    assert list(tmp_path.iterdir()) == []


def test_a_folder_that_cannot_be_is_refused(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(InputError, match="folder"):
        paper(tmp_path / "file" / "folder", Face(BoundaryCurves.from_half(head_points(28), 0.0)))


def test_an_overlay_puts_dots_where_the_photo_has_their_points() -> None:
    photo = np.full((100, 80, 3), 128, np.uint8)
    overlay = Overlay(photo, (20.0, 30.0, 60.0, 70.0), (400, 400))
    overlay.dots(np.array([[30.0, 60.0]]), (255, 0, 0), 11.0)
    image = overlay.image().astype(int)
    red = np.argwhere(image[..., 0] - image[..., 1] > 100)
    np.testing.assert_allclose(red.mean(axis=0), [300.0, 100.0], atol=1.0)
    assert image[10, 10].tolist() == [128, 128, 128]


def test_an_overlay_shows_the_photo_upright_and_in_place() -> None:
    photo = np.zeros((40, 60, 3), np.uint8)
    photo[:20, :30] = (255, 0, 0)
    image = Overlay(photo, (0.0, -10.0, 60.0, 50.0), (120, 120)).image().astype(int)
    assert image[5, 60].tolist() == [255, 255, 255]
    assert image[40, 30].tolist() == [255, 0, 0]
    assert image[40, 90].tolist() == [0, 0, 0]
    assert image[80, 30].tolist() == [0, 0, 0]


def test_a_mesh_is_drawn_by_its_rows_and_columns() -> None:
    lines = mesh_lines(np.arange(24.0).reshape(3, 4, 2))
    assert sorted(line.shape for line in lines) == [(3, 2)] * 4 + [(4, 2)] * 3


def test_a_window_holds_its_points_and_stays_in_the_photo() -> None:
    photo = np.zeros((300, 200, 3), np.uint8)
    left, top, right, bottom = window_around(np.array([[5.0, 50.0], [60.0, 120.0]]), photo)
    assert left >= 0.0
    assert left <= 5.0
    assert right >= 60.0
    assert top <= 50.0
    assert bottom >= 120.0
    assert right - left == pytest.approx(bottom - top)
