"""The table in a CSV file of recorded motion: its columns by name and its rows by line."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from dataclasses import dataclass

from pdeface import files
from pdeface.errors import FileFormatError
from pdeface.motion._input import read_bytes
from pdeface.motion.names import ANGLE_NAMES, ARKIT_NAMES

__all__ = ["Columns", "Table", "read_table"]

_TIMECODE, _COUNT = "timecode", "blendshapecount"


@dataclass(frozen=True)
class Columns:
    """Which column is what.

    Attributes:
        titles: of all columns, as the file spells them.
        timecode: place of the timecode.
        count: place of the number of values, None if there is no such column.
        weights: ARKit names that the file has, in their usual order.
        angles: names of angles that it has, likewise.
        places: column of each of these names.
        missing: names of weights and angles that it does not have.
        ignored: titles that mean nothing here.
    """

    titles: tuple[str, ...]
    timecode: int
    count: int | None
    weights: tuple[str, ...]
    angles: tuple[str, ...]
    places: dict[str, int]
    missing: tuple[str, ...]
    ignored: tuple[str, ...]


@dataclass(frozen=True)
class Table:
    """A file's columns, and its rows that are not empty: (line of the file from 1, cells)."""

    name: str
    columns: Columns
    rows: list[tuple[int, list[str]]]

    def error(self, line: int, what: str) -> FileFormatError:
        """The error that is in one row."""
        return FileFormatError(f"{self.name}, row {line}: {what}")


def read_table(path: files.PathLike) -> Table:
    """The table in a CSV file with a line of titles, separated by commas (or as they are).

    Raises:
        InputError: the file cannot be read.
        FileFormatError: it is empty, not text, or has no column of use.
    """
    name, text = str(path), _text(path)
    lines = csv.reader(io.StringIO(text, newline=""), delimiter=_separator(text), strict=True)
    rows: list[tuple[int, list[str]]] = []
    try:
        for cells in lines:
            if any(cell.strip() for cell in cells):
                rows.append((lines.line_num, cells))
    except csv.Error as error:
        raise FileFormatError(
            f"{name}, row {lines.line_num}: expected comma-separated values, got a row that "
            f"cannot be read ({error}); mend it"
        ) from error
    columns = _columns(name, [cell.strip() for cell in rows[0][1]])
    return Table(name, columns, [(line, _fitted(cells, columns)) for line, cells in rows[1:]])


def _text(path: files.PathLike) -> str:
    data = read_bytes(path)
    encoding = "utf-16" if data[:2] in (b"\xff\xfe", b"\xfe\xff") else "utf-8-sig"
    try:
        text = data.decode(encoding)
        if "\0" in text:
            raise ValueError("it has zero bytes")
    except ValueError as error:
        reason = getattr(error, "reason", None) or str(error)
        raise FileFormatError(
            f"{path} is not a text file ({reason}): expected comma-separated values; "
            "give the .csv that the app recorded"
        ) from error
    if not text.strip():
        raise FileFormatError(f"{path} is empty: expected recorded motion; record again")
    return text


def _separator(text: str) -> str:
    """Spreadsheets of some countries write semicolons; the titles have neither within them."""
    titles = text.lstrip().split("\n", 1)[0]
    return max(",;\t", key=titles.count)


def _columns(name: str, titles: Sequence[str]) -> Columns:
    known = {each.lower(): each for each in (*ARKIT_NAMES, *ANGLE_NAMES)}
    places: dict[str, int] = {}
    ignored: list[str] = []
    for place, title in enumerate(titles):
        key = known.get(title.lower(), title.lower())
        if key in places:
            raise FileFormatError(f"{name}: expected each column once, got {title} twice; drop one")
        if key in known.values() or key in (_TIMECODE, _COUNT):
            places[key] = place
        elif title:
            ignored.append(title)
    weights = tuple(each for each in ARKIT_NAMES if each in places)
    angles = tuple(each for each in ANGLE_NAMES if each in places)
    if not weights and not angles:
        raise FileFormatError(
            f"{name}: expected columns such as Timecode, EyeBlinkLeft and JawOpen in the first "
            f"row, got {', '.join(titles)[:60]!r}; give a CSV of Live Link Face"
        )
    if _TIMECODE not in places:
        raise FileFormatError(
            f"{name}: expected a column Timecode, got none; add the timecode of each frame"
        )
    missing = [each for each in (*ARKIT_NAMES, *ANGLE_NAMES) if each not in places]
    return Columns(
        tuple(titles),
        places[_TIMECODE],
        places.get(_COUNT),
        weights,
        angles,
        places,
        tuple(missing),
        tuple(ignored),
    )


def _fitted(cells: list[str], columns: Columns) -> list[str]:
    """The cells of a row without the empty ones that a comma at its end makes."""
    while len(cells) > len(columns.titles) and not cells[-1].strip():
        cells = cells[:-1]
    return cells
