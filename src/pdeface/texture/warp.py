"""Wolberg's two-pass mesh warp (Digital Image Warping, 1990), with exact area weighting."""

from __future__ import annotations

import importlib
import importlib.util
import sys
from collections.abc import Callable, Sequence
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from pdeface.errors import InputError, require
from pdeface.texture import _meshes, _spline

__all__ = ["Engine", "warp"]

FloatArray = NDArray[np.float64]
Engine = Literal["auto", "numba", "numpy"]

_NUMPY, _NUMBA = "pdeface.texture._resample_numpy", "pdeface.texture._resample_numba"
_WORTH_A_START = 2_000_000
"""Pixels of source and result together from which loading numba (0.7 s) is sooner won back."""

_DTYPES = ("uint8", "uint16", "float32", "float64")


def warp(
    image: Any,
    source: Any,
    target: Any,
    shape: tuple[int, int] | None = None,
    *,
    engine: Engine = "auto",
    names: Sequence[Sequence[str]] | None = None,
) -> NDArray[Any]:
    """Move the nodes of one mesh over an image to those of another, and the image with them.

    The first pass resamples every row, from the source mesh to an intermediate mesh that has the
    target's x and the source's y; the second resamples every column, on to the target mesh. Mesh
    lines are splines that cannot overshoot. Every output pixel is the exact mean of the source
    over the pixel's preimage (one dimension a pass), so a shrunk image does not alias and has no
    holes, a grown one has no blocks, a constant image stays constant and the identity returns
    the image itself, to the last bit.

    Pixels are unit squares: (0, 0) is the top-left corner of the top-left pixel, and the centre
    of pixel [row, column] is at (column + 1/2, row + 1/2). The meshes need not reach the borders
    of the images: beyond them the outermost pieces go on straight, and where that leaves the
    source image its border pixels are repeated.

    Args:
        image: (H, W) or (H, W, 1 to 4), uint8, uint16, float32 or float64. Channels are treated
            alike; floats must be finite and may overshoot a little beside sharp edges, as with
            any smooth resampling (the warp is linear in them), integers are rounded and clipped.
        source: (R, C, 2) nodes (x right, y down) in the image; x must increase along every row
            of nodes and y along every column.
        target: (R, C, 2) where the nodes shall be, in the same order.
        shape: (height, width) of the result; that of the image by default.
        engine: ``"numba"`` (compiled, ten times faster once it has started), ``"numpy"``, or
            whichever of the installed is done sooner. They agree to rounding.
        names: R rows of C names of the nodes, by which errors call them.

    Returns:
        The warped image: (height, width) or (height, width, channels), of the image's type.

    Raises:
        InputError: a mesh is folded (the message names the node), or the image's shape or type
            cannot be used.
    """
    pixels = _check_image(image)
    height, width = _check_shape(shape or pixels.shape[:2])
    source, target = _meshes.check_meshes(source, target, names)
    two_pass = _two_pass(engine, height * width + pixels.shape[0] * pixels.shape[1])

    to_y, from_y = _meshes.column_knots(source, target, np.arange(0.5, width), names)
    vertical = _spline.coefficients(to_y, from_y)
    rows = _needed(to_y, vertical, height, pixels.shape[0])
    y = np.arange(rows.start + 0.5, rows.stop)
    to_x, from_x = _meshes.row_knots(source, target, y, names)
    horizontal = _spline.coefficients(to_x, from_x)
    columns = _needed(to_x, horizontal, width, pixels.shape[1])

    # From here on, positions count from the first row and column that are needed.
    vertical[..., 0] -= rows.start
    horizontal[..., 0] -= columns.start
    part = pixels[rows, columns]
    result = two_pass(part, (to_x, horizontal), (to_y, vertical), (height, width))
    return result.reshape(height, width, *np.shape(image)[2:])


def _needed(knots: FloatArray, polynomials: FloatArray, width: int, length: int) -> slice:
    """Which of ``length`` source pixels the output lines read, and at least two on each side."""
    before, behind = np.minimum(-knots[:, 0], 0.0), np.maximum(width - knots[:, -1], 0.0)
    first = polynomials[:, 0, 0] + polynomials[:, 0, 1] * before
    last = polynomials[:, -1, 0] + polynomials[:, -1, 1] * behind
    low = int(np.clip(np.floor(first.min()) - 2, 0, length - 1))
    return slice(low, int(np.clip(np.ceil(last.max()) + 2, low + 1, length)))


def _two_pass(engine: Engine, pixels: int) -> Callable[..., NDArray[Any]]:
    if engine not in ("auto", "numba", "numpy"):
        raise InputError(f"engine must be 'auto', 'numba' or 'numpy', got {engine!r}")
    if engine == "auto":
        worth = _NUMBA in sys.modules or pixels >= _WORTH_A_START
        engine = "numba" if worth and importlib.util.find_spec("numba") else "numpy"
    if engine == "numba":
        require("numba", "texture", "to warp images with engine='numba'")
    name = _NUMBA if engine == "numba" else _NUMPY
    two_pass: Callable[..., NDArray[Any]] = importlib.import_module(name).two_pass
    return two_pass


def _check_image(image: Any) -> NDArray[Any]:
    """The image as (H, W, channels)."""
    pixels = np.asarray(image)
    if pixels.ndim == 2:
        pixels = pixels[..., None]
    if pixels.ndim != 3 or not 1 <= pixels.shape[2] <= 4 or 0 in pixels.shape:
        raise InputError(
            "an image must be an array of (height, width) or (height, width, 1 to 4 channels), "
            f"got {np.shape(image)}; reshape it"
        )
    if pixels.dtype.name not in _DTYPES:
        raise InputError(
            f"an image must be of type {', '.join(_DTYPES[:-1])} or {_DTYPES[-1]}, "
            f"got {pixels.dtype}; convert it"
        )
    if pixels.dtype.kind == "f" and not np.isfinite(pixels).all():
        raise InputError("an image must hold finite numbers, got NaN or infinity; replace them")
    return pixels.astype(pixels.dtype.newbyteorder("="), copy=False)


def _check_shape(shape: Any) -> tuple[int, int]:
    try:
        height, width = (int(side) for side in shape)
    except (TypeError, ValueError):
        height = width = 0
    if height < 1 or width < 1:
        raise InputError(f"shape must be two positive numbers (height, width), got {shape!r}")
    return height, width
