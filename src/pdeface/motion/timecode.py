"""Timecode: the hours, minutes, seconds and frames that a recording counts, and the seconds meant.

Film and video number their frames ``HH:MM:SS:FF``. At the NTSC rates (30000/1001, called 29.97,
and 60000/1001, called 59.94) a second of numbers lasts 1.001 seconds. **Drop-frame** counting,
written ``HH:MM:SS;FF``, keeps up with the clock: it skips the first two numbers (four at 59.94) of
each minute but every tenth. It drops numbers, never frames.

The fraction that some recorders add to the frame, ``FF.mmm``, is a fraction of a frame.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from pdeface.errors import InputError

__all__ = ["Clock", "Timecode", "infer_clock", "make_clock", "parse"]

_PATTERN = re.compile(r"(\d{1,2})[:;](\d{1,2})[:;](\d{1,2})([:;])(\d{1,3}(?:\.\d+)?)", re.ASCII)
_NTSC = 1000 / 1001
# Frame numbers in a second, of the recorders there are.
_NOMINAL = (24, 25, 30, 48, 50, 60, 100, 120, 240)
_ASSUMED = 60


@dataclass(frozen=True)
class Timecode:
    """What a timecode says: ``seconds`` since midnight by its numbers, and a frame in that one."""

    text: str
    seconds: int
    frame: float
    semicolon: bool


@dataclass(frozen=True)
class Clock:
    """How a recording counts.

    Attributes:
        nominal: frame numbers in a second of timecode.
        rate: frames that pass in a second of time.
        drop: whether numbers are dropped to keep up with the clock.
    """

    nominal: int
    rate: float
    drop: bool

    @property
    def dropped(self) -> int:
        """Numbers left out at the start of a minute: 2 at 29.97, 4 at 59.94, else 0."""
        return 2 * (self.nominal // 30) if self.drop else 0

    @property
    def day(self) -> int:
        """Frames in 24 hours of timecode."""
        return 86400 * self.nominal - self.dropped * (1440 - 144)

    def frames(self, timecode: Timecode) -> float:
        """Frames since midnight.

        Raises:
            InputError: a frame number that this clock never shows.
        """
        minutes, second = divmod(timecode.seconds, 60)
        if timecode.frame >= self.nominal:
            raise InputError(
                f"expected frame numbers below {self.nominal} at {self.rate:.5g} frames a second, "
                f"got timecode {timecode.text}; give the recording's fps"
            )
        if minutes % 10 and not second and timecode.frame < self.dropped:
            raise InputError(
                f"drop-frame timecode skips {self.dropped} numbers at each minute but every "
                f"tenth, got {timecode.text}, which is one of them; "
                "give drop_frame=False if the recording does not drop"
            )
        skipped = self.dropped * (minutes - minutes // 10)
        return timecode.seconds * self.nominal + timecode.frame - skipped


def parse(text: str) -> Timecode:
    """The timecode in ``HH:MM:SS:FF``, ``HH:MM:SS;FF``, either with a fraction of a frame.

    Raises:
        InputError: it is not one.
    """
    match = _PATTERN.fullmatch(text.strip())
    hours, minutes, seconds = (int(match[group]) if match else 60 for group in (1, 2, 3))
    if match is None or hours > 23 or minutes > 59 or seconds > 59:
        raise InputError(
            f"expected a timecode such as 13:05:59:07.250 (hours, minutes, seconds, frame), "
            f"got {text.strip()[:40]!r}; mend it"
        )
    total = 3600 * hours + 60 * minutes + seconds
    return Timecode(text.strip(), total, float(match[5]), match[4] == ";")


def make_clock(fps: float, drop: bool) -> Clock:
    """The clock of ``fps`` frames a second: a whole number or an NTSC rate such as 29.97.

    Numbers are dropped at 29.97 and 59.94 alone, so 30 and 60 mean these where ``drop`` is true.

    Raises:
        InputError: no timecode counts at this rate.
    """
    nominal = round(fps) if 1 <= fps <= 1000 else 0
    whole, ntsc = abs(fps - nominal) < 1e-6, nominal and abs(fps / (nominal * _NTSC) - 1) < 2e-4
    if not whole and not ntsc:
        raise InputError(
            f"expected a whole number of frames a second, or an NTSC rate such as 29.97 or "
            f"59.94, got {fps:g}; give the rate that the timecode counts at"
        )
    if drop and nominal % 30:
        raise InputError(
            f"drop-frame timecode counts at 29.97 or 59.94 frames a second, got {fps:g}; "
            "give one of these, or drop_frame=False"
        )
    return Clock(nominal, nominal * _NTSC if drop or not whole else float(nominal), drop)


def infer_clock(timecodes: Sequence[Timecode], drop: bool) -> tuple[Clock, bool]:
    """The clock that shows these timecodes one after the other, and whether it had to be guessed.

    What tells is the frame number of the last row of a second and the first of the next. With no
    two seconds to compare, or none whose frames are near a rate that recorders have, the clock is
    taken for one of 60 (or of more, where larger frame numbers occur).

    Raises:
        InputError: frame numbers that no recorder shows.
    """
    highest = int(max(timecode.frame for timecode in timecodes))
    possible = [rate for rate in _NOMINAL if rate > highest and not (drop and rate % 30)]
    if not possible:
        raise InputError(
            f"expected frame numbers below {_NOMINAL[-1]}, got {highest}; give the recording's fps"
        )
    measured = _numbers_in_a_second(timecodes, drop)
    nearest = min(possible, key=lambda rate: abs(rate - measured))
    # Lost frames and uneven ones blur the measure; 24 and 25, the closest two, are told apart.
    known = abs(nearest - measured) < 0.5 if nearest < 30 else abs(nearest / measured - 1) < 0.06
    if not known:
        nearest = min(rate for rate in possible if rate >= _ASSUMED or rate == possible[-1])
    return make_clock(nearest, drop), not known


def _numbers_in_a_second(timecodes: Sequence[Timecode], drop: bool) -> float:
    """The median, over the ends of seconds, of the numbers that a second has; infinite for none."""
    seconds = np.array([timecode.seconds for timecode in timecodes])
    frames = np.array([timecode.frame for timecode in timecodes])
    passed = np.diff(seconds) % 86400
    steps = np.diff(frames)[passed == 0]
    ends = passed == 1
    if drop:  # the first numbers of most minutes are missing
        ends &= (seconds[1:] % 60 != 0) | (seconds[1:] % 600 == 0)
    if not ends.any():
        return np.inf
    step = np.median(steps[steps > 0]) if (steps > 0).any() else 1.0
    return float(np.median(frames[:-1][ends] - frames[1:][ends]) + step)
