"""How well lids and lips meet: ``python -m benchmarks.contact [ICT_FACEKIT_FOLDER]``.

Not a timing. The gap of the left lids at a full blink and the cells that fold on its way, for
docs/openings.md; and with the folder of the measured head, how far beyond it upper lip and nose
move when the jaw opens.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

import pdeface
from pdeface.controls import slits
from pdeface.controls.seams import nearest
from pdeface.pde import PDESurface

LEVELS = ("28x46", "55x92")
MESHES = ((28, 41), (55, 81), (109, 161))
PEOPLE = (None, *range(20))
LOOKS = tuple(f"eyeLook{way}Left" for way in ("Up", "Down", "In", "Out"))
COMPANY = {
    "alone": {},
    "eyeWide": {"eyeWideLeft": 1.0},
    "eyeSquint": {"eyeSquintLeft": 1.0},
    "a look": {"eyeLookDownLeft": 1.0, "eyeLookOutLeft": 1.0},
    "all of these": {"eyeWideLeft": 1.0, "eyeSquintLeft": 1.0, **dict.fromkeys(LOOKS[:3:2], 1.0)},
}
BLINKS = (0.0, 0.25, 0.5, 0.75, 1.0)


def main(head: str | None = None) -> None:
    print(f"{len(PEOPLE)} people. Gap of the shut lids on the mesh, mm; folded cells on average")
    for level in LEVELS:
        people = [pdeface.neutral(level) if p is None else pdeface.random(p, level) for p in PEOPLE]
        for mesh in MESHES:
            for name, company in COMPANY.items():
                faces = [person.set(**company) for person in people]
                gaps = [lid_gap(face.set(eyeBlinkLeft=1.0), mesh) for face in faces]
                folds = [[folded(f.set(eyeBlinkLeft=b), mesh) for f in faces] for b in BLINKS]
                said = ", ".join(f"{np.mean(row):.2f}" for row in folds)
                print(f"{level} on {mesh[0]} x {mesh[1]}, {name}: {max(gaps):.3f} mm; {said}")
    if head is not None:
        print(f"The measured head itself, shut, by rows x columns: {measured_folds(Path(head))}")
        for level in LEVELS:
            print(f"{level} jawOpen: {overshoot(level, Path(head))}")


def lid_gap(face: pdeface.Face, size: tuple[int, int]) -> float:
    """How far any place on the edge of one left lid is from the other, mm."""
    cut, vertices = face.uv_mesh(*size).cuts[1], face.mesh(*size).vertices
    edges = [vertices[row * size[1] + cut.columns] for row in (cut.upper, cut.lower)]
    t = np.linspace(0.0, 1.0, 12)[:, None, None]
    dense = [(edge[:-1] + t * np.diff(edge, axis=0)).reshape(-1, 3) for edge in edges]
    away = [dense[i] - nearest(edges[1 - i], dense[i]) for i in (0, 1)]
    return 1000.0 * float(np.linalg.norm(np.concatenate(away), axis=1).max())


def folded(face: pdeface.Face, size: tuple[int, int]) -> int:
    """Cells whose two triangles face opposite ways."""
    mesh = face.mesh(*size)
    return int(bent(*mesh.vertices[mesh.quads].transpose(1, 0, 2)).sum())


def bent(a: np.ndarray, b: np.ndarray, c: np.ndarray, d: np.ndarray) -> np.ndarray:
    """(...) whether the two triangles of cells with these (..., 3) corners face opposite ways."""
    halves = np.cross(b - a, c - a), np.cross(c - a, d - a)
    return np.asarray(np.einsum("...i,...i", *halves) < 0.0)


def measured_folds(head: Path) -> str:
    """Bent cells about the left eye of the measured head when its lids are shut.

    Cells between its lids do not count, nor does what lies further than the folds of the lids.
    """
    from pdeface.controls.build.__main__ import SAMPLES, Sampler

    sampler, expressions = Sampler(head), np.load(head / "expressions.npz")
    names = [str(name) for name in expressions["names"]]
    row, eye = np.linspace(0.0, 27.0, SAMPLES[0])[:, None], sampler.openings[2]
    beside = (sampler.v > eye.start) & (sampler.v < eye.end)
    counted = (row >= 5) & (row < 11) & (np.abs(sampler.v - 2.2) < 0.4)
    counted &= ~((row >= 7) & (row < 9) & beside)
    said = []
    for company in (("eyeBlink_L",), ("eyeBlink_L", "eyeSquint_L")):
        offsets = sum(expressions["offsets_cm"][names.index(name)] for name in company)
        places = sampler.rest + sampler.displacements(offsets)
        for step in (8, 4, 2):
            cells = places[::step, ::step]
            folds = bent(cells[:-1, :-1], cells[1:, :-1], cells[1:, 1:], cells[:-1, 1:])
            folds &= counted[::step, ::step][:-1, :-1]
            said.append(f"{cells.shape[0]} x {cells.shape[1]} {'+'.join(company)} {folds.sum()}")
    return "; ".join(said)


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
