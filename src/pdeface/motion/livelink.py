"""Read the CSV that the Live Link Face app records on a phone.

Each row is a frame: a timecode, the number of values, the 52 ARKit weights and nine angles. What
public readers agree on, and what recordings show (docs/motion.md has the details):

- Angles are radians.
- The head's yaw is positive to the subject's left, its pitch is positive *upwards*, its roll is
  positive towards the subject's right shoulder.
- The eyes' angles are the mirror image of everything else: yaw is positive to the subject's
  right, pitch positive downwards, and ``RightEye`` is the eye whose weights end in ``Left``.
- A row whose ``BlendshapeCount`` is 0 is a frame in which the app saw no face.
- The timecode counts 60 (or 30) numbers a second; its fraction is one of a frame.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from pdeface import files
from pdeface.errors import FileFormatError, InputError
from pdeface.motion import _checks as checks
from pdeface.motion import timecode
from pdeface.motion._table import Table, read_table
from pdeface.motion.names import ANGLE_NAMES
from pdeface.motion.track import Track

__all__ = ["read_livelink"]

FloatArray = NDArray[np.float64]

# Of an angle within a file: the column that it is read from, and its sign.
_SOURCES = {
    "headYaw": ("headYaw", 1.0),
    "headPitch": ("headPitch", -1.0),
    "headRoll": ("headRoll", 1.0),
    "leftEyeYaw": ("rightEyeYaw", -1.0),
    "leftEyePitch": ("rightEyePitch", 1.0),
    "leftEyeRoll": ("rightEyeRoll", -1.0),
    "rightEyeYaw": ("leftEyeYaw", -1.0),
    "rightEyePitch": ("leftEyePitch", 1.0),
    "rightEyeRoll": ("leftEyeRoll", -1.0),
}
# What a smoothing or rounding recorder strays out of 0..1 without meaning anything by it.
_STRAY = 1e-3


@dataclass
class _Rows:
    """The rows that count, and what was done about the others."""

    lines: list[int] = field(default_factory=list)
    timecodes: list[timecode.Timecode] = field(default_factory=list)
    values: list[list[float]] = field(default_factory=list)
    without_face: list[int] = field(default_factory=list)


def read_livelink(
    path: files.PathLike,
    fps: float | None = None,
    drop_frame: bool | None = None,
    clamp: bool = False,
    degrees: bool = False,
) -> Track:
    """The track in a CSV file of Live Link Face, or of a program that writes the same columns.

    Columns are matched by name, whatever their case and order. Columns that are missing are 0 and
    listed in ``track.missing``, unknown ones in ``track.ignored``; what else was done is in
    ``track.notes``. A timecode that repeats is left out, and so is a frame without a face; the
    count goes on over midnight.

    Args:
        path: the file.
        fps: the rate at which its timecode counts. By default the timecodes themselves tell.
        drop_frame: whether frame numbers are dropped; by default where a semicolon says so.
        clamp: put weights out of 0..1 to the nearer end. Without it, those further out than
            0.001 are an error.
        degrees: the angles are degrees, as some programs write them; the app writes radians.

    Raises:
        InputError: the file cannot be opened, or ``fps`` is no rate of a timecode.
        FileFormatError: it is not such a file, or is damaged; the message gives the row, counted
            in lines of the file from 1, and the column.
    """
    rate = None if fps is None else checks.rate(fps)
    table = read_table(path)
    rows = _parse_rows(table)
    drop = rows.timecodes[0].semicolon if drop_frame is None else drop_frame
    notes: list[str] = []
    if rows.without_face:
        notes.append(f"{_rows_called(rows.without_face)} left out: the app saw no face.")
    clock = _clock(table, rows, rate, drop, notes)
    times, kept = _times(table, rows, clock, notes)
    values, lines = np.array(rows.values)[kept], [rows.lines[row] for row in kept]
    weights = _weights(table, values, lines, clamp, notes)
    angles = _angles(table, values, lines, degrees)
    return Track(
        times,
        table.columns.weights,
        weights,
        head=angles[:, 0:3],
        left_eye=angles[:, 3:6],
        right_eye=angles[:, 6:9],
        fps=clock.rate,
        missing=table.columns.missing,
        ignored=table.columns.ignored,
        notes=tuple(notes),
    )


def _parse_rows(table: Table) -> _Rows:
    rows, columns = _Rows(), table.columns
    wanted = [columns.places[name] for name in columns.weights + columns.angles]
    for line, cells in table.rows:
        if columns.count is not None and _is_zero(cells, columns.count):
            rows.without_face.append(line)
            continue
        if len(cells) != len(columns.titles):
            raise table.error(
                line,
                f"expected {len(columns.titles)} values, got {len(cells)}; "
                + (
                    "the file may be cut short: remove the row or record again"
                    if len(cells) < len(columns.titles)
                    else "remove what does not belong there"
                ),
            )
        try:
            rows.timecodes.append(timecode.parse(cells[columns.timecode]))
        except InputError as error:
            raise table.error(line, str(error)) from error
        rows.values.append(_numbers(table, line, cells, wanted))
        rows.lines.append(line)
    if not rows.lines:
        raise FileFormatError(
            f"{table.name}: expected at least one row of values"
            + (", got only rows without a face" if rows.without_face else " after the titles")
            + "; record again"
        )
    return rows


def _is_zero(cells: Sequence[str], place: int) -> bool:
    try:
        return len(cells) > place and float(cells[place]) == 0
    except ValueError:
        return False


def _numbers(table: Table, line: int, cells: Sequence[str], wanted: Sequence[int]) -> list[float]:
    try:
        numbers = [float(cells[place]) for place in wanted]
        if all(map(math.isfinite, numbers)):
            return numbers
    except ValueError:
        pass
    place = next(place for place in wanted if not _is_number(cells[place]))
    raise table.error(
        line,
        f"expected a number for {table.columns.titles[place]}, got "
        f"{cells[place].strip()[:40]!r}; correct it or remove the row",
    )


def _is_number(cell: str) -> bool:
    try:
        return math.isfinite(float(cell))
    except ValueError:
        return False


def _clock(
    table: Table, rows: _Rows, rate: float | None, drop: bool, notes: list[str]
) -> timecode.Clock:
    if rate is not None:
        return timecode.make_clock(rate, drop)
    try:
        clock, guessed = timecode.infer_clock(rows.timecodes, drop)
    except InputError as error:
        raise FileFormatError(f"{table.name}: {error}") from error
    if guessed and len(rows.lines) > 1:
        notes.append(f"Its timecode is taken to count {clock.rate:.5g} frames a second.")
    return clock


def _times(
    table: Table, rows: _Rows, clock: timecode.Clock, notes: list[str]
) -> tuple[FloatArray, list[int]]:
    """Seconds of the rows that are kept, from 0, and which rows these are."""
    frames: list[float] = []
    kept: list[int] = []
    repeated: list[int] = []
    days = 0
    for row, (line, code) in enumerate(zip(rows.lines, rows.timecodes, strict=True)):
        try:
            frame = clock.frames(code) + days * clock.day
        except InputError as error:
            raise table.error(line, str(error)) from error
        if frames and frame < frames[-1] - clock.day / 2:
            days += 1
            frame += clock.day
        if not frames or frame > frames[-1]:
            frames.append(frame)
            kept.append(row)
        elif frame == frames[-1]:
            repeated.append(line)
        else:
            raise table.error(
                line,
                f"expected a timecode after {rows.timecodes[kept[-1]].text}, got {code.text}; "
                "put the rows in order",
            )
    if repeated:
        notes.append(f"{_rows_called(repeated)} left out: a timecode that repeats.")
    return (np.array(frames) - frames[0]) / clock.rate, kept


def _weights(
    table: Table, values: FloatArray, lines: Sequence[int], clamp: bool, notes: list[str]
) -> FloatArray:
    weights = values[:, : len(table.columns.weights)]
    excess = np.maximum(-weights, weights - 1)
    wrong = np.argwhere(excess > _STRAY)
    if len(wrong) and not clamp:
        row, column = wrong[0]
        raise table.error(
            lines[row],
            f"expected {table.columns.weights[column]} within 0 and 1, got "
            f"{weights[row, column]:g}; correct it, or clamp such values",
        )
    if (excess > 0).any():
        count, most = int((excess > 0).sum()), float(excess.max())
        notes.append(f"{count} weights clamped to 0..1, the furthest out by {most:.3g}.")
    return np.clip(weights, 0.0, 1.0)


def _angles(table: Table, values: FloatArray, lines: Sequence[int], degrees: bool) -> FloatArray:
    """(T, 9) angles in the convention of a track, in the order of ANGLE_NAMES."""
    read = values[:, len(table.columns.weights) :]
    if degrees:
        read = np.radians(read)
    far = np.argwhere(np.abs(read) > 2 * np.pi)
    if len(far) and not degrees:
        row, column = far[0]
        raise table.error(
            lines[row],
            f"expected {table.columns.angles[column]} in radians, got {read[row, column]:g}; "
            "if the file has degrees, say so",
        )
    angles = np.zeros((len(values), len(ANGLE_NAMES)))
    for place, (source, sign) in enumerate(_SOURCES[name] for name in ANGLE_NAMES):
        if source in table.columns.angles:
            column = read[:, table.columns.angles.index(source)]
            angles[:, place] = sign * column + 0.0  # no -0
    # An angle that passes pi goes on past it, or the frames between would turn all the way back.
    return np.unwrap(angles, axis=0)


def _rows_called(lines: Sequence[int]) -> str:
    if len(lines) == 1:
        return f"Row {lines[0]}"
    return f"{len(lines)} rows (the first is row {lines[0]})"
