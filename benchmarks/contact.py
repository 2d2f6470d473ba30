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
    a, b, c, d = mesh.vertices[mesh.quads].transpose(1, 0, 2)
    halves = np.cross(b - a, c - a), np.cross(c - a, d - a)
    return int((np.einsum("ij,ij->i", *halves) < 0.0).sum())


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
