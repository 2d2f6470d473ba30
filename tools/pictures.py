"""Draw the pictures of the README and the docs: ``python tools/pictures.py``."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from PIL import Image

import pdeface
from pdeface.photo import photo_report, portrait_person
from pdeface.pictures import contact_sheet, demo_sheet, render

OUT = Path(__file__).resolve().parents[1] / "docs" / "pictures"
EXPRESSIONS = {
    "neutral": {},
    "blink": {"eyeBlinkLeft": 1.0, "eyeBlinkRight": 1.0},
    "smile": {"mouthSmileLeft": 1.0, "mouthSmileRight": 1.0},
    "jaw open": {"jawOpen": 1.0},
    "funnel": {"mouthFunnel": 1.0},
    "surprise": {
        **{"browInnerUp": 1.0, "browOuterUpLeft": 1.0, "browOuterUpRight": 1.0, "jawOpen": 0.3},
        **{"eyeWideLeft": 1.0, "eyeWideRight": 1.0},
    },
}


def save(pixels: np.ndarray, name: str, width: int) -> None:
    image = Image.fromarray(pixels)
    height = round(image.height * width / image.width)
    image = image.resize((width, height), Image.Resampling.LANCZOS).convert("RGB")
    image.save(OUT / name, optimize=True, quality=88)
    print(f"{name}: {(OUT / name).stat().st_size / 1024:.0f} kB")


def levels() -> np.ndarray:
    views = ("front", "three-quarter", "profile")
    how = {"style": "shaded", "light": "raking", "mesh": (541, 321), "size": (480, 600)}
    faces = {level: pdeface.neutral(level) for level in ("28x46", "55x92", "109x184")}
    rows = [[render(face, view=view, **how) for view in views] for face in faces.values()]
    return contact_sheet(rows, [[f"{level}, {view}" for view in views] for level in faces])


def expressions(face: pdeface.Face) -> np.ndarray:
    people = [face, pdeface.random(4), pdeface.random(5)]
    how = {"view": 20, "mesh": (217, 161), "size": (360, 450)}
    rows = [[render(person.set(**w), **how) for w in EXPRESSIONS.values()] for person in people]
    return contact_sheet(rows, [list(EXPRESSIONS)] * len(people))


def main() -> None:
    OUT.mkdir(parents=True, exist_ok=True)
    face, views = portrait_person()
    save(demo_sheet(face), "demo.png", 1320)
    save(levels(), "levels.png", 1200)
    save(expressions(face), "expressions.png", 1320)
    save(photo_report(face, views), "report.jpg", 1320)


if __name__ == "__main__":
    main()
