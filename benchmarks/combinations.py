"""How far all shape controls may be moved at once before the surface folds.

    python -m benchmarks.combinations [combinations]

Draws every control evenly from [-r, r], 2,000 times, and counts combinations with a folded cell
(one whose two triangles face opposite ways), at every level of detail, for growing r, on meshes
whose eyes and mouth are cut and on whole ones. The directions are the same for every r.
"""

from __future__ import annotations

from benchmarks.timing import machine

# isort: split
import sys
import time

import numpy as np

from pdeface.controls.shape import SHAPE_CONTROLS, displacement
from pdeface.sampler import sampler
from pdeface.template import LEVELS, neutral_curves, openings
from pdeface.uvmesh import UVMesh

COMBINATIONS = 2000
SEED = 20240229
MESHES = ((28, 41), (109, 161))
RANGES = (0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.1, 1.2)


def main(arguments: list[str]) -> None:
    count = int(arguments[0]) if arguments else COMBINATIONS
    print(f"Combinations of {len(SHAPE_CONTROLS)} shape controls. {machine()}")
    for level in LEVELS:
        for size in MESHES:
            for name, cut in (("whole", ()), ("cut", openings())):
                start = time.perf_counter()
                folded = folded_combinations(level, UVMesh(*size, openings=cut), count)
                clean = max(r for r in RANGES if not any(folded[q] for q in RANGES if q <= r))
                print(
                    f"  {level:>7} on {size[0]:3} x {size[1]}, {name:>5}: none of {count} folds up "
                    f"to r = {clean}; {folded[1.0]} do at r = 1 "
                    f"({time.perf_counter() - start:.0f} s)",
                    flush=True,
                )


def folded_combinations(level: str, mesh: UVMesh, count: int) -> dict[float, int]:
    """Combinations that fold, by r."""
    kept = cells(mesh)
    surface, steps = surfaces(level, mesh)
    directions = np.random.default_rng(SEED).uniform(-1.0, 1.0, (count, len(steps)))
    folded = dict.fromkeys(RANGES, 0)
    for direction in directions.astype(np.float32):
        moved = (direction @ steps).reshape(surface.shape)
        for r in folded:
            folded[r] += has_fold(surface + np.float32(r) * moved, kept)
    return folded


def surfaces(level: str, mesh: UVMesh) -> tuple[np.ndarray, np.ndarray]:
    """(3, U, V) neutral surface and (controls, 3 U V) what each control adds to it at +1."""
    curves = neutral_curves(level)
    evaluator = sampler(curves.shape, mesh, 1.0, 6, "smooth", False, True)
    moved = np.stack([displacement(name, curves.shape) for name in SHAPE_CONTROLS])
    neutral = np.moveaxis(evaluator.positions(curves.points), -1, 0)
    steps = np.moveaxis(evaluator.positions(moved), -1, 1)
    grid = neutral.reshape(3, mesh.rows, mesh.columns)
    return grid.astype(np.float32), steps.reshape(len(moved), -1).astype(np.float32)


def cells(mesh: UVMesh) -> np.ndarray:
    """(U - 1, V - 1) whether a mesh has a cell whole: those in openings it has not."""
    kept = np.zeros((mesh.rows, mesh.columns), dtype=bool)
    kept.reshape(-1)[mesh.quads[:, 0]] = True
    return kept[:-1, :-1]


def has_fold(grid: np.ndarray, kept: np.ndarray) -> bool:
    """Whether the two triangles of any kept cell of a (3, U, V) grid face opposite ways."""
    down, across = np.diff(grid, axis=1), np.diff(grid, axis=2)
    first = cross(down[:, :, :-1], across[:, 1:])
    second = cross(down[:, :, 1:], across[:, :-1])
    return bool((((first * second).sum(axis=0) < 0.0) & kept).any())


def cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return np.stack([a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3)])


if __name__ == "__main__":
    main(sys.argv[1:])
