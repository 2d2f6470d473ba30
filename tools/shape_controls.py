"""Draw every shape control at both ends, for the docs: ``python tools/shape_controls.py``.

All pictures have one scale. ``python tools/shape_controls.py PLACE.png raking three-quarter`` draws
them elsewhere, under another light and from one side, to judge them by.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from PIL import Image

import pdeface
from pdeface.controls.shape import SHAPE_CONTROLS
from pdeface.pictures import contact_sheet
from pdeface.pictures.canvas import picture_of
from pdeface.pictures.ground import background_image, over
from pdeface.pictures.options import Options
from pdeface.pictures.picture import face_camera
from pdeface.pictures.styles import style_named

OUT = Path(__file__).resolve().parents[1] / "docs" / "pictures" / "shape-controls.png"
SIZE = (204, 262)
MESH = (109, 161)
PAIRS_IN_A_ROW = 5
# Room around the neutral face for those that grow.
ROOM = (1.1, 1.12, 1.0)
# Where a control is seen best; the others are seen from the front.
VIEWS = {
    "three-quarter": "browRidge eyeDepth cheekFullness jawAngle upperLipFullness lowerLipFullness",
    "profile": "foreheadProtrusion noseBridgeHeight noseTipProjection noseTipRotation "
    "mouthProtrusion chinProtrusion faceDepth",
}


def main(path: Path = OUT, light: str = "studio", view: str | None = None) -> None:
    best = {name: each for each, names in VIEWS.items() for name in names.split()}
    pictures, captions = [], []
    for name in SHAPE_CONTROLS:
        seen = view or best.get(name, "front")
        pictures += [picture(name, weight, seen, light) for weight in (-1.0, 1.0)]
        captions += [f"{name} -1", "+1"]
    step = 2 * PAIRS_IN_A_ROW
    starts = range(0, len(pictures), step)
    sheet = contact_sheet(
        [pictures[s : s + step] for s in starts],
        [captions[s : s + step] for s in starts],
        gap=4,
        letters=12,
    )
    # Clay has few colours: a palette makes the file a third as large.
    Image.fromarray(sheet).quantize(200, dither=Image.Dither.NONE).save(path, optimize=True)
    print(f"{path.name}: {path.stat().st_size / 1024:.0f} kB")


def picture(name: str, weight: float, view: str, light: str) -> np.ndarray:
    """The neutral face with one control, at the scale of all others."""
    face = pdeface.neutral("55x92")
    frame = face.with_curves(face.curves.with_points(face.curves.points * ROOM))
    size = (2 * SIZE[0], 2 * SIZE[1])
    camera = face_camera(frame, view, size)
    _, draw = style_named("shaded", face)
    drawn = draw(face.set(**{name: weight}), camera, Options(mesh=MESH, light=light))
    image = over(picture_of(drawn, camera, size), background_image("white", size))
    return np.asarray(Image.fromarray(image).resize(SIZE, Image.Resampling.LANCZOS))


if __name__ == "__main__":
    main(*(Path(a) if i == 0 else a for i, a in enumerate(sys.argv[1:])))
