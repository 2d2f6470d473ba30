"""The file of MediaPipe's face landmarker: given, named by the environment, or fetched once."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

from pdeface.errors import InputError, require
from pdeface.files import PathLike

__all__ = ["NAME", "SHA256", "URL", "VARIABLE", "model_file"]

NAME = "face_landmarker.task"
URL = (
    "https://storage.googleapis.com/mediapipe-models/face_landmarker/face_landmarker/float16/1/"
    + NAME
)
SHA256 = "64184e229b263107bc2b804c6625db1341ff2bb731874b0bcc2fe6544e0bc9ff"
VARIABLE = "PDEFACE_MODEL"

Progress = Callable[[int, int], None]


def model_file(given: PathLike | None = None, progress: Progress | None = None) -> Path:
    """Where the model is; fetched from its publisher into the user's cache if it is nowhere.

    Args:
        given: the file. None takes the one that the environment variable ``PDEFACE_MODEL`` names,
            or else the one in the cache, which must have the right SHA-256.
        progress: called with bytes fetched and bytes in all while the model is fetched.

    Raises:
        InputError: no file of that name, or none in the cache and it cannot be fetched.
        MissingExtraError: pooch, which fetches it, is not installed.
    """
    if given is not None:
        return _existing(Path(given), "--model")
    if named := os.environ.get(VARIABLE):
        return _existing(Path(named), VARIABLE)
    pooch = require("pooch", "photo", "to keep the face model")
    cached = Path(pooch.os_cache("pdeface")) / NAME
    if not _is_right(cached):
        _fetch(pooch, cached, progress)
    return cached


def _existing(path: Path, source: str) -> Path:
    if path.is_file():
        return path
    raise InputError(f"{source} must name the file {NAME}, found no file at {path}; check it")


def _is_right(path: Path) -> bool:
    try:
        return hashlib.sha256(path.read_bytes()).hexdigest() == SHA256
    except OSError:
        return False


def _fetch(pooch: Any, target: Path, progress: Progress | None) -> None:
    pooch.get_logger().setLevel("ERROR")  # its log lines would break into ours
    try:
        downloader = pooch.HTTPDownloader(progressbar=_Bar(progress) if progress else False)
        pooch.retrieve(URL, f"sha256:{SHA256}", target.name, target.parent, downloader=downloader)
    except Exception as error:  # whatever the network, the disk or the hash has against it
        reason = "it is damaged" if "hash" in str(error) else "it cannot be fetched"
        raise InputError(
            f"the face model is not here and {reason}; download {URL} and save it as {target}, "
            f"or name it with --model or {VARIABLE}"
        ) from error


class _Bar:
    """What pooch calls while it downloads, in the manner of tqdm."""

    def __init__(self, progress: Progress) -> None:
        self._progress = progress
        self._done = 0
        self.total = 0

    def update(self, count: int) -> None:
        self._done += count
        self._progress(min(self._done, self.total), self.total)

    def reset(self) -> None:
        self._done = 0

    def close(self) -> None:
        pass
