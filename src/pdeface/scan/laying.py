"""The surface laid onto a scan, coarse to fine.

The grid moves to the nearest places of the scan that face the same way: along its normals, and a
little along the surface, by which creases find creases. Every move is smoothed over the grid, at
first widely and in the end hardly, so that rows and columns stay as fair as the template's; where
the scan has a hole, or hair, the surface around it is carried on.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pdeface.scan.alignment import Landmarks
from pdeface.scan.fields import enlarged, normals, smoothed
from pdeface.scan.nearest import Target
from pdeface.scan.noise import quiet_width
from pdeface.scan.nostrils import fitted_nostrils
from pdeface.scan.surface import Scan
from pdeface.template import column_v, row_u

__all__ = ["lay", "met"]

FloatArray = NDArray[np.float64]


class Stage(NamedTuple):
    """One width of smoothing.

    Attributes:
        width: standard deviation in rows, of the paper's 28.
        cutoff: metres from which on a place of the scan does not count.
        rounds: how often.
        step: every so many-th node is looked at.
        pulled: whether the landmarks pull.
    """

    width: float
    cutoff: float
    rounds: int
    step: int
    pulled: bool = False


_STAGES = (
    Stage(3.0, 10.0e-3, 2, 4, pulled=True),
    Stage(1.6, 7.0e-3, 3, 4, pulled=True),
    Stage(0.9, 5.0e-3, 3, 4),
    Stage(0.5, 4.0e-3, 3, 2),
    Stage(0.28, 3.0e-3, 3, 2),
)
_NOSTRILS = 3
"""The stage before which the depth of the nostrils is found."""

_LAST = Stage(0.14, 2.0e-3, 2, 1)

_ROW = 6.7e-3
_DETAIL = 0.25
"""Metres between rows of the paper; and the share of a cloud's spacing below which widths of the
smoothing follow its points, not its shape."""

_BREADTH = 4.0e-3
_SLIDE = 0.4
"""Share of the way along the surface that is gone."""

_ROUND = 0.5
"""Share of the way to the vertices' tangent planes, with which flat triangles become round."""

_MARK = 4.0
"""What a landmark counts, in nodes."""

_MARK_CUTOFF = 6.0e-3
_ODD = 1.2e-3
"""Metres that a move may differ from those around it, as into a nostril, before it loses weight."""


_RIM, _RIM_WIDTH, _FOLD = (24.8, 26.6), 1.2, 1.0e-3
"""Rows of the paper between which the edge under the jaw begins; how smooth it becomes, in rows;
and how far from that, metres, it is half-way on its way there."""


def lay(
    start: FloatArray,
    scan: Scan,
    landmarks: Landmarks,
    *,
    rounded: bool = False,
    on_round: Callable[[FloatArray], None] = lambda points: None,
) -> tuple[FloatArray, FloatArray]:
    """Lay a face onto a scan.

    Args:
        start: (U, V, 3) the face on its grid, nearly there.
        scan: its outside, in the frame of the template.
        landmarks: in that frame.
        rounded: onto the curved surface that its triangles stand for, not onto their flat faces.
        on_round: given the (U, V, 3) grid after each move.

    Returns:
        (U, V, 3) the grid on the scan, and (U, V) how well it was met, 0 in holes to 1.
    """
    target = Target(scan, _BREADTH)
    bend = _ROUND if rounded else 0.0
    points, known = start.copy(), _known(*start.shape[:2])
    finest = quiet_width(scan) / _ROW
    for number, stage in enumerate(_STAGES):
        stage = stage._replace(width=max(stage.width, finest))
        if number == _NOSTRILS:
            points = fitted_nostrils(points, target)
        for _ in range(stage.rounds):
            points = points + _move(points, stage, target, landmarks, known, _SLIDE, bend)
            on_round(points)
    # Finer than its triangles the curved surface that they stand for is as lumpy as they are.
    followed = not scan.is_cloud and not rounded
    fine = followed or _LAST.width * _ROW > _DETAIL * scan.spacing
    detailed = fine and _LAST.width > finest
    for _ in range(_LAST.rounds if detailed else 0):
        points = points + _move(points, _LAST, target, landmarks, known, 0.0, bend)
        on_round(points)
    points = _with_fair_rim(points, start)
    facing = normals(points).reshape(-1, 3)
    found = target.nearest(points.reshape(-1, 3), facing)
    trust = met(found.away, (found.normals * facing).sum(axis=1), _LAST.cutoff)
    return points, trust.reshape(points.shape[:2])


def _with_fair_rim(points: FloatArray, start: FloatArray) -> FloatArray:
    """The grid without the folds that it has beneath the jaw: where it lies far from its way from
    the start, smoothed, it goes back to that."""
    rows, columns = points.shape[:2]
    row = np.linspace(0.0, 27.0, rows)
    inner = np.tile(((_RIM[1] - row) / (_RIM[1] - _RIM[0])).clip(0.0, 1.0)[:, None], columns)
    widths = _RIM_WIDTH * (rows - 1) / 27, _RIM_WIDTH * columns / 27
    fair = start + smoothed(points - start, inner + 0.1, widths, 0.0)
    squares = np.repeat(((points - fair) ** 2).sum(axis=2)[..., None], 3, axis=2)
    off = np.abs(smoothed(squares, np.ones((rows, columns)), widths, 0.0)[..., :1])
    share = (1.0 - inner[..., None]) * off**2 / (off**2 + _FOLD**4)
    return np.asarray(points + share * (fair - points))


def met(away: FloatArray, alike: FloatArray, cutoff: float) -> FloatArray:
    """1 for a near place that faces the same way, falling to 0 at the cutoff (Tukey's weights).

    Args:
        away: (n,) distances.
        alike: (n,) cosines of the angles between normals.
    """
    near = (1.0 - (away / cutoff).clip(0.0, 1.0) ** 2) ** 2
    return np.asarray(near * ((alike - 0.4) / 0.4).clip(0.0, 1.0))


def _move(
    points: FloatArray,
    stage: Stage,
    target: Target,
    landmarks: Landmarks,
    known: tuple[FloatArray, FloatArray],
    slide: float,
    bend: float,
) -> FloatArray:
    """(U, V, 3) smoothed way to the scan."""
    some = (slice(None, None, stage.step), slice(None, None, stage.step))
    here, facing = points[some], _facing(points)[some]
    flat, flat_facing = here.reshape(-1, 3), facing.reshape(-1, 3)
    found = target.nearest(flat, flat_facing)
    trust = met(found.away, (found.normals * flat_facing).sum(axis=1), stage.cutoff)
    off = found.bent(target.scan, bend) - flat
    along = off - (off * flat_facing).sum(axis=1, keepdims=True) * flat_facing
    off = (off - (1.0 - slide) * along).reshape(here.shape)
    lips, inner = known
    trust = trust.reshape(here.shape[:2]) * lips[some]
    in_rows = stage.width * (points.shape[0] - 1) / 27 / stage.step
    widths = in_rows, in_rows * points.shape[1] / points.shape[0]
    if stage.pulled:
        off, trust = _pulled(off, trust, here, landmarks)
    elif stage.width < 0.8:
        trust = trust * inner[some]
        around = smoothed(off, trust, (2.0 * widths[0], 2.0 * widths[1]))
        odd = np.linalg.norm(off - around, axis=2)
        trust = trust / (1.0 + (odd / _ODD) ** 2) ** 2
    move = smoothed(off, trust, widths)
    return enlarged(move, stage.step, (points.shape[0], points.shape[1]))


def _pulled(
    off: FloatArray, trust: FloatArray, here: FloatArray, landmarks: Landmarks
) -> tuple[FloatArray, FloatArray]:
    """Moves and weights with those of the landmarks mixed in."""
    rows, columns = here.shape[:2]
    row = np.rint(landmarks.uv[:, 0] * (rows - 1)).astype(int).clip(0, rows - 1)
    column = np.rint(landmarks.uv[:, 1] / np.pi * columns - 0.5).astype(int).clip(0, columns - 1)
    away = landmarks.points - here[row, column]
    length = np.linalg.norm(away, axis=1)
    worth = _MARK * landmarks.trust / (1.0 + (length / _MARK_CUTOFF) ** 2) ** 2 / 16.0
    values, weights = off * trust[..., None], trust.copy()
    np.add.at(values, (row, column), worth[:, None] * away)
    np.add.at(weights, (row, column), worth)
    return values / np.maximum(weights, 1e-9)[..., None], weights


def _seam(rows: int, columns: int) -> tuple[int, int, slice]:
    """Rows on the two lips where they meet, and the columns of the mouth."""
    above, below = (round(row_u(f"mouth_seam_{side}") * (rows - 1)) for side in ("upper", "lower"))
    ends = [column_v(f"{side}_mouth_corner") / np.pi * columns for side in ("right", "left")]
    return above, below, slice(round(ends[0]), round(ends[1]))


def _facing(points: FloatArray) -> FloatArray:
    """Normals of the grid; where the lips meet, those of each lip alone."""
    facing = normals(points)
    above, below, mouth = _seam(points.shape[0], points.shape[1])
    for row, rows in ((above, slice(above - 2, above + 1)), (below, slice(below, below + 3))):
        facing[row, mouth] = normals(points[rows])[row - rows.start, mouth]
    return facing


def _known(rows: int, columns: int) -> tuple[FloatArray, FloatArray]:
    """(U, V) weights: 0 between the lips, which have no place of their own on a scan; and falling
    towards the edge of the face, whose ears and neck are not followed in detail."""
    lips = np.ones((rows, columns))
    above, below, mouth = _seam(rows, columns)
    lips[above + 1 : below, mouth] = 0.0
    v = (np.arange(columns) + 0.5) * (np.pi / columns)
    side = ((np.minimum(v, np.pi - v) - 0.12) / 0.25).clip(0.0, 1.0)
    row = np.linspace(0.0, 27.0, rows)
    end = np.minimum((26.6 - row) / 1.5, row / 0.5 + 0.3).clip(0.0, 1.0)
    return lips, np.minimum.outer(end, side)
