"""Rate and distortion of faces, from the command line: see :mod:`benchmarks.rates`.

DATA is the folder that holds ``ict_facekit`` and ``makehuman``. Each head is fitted from its mesh
and kept in compact files of several levels and errors, in Draco's files of meshes decimated by
quadrics and quantised several ways, and, without quantisation, as a bicubic B-spline of as many
coefficients as the curves. Printed are the best errors within so many bytes, means over the heads.
Needs the extras scan, photo, template and bench, and MediaPipe's model (docs/photos.md).
"""

from __future__ import annotations

import argparse
import json
import time
from collections.abc import Iterable
from pathlib import Path

import numpy as np

from benchmarks.rates.codecs import LEVELS, Point, compact_files, draco_files, spline
from benchmarks.rates.figure import draw
from benchmarks.rates.truth import Errors, Truth, front_of, surface_of
from benchmarks.scans import ict_heads, makehuman_heads
from pdeface.scan import ScanFit, fit_scan

BUDGETS = (150, 250, 350, 500, 700, 1000, 1400, 2000, 2800, 4000, 6000)
WAYS = "pdeface", "draco", "draco with texcoords"


def rates(fit: ScanFit, truth: Truth) -> dict[str, list[Point]]:
    """The files of one head, by what made them."""
    return {
        WAYS[0]: list(compact_files(fit, truth)),
        WAYS[1]: list(draco_files(fit, truth, texcoords=False)),
        WAYS[2]: list(draco_files(fit, truth, texcoords=True)),
    }


def best(points: Iterable[Point], budget: int, what: int) -> float:
    """The smallest error within so many bytes, infinite if nothing is as small."""
    return min((p.errors[what] for p in points if p.size <= budget), default=np.inf)


def table(heads: list[dict[str, list[Point]]]) -> str:
    """Means over heads of the best errors within each budget."""
    lines = [f"{'bytes':>6s}" + "".join(f"{way:>26s}" for way in WAYS)]
    for budget in BUDGETS:
        cells = [f"{budget:6d}"]
        for way in WAYS:
            both = [np.mean([best(h[way], budget, what) for h in heads]) for what in (0, 1)]
            cells.append(f"{both[0]:14.3f} mm {both[1]:5.2f} deg")
        lines.append("".join(cells))
    return "\n".join(lines)


def coefficients(fit: ScanFit, truth: Truth) -> list[tuple[Errors, Errors]]:
    """At each level, what curves and a B-spline of as many coefficients leave."""
    return [
        (truth.errors(surface_of(fit.at_level(*level))), truth.errors(spline(fit, level)))
        for level in LEVELS
    ]


def splines(heads: list[list[tuple[Errors, Errors]]]) -> str:
    """Means over heads."""
    lines = ["level        curves                  B-spline"]
    for number, (count, points) in enumerate(LEVELS):
        ours, theirs = (np.mean([h[number][k] for h in heads], axis=0) for k in (0, 1))
        cells = [f"{of[0]:8.3f} mm {of[1]:6.2f} deg" for of in (ours, theirs)]
        lines.append(f"{count:3d}x{points:3d}" + "    ".join(cells))
    return "\n".join(lines)


def main(arguments: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(prog="benchmarks.rates", description=__doc__)
    parser.add_argument("data", type=Path)
    parser.add_argument("--people", type=int, default=4, help="random heads of ICT-FaceKit")
    parser.add_argument("--figure", type=Path, help="picture of the curves to draw")
    parser.add_argument("--json", type=Path, help="file for every single number")
    options = parser.parse_args(arguments)
    groups = {
        "MakeHuman": makehuman_heads(options.data / "makehuman"),
        "ICT-FaceKit": ict_heads(options.data / "ict_facekit", options.people),
    }
    files: dict[str, list[dict[str, list[Point]]]] = {}
    for group, subjects in groups.items():
        files[group], smooth = [], []
        for subject in subjects:
            began = time.perf_counter()
            fit = fit_scan(subject.scan, LEVELS[-1], rounded=False)
            truth = front_of(fit)
            smooth.append(coefficients(fit, truth))
            files[group].append(rates(fit, truth))
            print(f"{subject.name}: {time.perf_counter() - began:.0f} s", flush=True)
        print(f"\n{group}: the best errors within so many bytes, means of {len(smooth)} heads")
        print(table(files[group]))
        print(f"\n{group}: without quantisation\n{splines(smooth)}\n", flush=True)
    if options.json:
        options.json.write_text(json.dumps(files))
    if options.figure:
        draw(files, best, options.figure)


if __name__ == "__main__":
    main()
