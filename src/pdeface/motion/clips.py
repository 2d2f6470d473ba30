"""Built-in clips: a blink, a smile, eyes that look around, a face that talks.

Each begins and ends with the face at rest, so that it can be looped, and is the same every time.
Timing follows what is measured on people: lids close in about 90 ms and open in about twice that;
the eyes turn in under 80 ms and the head follows in half a second; a smile takes half a second to
come and longer to go.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from pdeface.errors import InputError
from pdeface.motion import _checks as checks
from pdeface.motion.easing import bump, eased, through, window
from pdeface.motion.gaze import eye_angles, look_weights
from pdeface.motion.names import ARKIT_NAMES, both_sides, did_you_mean
from pdeface.motion.speech import mouth_weights
from pdeface.motion.track import Track

__all__ = ["CLIPS", "blink", "clip", "look", "smile", "talk"]

FloatArray = NDArray[np.float64]
Channels = dict[str, FloatArray]

# "Hello, I am a face: a few curves and one equation", roughly, with seconds for each sound.
_WORDS: tuple[tuple[str, float], ...] = (
    *(("viseme_kk", 0.06), ("viseme_E", 0.09), ("viseme_nn", 0.09), ("viseme_O", 0.15)),
    *(("viseme_U", 0.09), ("viseme_sil", 0.22)),
    *(("viseme_aa", 0.11), ("viseme_I", 0.07), ("viseme_E", 0.08), ("viseme_PP", 0.09)),
    *(("viseme_aa", 0.06), ("viseme_FF", 0.1), ("viseme_E", 0.1), ("viseme_I", 0.08)),
    *(("viseme_SS", 0.12), ("viseme_sil", 0.24)),
    *(("viseme_aa", 0.06), ("viseme_FF", 0.09), ("viseme_I", 0.07), ("viseme_U", 0.12)),
    *(("viseme_kk", 0.08), ("viseme_RR", 0.12), ("viseme_FF", 0.08), ("viseme_SS", 0.1)),
    *(("viseme_E", 0.08), ("viseme_nn", 0.07), ("viseme_DD", 0.06)),
    *(("viseme_U", 0.08), ("viseme_aa", 0.1), ("viseme_nn", 0.08)),
    *(("viseme_I", 0.09), ("viseme_kk", 0.07), ("viseme_U", 0.06), ("viseme_E", 0.14)),
    *(("viseme_CH", 0.11), ("viseme_aa", 0.07), ("viseme_nn", 0.12), ("viseme_TH", 0.07)),
)
_FIRST_WORD = 0.35
# Seconds at which a word is stressed: the head nods, the brows rise.
_STRESSED = (0.6, 1.45, 2.15, 3.45)


def blink(fps: float = 60.0) -> Track:
    """Both eyes close and open once; one second.

    The lids close in 90 ms, rest for 25 ms, and open fast, then ever slower, in 190 ms. Meanwhile
    the lower lids draw in a little and the eyes dip.
    """
    times = _moments(1.0, fps)
    return _track(times, _blinks(times, [0.3]), fps=fps)


def smile(fps: float = 60.0) -> Track:
    """A smile that reaches the eyes comes, stays and goes; three and a half seconds."""
    times = _moments(3.5, fps)
    corners = through(times, [(0.2, 0), (0.75, 0.72), (1.3, 0.8), (2.3, 0.74), (3.3, 0)])
    cheeks = through(times, [(0.35, 0), (0.95, 0.9), (2.2, 0.85), (3.1, 0)])
    smiling = _times_channels(corners, mouthSmile=1.0, mouthDimple=0.12, browOuterUp=0.08)
    # No smile is quite even; one that is looks drawn on.
    smiling["mouthSmileRight"] = smiling["mouthSmileRight"] * 0.94
    raised = _times_channels(cheeks, cheekSquint=0.55, eyeSquint=0.3)
    head = np.zeros((len(times), 3))
    head[:, 1] = -0.03 * bump(times, 1.7, 3.0, 1.0)
    head[:, 2] = 0.035 * bump(times, 1.8, 3.0, 0.8)
    return _track(times, _sum(smiling, raised, _blinks(times, [2.45])), head, fps)


def look(fps: float = 60.0) -> Track:
    """The eyes look left, right, up and down, and the head follows; five and a half seconds.

    The eyes leap to the new place first; the head turns after them, slower and a third as far,
    and the eyes give way so that they stay where they look. The long way from left to right goes
    with a blink.
    """
    times = _moments(5.5, fps)
    # Seconds, yaw and pitch of what is looked at, radians.
    places = ((0.4, 0.36, 0.0), (1.5, -0.36, 0.0), (2.7, 0.0, -0.3), (3.7, 0.05, 0.32))
    targets = np.zeros((2, len(times)))
    heads = np.zeros((2, len(times)))
    at = np.zeros(2)
    for start, *place in (*places, (4.6, 0.0, 0.0)):
        turn = np.array(place) - at
        leap = 0.021 + 0.126 * float(np.abs(turn).max())  # 2.2 ms a degree and 21 ms
        targets += turn[:, np.newaxis] * eased(times, start, start + leap)
        heads += turn[:, np.newaxis] * eased(times, start + 0.05, start + 0.55) / 3.0
        at += turn
    looking = look_weights(*(targets - heads))
    raised = np.maximum(0.0, -targets[1] / 0.3) ** 2
    brows = _times_channels(raised, browInnerUp=0.25, browOuterUp=0.2)
    head = np.stack([*heads, np.zeros_like(times)], axis=-1)
    return _track(times, _sum(looking, brows, _blinks(times, [1.52])), head, fps)


def talk(fps: float = 60.0) -> Track:
    """A few words: the mouth speaks, the head nods with the stress, the eyes hold their gaze.

    The eyes stay on whoever listens: they turn against the head. Nearly five seconds.
    """
    length = sum(seconds for _, seconds in _WORDS)
    duration = np.ceil(_FIRST_WORD + length + 0.6)
    times = _moments(duration, fps)
    mouth = mouth_weights(times, _WORDS, _FIRST_WORD)
    stress = sum((bump(times, at, 0.5) for at in _STRESSED), np.zeros_like(times))
    at_ends = window(times, duration, 0.6)
    brows = _times_channels(stress, browInnerUp=0.22, browOuterUp=0.12)
    yaw = at_ends * (0.07 * np.sin(1.9 * times + 0.4) + 0.03 * np.sin(4.3 * times))
    pitch = at_ends * 0.02 * np.sin(2.7 * times) + 0.06 * stress
    roll = at_ends * 0.035 * np.sin(1.3 * times + 1.0)
    eyes = look_weights(-yaw, -pitch)
    final = _times_channels(bump(times, duration - 0.9, 1.6, 0.2), mouthSmile=0.22, cheekSquint=0.1)
    blinks = _blinks(times, [1.18, 2.02, duration - 0.75])
    head = np.stack([yaw, pitch, roll], axis=-1)
    return _track(times, _sum(mouth, brows, eyes, final, blinks), head, fps)


CLIPS: Mapping[str, Callable[[float], Track]] = MappingProxyType(
    {"blink": blink, "smile": smile, "look": look, "talk": talk}
)
"""The built-in clips by name; each takes its samples a second."""


def clip(name: str, fps: float = 60.0) -> Track:
    """A built-in clip: ``"blink"``, ``"smile"``, ``"look"`` or ``"talk"``.

    Raises:
        InputError: an unknown name, or ``fps`` is no positive number.

    Example:
        >>> clip("blink").at(0.4).weights["eyeBlinkLeft"]
        1.0
    """
    if name not in CLIPS:
        raise InputError(f"expected the name of a clip, got {name!r}; {did_you_mean(name, CLIPS)}")
    return CLIPS[name](fps)


def _moments(duration: float, fps: float) -> FloatArray:
    rate = checks.rate(fps)
    return np.arange(int(np.floor(duration * rate + 1e-6)) + 1) / rate


def _blinks(times: FloatArray, starts: Sequence[float]) -> Channels:
    closed = np.zeros_like(times)
    for start in starts:
        down, up = start + 0.09, start + 0.115
        knots = [(start, 0), (down, 1), (up, 1), (up + 0.08, 0.4), (up + 0.19, 0)]
        closed = closed + through(times, knots)
    return _times_channels(closed, eyeBlink=1.0, eyeSquint=0.15, browDown=0.04, eyeLookDown=0.06)


def _times_channels(curve: FloatArray, **heights: float) -> Channels:
    return {name: height * curve for name, height in both_sides(**heights).items()}


def _sum(*parts: Channels) -> Channels:
    total: Channels = {}
    for part in parts:
        for name, values in part.items():
            total[name] = total[name] + values if name in total else values
    return total


def _track(
    times: FloatArray, channels: Channels, head: FloatArray | None = None, fps: float = 60.0
) -> Track:
    used = [name for name in ARKIT_NAMES if name in channels and channels[name].any()]
    weights = np.stack([np.clip(channels[name], 0.0, 1.0) for name in used], axis=1)
    looks = {name: channels.get(name, np.zeros_like(times)) for name in look_weights(times, times)}
    eyes = eye_angles(looks)
    return Track(
        times,
        tuple(used),
        weights,
        head=np.zeros((len(times), 3)) if head is None else head,
        left_eye=eyes,
        right_eye=eyes,
        fps=fps,
    )
