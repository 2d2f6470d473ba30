"""A face of the studio on its uv mesh: what each control adds to it, and where it is exactly.

Vertices come in one list: the skin's, those of each part behind the openings in their order, and
last the data points of the boundary curves.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pdeface.anatomy import Part
from pdeface.controls import (
    BLINKS,
    COMPANY,
    CONTROLS,
    Displacement,
    displacement,
    expressed,
    together,
)
from pdeface.curves import mirror_points
from pdeface.errors import InputError
from pdeface.face import Face
from pdeface.formats import export, part_on_mesh
from pdeface.parts import FaceParts, has_parts
from pdeface.pde import Join
from pdeface.sampler import sampler
from pdeface.studio.moves import front_moves

__all__ = ["MOST_VERTICES", "Geometry"]

FloatArray = NDArray[np.float64]
Float32 = NDArray[np.float32]

MOST_VERTICES = 60_000
"""Of the skin, in the page; a file may have more."""

_BATCH = 16


class Geometry:
    """A face without weights on a uv mesh.

    Args:
        face: the face; its weights are left out.
        rows, columns: of the uv mesh.
        join: of the surface.

    Raises:
        InputError: a mesh that is too fine for the page.
    """

    def __init__(self, face: Face, rows: int, columns: int, join: Join = "smooth") -> None:
        if rows * columns > MOST_VERTICES or min(rows, columns) < 2:
            raise InputError(
                f"the page shows 2 x 2 to {MOST_VERTICES:,} vertices, got {rows} x {columns}; "
                "export finer meshes"
            )
        self.face = face.with_weights(dict.fromkeys(face.weights, 0.0))
        self.size, self._join = (rows, columns), join
        self._mesh = self.face.uv_mesh(rows, columns, join=join)
        # The paper's join has no slits: what parts lids and lips moves the curves themselves.
        self._parted = join == "smooth" and face.has_lids
        self._sampler = sampler(
            face.curves.shape, self._mesh, face.a, face.modes, join, self._parted
        )

    @cached_property
    def parts(self) -> Mapping[str, Part]:
        """The parts behind the openings, by name; none if the mesh has no openings."""
        if not self._mesh.cuts or not has_parts(self.face):
            return {}
        return {name: part_on_mesh(p, self.size[0]) for name, p in FaceParts.parts.items()}

    @property
    def counts(self) -> list[int]:
        """Vertices of the skin, of each part, and of the curves."""
        parts = [part.rows * part.columns for part in self.parts.values()]
        return [self._mesh.vertex_count, *parts, len(self.face.curves.points.reshape(-1, 3))]

    def glb(self) -> bytes:
        """The face without weights as a user exports it, without morph targets."""
        with TemporaryDirectory(prefix="pdeface-") as folder:
            path = Path(folder) / "face.glb"
            export(self.face, path, mesh=self.size, join=self._join, expressions=())
            return path.read_bytes()

    def exact(self, weights: Mapping[str, float], normals: bool = False) -> tuple[Float32, Float32]:
        """(V, 3) positions of all vertices at these weights; (W, 3) normals of all but curves'."""
        face = self.face.with_weights(weights)
        moved = face.displacement
        rest = face.curves.points + moved.smooth
        points = self._layers(rest, moved.parting)
        skin = self._sampler.positions(points, moved.margins)
        shading = [self._sampler.normals(points, moved.margins)] if normals else []
        behind, anatomy = [], FaceParts(face) if self.parts else None
        for name, part in self.parts.items():
            assert anatomy is not None
            curves = anatomy.curves(name)
            behind.append(part.positions(curves))
            if normals:
                shading.append(part.normals(curves))
        listed = [skin, *behind, (rest + moved.parting).reshape(-1, 3)]
        flat = np.concatenate(shading) if normals else np.zeros((0, 3))
        return np.concatenate(listed).astype(np.float32), flat.astype(np.float32)

    def columns(self) -> dict[str, NDArray[np.floating]]:
        """What each control adds at 1, in the order of :data:`pdeface.controls.CONTROLS`.

        Returns:
            ``skin`` (C, V, 3); ``curves`` (C, P, 3); ``shifts`` (C, parts, 3), by which a part
            moves as a whole with who the face is, about; and ``part:control`` (W, 3) for each
            part, by number, that an expression moves, exactly.
        """
        moved = list(self._moved.values())
        arrays: dict[str, NDArray[np.floating]] = {
            "skin": self._skin_columns(moved),
            "curves": np.array(
                [(m.smooth + m.parting).reshape(-1, 3) for m in moved], dtype=np.float32
            ),
            "shifts": np.zeros((len(moved), len(self.parts), 3), np.float32),
        }
        if self.parts:
            anatomy = self._anatomy
            for index, (control, by) in enumerate(zip(CONTROLS.values(), moved, strict=True)):
                if control.kind == "expression":
                    arrays |= self._part_columns(anatomy, index, control.name, by)
                else:
                    arrays["shifts"][index] = self._shifts(anatomy, by)
        return arrays

    def response(
        self, handles: Sequence[tuple[int, int, float]], symmetric: bool = False
    ) -> tuple[Float32, Float32]:
        """What a metre of a handle adds to the vertices, along x, y and z each.

        x and y of the mirrored back of the curves go with the front's, z goes against it, so that
        z has a response of its own.

        Args:
            handles: curve, point on its front half, and the share of the move that it makes.
            symmetric: whether the other side makes the mirrored move.

        Returns:
            (V, 3) of the skin and (P, 3) of the curves' data points.
        """
        by = front_moves([(c, p, w, w, w) for c, p, w in handles], self.face.curves.shape)
        if symmetric:
            by = by + by[:, ::-1] * (-1.0, 1.0, 1.0)
        closed = mirror_points(by)
        skin = self._sampler.positions(self._layers(closed, np.zeros_like(closed)))
        return skin.astype(np.float32), closed.reshape(-1, 3).astype(np.float32)

    def facts(self) -> dict[str, Any]:
        """What the page has to know to add columns: vertices, parts, and what expressions leave
        of each other."""
        return {
            "counts": self.counts,
            "parts": list(self.parts),
            "company": {name: list(others) for name, others in COMPANY.items()},
            "blinks": {name: list(others) for name, others in BLINKS.items()},
        }

    def lacking(self, weights: Mapping[str, float]) -> Displacement:
        """What the weights do beyond the sum of what each of them does, with what is left of it."""
        lacking = self.face.with_weights(weights).displacement
        for name, weight in together(weights).items():
            lacking = lacking.less(Displacement(*(weight * part for part in self._moved[name])))
        return lacking

    def everywhere(self, by: Displacement) -> FloatArray:
        """(W, 3) displacement of skin and parts by one of the curves, in which it is linear."""
        places = [self._sampler.positions(self._layers(by.smooth, by.parting), by.margins)]
        if self.parts:
            outline = self._anatomy.outline(by)
            moved = {name: self._anatomy.moved(name, outline, {}) for name in self.parts}
            places += [part.positions(moved[name]) for name, part in self.parts.items()]
        return np.concatenate(places)

    @cached_property
    def _anatomy(self) -> FaceParts:
        return FaceParts(self.face)

    @cached_property
    def _moved(self) -> dict[str, Displacement]:
        # In single precision, as the page has them: of a fine face they are 16 MB.
        each = ((name, self._alone(name)) for name in CONTROLS)
        return {n: Displacement(*(part.astype(np.float32) for part in by)) for n, by in each}  # type: ignore[arg-type]

    def _layers(self, smooth: FloatArray, parting: FloatArray) -> FloatArray:
        return np.concatenate([smooth, parting], axis=-3) if self._parted else smooth + parting

    def _alone(self, name: str) -> Displacement:
        """What a control adds to the curves at 1, among those without which it does nothing."""
        shape = self.face.curves.shape
        if CONTROLS[name].kind != "expression":
            return displacement({name: 1.0}, shape)
        if not self.face.has_lids:
            return Displacement(np.zeros((*shape, 3)), np.zeros((*shape, 3)))
        rest, options = self.face.curves.points, (self.face.a, self.face.modes)
        company = COMPANY.get(name, {})
        before = expressed(rest, company, *options)
        return expressed(rest, {**company, name: 1.0}, *options).less(before)

    def _skin_columns(self, moved: Sequence[Displacement]) -> Float32:
        columns = np.empty((len(moved), self._mesh.vertex_count, 3), np.float32)
        for start in range(0, len(moved), _BATCH):
            some = moved[start : start + _BATCH]
            points = np.array([self._layers(m.smooth, m.parting) for m in some])
            margins = np.array([m.margins for m in some])
            columns[start : start + _BATCH] = self._sampler.positions(points, margins)
        return columns

    def _part_columns(
        self, anatomy: FaceParts, index: int, name: str, by: Displacement
    ) -> dict[str, NDArray[np.floating]]:
        outline = anatomy.outline(by)
        found = {}
        for number, (part_name, part) in enumerate(self.parts.items()):
            moved = anatomy.moved(part_name, outline, {name: 1.0})
            if np.abs(moved).max() > 1e-6:
                found[f"{number}:{index}"] = part.positions(moved).astype(np.float32)
        return found

    def _shifts(self, anatomy: FaceParts, by: Displacement) -> FloatArray:
        """(parts, 3) mean displacement of the opening before each part."""
        outline = anatomy.outline(by)
        of = {"right": outline.right_eye, "left": outline.left_eye}
        sides = [of.get(name.split("_")[0], outline.mouth) for name in self.parts]
        return np.array([np.mean([margins.upper, margins.lower], axis=(0, 1)) for margins in sides])
