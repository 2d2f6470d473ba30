"""The bytes of a motion file."""

from __future__ import annotations

from pathlib import Path

from pdeface import files
from pdeface.errors import FileFormatError, InputError

__all__ = ["read_bytes"]


def read_bytes(path: files.PathLike) -> bytes:
    """All that a file holds.

    Raises:
        InputError: it cannot be read.
        FileFormatError: it is empty.
    """
    try:
        data = Path(path).read_bytes()
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise InputError(f"cannot read the motion file {path}: {reason}; check its name") from error
    if not data.strip():
        raise FileFormatError(f"{path} is empty: expected recorded motion; record again")
    return data
