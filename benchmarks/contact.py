"""How well lids and lips meet: ``python -m benchmarks.contact [ICT_FACEKIT_FOLDER]``.

Not a timing. The gap of the left lids at a full blink, for docs/openings.md; and with the folder of
the measured head, how far beyond it upper lip and nose move when the jaw opens.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

import pdeface
from pdeface.controls import slits
from pdeface.controls.seams import nearest, seam
from pdeface.pde import PDESurface

LEVELS = ("28x46", "55x92")
OTHERS = ({}, {"eyeSquintLeft": 1.0}, {"eyeWideLeft": 1.0})
MIDDLE = slice(8, -8)


def main(head: str | None = None) -> None:
    print("gap of the lids at a full blink, mm: away from the corners, and at most anywhere")
    for level in LEVELS:
        for seed in (None, 0, 1, 2):
            face = pdeface.neutral(level) if seed is None else pdeface.random(seed, level)
            gaps = [lid_gap(face.set(eyeBlinkLeft=1.0, **others)) for others in OTHERS]
            row = ", ".join(f"{gap[MIDDLE].max():.2f} ({gap.max():.2f})" for gap in gaps)
            print(f"{level} {face.name}: alone, with squint, with wide: {row}")
    if head is not None:
        for level in LEVELS:
            print(f"{level} jawOpen: {overshoot(level, Path(head))}")


def lid_gap(face: pdeface.Face) -> np.ndarray:
    """(n,) distance of each place on the upper line to the lower line, mm."""
    moved = face.displacement
    lids = seam("left_eye", face.curves.shape)
    upper, lower = lids.lines(face.curves.points + moved.smooth, moved.parting)
    return 1000.0 * np.linalg.norm(upper - nearest(lower, upper), axis=1)


def overshoot(level: str, head: Path) -> str:
    """How much further than on the measured head rows 12 to 18 move."""
    from pdeface.controls.build.__main__ import SAMPLES, Sampler

    sampler, expressions = Sampler(head), np.load(head / "expressions.npz")
    index = [str(name) for name in expressions["names"]].index("jawOpen")
    source = np.linalg.norm(sampler.displacements(expressions["offsets_cm"][index]), axis=2)
    face = pdeface.neutral(level).set(jawOpen=1.0)
    moved, slit = face.displacement, slits(face.curves.shape[0])
    u = np.linspace(0.0, 1.0, SAMPLES[0])
    where = u[:, None], sampler.v
    surfaces = PDESurface(moved.smooth), PDESurface(moved.parting, continuity=slit)
    ours = np.linalg.norm(surfaces[0](*where) + surfaces[1](*where), axis=2)
    rows = (u * 27 >= 12) & (u * 27 <= 18)
    said = []
    for name, half_width in (("middle", 0.08), ("to beyond the corners", 0.2)):
        columns = np.abs(sampler.v / np.pi - 0.5) < half_width
        excess = 1000.0 * (ours - source)[np.ix_(rows, columns)]
        said.append(f"{name} {excess.max():.2f} mm, 95 % {np.percentile(excess, 95):.2f}")
    return "; ".join(said)


if __name__ == "__main__":
    main(*sys.argv[1:2])
