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

from pdeface.texture._margins import clean_margins
from pdeface.texture._reading import PhotoReader
from pdeface.texture._seen import View, filled, matched, mirrored, shares_of
from pdeface.texture._shading import shading
from pdeface.texture._skin import kinds
from pdeface.texture._smooth import blur, enlarge
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
    seen = matched([r.coarse(coarse, delight) for r in read])
    seen += [mirrored(view, number) for number, view in enumerate(seen)]
    shares = shares_of(seen)
    fill = filled(seen, shares)
    result = np.empty((*shape, 3), np.uint8)

    def make(rows: slice) -> None:
        result[rows] = _mixed(read, seen, shares, fill, shape, rows)

    bands = [slice(top, min(top + _BAND, shape[0])) for top in range(0, shape[0], _BAND)]
    with ThreadPoolExecutor(min(4, os.cpu_count() or 1)) as pool:  # numpy lets threads run
        list(pool.map(make, bands))
    return clean_margins(result) if margins else result


def _mixed(
    read: list[_Reading],
    seen: list[View],
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

    def coarse(self, shape: tuple[int, int], delight: bool) -> View:
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
        return View(0, False, colours, (known * found.face).astype(np.float32), found, gain)


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
