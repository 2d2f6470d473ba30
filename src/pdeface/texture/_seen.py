"""What photos show of a face, on a coarse texture: matched, mirrored, shared out and filled."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from pdeface.texture._fill import extend
from pdeface.texture._skin import Kinds
from pdeface.texture._smooth import blur, step

__all__ = ["View", "filled", "matched", "mirrored", "shares_of"]

FloatArray = NDArray[np.floating[Any]]

_SHARPNESS = 4
"""How much more the better of two photos counts: a power of their trust."""

_MOST_GAIN = 0.7
"""How far photos are matched in light, at most: a natural logarithm."""


class View(NamedTuple):
    """What a photo, or its mirror image, shows, on the coarse texture.

    ``gain`` is the logarithm by which its colours are to be multiplied.
    """

    layer: int
    flipped: bool
    colours: FloatArray
    known: FloatArray
    kinds: Kinds
    gain: FloatArray


def matched(views: list[View]) -> list[View]:
    """The views, each brought to the light of the first where both show the same."""
    result = [views[0]]
    base = views[0]
    for number, view in enumerate(views[1:], start=1):
        result.append(view._replace(layer=number, gain=_gain(view, base)))
    return result


def mirrored(view: View, number: int) -> View:
    """The view as the other side of the face, in the light of this one."""
    flip = [array[:, ::-1] for array in (view.colours, view.known, view.gain)]
    other = Kinds(*(kind[:, ::-1] for kind in view.kinds))
    # What is not skin or hair is nobody's mirror image.
    known = flip[1] * np.maximum(other.skin, other.hair)
    mirrored = View(number, True, flip[0], known, other, flip[2])
    return mirrored._replace(gain=_gain(mirrored, view))


def _gain(view: View, base: View) -> FloatArray:
    """(H, W, 3) logarithm of what turns the light of a view into that of another; smooth."""
    ratio = np.log(np.maximum(base.colours, 4.0)) + base.gain
    ratio = ratio - np.log(np.maximum(view.colours, 4.0)) - view.gain
    both = view.known * base.known * view.kinds.skin * base.kinds.skin
    if float(both.sum()) < 16.0:
        return view.gain
    radius = len(both) / 32.0
    weight = blur(both, radius)
    mean = blur(ratio * both[..., None], radius) / np.maximum(weight, 1e-4)[..., None]
    smooth = extend(mean, np.clip(weight * 20.0, 0.0, 1.0))
    return np.asarray(view.gain + np.clip(blur(smooth, radius), -_MOST_GAIN, _MOST_GAIN))


def shares_of(views: list[View]) -> list[FloatArray]:
    """(H, W) how much of each view is taken; together at most 1, mirror images last."""
    photos = [view.known for view in views if not view.flipped]
    mirrors = [view.known for view in views if view.flipped]
    shares = _contest(photos)
    left = np.clip(1.0 - sum(shares), 0.0, 1.0)
    return shares + [left * share for share in _contest(mirrors)]


def _contest(known: list[FloatArray]) -> list[FloatArray]:
    best = np.max(known, axis=0)
    weights = [k * (k / np.maximum(best, 1e-6)) ** _SHARPNESS for k in known]
    total = np.maximum(sum(weights), 1e-6)
    return [np.asarray(best * weight / total) for weight in weights]


def filled(views: list[View], shares: list[FloatArray]) -> FloatArray:
    """(H, W, 3) skin and hair for where no view shows the face."""
    known = np.clip(sum(shares), 0.0, 1.0)
    total = np.maximum(sum(shares), 1e-6)
    pairs = list(zip(views, shares, strict=True))
    colours = sum(v.colours * np.exp(v.gain) * s[..., None] for v, s in pairs) / total[..., None]
    hair = sum(v.kinds.hair * s for v, s in pairs) / total
    skin = sum(v.kinds.skin * s for v, s in pairs) / total
    height = len(known)
    of_skin = _spread(colours, known * skin * (1.0 - hair), height)
    of_hair = _spread(colours, known * hair, height)
    where = extend(np.repeat(hair[..., None], 3, axis=2).astype(np.float32), known)[..., 0]
    where = step(0.3, 0.7, blur(where * _hair_reach(known.shape), height / 100.0))[..., None]
    return np.asarray(where * of_hair + (1.0 - where) * of_skin)


def _spread(colours: FloatArray, known: FloatArray, height: int) -> FloatArray:
    """The colours, extended smoothly from where they are known for sure."""
    sure = step(0.3, 0.9, known)
    if float(sure.sum()) < 16.0:
        sure = known
    if float(sure.sum()) < 1e-3:
        return colours
    middle = blur(colours * sure[..., None], height / 64.0)
    middle = middle / np.maximum(blur(sure, height / 64.0), 1e-4)[..., None]
    return extend(middle.astype(np.float32), sure.astype(np.float32))


def _hair_reach(shape: tuple[int, ...]) -> FloatArray:
    """(H, W) where hair may go on beyond what is seen: down to the ears, less and less."""
    u = ((np.arange(shape[0]) + 0.5) / shape[0])[:, None]
    aside = np.abs(((np.arange(shape[1]) + 0.5) / shape[1] - 0.5) * np.pi)[None]
    limit = 0.10 + 0.34 * step(0.7, 1.5, aside)
    return step(0.10, -0.04, u - limit)
