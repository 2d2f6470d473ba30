"""Scans that the page sends: what they are, by content, and the faces fitted to them."""

from __future__ import annotations

import re
import struct
from pathlib import Path
from tempfile import TemporaryDirectory

from pdeface.studio.jobs import Result, Tell
from pdeface.studio.store import FaceStore

__all__ = ["fitted", "scan_suffix"]

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


def fitted(store: FaceStore, data: bytes, suffix: str, model: str | None, tell: Tell) -> Result:
    """A scan's face: curves fitted to it, and its colours where it has some.

    Args:
        store: where the face goes.
        data: bytes of the file.
        suffix: of its format.
        model: MediaPipe's model file, or None for the usual one.
        tell: told what is being done.

    Raises:
        InputError: no scan, or no face in it.
        MissingExtraError: what reads scans is not installed.
    """
    from pdeface.scan import fit_scan, measure, read_scan, texture_of

    with TemporaryDirectory(prefix="pdeface-") as folder:
        path = Path(folder) / f"scan{suffix}"
        path.write_bytes(data)
        head = read_scan(path)
    tell("fitting")
    found = fit_scan(head, model=Path(model) if model else None, progress=tell)
    tell("carrying the colours over")
    image = texture_of(found)
    face = found.face.with_name("scan")
    face = face if image is None else face.with_texture(image)
    tell("measuring the fit")
    there = measure(found).to_scan
    note = f"fitted: RMS {there.rms:.2f} mm from the scan, median {there.median:.2f}"
    return store.put(face.with_notes({"fit": note})), []
