"""A texture from photos that are projected onto the face.

Each texel is read from the photos where they show it, and what none of them shows is completed:
from the other side of the face where that was seen, else by smooth skin, and by hair where hair
goes on. All that is smooth (how far a photo is trusted, what is filled in, how photos differ in
light) is worked out on a coarse texture; the photos themselves are read once, at full size.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from pdeface.texture._fill import extend
from pdeface.texture._margins import clean_margins
from pdeface.texture._reading import PhotoReader
from pdeface.texture._shading import shading
from pdeface.texture._skin import Kinds, kinds
from pdeface.texture._smooth import blur, enlarge, step
from pdeface.texture._texels import Texels, at_texels

__all__ = ["PhotoLayer", "project", "shown"]

FloatArray = NDArray[np.floating[Any]]
Pixels = NDArray[np.uint8]

_COARSE = 384
_SMALLEST, _LARGEST, _STEP = 512, 4096, 16
_BAND = 64
"""Rows worked on at once: what a processor's cache holds beats what fits the memory."""

_LEAST_SHARE = 1e-3
_FINEST = 0.75
"""Part of the face that is not read more coarsely than the photo is: lids alone are closer."""

_SHARPNESS = 4
"""How much more the better of two photos counts: a power of their trust."""

_MOST_GAIN = 0.7
"""How far photos are matched in light, at most: a natural logarithm."""


class PhotoLayer(NamedTuple):
    """A photo and where the nodes of a uv mesh lie in it.

    Attributes:
        photo: (h, w, 3 or 4) uint8.
        places: (R, C, 2) pixels of the photo.
        trust: (R, C) how well the photo shows each node, 0 to 1.
        normals: (R, C, 3) unit normals as the camera sees them.
    """

    photo: Pixels
    places: FloatArray
    trust: FloatArray
    normals: FloatArray


def project(
    layers: Sequence[PhotoLayer],
    nodes: NDArray[np.float64],
    size: tuple[int, int] | None = None,
    *,
    margins: bool = True,
    delight: bool = False,
) -> Pixels:
    """The texture that these photos give.

    Args:
        layers: the photos, the first the one that the others are matched to.
        nodes: (R, C, 2) u and v of the nodes of the uv mesh.
        size: (height, width); by default what keeps the detail of the photos, 512 to 4096.
        margins: as for :func:`pdeface.texture.uv_texture`.
        delight: whether to divide out the light, as far as a face shows it.

    Returns:
        (H, W, 3) uint8.
    """
    shape = size or _size_for(layers, nodes)
    coarse = _coarse_shape(shape)
    read = [_Reading(layer, nodes, shape) for layer in layers]
    seen = _matched([r.coarse(coarse, delight) for r in read])
    seen += [_mirrored(view, number) for number, view in enumerate(seen)]
    shares = _shares(seen)
    fill = _fill(seen, shares)
    result = np.empty((*shape, 3), np.uint8)

    def make(rows: slice) -> None:
        result[rows] = _mixed(read, seen, shares, fill, shape, rows)

    bands = [slice(top, min(top + _BAND, shape[0])) for top in range(0, shape[0], _BAND)]
    with ThreadPoolExecutor(min(4, os.cpu_count() or 1)) as pool:  # numpy lets threads run
        list(pool.map(make, bands))
    return clean_margins(result) if margins else result


def _mixed(
    read: list[_Reading],
    seen: list[_View],
    shares: list[FloatArray],
    fill: FloatArray,
    shape: tuple[int, int],
    rows: slice,
) -> Pixels:
    """Some rows of the texture: every view in its share, and the fill in what is left."""
    left = np.ones((rows.stop - rows.start, shape[1]), np.float32)
    texture = np.zeros((*left.shape, 3), np.float32)
    for number, layer in enumerate(read):
        colours = None
        for view, share in zip(seen, shares, strict=True):
            part = enlarge(share, shape, rows) if view.layer == number else np.zeros(1)
            if float(part.max()) < _LEAST_SHARE:
                continue
            colours = layer.colours(rows) if colours is None else colours
            image = colours[:, ::-1] if view.flipped else colours
            weight = part[..., None]
            if view.gain.any():
                weight = weight * np.exp(enlarge(view.gain, shape, rows))
            texture += weight * image
            left -= part
    texture += left.clip(0.0)[..., None] * enlarge(fill, shape, rows)
    return np.clip(np.rint(texture), 0, 255).astype(np.uint8)


def shown(
    photo: Pixels,
    places: FloatArray,
    trust: FloatArray,
    nodes: NDArray[np.float64],
    size: tuple[int, int],
) -> tuple[FloatArray, FloatArray]:
    """How well a photo shows each texel of a coarse texture, and how like skin it is there.

    Args:
        photo, places, trust: as in :class:`PhotoLayer`.
        nodes: (R, C, 2) u and v of the nodes.
        size: (height, width).

    Returns:
        (H, W) each, 0 to 1.
    """
    layer = PhotoLayer(photo, places, trust, np.zeros((*trust.shape, 3)))
    view = _Reading(layer, nodes, size).coarse(_coarse_shape(size), delight=False)
    return enlarge(view.known, size), enlarge(view.kinds.skin, size)


class _View(NamedTuple):
    """What a photo, or its mirror image, shows, on the coarse texture.

    ``gain`` is the logarithm by which its colours are to be multiplied.
    """

    layer: int
    flipped: bool
    colours: FloatArray
    known: FloatArray
    kinds: Kinds
    gain: FloatArray


class _Reading:
    """A layer made ready to be read at any size."""

    def __init__(self, layer: PhotoLayer, nodes: NDArray[np.float64], shape: tuple[int, int]):
        self._layer, self._nodes = layer, nodes
        used = layer.places[layer.trust > 0.0]
        if not len(used):
            used = layer.places.reshape(-1, 2)
        box = used.min(axis=0), used.max(axis=0)
        closest = _texel_steps(layer, nodes, shape)
        self._fine = PhotoReader(layer.photo, *box, closest)
        ratio = shape[0] / _coarse_shape(shape)[0]
        self._coarse = PhotoReader(layer.photo, *box, closest * ratio)
        self._places = Texels(layer.places, nodes, shape)

    def colours(self, rows: slice) -> FloatArray:
        return self._fine.colours(self._places.rows(rows))

    def coarse(self, shape: tuple[int, int], delight: bool) -> _View:
        layer = self._layer
        values = np.concatenate([layer.places, layer.trust[..., None], layer.normals], axis=-1)
        places, trust, normals = np.split(at_texels(values, self._nodes, shape), [2, 3], axis=-1)
        colours = self._coarse.colours(places)
        known = trust[..., 0] * self._coarse.seen(places)
        found = kinds(colours, known)
        gain = np.zeros_like(colours)
        if delight:
            # Softly: beside a nose the normals of a fitted face are only nearly the person's.
            light = shading(colours, normals, known * found.skin)
            gain -= blur(light, len(light) / 40.0)[..., None]
        return _View(0, False, colours, (known * found.face).astype(np.float32), found, gain)


def _matched(views: list[_View]) -> list[_View]:
    """The views, each brought to the light of the first where both show the same."""
    result = [views[0]]
    base = views[0]
    for number, view in enumerate(views[1:], start=1):
        result.append(view._replace(layer=number, gain=_gain(view, base)))
    return result


def _mirrored(view: _View, number: int) -> _View:
    """The view as the other side of the face, in the light of this one."""
    flip = [array[:, ::-1] for array in (view.colours, view.known, view.gain)]
    other = Kinds(*(kind[:, ::-1] for kind in view.kinds))
    # What is not skin or hair is nobody's mirror image.
    known = flip[1] * np.maximum(other.skin, other.hair)
    mirrored = _View(number, True, flip[0], known, other, flip[2])
    return mirrored._replace(gain=_gain(mirrored, view))


def _gain(view: _View, base: _View) -> FloatArray:
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


def _shares(views: list[_View]) -> list[FloatArray]:
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


def _fill(views: list[_View], shares: list[FloatArray]) -> FloatArray:
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


def _size_for(layers: Sequence[PhotoLayer], nodes: NDArray[np.float64]) -> tuple[int, int]:
    """(height, width) at which hardly any part of the face loses pixels."""
    rows, columns = nodes.shape[:2]
    sides = []
    for axis, count in ((0, rows - 1), (1, columns - 1)):
        longest = []
        for layer in layers:
            steps = np.linalg.norm(np.diff(layer.places, axis=axis), axis=-1)
            shown = np.minimum(*(np.delete(layer.trust, end, axis) for end in (0, -1))) > 0.5
            longest.append(float(np.quantile(steps[shown], _FINEST)) if shown.any() else 0.0)
        side = int(np.ceil(max(longest) * count / _STEP)) * _STEP
        sides.append(min(max(side, _SMALLEST), _LARGEST))
    return sides[0], sides[1]


def _texel_steps(layer: PhotoLayer, nodes: NDArray[np.float64], shape: tuple[int, int]) -> float:
    """Pixels of the photo from one texel to the next, in the middle of the face's texels."""
    found = []
    for axis, count in ((0, shape[0]), (1, shape[1])):
        steps = np.linalg.norm(np.diff(layer.places, axis=axis), axis=-1)
        found.append(float(np.median(steps)) * (nodes.shape[axis] - 1) / count)
    return max(found)


def _coarse_shape(shape: tuple[int, int]) -> tuple[int, int]:
    most = max(shape)
    return tuple(max(16, side * min(_COARSE, most) // most) for side in shape)  # type: ignore
