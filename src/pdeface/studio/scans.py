"""Scans that the page sends: what they are, by content, and the faces fitted to them."""

from __future__ import annotations

import re
import secrets
import struct
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from pdeface.face import Face
from pdeface.studio.apart import Telling, apart
from pdeface.studio.jobs import Result, Tell
from pdeface.studio.schema import ScanInfo
from pdeface.studio.store import FaceStore, Kept
from pdeface.studio.temporary import as_file

if TYPE_CHECKING:
    from pdeface.scan import Scan, Spread, Target

__all__ = ["MOST_VERTICES", "ScanDesk", "scan_suffix"]

FloatArray = NDArray[np.float64]
Float32 = NDArray[np.float32]

MOST_VERTICES = 120_000
"""Of a scan in the page."""

_STEPS = {
    "looking for": 0.15,
    "looking": 0.25,
    "aligning": 0.36,
    "finding": 0.38,
    "laying": 0.45,
    "fitting": 0.83,
}
"""The steps of a fit by how they begin, and the share of its time that is over by then."""

_SHOWN_ROWS = 55
_STL_HEADER, _STL_TRIANGLE = 84, 50
_BEGINNING = 65536


def scan_suffix(data: bytes) -> str:
    """The suffix of the format that a scan is in, or nothing if it is none."""
    if data.startswith(b"glTF"):
        return ".glb"
    if re.match(rb"ply\r?\n", data):
        return ".ply"
    if data.lstrip()[:6] == b"solid " and b"facet" in data[:_BEGINNING]:
        return ".stl"
    if len(data) > _STL_HEADER:
        (count,) = struct.unpack_from("<I", data, 80)
        if len(data) == _STL_HEADER + _STL_TRIANGLE * count:
            return ".stl"
    beginning = data[:_BEGINNING]
    text = b"\0" not in beginning
    return ".obj" if text and re.search(rb"(?m)^v +-?[\d.]", beginning) else ""


class ScanDesk:
    """The scan that was fitted last, to see how near a face comes to it.

    Args:
        store: where faces go.
        model: MediaPipe's model file, or None for the usual one.
    """

    def __init__(self, store: FaceStore, model: str | None = None) -> None:
        self._store, self._model = store, model
        self._targets: Kept[Target] = Kept(1, "scan")

    def fitted(self, data: bytes, suffix: str, tell: Tell) -> Result:
        """A scan's face: curves fitted to it, and its colours where it has some.

        Args:
            data: bytes of the file.
            suffix: of its format.
            tell: told what is being done.

        Raises:
            InputError: no scan, or no face in it.
            MissingExtraError: what reads scans is not installed.
        """
        from pdeface.scan import Target

        face, scan, there, coverage = apart(
            _fitted, data, suffix, self._model, tell=tell, show=tell.show
        )
        key = secrets.token_hex(8)
        self._targets.put(key, Target(scan))
        note = f"fitted: RMS {there.rms:.2f} mm from the scan, median {there.median:.2f}"
        info = ScanInfo(
            key,
            len(scan.vertices),
            there.rms,
            there.median,
            there.largest,
            coverage,
        )
        return Result(self._store.put(face.with_notes({"fit": note})), scan=info)

    def distances(self, key: str, points: FloatArray, normals: FloatArray) -> Float32:
        """(n,) millimetres from places of a face to a scan; -1 where the scan has none.

        Raises:
            InputError: the scan is not known (any more).
        """
        from pdeface.scan import distances

        away = distances(self._targets.get(key), points, normals)
        return np.where(away.known, 1e3 * away.metres, -1.0).astype(np.float32)

    def drawn(self, key: str) -> dict[str, NDArray[np.floating | np.integer]]:
        """``vertices`` (V, 3) and ``triangles`` (T, 3) of a scan, none of a cloud's.

        A scan of more vertices than the page can show comes as some of its points.

        Raises:
            InputError: the scan is not known (any more).
        """
        return _drawn(self._targets.get(key).scan)


class Watched:
    """Shows a fit while it is made: the scan once, then the face on it, 55 x 46 places of it.

    Args:
        telling: where it is shown.
    """

    def __init__(self, telling: Telling) -> None:
        self._telling, self._begun = telling, False

    def __call__(self, scan: Scan, points: FloatArray) -> None:
        """A round of the fit is done: as ``on_round`` of :func:`pdeface.scan.fit_scan`."""
        if not self._begun:
            self._telling.show(_drawn(scan))
            self._begun = True
        step = (points.shape[0] - 1) // (_SHOWN_ROWS - 1)
        # Columns lie halfway between places: the coarse ones are means of those around them.
        middle = points[::step, (step - 1) // 2 :: step] + points[::step, step // 2 :: step]
        self._telling.show({"face": (0.5 * middle).astype(np.float32)})


def _drawn(scan: Scan) -> dict[str, NDArray[np.floating | np.integer]]:
    vertices = scan.vertices.astype(np.float32)
    if len(vertices) <= MOST_VERTICES:
        return {"vertices": vertices, "triangles": scan.triangles.astype(np.int32)}
    step = -(-len(vertices) // MOST_VERTICES)
    return {"vertices": vertices[::step], "triangles": np.zeros((0, 3), np.int32)}


def _fitted(
    tell: Telling, data: bytes, suffix: str, model: str | None
) -> tuple[Face, Scan, Spread, float]:
    """A scan's face, the scan in its frame, how far they are apart, and the scan's coverage."""
    from pdeface.scan import Scan, fit_scan, measure, read_scan, texture_of

    with as_file(data, suffix) as path:
        head = read_scan(path)
    given = Path(model) if model else None

    def say(text: str) -> None:
        tell(text, _share(text))

    found = fit_scan(head, model=given, progress=say, on_round=Watched(tell))
    tell("carrying the colours over", 0.88)
    image = texture_of(found)
    face = found.face.with_name("scan")
    face = face if image is None else face.with_texture(image)
    tell("measuring the fit", 0.94)
    measures = measure(found)
    bare = Scan(found.scan.vertices, found.scan.triangles, given_normals=found.scan.normals)
    return face, bare, measures.to_scan, measures.coverage


def _share(text: str) -> float:
    """About how much of the time is over when the fit says this."""
    return next((share for start, share in _STEPS.items() if text.startswith(start)), 0.0)
