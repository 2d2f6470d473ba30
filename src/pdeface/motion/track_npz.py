"""A track as NumPy arrays in one file (.npz); docs/motion.md describes it."""

from __future__ import annotations

import io
import zipfile
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pdeface import files
from pdeface.errors import FileFormatError
from pdeface.motion._input import read_bytes
from pdeface.motion._stored import FORMAT, VERSION, check_version, make_track
from pdeface.motion.track import Track

__all__ = ["read_npz", "write_npz"]

_NEEDED = ("times", "names", "weights")
_ANGLES = ("head", "left_eye", "right_eye")
_TEXTS = ("missing", "ignored", "notes")
_MEMBERS = (*_NEEDED, *_ANGLES, *_TEXTS, "fps", "format", "version")
# A megabyte of ZIP can unfold to a gigabyte. An hour at 60 a second takes about 100 MiB.
_LARGEST = 1 << 30


def read_npz(path: files.PathLike, clamp: bool = False) -> Track:
    """The track in an .npz file: ``times``, ``names`` and ``weights``, the rest where it is there.

    Raises:
        InputError: the file cannot be read.
        FileFormatError: it is no track, is damaged, or is newer than this library.
    """
    arrays = _arrays(path)
    if "format" in arrays and str(arrays["format"]) != FORMAT:
        raise FileFormatError(f"{path}: expected format {FORMAT}, got {str(arrays['format'])!r}")
    if "version" in arrays:
        check_version(path, arrays["version"].tolist())
    absent = [name for name in _NEEDED if name not in arrays]
    if absent:
        raise FileFormatError(
            f"{path}: expected the arrays {', '.join(_NEEDED)}, got no {' and no '.join(absent)}; "
            "see docs/motion.md"
        )
    others: dict[str, Any] = {name: arrays[name] for name in _ANGLES if name in arrays}
    others |= {name: tuple(_texts(path, name, arrays[name])) for name in _TEXTS if name in arrays}
    if "fps" in arrays:
        others["fps"] = arrays["fps"].tolist()
    names = _texts(path, "names", arrays["names"])
    return make_track(path, arrays["times"], names, arrays["weights"], clamp, others)


def write_npz(track: Track, path: files.PathLike) -> None:
    """Write a track; all of it or nothing. Reading it gives it back exactly.

    Raises:
        InputError: the file cannot be written.
    """
    arrays: dict[str, Any] = {name: getattr(track, name) for name in ("times", "weights", *_ANGLES)}
    arrays |= {name: np.array(getattr(track, name), dtype=np.str_) for name in ("names", *_TEXTS)}
    if track.fps is not None:
        arrays["fps"] = np.float64(track.fps)
    stream = io.BytesIO()
    np.savez_compressed(stream, format=np.str_(FORMAT), version=np.int64(VERSION), **arrays)
    files.atomic_write(path, stream.getvalue())


def _arrays(path: files.PathLike) -> dict[str, NDArray[Any]]:
    data = read_bytes(path)
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            sizes = {info.filename: info.file_size for info in archive.infolist()}
        if sum(sizes.values()) > _LARGEST:
            raise ValueError(f"it unfolds to more than {_LARGEST >> 20} MiB")
        with np.load(io.BytesIO(data), allow_pickle=False) as stored:
            return {name: stored[name] for name in _MEMBERS if name in stored.files}
    except Exception as error:  # zipfile and the parser of .npy raise nearly anything
        reason = " ".join((str(error) or repr(error)).split())
        raise FileFormatError(
            f"{path} is not a track: expected the arrays of an .npz file ({reason}); write it anew"
        ) from error


def _texts(path: files.PathLike, name: str, array: NDArray[Any]) -> list[str]:
    if array.ndim != 1 or (array.size and array.dtype.kind != "U"):
        raise FileFormatError(
            f"{path}: expected a list of texts in {name}, got {array.dtype} of shape "
            f"{array.shape}; see docs/motion.md"
        )
    return [str(text) for text in array]
