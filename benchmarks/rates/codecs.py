"""What is compared: compact faces, Draco's meshes, and B-splines of as many coefficients."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import DracoPy
import fast_simplification
import numpy as np
from scipy.interpolate import BSpline, make_lsq_spline

from benchmarks.rates.truth import Errors, Mesh, Truth, gridded, surface_of
from pdeface.archive import FaceRecord
from pdeface.compact import pack_compact, unpack_compact
from pdeface.scan import ScanFit
from pdeface.scan.measures import FRONT
from pdeface.scan.surface import Scan, unit

LEVELS = (28, 46), (55, 92), (109, 184)
ERRORS = (2.0, 1.0, 0.7, 0.5, 0.35, 0.25, 0.2, 0.15, 0.1, 0.07, 0.05, 0.03, 0.02)
"""Millimetres that a compact file is asked for."""

FACES = (40, 60, 90, 130, 190, 270, 390, 560, 800, 1150, 1650, 2400, 3500, 5000, 8000)
BITS = (5, 6, 7, 8, 9, 10, 11, 12)
TEXCOORD_BITS = 8
DENSE = 217, 184


class Point(NamedTuple):
    """One file of one head: what made it, its bytes, how far its surface is from the scan."""

    made: str
    size: int
    errors: Errors


def compact_files(fit: ScanFit, truth: Truth) -> Iterator[Point]:
    """A fit in compact files of several levels and errors."""
    for level in LEVELS:
        at = fit.at_level(*level)
        for error in ERRORS:
            packed = pack_compact(record(at), 1e-3 * error)
            curves = unpack_compact(packed.data).curves
            restored = ScanFit(at.face.with_curves(curves), *rest(at))
            name = f"{level[0]}x{level[1]} {error:g} mm"
            yield Point(name, packed.shape_bytes, truth.errors(surface_of(restored)))


def record(fit: ScanFit) -> FaceRecord:
    face = fit.face
    return FaceRecord(curves=face.curves, a=face.a, modes=face.modes)


def rest(fit: ScanFit) -> tuple[object, ...]:
    return fit.registered, fit.rotation, fit.scale, fit.shift, fit.unit


def draco_files(fit: ScanFit, truth: Truth, *, texcoords: bool) -> Iterator[Point]:
    """Decimated meshes of the front in Draco's files, at its highest compression.

    Decimated from the scan's own triangles, and from a dense clean sheet laid on them: whichever
    is better at a size is Draco's.
    """
    for name, source in (("scan", truth.mesh), ("sheet", sheet(fit))):
        for faces in FACES:
            if faces >= len(source.triangles):
                yield from coded(f"{name}, whole", source, truth, texcoords)
                break
            yield from coded(f"{name}, {faces}", decimated(source, faces), truth, texcoords)


def coded(name: str, mesh: Mesh, truth: Truth, texcoords: bool) -> Iterator[Point]:
    for bits in BITS:
        data = DracoPy.encode(
            mesh.vertices.astype(np.float32),
            mesh.triangles.astype(np.uint32),
            quantization_bits=bits,
            compression_level=10,
            tex_coord=mesh.uv if texcoords and mesh.uv is not None else None,
            tex_coord_quantization_bits=TEXCOORD_BITS,
        )
        read = DracoPy.decode(data)
        points, triangles = np.array(read.points, np.float64), np.array(read.faces, np.int64)
        restored = Mesh(points, triangles, Scan(points, triangles).normals)
        yield Point(f"{name}, {bits} bits", len(data), truth.errors(restored))


def decimated(mesh: Mesh, faces: int) -> Mesh:
    """So many triangles, by quadrics; texture coordinates from where the vertices lie."""
    from pdeface.scan.nearest import Target

    share = 1.0 - faces / len(mesh.triangles)
    points, triangles = fast_simplification.simplify(
        mesh.vertices.astype(np.float32), mesh.triangles.astype(np.int32), share, agg=3
    )
    points, triangles = points.astype(np.float64), triangles.astype(np.int64)
    found = Target(Scan(mesh.vertices, mesh.triangles)).nearest(points)
    assert mesh.uv is not None
    uv = np.einsum("nc,nci->ni", found.weights, mesh.uv[found.corners])
    return Mesh(points, triangles, Scan(points, triangles).normals, uv)


def sheet(fit: ScanFit) -> Mesh:
    """The front of the samples that the fit laid on the scan."""
    u, v = np.linspace(0.0, 1.0, DENSE[0]), (np.arange(DENSE[1]) + 0.5) * (np.pi / DENSE[1])
    front = (v > FRONT[0]) & (v < FRONT[1])
    points = fit.registered.points[:, front]
    mesh = gridded(points, points, u, v[front])
    return mesh._replace(normals=Scan(mesh.vertices, mesh.triangles).normals)


def spline(fit: ScanFit, level: tuple[int, int]) -> Mesh:
    """The bicubic B-spline nearest to the fit's samples, of as many coefficients as its curves."""
    samples = fit.registered.points
    u = np.linspace(0.0, 1.0, samples.shape[0])
    v = (np.arange(samples.shape[1]) + 0.5) * (np.pi / samples.shape[1])
    rows = make_lsq_spline(u, samples, knots(u, level[0]), 3)
    both = make_lsq_spline(v, rows.c.swapaxes(0, 1), knots(v, level[1] // 2), 3)
    dense_u, dense_v = np.linspace(0.0, 1.0, 271), np.linspace(v[0], v[-1], 241)

    def at(of_u: int, of_v: int) -> np.ndarray:
        columns = both(dense_v, nu=of_v).swapaxes(0, 1)
        return BSpline(rows.t, columns, 3)(dense_u, nu=of_u)

    return gridded(at(0, 0), unit(np.cross(at(1, 0), at(0, 1))), dense_u, dense_v)


def knots(places: np.ndarray, count: int) -> np.ndarray:
    inner = np.linspace(places[0], places[-1], count - 2)
    return np.concatenate([[inner[0]] * 3, inner, [inner[-1]] * 3])
