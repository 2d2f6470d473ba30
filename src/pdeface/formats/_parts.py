"""The parts behind the openings of a face, sampled for a file, with the face's morph targets."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from pdeface.anatomy import Outline, Part, textures
from pdeface.formats._targets import MorphTargets
from pdeface.parts import FaceParts, eye_colours, has_parts

__all__ = ["PartSample", "part_on_mesh", "sampled_parts"]

Float32 = NDArray[np.float32]

_STILL = 2e-5
"""Metres by which a target must move some curve of a part to be a target of it."""

# A part is sampled as finely as the face is: its own uv mesh goes with a face of so many rows, and
# below a quarter of that a tooth would be a block.
_ROWS, _COARSEST = 109, 0.25
_FEWEST_ROWS, _FEWEST_COLUMNS = 5, 9
# What goes round an opening has about as many columns as the skin has nodes there.
_RINGS, _RING = frozenset({"lids", "mouth"}), 0.68


@dataclass(frozen=True, eq=False)
class PartSample:
    """One part on its uv mesh.

    Attributes:
        name: such as ``"left_eyeball"``.
        material: such as ``"eye"``.
        vertices, normals, texcoords: (V, 3), (V, 3) and (V, 2).
        triangles: (T, 3) indices.
        differences: what each target adds to positions and normals, (V, 3) each; None for a target
            that leaves the part where it is.
        texture: (H, W, 3) uint8.
    """

    name: str
    material: str
    vertices: Float32
    normals: Float32
    texcoords: Float32
    triangles: NDArray[np.int32]
    differences: list[tuple[Float32, Float32] | None]
    texture: NDArray[np.uint8]


def sampled_parts(targets: MorphTargets) -> Iterator[PartSample]:
    """The parts of a face that has openings; none of one that has not."""
    if not targets.surface.uv_mesh.cuts or not has_parts(targets.face):
        return
    parts = FaceParts(targets.face)
    outlines = [parts.outline(moved) for moved in targets.moved]
    eyes = eye_colours(targets.face)
    for name, part in parts.parts.items():
        own = part_on_mesh(part, targets.surface.uv_mesh.rows)
        yield _sampled(targets, parts, outlines, own, name, textures.texture(name, *eyes))


def part_on_mesh(part: Part, face_rows: int) -> Part:
    """The part sampled as finely as a face on a uv mesh of so many rows."""
    detail = max(_COARSEST, face_rows / _ROWS)
    across = detail * (_RING if part.material in _RINGS else 1.0)
    rows = max(_FEWEST_ROWS, round(part.rows * min(1.0, detail)))
    columns = max(_FEWEST_COLUMNS, round(part.columns * min(1.0, across)))
    return replace(part, rows=rows, columns=columns)


def _sampled(
    targets: MorphTargets,
    parts: FaceParts,
    outlines: list[Outline],
    part: Part,
    name: str,
    texture: NDArray[np.uint8],
) -> PartSample:
    curves = parts.curves(name)
    normals = part.normals(curves)
    differences: list[tuple[Float32, Float32] | None] = []
    for target, outline in zip(targets.names, outlines, strict=True):
        by = parts.moved(name, outline, targets.controls(target))
        if not np.abs(by).max() > _STILL:
            differences.append(None)
            continue
        turned = part.normals(curves + by) - normals
        differences.append((part.positions(by).astype(np.float32), turned.astype(np.float32)))
    return PartSample(
        name,
        part.material,
        part.positions(curves).astype(np.float32),
        _unit(normals),
        part.grid.texcoords.astype(np.float32),
        part.grid.triangles,
        differences,
        texture,
    )


def _unit(normals: NDArray[np.float64]) -> Float32:
    """The normals; where the surface is pinched to a point and has none, +Z."""
    missing = np.linalg.norm(normals, axis=1) < 0.5
    return np.where(missing[:, None], [0.0, 0.0, 1.0], normals).astype(np.float32)
