"""Differential geometry of a parametric surface from its derivatives."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ["Curvature", "curvature", "unit_normal", "write_unit_normals"]

FloatArray = NDArray[np.float64]


class Curvature(NamedTuple):
    """Gaussian curvature (1/m^2) and mean curvature (1/m).

    The mean curvature is positive where the surface bulges outwards, as the tip of the nose
    does: on a sphere of radius r with outward normals it is 1/r.
    """

    gaussian: FloatArray
    mean: FloatArray


def unit_normal(s_u: FloatArray, s_v: FloatArray) -> FloatArray:
    """(..., 3) unit outward normal ``S_u x S_v / |S_u x S_v|``; zero where the surface is
    degenerate."""
    normal = np.cross(s_u, s_v)
    length = np.linalg.norm(normal, axis=-1, keepdims=True)
    return np.asarray(np.divide(normal, length, out=np.zeros_like(normal), where=length > 0))


def write_unit_normals(
    s_u: NDArray[np.floating],
    s_v: NDArray[np.floating],
    out: NDArray[np.floating],
    scratch: NDArray[np.floating],
) -> None:
    """Write unit normals as :func:`unit_normal` has them, planar and without temporaries.

    Args:
        s_u, s_v, out: (3, ...) each, x, y and z apart.
        scratch: (2, ...) overwritten.
    """
    product, length = scratch
    for i, normal in enumerate(out):
        j, k = (i + 1) % 3, (i + 2) % 3
        np.multiply(s_u[j], s_v[k], out=normal)
        np.multiply(s_u[k], s_v[j], out=product)
        normal -= product
    np.multiply(out[0], out[0], out=length)
    for normal in out[1:]:
        np.multiply(normal, normal, out=product)
        length += product
    # A degenerate place has a product of 0; this makes its normal 0 rather than 0 / 0.
    length += np.finfo(length.dtype).tiny
    np.sqrt(length, out=length)
    np.reciprocal(length, out=length)
    out *= length


def curvature(
    s_u: FloatArray, s_v: FloatArray, s_uu: FloatArray, s_uv: FloatArray, s_vv: FloatArray
) -> Curvature:
    """Curvatures from the first and second fundamental forms (do Carmo 1976, section 3-3)."""
    normal = unit_normal(s_u, s_v)
    e, f, g = _dot(s_u, s_u), _dot(s_u, s_v), _dot(s_v, s_v)
    second = [_dot(part, normal) for part in (s_uu, s_uv, s_vv)]
    area = e * g - f * f
    with np.errstate(divide="ignore", invalid="ignore"):
        gaussian = (second[0] * second[2] - second[1] ** 2) / area
        mean = -(e * second[2] - 2.0 * f * second[1] + g * second[0]) / (2.0 * area)
    return Curvature(gaussian, mean)


def _dot(x: FloatArray, y: FloatArray) -> FloatArray:
    return np.asarray(np.einsum("...i,...i->...", x, y))
