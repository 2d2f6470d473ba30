"""Read a scan from a file: OBJ, PLY, STL, GLB, glTF or OFF, a mesh or a cloud of points."""

from __future__ import annotations

import logging
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pdeface.errors import InputError, require
from pdeface.files import PathLike
from pdeface.scan.surface import Scan

__all__ = ["SUFFIXES", "make_scan", "read_scan"]

SUFFIXES = (".obj", ".ply", ".stl", ".glb", ".gltf", ".off")
FEWEST = 200
"""Vertices below which nothing can be a face."""
LARGEST_FILE = 4 << 30


def read_scan(path: PathLike) -> Scan:
    """The scan in a file, with its texture or the colours of its vertices.

    Places that are not numbers, which scanners write where they saw nothing, are left out.

    Args:
        path: ends in .obj, .ply, .stl, .glb, .gltf or .off.

    Raises:
        InputError: no such file, or no scan in it.
        MissingExtraError: trimesh is not installed.
    """
    path = Path(path)
    if path.suffix.lower() not in SUFFIXES:
        raise InputError(f"a scan is one of {', '.join(SUFFIXES)}, got '{path}'; convert it")
    if not path.is_file():
        raise InputError(f"expected a scan, found no file at {path}; check its name")
    if (size := path.stat().st_size) > LARGEST_FILE:
        raise InputError(
            f"a scan may have {LARGEST_FILE >> 30} GiB, {path} has {size >> 30}; thin it out"
        )
    trimesh = require("trimesh", "scan", "to read scans")
    require("scipy.spatial", "scan", "to fit scans")
    logging.getLogger("trimesh").setLevel(logging.CRITICAL)  # its lines would break into ours
    try:
        loaded = trimesh.load(path, process=False)
        geometry = _one(trimesh, loaded)
        return make_scan(
            geometry.vertices, getattr(geometry, "faces", None), **_looks(trimesh, geometry)
        )
    except InputError as error:
        raise InputError(f"{path}: {error}") from error
    except MemoryError as error:
        raise InputError(f"{path} is too large for this machine's memory; thin it out") from error
    except Exception as error:  # a parser raises nearly anything on a file that is cut short
        reason = " ".join(str(error).split()) or type(error).__name__
        raise InputError(
            f"cannot read {path} as {path.suffix[1:].upper()} ({reason[:120]}); "
            "it may be cut short: export it again"
        ) from error


def make_scan(
    vertices: Any,
    triangles: Any = None,
    *,
    colors: NDArray[np.uint8] | None = None,
    texcoords: Any = None,
    image: NDArray[np.uint8] | None = None,
    normals: Any = None,
) -> Scan:
    """A scan of arrays, checked, without what is no number or belongs to no triangle.

    Args:
        vertices: (V, 3).
        triangles: (T, 3) indices, or None for a cloud of points.
        colors: (V, 3 or 4) uint8.
        texcoords: (V, 2), top-left origin, with ``image``, (H, W, 3 or 4) uint8.
        normals: (V, 3); of a cloud.

    Raises:
        InputError: too few vertices, or triangles of vertices that there are not.
    """
    vertices = np.asarray(vertices, dtype=np.float64).reshape(-1, 3)
    triangles = np.asarray([] if triangles is None else triangles, dtype=np.int64).reshape(-1, 3)
    if len(triangles) and not 0 <= triangles.min() <= triangles.max() < len(vertices):
        raise InputError(
            f"triangles need vertices 0 to {len(vertices) - 1}, got {triangles.min()} to "
            f"{triangles.max()}; export the scan again"
        )
    good = np.isfinite(vertices).all(axis=1)
    good &= np.abs(np.where(np.isfinite(vertices), vertices, 0.0)).max(axis=1) < 1e12
    if len(triangles):
        used = np.zeros(len(vertices), bool)
        used[triangles[good[triangles].all(axis=1)]] = True
        good &= used
    count = int(good.sum())
    extent = np.ptp(vertices[good], axis=0).max() if count else 0.0
    if count < FEWEST or extent == 0.0:
        raise InputError(
            f"a face needs at least {FEWEST} vertices with finite places, got {count}; "
            "use a denser scan"
        )
    whole = Scan(
        vertices,
        triangles,
        None if colors is None else np.asarray(colors)[:, :3].astype(np.uint8),
        None if texcoords is None or image is None else np.asarray(texcoords, np.float64),
        None if texcoords is None or image is None else image[..., :3],
        None if normals is None else np.asarray(normals, np.float64),
    )
    return whole if good.all() else _without(whole, good)


def _without(scan: Scan, good: NDArray[np.bool_]) -> Scan:
    index = np.cumsum(good) - 1
    colors = None if scan.colors is None else scan.colors[good]
    texcoords = None if scan.texcoords is None else scan.texcoords[good]
    normals = None if scan.given_normals is None else scan.given_normals[good]
    triangles = scan.triangles
    if len(triangles):
        triangles = index[triangles[good[triangles].all(axis=1)]]
    return Scan(scan.vertices[good], triangles, colors, texcoords, scan.image, normals)


def _one(trimesh: Any, loaded: Any) -> Any:
    """All geometry of a file in one piece; lines and the like are left out."""
    if not isinstance(loaded, trimesh.Scene):
        return loaded
    kinds = (trimesh.Trimesh, trimesh.PointCloud)
    parts = [part for part in loaded.dump() if isinstance(part, kinds) and len(part.vertices)]
    if not parts:
        raise InputError(
            "expected a mesh or points, got a file without any, perhaps cut short; export it again"
        )
    meshes = [part for part in parts if isinstance(part, trimesh.Trimesh) and len(part.faces)]
    if len(meshes) > 1:
        return trimesh.util.concatenate(meshes)
    return (meshes or parts)[0]


def _looks(trimesh: Any, geometry: Any) -> dict[str, Any]:
    """Colours, texture and normals, as far as the file has them."""
    if isinstance(geometry, trimesh.PointCloud):
        colors = np.asarray(geometry.colors)
        normals = geometry.metadata.get("normals")
        return {
            "colors": colors if len(colors) == len(geometry.vertices) else None,
            "normals": normals,
        }
    visual = geometry.visual
    if visual.kind == "texture" and visual.uv is not None and len(visual.uv):
        image = _picture(visual.material)
        if image is not None:
            texcoords = np.asarray(visual.uv, np.float64) * (1.0, -1.0) + (0.0, 1.0)
            return {"texcoords": texcoords, "image": image}
        return {}
    if visual.kind == "vertex":
        return {"colors": np.asarray(visual.vertex_colors)}
    return {}


def _picture(material: Any) -> NDArray[np.uint8] | None:
    for name in ("image", "baseColorTexture"):
        image = getattr(material, name, None)
        if image is not None:
            pixels: NDArray[np.uint8] = np.asarray(image.convert("RGB"))
            return pixels
    return None
