"""Draw the contact sheet of every expression: ``python tools/expressions.py [FACE]``."""

from __future__ import annotations

import sys
from pathlib import Path

from PIL import Image

import pdeface
from pdeface.controls import COMPANY, CONTROLS
from pdeface.photo import portrait_person
from pdeface.pictures import contact_sheet, render

OUT = Path(__file__).resolve().parents[1] / "docs" / "pictures" / "expressions-all.jpg"
A_ROW = 9
# A tongue comes out of an open mouth only.
COMPANIONS = {**COMPANY, "tongueOut": {"jawOpen": 0.5}}


def main() -> None:
    if len(sys.argv) > 1:
        face = pdeface.load(sys.argv[1])
    else:
        face, _ = portrait_person()
    names = [c.name for c in CONTROLS.values() if c.kind == "expression"]
    cells = []
    for name in names:
        posed = face.set(**{**COMPANIONS.get(name, {}), name: 1.0})
        cells.append(render(posed, view=15, mesh=(217, 161), size=(300, 360)))
    rows = [slice(k, k + A_ROW) for k in range(0, len(names), A_ROW)]
    sheet = contact_sheet([cells[row] for row in rows], [names[row] for row in rows])
    Image.fromarray(sheet).convert("RGB").save(OUT, quality=85, optimize=True)
    print(f"{OUT.name}: {OUT.stat().st_size / 1024:.0f} kB")


if __name__ == "__main__":
    main()
