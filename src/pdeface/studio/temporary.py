"""Bytes that the page sent as a file for the library to read."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

from pdeface.errors import PDEFaceError

__all__ = ["as_file"]


@contextmanager
def as_file(data: bytes, suffix: str) -> Iterator[Path]:
    """A file of these bytes while the block lasts; errors do not name it, whose name says nothing.

    Args:
        data: the bytes.
        suffix: of the file's name, by which readers know its format.
    """
    with TemporaryDirectory(prefix="pdeface-") as folder:
        path = Path(folder) / f"file{suffix}"
        path.write_bytes(data)
        try:
            yield path
        except PDEFaceError as error:
            text = str(error).replace(f"{path}: ", "").replace(str(path), "the file")
            raise type(error)(text) from error
