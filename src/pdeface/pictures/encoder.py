"""Pictures to an MP4, by the ffmpeg that the package imageio-ffmpeg brings."""

from __future__ import annotations

import contextlib
import math
import subprocess
import tempfile
from pathlib import Path
from types import TracebackType
from typing import IO, Any, Final

import numpy as np
from numpy.typing import NDArray

from pdeface.errors import InputError, MissingExtraError, require

__all__ = ["Encoder"]

MOST: Final = 240.0
"""Frames a second; no screen shows more."""

# As good as the eye can tell, and what browsers and phones play: 8 bits, colours halved both ways,
# in the colours of HD television, said so that no player has to guess. The index comes first, so
# that a browser can begin before it has all.
_CODEC = (
    *("-an", "-c:v", "libx264", "-preset", "medium", "-crf", "17", "-pix_fmt", "yuv420p"),
    *("-vf", "scale=out_color_matrix=bt709:out_range=tv"),
    *("-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709"),
    *("-color_range", "tv", "-movflags", "+faststart", "-f", "mp4"),
)


class Encoder:
    """Writes pictures into a film, one after the other, in a ``with`` block.

    Args:
        path: the file, which is overwritten.
        size: (width, height) of all pictures, pixels, both even.
        rate: frames a second.

    Raises:
        InputError: such a rate cannot be, or ffmpeg cannot write there.
        MissingExtraError: imageio-ffmpeg is not installed, or has no ffmpeg for this machine.
    """

    def __init__(self, path: Path, size: tuple[int, int], rate: float) -> None:
        if not (math.isfinite(rate) and 0.0 < rate <= MOST):
            raise InputError(
                f"a film has more than 0 and at most {MOST:g} frames a second, got {rate:g}; try 30"
            )
        raw = ("-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{size[0]}x{size[1]}")
        source = (*raw, "-framerate", f"{rate:.9g}", "-i", "pipe:0")
        quiet = ("-hide_banner", "-loglevel", "error", "-y")
        self._command = [_ffmpeg(), *quiet, *source, *_CODEC, str(path)]
        self._shape = (size[1], size[0], 3)

    def __enter__(self) -> Encoder:
        # What ffmpeg says goes to a file: a pipe that nobody empties would stop it.
        self._said: IO[bytes] = tempfile.TemporaryFile()
        self._process = subprocess.Popen(
            self._command, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=self._said
        )
        return self

    def add(self, image: NDArray[np.uint8], number: int) -> None:
        """Add an (H, W, 3) picture, the frame of this number.

        Raises:
            InputError: ffmpeg could not write it.
        """
        if image.shape != self._shape:
            raise ValueError(f"frame {number} has shape {image.shape}, not {self._shape}")
        pipe: Any = self._process.stdin
        try:
            pipe.write(np.ascontiguousarray(image).data)
        except OSError as error:
            raise self._failed() from error

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        try:
            if error is not None:
                self._process.kill()
            pipe: Any = self._process.stdin
            with contextlib.suppress(OSError):  # what went wrong shows in what ffmpeg returns
                pipe.close()
            if self._process.wait() and error is None:
                raise self._failed()
        finally:
            self._said.close()

    def _failed(self) -> InputError:
        self._process.wait()
        self._said.seek(0)
        lines = self._said.read().decode(errors="replace").split("\n")
        reason = next((line.strip() for line in lines if line.strip()), "it does not say why")
        return InputError(f"ffmpeg cannot write the film: {reason}; check the place and its space")


def _ffmpeg() -> str:
    try:
        path: str = require("imageio_ffmpeg", "video", "to write films").get_ffmpeg_exe()
    except RuntimeError as error:
        raise MissingExtraError(
            "imageio-ffmpeg has no ffmpeg for this machine; install one and set the environment "
            "variable IMAGEIO_FFMPEG_EXE to it"
        ) from error
    return path
