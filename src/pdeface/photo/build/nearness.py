"""How near identities are to each other as faces are: in distance, wherever both are put."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pdeface.controls import CONTROLS
from pdeface.face import neutral
from pdeface.photo.build.straying import FACE

__all__ = ["metric", "shares_worse"]

FloatArray = NDArray[np.float64]

_GRID = 61, 91

_NEAREST = 0.1
"""Share of the people who are looked at apart: those who are nearest to the neutral face."""


def metric() -> FloatArray:
    """(50, 50) G: w G w is the mean square, over the face, of the distance along its normals that
    identity weights w move it, metres, less what moving, turning and scaling it would do."""
    face = neutral()
    mesh = face.mesh(*_GRID, openings="none")
    v, u = np.asarray(mesh.texcoords).T
    some = (u < FACE[0]) & (np.abs(np.pi * v - np.pi / 2) < FACE[1])
    points, normals = mesh.vertices[some], mesh.normals[some]
    middle = points - points.mean(axis=0)
    names = [name for name, control in CONTROLS.items() if control.kind == "identity"]
    moved = [face.with_weights({n: 1.0}).mesh(*_GRID, openings="none").vertices[some] - points
             for n in names]  # fmt: skip
    ways = np.array([np.einsum("ni,ni->n", each, normals) for each in moved]).T
    along = np.einsum("ni,ni->n", middle, normals)
    placing = np.column_stack([normals, np.cross(middle, normals), along])
    left = ways - placing @ np.linalg.lstsq(placing, ways, rcond=None)[0]
    return np.asarray(left.T @ left / len(left))


def shares_worse(said: FloatArray, truth: FloatArray) -> tuple[float, float]:
    """Shares of people to whom the neutral face is nearer than what is said of them.

    Args:
        said: (n, 50) identities that were told.
        truth: (n, 50) theirs.

    Returns:
        The share of all, and of the tenth who are nearest to the neutral face.
    """
    by = metric()
    off, rest = (np.einsum("ni,ij,nj->n", w, by, w) for w in (said - truth, truth))
    near = rest <= np.quantile(rest, _NEAREST)
    return float(np.mean(off > rest)), float(np.mean(off[near] > rest[near]))
