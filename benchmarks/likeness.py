"""How near the shape from one photo is to the person: ``python -m benchmarks.likeness``.

Synthetic: random heads on which nothing was calibrated, drawn with the bundled portrait's skin
from random sides. Beside the fit, the neutral face. Each is moved, turned and scaled onto the true
head by the front of the face; what counts is the mean distance of its front from the true surface.
Needs the extras photo, render and bench, and the model (docs/photos.md).
"""

from __future__ import annotations

import argparse

import numpy as np
from scipy.spatial import cKDTree

import pdeface
from pdeface.photo import find_faces, fit_shape
from pdeface.photo.build.renders import people

FIRST_SEED = 2000
MESH, DENSE, EDGE = (55, 81), (217, 325), 8


def front(face: pdeface.Face) -> np.ndarray:
    """(n, 3) samples of the face without its sides."""
    mesh = face.mesh(*MESH).vertices.reshape(*MESH, 3)
    return mesh[:, EDGE:-EDGE].reshape(-1, 3)


def aligned(points: np.ndarray, onto: np.ndarray) -> np.ndarray:
    """The points after the similarity that brings them nearest to their partners."""
    middle, target = points.mean(axis=0), onto.mean(axis=0)
    left, sizes, right = np.linalg.svd((onto - target).T @ (points - middle))
    flip = np.array([1.0, 1.0, np.sign(np.linalg.det(left @ right))])
    scale = (sizes * flip).sum() / ((points - middle) ** 2).sum()
    return scale * (points - middle) @ (left * flip @ right).T + target


def distance(face: pdeface.Face, truth: pdeface.Face) -> float:
    """Mean distance of the front of a face from the true surface, millimetres."""
    surface = cKDTree(truth.mesh(*DENSE).vertices)
    return 1e3 * float(surface.query(aligned(front(face), front(truth)))[0].mean())


def main(arguments: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(prog="benchmarks.likeness", description=__doc__)
    parser.add_argument("--people", type=int, default=24)
    count = parser.parse_args(arguments).people
    neutral, rows = pdeface.neutral(), []
    for rendered in people(count, FIRST_SEED):
        shape = fit_shape(find_faces(rendered.picture)[0])
        fitted = neutral.with_weights(shape.identity)
        rows.append([distance(face, rendered.face) for face in (neutral, fitted)] + [shape.error])
    before, after, error = np.array(rows).T
    print(f"{count} random heads, one picture each (synthetic)")
    for name, values in (("neutral face", before), ("fitted face", after)):
        print(f"{name:13s} mean {values.mean():.2f} mm, median {np.median(values):.2f} mm")
    print(f"nearer by {100 * (1 - after.mean() / before.mean()):.0f} per cent on average; "
          f"{(after > before).sum()} further off than the neutral face")  # fmt: skip
    print(f"landmarks met to {100 * error.mean():.1f} per cent of the eye distance")


if __name__ == "__main__":
    main()
