"""The ZIP around a ``.pdeface`` file: named members in, the same members out, or a clear no."""

from __future__ import annotations

import io
import zipfile
from collections.abc import Mapping

from pdeface.errors import FileFormatError, InputError

__all__ = ["damaged", "read_members", "write_members"]

_MEBIBYTE = 1 << 20
# A megabyte of ZIP can unfold to a gigabyte. No face is near these sizes.
_LIMITS = {
    "face.json": 16 * _MEBIBYTE,
    "curves.npy": 64 * _MEBIBYTE,
    "texture.png": 320 * _MEBIBYTE,
    "texture.jpg": 320 * _MEBIBYTE,
}
# Without a date, the same face makes the same bytes; 1980 is where the dates of a ZIP begin.
_DATE = (1980, 1, 1, 0, 0, 0)


def write_members(members: Mapping[str, bytes]) -> bytes:
    """ZIP bytes of the members, in their order; the same members give the same bytes.

    Raises:
        InputError: a member larger than a reader would accept.
    """
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w") as archive:
        for name, data in members.items():
            _check_size(name, len(data), InputError)
            info = zipfile.ZipInfo(name, _DATE)
            info.create_system = 3  # Unix, on every system
            info.external_attr = 0o644 << 16
            if not name.startswith("texture"):  # pictures are compressed already
                info.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(info, data)
    return stream.getvalue()


def read_members(data: bytes) -> dict[str, bytes]:
    """The members that a face is made of; others are left unread.

    Raises:
        FileFormatError: not a ZIP, damaged, or a member that unfolds to too much.
    """
    if not data:
        raise damaged("the file is empty")
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            known = [info for info in archive.infolist() if info.filename in _LIMITS]
            return {info.filename: _inflate(archive, info) for info in known}
    except FileFormatError:
        raise
    except Exception as error:  # zipfile raises nearly anything on damaged files.
        raise damaged(str(error) or repr(error)) from error


def damaged(reason: str) -> FileFormatError:
    """The error that says, in one line, that a file is no readable face."""
    return FileFormatError(
        "expected a .pdeface file, got one that is damaged or not such a file "
        f"({' '.join(reason.split())}); take it from a backup or make it again"
    )


def _inflate(archive: zipfile.ZipFile, info: zipfile.ZipInfo) -> bytes:
    if info.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
        raise damaged(f"{info.filename} is compressed in an unknown way")
    # The size that the ZIP declares also bounds what zipfile will inflate.
    _check_size(info.filename, info.file_size, FileFormatError)
    return archive.read(info)


def _check_size(name: str, size: int, error: type[InputError]) -> None:
    if size > _LIMITS[name]:
        raise error(
            f"{name} of a .pdeface file may have {_LIMITS[name] // _MEBIBYTE} MiB at most, "
            f"got {size / _MEBIBYTE:.0f} MiB; make it smaller"
        )
