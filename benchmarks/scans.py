"""How near curves come to scans of known heads: ``python -m benchmarks.scans DATA``.

DATA is the folder that holds ``ict_facekit`` and ``makehuman``. Random heads of ICT-FaceKit, by all
of its 100 identity modes (the fit knows 50), and the heads of MakeHuman, whose topology nothing was
learnt from: whole heads with eyeballs and mouth, each fitted from nothing but its mesh. Distances
over the front of the face, millimetres; the nearer of feature rows is known for ICT's heads alone.
Needs the extras scan, photo, render and template, and MediaPipe's model (docs/photos.md).
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np

from pdeface.controls.build.__main__ import SAMPLES, Sampler
from pdeface.controls.seams import nearest
from pdeface.pictures import contact_sheet, render
from pdeface.pictures.image_file import write_image
from pdeface.scan import Scan, ScanFit, Target, fit_scan, make_scan, measure, read_scan
from pdeface.scan.model import dense_neutral
from pdeface.scan.report import scan_picture
from pdeface.template import row
from pdeface.template.build.head import CENTIMETRE, load_head

LEVELS = (28, 46), (55, 92), (109, 184)
PARTS = "M_Face", "M_BackHead", "M_ScleraLeft", "M_IrisLeft", "M_ScleraRight", "M_IrisRight"
VIEWS = "front", "three-quarter", "profile"
# Feature rows and the values of v, on the subject's right, between which they lie on the feature.
ROWS = {
    "upper_lid_margin": (0.9, 1.2),
    "lower_lid_margin": (0.9, 1.2),
    "subnasale": (1.35, np.pi / 2),
    "upper_lip_border": (1.25, np.pi / 2),
    "mouth_seam_upper": (1.2, np.pi / 2),
    "mouth_seam_lower": (1.2, np.pi / 2),
    "lower_lip_border": (1.3, np.pi / 2),
}

SHOWN = 0.25e-3
"""Metres from a scan's outside within which it shows a place."""


class Subject(NamedTuple):
    """A scan, and where its rows are if that is known: (U, V, 3) in its own frame and unit."""

    name: str
    scan: Scan
    rows: np.ndarray | None


def ict_heads(folder: Path, count: int, first_seed: int = 1) -> Iterator[Subject]:
    """Random heads of ICT-FaceKit, centimetres."""
    head, sampler = load_head(folder), Sampler(folder)
    modes = np.load(folder / "identities.npz")["offsets_cm"]
    polygons = [face for part in PARTS for face in head.parts[part]]
    triangles = [(f[0], f[k], f[k + 1]) for f in polygons for k in range(1, len(f) - 1)]
    neutral = dense_neutral(np.linspace(0.0, 1.0, SAMPLES[0]), sampler.v)
    for seed in range(first_seed, first_seed + count):
        weights = np.random.default_rng(seed).normal(size=len(modes))
        offsets = np.tensordot(weights, modes, 1)
        truth = (neutral + sampler.displacements(offsets)) / CENTIMETRE
        yield Subject(
            f"ICT random {seed}",
            make_scan(head.vertices / CENTIMETRE + offsets, np.array(triangles)),
            truth,
        )


def makehuman_heads(folder: Path) -> Iterator[Subject]:
    for path in sorted(folder.glob("*.obj")):
        yield Subject(path.stem.replace("_", " "), read_scan(path), None)


def off_features(fit: ScanFit, truth: np.ndarray) -> dict[str, float]:
    """Root mean square distance of each feature row from the true one, millimetres.

    Where lips of a head go through each other the true row is inside, and no scan shows it: what
    lies off the scan's outside does not count.
    """
    truth = fit.scale * truth @ fit.rotation.T + fit.shift
    surface, distances, outside = fit.face.surface(), {}, Target(fit.scan)
    for name, (first, last) in ROWS.items():
        line = truth[row(name, SAMPLES[0])]
        v = np.linspace(first, last, 25)
        ours = np.concatenate([surface(row(name) / 27, v), surface(row(name) / 27, np.pi - v)])
        true = nearest(line, ours)
        away = np.linalg.norm(true - ours, axis=1)[outside.nearest(true).away < SHOWN]
        distances[name] = 1e3 * float(np.sqrt((away**2).mean()))
    return distances


def sheet(fits: list[tuple[str, ScanFit]], path: Path) -> None:
    """Scan and finest fit of each subject from three sides, under raking light."""
    rows, captions = [], []
    size = (300, 375)
    for name, fit in fits:
        pictures = []
        for view in VIEWS:
            pictures.append(scan_picture(fit, view, size))
            options = {"style": "shaded", "light": "raking", "openings": "none"}
            pictures.append(render(fit.face, view=view, size=size, **options))
        rows.append(pictures)
        captions.append([name, "{} x {}".format(*fit.face.curves.shape)] + [""] * 4)
    write_image(path, contact_sheet(rows, captions, letters=14))


def main(arguments: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(prog="benchmarks.scans", description=__doc__)
    parser.add_argument("data", type=Path)
    parser.add_argument("--people", type=int, default=6, help="random heads of ICT-FaceKit")
    parser.add_argument("--sheet", type=Path, help="picture of scans and fits to draw")
    parser.add_argument(
        "--round",
        action=argparse.BooleanOptionalAction,
        help="fit the triangles' round surface, or their flat faces, whatever their size",
    )
    options = parser.parse_args(arguments)
    subjects = [
        *ict_heads(options.data / "ict_facekit", options.people),
        *makehuman_heads(options.data / "makehuman"),
    ]
    print(f"{'head':24s} level      RMS  median   95 %  normals  back RMS  features  coverage  s")
    shown, features = [], []
    for subject in subjects:
        began = time.perf_counter()
        finest = fit_scan(subject.scan, LEVELS[-1], rounded=options.round)
        seconds = time.perf_counter() - began
        for level in LEVELS:
            fit = finest.at_level(*level)
            found = measure(fit)
            known = subject.rows is not None
            rows = off_features(fit, subject.rows) if known else {}
            worst = f"{max(rows.values()):8.2f}" if rows else "       -"
            if rows and level == LEVELS[-1]:
                features.append(rows)
            there = found.to_scan
            numbers = f"{there.rms:6.3f}  {there.median:6.3f} {there.p95:6.2f}  {found.normal:7.2f}"
            print(
                f"{subject.name:24s} {level[0]:3d}x{level[1]:3d} {numbers}  "
                f"{found.to_face.rms:8.3f}  {worst} {100 * found.coverage:8.1f}%  {seconds:.1f}",
                flush=True,
            )
        shown.append((subject.name, finest))
    for name in ROWS:
        print(f"{name}: {np.mean([row[name] for row in features]):.2f} mm")
    if options.sheet:
        sheet([*shown[: min(2, options.people)], *shown[-4:]], options.sheet)


if __name__ == "__main__":
    main()
