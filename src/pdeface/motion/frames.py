"""A face moved by a track, frame by frame: what a film or a sequence of meshes is made of."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import overload

import numpy as np
from numpy.typing import NDArray

from pdeface.controls import CONTROLS
from pdeface.face import Face
from pdeface.motion.names import ARKIT_NAMES
from pdeface.motion.track import Track

__all__ = ["Frames"]

Frame = tuple[Face, NDArray[np.float64]]


class Frames(Sequence[Frame]):
    """The face and the (3,) yaw, pitch and roll of its head, radians, in each frame of a track.

    Expressions that the track was asked for and lacks are 0, as in an animated GLB; others that it
    does not name stay as the face has them. What the face cannot do yet is left
    out.

    Args:
        face: who moves.
        track: what it does.
        rate: frames a second.

    Raises:
        InputError: ``rate`` is not a positive number, or gives over ten million frames.

    Example:
        >>> import pdeface
        >>> from pdeface.motion import clip
        >>> face, head = Frames(pdeface.neutral(), clip("blink"), rate=30)[12]
        >>> face.weights["eyeBlinkLeft"]
        1.0
    """

    def __init__(self, face: Face, track: Track, rate: float = 30.0) -> None:
        sampled = track.resampled(rate)
        lacking = (name for name in track.missing if name in ARKIT_NAMES)
        self._face = face
        self._names = tuple(n for n in dict.fromkeys((*track.names, *lacking)) if n in CONTROLS)
        self._weights = sampled.weights_of(self._names)
        self._head = sampled.head

    @property
    def moving(self) -> tuple[str, ...]:
        """The expressions that the track moves and the face can do."""
        return self._names

    def __len__(self) -> int:
        return len(self._weights)

    @overload
    def __getitem__(self, index: int) -> Frame: ...

    @overload
    def __getitem__(self, index: slice) -> Sequence[Frame]: ...

    def __getitem__(self, index: int | slice) -> Frame | Sequence[Frame]:
        if isinstance(index, slice):
            return [self[each] for each in range(*index.indices(len(self)))]
        weights = dict(zip(self._names, self._weights[index].tolist(), strict=True))
        return self._face.with_weights(weights), self._head[index]

    def __iter__(self) -> Iterator[Frame]:
        return (self[index] for index in range(len(self)))
