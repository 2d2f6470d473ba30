"""Warp meshes: their checks, and what the two passes read off them.

A warp mesh is an (R, C, 2) array of control points (x right, y down, pixels). The intermediate
mesh of the two-pass method takes x from the target and y from the source: the first pass moves
points along rows only, the second along columns only.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pdeface.errors import InputError
from pdeface.texture import _spline

__all__ = ["check_mesh", "check_meshes", "column_knots", "row_knots"]

FloatArray = NDArray[np.float64]
Names = Sequence[Sequence[str]] | None

_CLOSEST = 1e-3
"""Pixels between neighbouring curves at least: closer, and the warp would tear."""


def check_mesh(mesh: Any, kind: str, names: Names = None) -> FloatArray:
    """The (R, C, 2) float array that ``mesh`` is, x increasing along rows, y along columns.

    Args:
        mesh: control points.
        kind: which mesh this is, for messages: ``"source"`` or ``"target"``.
        names: R rows of C names of the nodes, for messages.

    Raises:
        InputError: another shape, a node that is not finite, or nodes in crossing order.
    """
    nodes = np.array(mesh, dtype=np.float64)
    if nodes.ndim != 3 or nodes.shape[2] != 2 or min(nodes.shape[:2]) < 2:
        raise InputError(
            f"the {kind} mesh must be an array of (rows >= 2, columns >= 2, 2), "
            f"got {nodes.shape}; give (x, y) for each node"
        )
    bad = np.argwhere(~np.isfinite(nodes))
    if len(bad):
        row, column, _ = bad[0]
        raise InputError(
            f"every node of the {kind} mesh must be finite, got {_point(nodes[row, column])} for "
            f"{node_name(row, column, names)}; replace it"
        )
    _check_order(nodes, kind, names)
    return nodes


def _check_order(nodes: FloatArray, kind: str, names: Names) -> None:
    for axis, (coordinate, side) in enumerate([("x", "right of"), ("y", "below")]):
        steps = np.diff(nodes[..., axis], axis=1 - axis)
        bad = np.argwhere(steps < _CLOSEST)
        if len(bad):
            row, column = bad[0]
            following = (row, column + 1) if axis == 0 else (row + 1, column)
            raise InputError(
                f"the {kind} mesh is folded: {node_name(*following, names)} at "
                f"{_point(nodes[following])} must lie {side} {node_name(row, column, names)} at "
                f"{_point(nodes[row, column])}, by its {coordinate}; move one of them"
            )


def check_meshes(source: Any, target: Any, names: Names = None) -> tuple[FloatArray, FloatArray]:
    """Both meshes, checked, of one shape."""
    checked = check_mesh(source, "source", names), check_mesh(target, "target", names)
    if checked[0].shape != checked[1].shape:
        raise InputError(
            "source and target mesh must have the same number of rows and columns, "
            f"got {checked[0].shape[:2]} and {checked[1].shape[:2]}; pair their nodes"
        )
    return checked


def row_knots(
    source: FloatArray, target: FloatArray, rows: FloatArray, names: Names = None
) -> tuple[FloatArray, FloatArray]:
    """First pass: where the C upright curves of both meshes cross each image row.

    Args:
        source: (R, C, 2) source mesh.
        target: (R, C, 2) target mesh, of which x is used.
        rows: (n,) y of the rows.

    Returns:
        (n, C) x in the intermediate image and (n, C) x in the source image.

    Raises:
        InputError: two curves cross between their nodes.
    """
    height = source[..., 1].T
    curves = _spline.coefficients(height, np.stack([target[..., 0].T, source[..., 0].T]))
    ends = _spline.evaluate(height, curves, rows)
    _check_curves(ends, rows, height, "columns", names)
    return ends[0].T, ends[1].T


def column_knots(
    source: FloatArray, target: FloatArray, columns: FloatArray, names: Names = None
) -> tuple[FloatArray, FloatArray]:
    """Second pass: where the R level curves of both meshes cross each image column.

    Args:
        source: (R, C, 2) source mesh, of which y is used.
        target: (R, C, 2) target mesh.
        columns: (n,) x of the columns of the target image.

    Returns:
        (n, R) y in the target image and (n, R) y in the intermediate image.

    Raises:
        InputError: two curves cross between their nodes.
    """
    across = target[..., 0]
    curves = _spline.coefficients(across, np.stack([target[..., 1], source[..., 1]]))
    ends = _spline.evaluate(across, curves, columns)
    _check_curves(ends, columns, across, "rows", names)
    return ends[0].T, ends[1].T


def _check_curves(
    ends: FloatArray, at: FloatArray, nodes_at: FloatArray, lines: str, names: Names
) -> None:
    """Refuse curves of neighbouring nodes that cross between the nodes.

    Args:
        ends: (2, curves, n) positions of the target's and the source's curves.
        at: (n,) the coordinate along the curves.
        nodes_at: (curves, nodes) that coordinate at the nodes.
    """
    bad = np.argwhere(np.diff(ends, axis=1) < _CLOSEST)
    if not len(bad):
        return
    mesh, curve, line = bad[0]
    node = int(np.argmin(np.abs(nodes_at[curve] - at[line])))
    if lines == "columns":
        first, second = node_name(node, curve, names), node_name(node, curve + 1, names)
    else:
        first, second = node_name(curve, node, names), node_name(curve + 1, node, names)
    raise InputError(
        f"{lines} of the {('target', 'source')[mesh]} mesh must not cross, but those through "
        f"{first} and {second} do; move one of these points away from the other"
    )


def node_name(row: Any, column: Any, names: Names = None) -> str:
    """How a message calls a node."""
    return names[row][column] if names else f"node (row {row}, column {column})"


def _point(node: FloatArray) -> str:
    return f"({node[0]:.1f}, {node[1]:.1f})"
