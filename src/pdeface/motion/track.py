"""A track: the weights of expressions, and the angles of head and eyes, over time.

Angles are right-handed rotations, radians, about the axes of docs/conventions.md (+X the subject's
left, +Y up, +Z forward):

- **yaw** about +Y: positive turns to the subject's left;
- **pitch** about +X: positive looks down;
- **roll** about +Z: positive tips the top of the head towards the subject's right shoulder.

Yaw is outermost: the rotation is ``R = R_y(yaw) R_x(pitch) R_z(roll)`` (intrinsic Y-X-Z, which
three.js calls ``"YXZ"``).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pdeface.errors import InputError
from pdeface.motion import _checks as checks

__all__ = ["Pose", "Track"]

FloatArray = NDArray[np.float64]
Angles = tuple[float, float, float]

_MOST_SAMPLES = 10_000_000


def _at_rest() -> FloatArray:
    return np.zeros((0, 3))


@dataclass(frozen=True)
class Pose:
    """A track at one moment.

    Attributes:
        weights: weight 0..1 by ARKit name; ``face.set(**pose.weights)`` puts it on a face.
        head: yaw, pitch and roll of the head, radians.
        left_eye: of the subject's left eye, relative to the head.
        right_eye: of the subject's right eye, relative to the head.
    """

    weights: Mapping[str, float]
    head: Angles
    left_eye: Angles
    right_eye: Angles


@dataclass(frozen=True, eq=False)
class Track:
    """Expression weights and angles at T moments; between them, straight lines.

    Attributes:
        times: (T,) seconds, not negative, strictly increasing; most tracks begin at 0.
        names: (N,) the ARKit blendshapes that the track has; any other is 0 throughout.
        weights: (T, N) weights, 0..1.
        head: (T, 3) yaw, pitch and roll of the head, radians (see :mod:`pdeface.motion.track`).
            Without it, as without the next two, the angles are 0.
        left_eye: (T, 3) of the subject's left eye, relative to the head.
        right_eye: (T, 3) of the subject's right eye. A recording that has both the eyes' angles
            and their ``eyeLook`` weights says the same thing twice: apply one of the two.
        fps: frames a second of the source, or None if it has no such rate.
        missing: ARKit and angle names that the source was asked for and did not have.
        ignored: names in the source that mean nothing here.
        notes: what a reader did to the source, a sentence each.

    Raises:
        InputError: not such arrays, an unknown name, or a number out of range; it says where.
    """

    times: FloatArray
    names: tuple[str, ...]
    weights: FloatArray
    head: FloatArray = field(default_factory=_at_rest)
    left_eye: FloatArray = field(default_factory=_at_rest)
    right_eye: FloatArray = field(default_factory=_at_rest)
    fps: float | None = None
    missing: tuple[str, ...] = ()
    ignored: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        times = checks.times(self.times)
        names = checks.names(self.names)
        self._put("times", times)
        self._put("names", names)
        self._put("weights", checks.weights(self.weights, times, names))
        for part in ("head", "left_eye", "right_eye"):
            self._put(part, checks.angles(getattr(self, part), times, part))
        self._put("fps", None if self.fps is None else checks.rate(self.fps))
        for texts in ("missing", "ignored", "notes"):
            self._put(texts, tuple(str(text) for text in getattr(self, texts)))

    @property
    def duration(self) -> float:
        """Seconds from the first sample to the last."""
        return float(self.times[-1] - self.times[0])

    def at(self, time: float) -> Pose:
        """The pose at ``time`` seconds, by linear interpolation; before and after, it holds.

        Raises:
            InputError: ``time`` is not a finite number.
        """
        moment = checks.number(time, "a time in seconds")
        weights, head, left_eye, right_eye = self._interpolate(np.array([moment]))
        return Pose(
            dict(zip(self.names, weights[0].tolist(), strict=True)),
            *(_triple(angles[0]) for angles in (head, left_eye, right_eye)),
        )

    def resampled(self, fps: float) -> Track:
        """The track at ``fps`` samples a second, from its first sample on.

        The last sample is the last that falls within the track: up to one frame is lost at its
        end if its duration is no whole number of frames.

        Raises:
            InputError: ``fps`` is not a positive number, or gives over ten million samples.
        """
        rate = checks.rate(fps)
        frames = self.duration * rate
        if frames >= _MOST_SAMPLES:
            raise InputError(
                f"expected at most {_MOST_SAMPLES} samples, got {frames:.3g} from {rate:g} a "
                "second; use a lower rate or a slice of the track"
            )
        # A track of 2 s at 30 a second has a sample at its end, however 2 * 30 is rounded.
        count = int(np.floor(frames + 1e-6)) + 1
        return self._sampled(self.times[0] + np.arange(count) / rate, fps=rate)

    def slice(self, start: float, stop: float | None = None) -> Track:
        """The part from ``start`` to ``stop`` seconds (or to the end), its times from 0.

        Raises:
            InputError: not 0 <= start <= stop, or nothing of the track lies there.
        """
        first = checks.number(start, "a time in seconds")
        last = float(self.times[-1])
        end = last if stop is None else min(checks.number(stop, "a time in seconds"), last)
        if not 0 <= first <= end:
            raise InputError(
                f"expected 0 <= start <= stop within the track's {last:g} seconds, got start = "
                f"{start:g} and stop = {'the end' if stop is None else format(stop, 'g')}; "
                "choose a part that is there"
            )
        inside = self.times[(self.times > first) & (self.times < end)]
        moments = np.unique(np.concatenate([[first], inside, [end]]))
        part = self._sampled(moments, fps=self.fps)
        return replace(part, times=moments - first)

    def weights_of(self, names: Sequence[str]) -> FloatArray:
        """(T, len(names)) weights in the order asked for; of a name the track lacks, zeros."""
        columns = {name: column for column, name in enumerate(self.names)}
        chosen = np.zeros((len(self.times), len(names)))
        for place, name in enumerate(names):
            if name in columns:
                chosen[:, place] = self.weights[:, columns[name]]
        return chosen

    def _sampled(self, moments: FloatArray, fps: float | None) -> Track:
        weights, head, left_eye, right_eye = self._interpolate(moments)
        return replace(
            self,
            times=moments,
            weights=weights,
            head=head,
            left_eye=left_eye,
            right_eye=right_eye,
            fps=fps,
        )

    def _interpolate(self, moments: FloatArray) -> tuple[FloatArray, ...]:
        """Weights and the three angles at each moment."""
        last = len(self.times) - 1
        after = np.clip(np.searchsorted(self.times, moments, side="right"), min(1, last), last)
        before = np.maximum(after - 1, 0)
        length = np.where(after > before, self.times[after] - self.times[before], 1.0)
        share = np.clip((moments - self.times[before]) / length, 0.0, 1.0)[:, np.newaxis]
        # Both products, rather than one of a difference: exact at both ends.
        weights, *angles = (
            (1.0 - share) * values[before] + share * values[after]
            for values in (self.weights, self.head, self.left_eye, self.right_eye)
        )
        return np.clip(weights, 0.0, 1.0), *angles

    def _put(self, name: str, value: object) -> None:
        if isinstance(value, np.ndarray):
            value.setflags(write=False)
        object.__setattr__(self, name, value)

    def _values(self) -> tuple[Any, ...]:
        return (
            *(self.times, self.names, self.weights, self.head, self.left_eye, self.right_eye),
            *(self.fps, self.missing, self.ignored, self.notes),
        )

    def __reduce__(self) -> tuple[Any, ...]:
        # Unpickled arrays would be writable.
        return type(self), self._values()

    def __len__(self) -> int:
        return len(self.times)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Track):
            return NotImplemented
        pairs = zip(self._values(), other._values(), strict=True)
        return all(np.array_equal(mine, theirs) for mine, theirs in pairs)

    def __repr__(self) -> str:
        return (
            f"Track({len(self)} samples of {len(self.names)} blendshapes, "
            f"{self.duration:.3f} seconds)"
        )


def _triple(angles: FloatArray) -> Angles:
    yaw, pitch, roll = angles.tolist()
    return yaw, pitch, roll
