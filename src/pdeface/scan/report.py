"""A picture of how near a fit is: scan, fit, and where and how far they differ."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from pdeface.files import PathLike
from pdeface.pictures import contact_sheet, render
from pdeface.pictures.camera import Camera, View
from pdeface.pictures.canvas import picture_of
from pdeface.pictures.ground import STUDIO, background_image, over
from pdeface.pictures.image_file import check_suffix, write_image
from pdeface.pictures.lettering import write
from pdeface.pictures.light import light_up, rig_named
from pdeface.pictures.picture import face_camera
from pdeface.pictures.solid import Solid
from pdeface.pictures.styles.shaded import CLAY
from pdeface.scan.fitting import ScanFit
from pdeface.scan.measures import Measures
from pdeface.scan.surface import Scan
from pdeface.uvmesh import UVMesh

__all__ = ["LIMITS", "report_sheet", "scan_picture"]

FloatArray = NDArray[np.float64]
Pixels = NDArray[np.uint8]

LIMITS: Final = 1.0, 15.0
"""Millimetres and degrees at which the maps are at their darkest."""

_VIEWS: Final[tuple[View, ...]] = ("front", "three-quarter", "profile")
_UNKNOWN: Final = np.array([0.45, 0.45, 0.47])
_SCALE: Final = np.array(
    [
        [0.93, 0.95, 0.92],
        [0.62, 0.83, 0.75],
        [0.98, 0.78, 0.36],
        [0.86, 0.33, 0.18],
        [0.42, 0.04, 0.14],
    ]
)
_BAR: Final = 0.09


def report_sheet(
    fit: ScanFit,
    measures: Measures,
    path: PathLike | None = None,
    *,
    size: tuple[int, int] = (440, 550),
) -> Pixels:
    """Scan and fit under raking light from three sides, and maps of distance and of angle.

    Args:
        path: file to write, or None.
        size: (width, height) of each picture, pixels.

    Returns:
        (H, W, 3) uint8.
    """
    if path is not None:
        check_suffix(path)
    rows: list[list[Pixels]] = [[], [], [], []]
    for view in _VIEWS:
        rows[0].append(scan_picture(fit, view, size))
        rows[1].append(
            render(fit.face, view=view, style="shaded", light="raking", size=size, openings="none")
        )
        rows[2].append(_map(fit, measures, 1e3 * measures.away / LIMITS[0], view, size))
        rows[3].append(_map(fit, measures, measures.angle / LIMITS[1], view, size))
    rows[2][0] = _with_bar(rows[2][0], f"{LIMITS[0]:g} mm")
    rows[3][0] = _with_bar(rows[3][0], f"{LIMITS[1]:g} degrees")
    sheet = contact_sheet(rows, _captions(fit, measures))
    if path is not None:
        write_image(path, sheet)
    return sheet


def _captions(fit: ScanFit, measures: Measures) -> list[list[str]]:
    curves, points = fit.face.curves.shape
    there, back = measures.to_scan, measures.to_face
    return [
        ["scan", "", f"{len(fit.scan.vertices):,} vertices"],
        [f"fit, {curves} x {points}", "", f"coverage {100 * measures.coverage:.1f} %"],
        [
            f"distance: RMS {there.rms:.3f} mm",
            f"median {there.median:.3f}, 95 % {there.p95:.2f}, largest {there.largest:.2f}",
            f"scan to fit: RMS {back.rms:.3f}",
        ],
        ["angle of normals", f"median {measures.normal:.2f} degrees", ""],
    ]


def scan_picture(
    fit: ScanFit, view: View = "front", size: tuple[int, int] = (440, 550), light: str = "raking"
) -> Pixels:
    """(H, W, 3) the scan in clay, as :func:`pdeface.render` draws the fit."""
    camera = face_camera(fit.face, view, size)
    scan = _drawable(fit.scan, camera)
    colors = light_up(scan.vertices, scan.normals, np.array(CLAY), camera, rig_named(light))
    solid = Solid(scan.vertices, scan.triangles.astype(np.int32), colors)
    return over(picture_of([solid], camera, size), background_image(STUDIO, size))


def _drawable(scan: Scan, camera: Camera) -> Scan:
    """The scan; a cloud as small squares that lie in its surface."""
    if not scan.is_cloud:
        return scan
    first = np.cross(scan.normals, camera.backward + 0.1 * camera.right)
    first /= np.maximum(np.linalg.norm(first, axis=1, keepdims=True), 1e-9)
    second = np.cross(scan.normals, first)
    reach = 0.85 * scan.spacing
    corners = [scan.vertices + reach * (a * first + b * second)
               for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]  # fmt: skip
    index = np.arange(len(scan.vertices))
    count = len(index)
    triangles = np.concatenate(
        [np.stack([index, index + count, index + 2 * count], 1),
         np.stack([index, index + 2 * count, index + 3 * count], 1)]
    )  # fmt: skip
    return Scan(np.concatenate(corners), triangles, given_normals=np.tile(scan.normals, (4, 1)))


def _map(
    fit: ScanFit, measures: Measures, values: FloatArray, view: View, size: tuple[int, int]
) -> Pixels:
    """The fit in colours of values from 0 to 1, grey where the scan has a hole."""
    rows, columns = values.shape
    colors = _colours(values)
    colors[~measures.known] = _UNKNOWN
    camera = face_camera(fit.face, view, size)
    triangles = UVMesh(rows, columns).triangles
    vertices = measures.grid.reshape(-1, 3)
    normals = Scan(vertices, triangles.astype(np.int64)).normals
    shade = 0.72 + 0.28 * np.clip(normals @ camera.backward, 0.0, 1.0)
    solid = Solid(vertices, triangles, colors.reshape(-1, 3) * shade[:, None])
    return over(picture_of([solid], camera, size), background_image(STUDIO, size))


def _colours(values: FloatArray) -> FloatArray:
    place = np.clip(values, 0.0, 1.0) * (len(_SCALE) - 1)
    steps = np.arange(len(_SCALE))
    return np.stack([np.interp(place, steps, _SCALE[:, k]) for k in range(3)], axis=-1)


def _with_bar(image: Pixels, limit: str) -> Pixels:
    """The picture with what its colours mean at its foot."""
    height, width = image.shape[:2]
    result = image.copy()
    top, left, right = round((1.0 - 0.5 * _BAR) * height), round(0.2 * width), round(0.8 * width)
    bar = np.rint(255.0 * _colours(np.linspace(0.0, 1.0, right - left))).astype(np.uint8)
    result[top : top + max(3, round(0.015 * height)), left:right] = bar
    letters = 0.25 * _BAR * height
    labels = [(left, top - 0.6 * letters, "0"), (right, top - 0.6 * letters, limit)]
    return write(result, [(float(x), float(y), text) for x, y, text in labels], letters)
