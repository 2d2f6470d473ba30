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

__all__ = ["check_mesh", "check_meshes", "column_knots", "map_points", "row_knots"]

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
    across = np.stack([target[..., 0].T, source[..., 0].T])
    ends = _crossings(source[..., 1].T, across, rows, "columns", names)
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
    down = np.stack([target[..., 1], source[..., 1]])
    ends = _crossings(target[..., 0], down, columns, "rows", names)
    return ends[0].T, ends[1].T


def map_points(
    source: FloatArray, target: FloatArray, points: FloatArray, names: Names = None
) -> FloatArray:
    """Where in the source image the two-pass warp takes points of the target image from.

    Args:
        source: (R, C, 2) source mesh.
        target: (R, C, 2) target mesh.
        points: (n, 2) positions in the target image.
        names: of the nodes, for messages.

    Returns:
        (n, 2) positions in the source image.

    Raises:
        InputError: a mesh is folded.
    """
    source, target = check_meshes(source, target, names)
    order = np.argsort(points[:, 0])
    knots = column_knots(source, target, points[order, 0], names)
    y = _at_own_place(*knots, points[order, 1])
    again = np.argsort(y)
    order = order[again]
    knots = row_knots(source, target, y[again], names)
    result = np.empty_like(points)
    result[order, 0] = _at_own_place(*knots, points[order, 0])
    result[order, 1] = y[again]
    return result


def _at_own_place(knots: FloatArray, values: FloatArray, at: FloatArray) -> FloatArray:
    """(n,) values of n curves (n, nodes), each at a place of its own."""
    shifted = knots - at[:, None]
    return _spline.evaluate(shifted, _spline.coefficients(shifted, values), np.zeros(1))[:, 0]


def _crossings(
    nodes_at: FloatArray, values: FloatArray, at: FloatArray, lines: str, names: Names
) -> FloatArray:
    """Where mesh lines cross image lines: (2, curves, n), increasing along the second axis.

    Args:
        nodes_at: (curves, nodes) coordinate along the curves, at their nodes.
        values: (2, curves, nodes) the other coordinate, in the target and in the source.
        at: (n,) coordinate of the image lines.
        lines: what the curves are, for messages.
        names: of the nodes, for messages.
    """
    ends = _spline.evaluate(nodes_at, _spline.coefficients(nodes_at, values), at)
    tight = (np.diff(ends, axis=1) < _CLOSEST).any(axis=(0, 1))
    own = (at >= nodes_at[:, :1]) & (at <= nodes_at[:, -1:])
    for line in np.flatnonzero(tight):
        curves = np.flatnonzero(own[:, line])
        for mesh, kind in enumerate(("target", "source")):
            found = ends[mesh, :, line]
            crossed = np.flatnonzero(np.diff(found[curves]) < _CLOSEST)
            if len(crossed):
                pair = curves[crossed[0] : crossed[0] + 2]
                nodes = [int(np.argmin(np.abs(nodes_at[c] - at[line]))) for c in pair]
                raise _crossing_error(kind, lines, list(zip(pair, nodes, strict=True)), names)
            _part(found, curves)
    return ends


def _part(positions: FloatArray, own: NDArray[np.intp]) -> None:
    """Part curves that were continued beyond their nodes and met another there, in place.

    No pixel is read off these, but the map of the whole line hangs on their order.

    Args:
        positions: (curves,) where they cross the line.
        own: which of them cross it between their nodes, at least one in a mesh that covers it.
    """
    count = len(positions)
    if len(own):
        between = np.arange(own[0], own[-1] + 1)
        positions[between] = np.interp(between, own, positions[own])
    first, last = (own[0], own[-1]) if len(own) else (count, 0)
    for k in range(last + 1, count):
        positions[k] = max(positions[k], positions[k - 1] + 2.0 * _CLOSEST)
    for k in range(min(first, count) - 1, -1, -1):
        if k + 1 < count and first < count:
            positions[k] = min(positions[k], positions[k + 1] - 2.0 * _CLOSEST)


def _crossing_error(kind: str, lines: str, pair: list[tuple[int, int]], names: Names) -> InputError:
    first, second = (
        node_name(node, curve, names) if lines == "columns" else node_name(curve, node, names)
        for curve, node in pair
    )
    return InputError(
        f"{lines} of the {kind} mesh must not cross, but those through {first} and {second} do; "
        "move one of these points away from the other"
    )


def node_name(row: Any, column: Any, names: Names = None) -> str:
    """How a message calls a node."""
    return names[row][column] if names else f"node (row {row}, column {column})"


def _point(node: FloatArray) -> str:
    return f"({node[0]:.1f}, {node[1]:.1f})"
