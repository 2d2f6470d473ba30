"""Evaluation on a fixed uv mesh: everything that does not depend on the face, computed once."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import DTypeLike, NDArray

from pdeface.errors import InputError
from pdeface.pde.fourier import wave_numbers
from pdeface.pde.joins import Continuity, Join, check_join
from pdeface.pde.modes import ModeProducts
from pdeface.pde.rows import Side, locate, u_weights
from pdeface.pde.sheet import Sheet
from pdeface.pde.stations import choose_stations
from pdeface.pde.surface import check_parameters
from pdeface.pde.waves import closed_waves, mirrored_waves

__all__ = ["GridEvaluator", "planar", "u_weights"]

Array = NDArray[np.floating]

# Numbers of a batch that are worked on together: they stay in a processor's second cache.
CHUNK = 250_000


class GridEvaluator:
    """Positions and normals of any face with K curves of M points on one uv mesh.

    The surface is linear in the data points and separates: weights along u, one small matrix
    for each distinct wave number, and Fourier waves along v. A new face costs small matrix
    products; leading axes of ``points`` are a batch. Displacements are evaluated like points:
    the surface of a sum is the sum of the surfaces.

    Results are views (..., U, V, 3) of memory in which x, y and z lie apart, each (..., U, V).
    Large ones are faster to write over (``out``) than to allocate anew.

    Args:
        shape: (K, M) of the curves.
        u: (U,) values in [0, 1].
        v: (V,) radians.
        a, modes, join, continuity: as for :class:`pdeface.pde.PDESurface`.
        parting: the continuity of a second surface that is added to the first, for displacements
            that part where the face does not. Points are then (..., 2 K, M, 3): the K curves, and
            after them the K displacement curves of the second surface.
        side: which side of a curve its own u means, at a crease.
        mirrored: every curve is its own reflection in a plane z = const, as a face's are:
            half the work. The second half of the points is not looked at; M must be even.
        dtype: precision of the evaluation, float32 or float64.

    Raises:
        InputError: parameters, or a mesh, that no such surface has.
    """

    def __init__(
        self,
        shape: tuple[int, int],
        u: Any,
        v: Any,
        *,
        a: float = 1.0,
        modes: int = 6,
        join: Join = "smooth",
        continuity: Mapping[int, Continuity] | None = None,
        parting: Mapping[int, Continuity] | None = None,
        side: Side = "after",
        mirrored: bool = False,
        dtype: DTypeLike = np.float64,
    ) -> None:
        check_parameters(a, modes)
        layers = [continuity or {}, *([] if parting is None else [parting])]
        for layer in layers:
            check_join(shape[0], join, layer)
        if mirrored and shape[1] % 2:
            raise InputError(
                f"mirrored curves need an even number of points, got {shape[1]}; leave mirrored out"
            )
        self.shape = (len(layers) * shape[0], shape[1])
        self._layers = len(layers)
        self.u = np.atleast_1d(np.asarray(u, dtype=np.float64))
        self.v = np.atleast_1d(np.asarray(v, dtype=np.float64))
        self.dtype = np.dtype(dtype)
        rows = locate(self.u, shape[0], side, {k: c for each in layers for k, c in each.items()})
        fastest = float(wave_numbers(shape[1], a, modes)[-1]) / (shape[0] - 1)
        stations = choose_stations(rows, fastest, self.dtype)
        self._waves = mirrored_waves(shape[1]) if mirrored else closed_waves(shape[1])
        self._modes = ModeProducts(
            shape,
            self._waves,
            stations.rows if stations else rows,
            a,
            modes,
            join,
            layers,
            self.dtype,
        )
        self._sheet = Sheet(self._waves, self.v, stations, self.dtype)
        # Where every row is a curve, its points need no weights along u.
        self._on_curves = rows.on_curves()
        direct = self._waves.analysis.swapaxes(1, 2) @ self._waves.synthesis(self.v)
        self._direct = direct.astype(self.dtype)

    def empty(self, *batch: int) -> Array:
        """(*batch, U, V, 3) uninitialised memory for ``out``."""
        return _points_last(np.empty((3, *batch, len(self.u), len(self.v)), self.dtype))

    def positions(self, points: Any, *, out: Array | None = None) -> Array:
        """(..., U, V, 3) positions of the faces with (..., K, M, 3) data points.

        Args:
            points: data points, or displacements of them.
            out: memory from :meth:`empty` to write over.
        """
        points = self._checked(points)
        out = self.memory(points.shape[:-3], out)
        self._write(points, out, None)
        return out

    def normals(self, points: Any, *, out: Array | None = None) -> Array:
        """(..., U, V, 3) unit outward normals; zero where the surface is degenerate."""
        points = self._checked(points)
        out = self.memory(points.shape[:-3], out)
        self._write(points, None, out)
        return out

    def positions_and_normals(
        self, points: Any, *, out: tuple[Array, Array] | None = None
    ) -> tuple[Array, Array]:
        """Positions and unit outward normals, each (..., U, V, 3)."""
        points = self._checked(points)
        batch = points.shape[:-3]
        positions, normals = (self.memory(batch, own) for own in out or (None, None))
        self._write(points, positions, normals)
        return positions, normals

    def _checked(self, points: Any) -> Array:
        array: Array = np.asarray(points)
        if array.shape[-3:] != (*self.shape, 3):
            raise InputError(
                f"this evaluator serves points of shape (..., {self.shape[0]}, {self.shape[1]}, "
                f"3), got {array.shape}; build one for the other level"
            )
        return array

    def row_modes(self, points: Any) -> Array:
        """(3, F, R, waves) value of each Fourier wave of F faces on each row that is evaluated.

        They are linear in the (F, K, M, 3) data points, fewer than the positions on a large uv
        mesh, and all that :meth:`write_from_modes` needs.
        """
        points = self._checked(points)
        coefficients = self._modes.coefficients(self._waves.samples(points, self.dtype))
        modes = self._modes.on_rows(coefficients)
        return modes.reshape(3, len(points), -1, modes.shape[-1])

    def write_from_modes(self, modes: Array, out: Array) -> None:
        """Write the positions (F, U, V, 3) of faces, given (3, F, R, waves) modes on rows."""
        self._sheet.write_positions(modes.reshape(3, -1, modes.shape[-1]), planar(out))

    def memory(self, batch: tuple[int, ...], out: Array | None) -> Array:
        """``out`` if it is such memory as :meth:`empty` gives for a batch; new memory for None.

        Raises:
            InputError: ``out`` is another array.
        """
        if out is None:
            return self.empty(*batch)
        shape = (*batch, len(self.u), len(self.v), 3)
        if out.shape != shape or out.dtype != self.dtype or not planar(out).flags.contiguous:
            raise InputError(
                f"out must be planar memory of shape {shape} and type {self.dtype}, got "
                f"{out.shape} and {out.dtype}; use what empty() of this evaluator gives"
            )
        return out

    def _write(self, points: Array, positions: Array | None, normals: Array | None) -> None:
        """Write what is wanted, some faces of the batch at a time."""
        faces = points.reshape(-1, *self.shape, 3)
        grid = (len(self.u), len(self.v))
        wanted = [
            None if out is None else planar(out).reshape(3, -1, *grid)
            for out in (positions, normals)
        ]
        step = max(1, CHUNK // (3 * (grid[0] * grid[1] + self.shape[0] * self.shape[1])))
        for start in range(0, len(faces), step):
            some = slice(start, start + step)
            self._write_some(
                faces[some], *(None if out is None else out[:, some] for out in wanted)
            )

    def _write_some(self, points: Array, positions: Array | None, normals: Array | None) -> None:
        if positions is not None and self._on_curves is not None:
            layers = points.reshape(len(points), self._layers, -1, *points.shape[2:])
            on_rows = layers[:, :, self._on_curves].sum(axis=1)
            samples = self._waves.samples(on_rows, self.dtype)
            np.matmul(samples, self._direct, out=positions.reshape(3, -1, len(self.v)))
            positions = None
        if positions is None and normals is None:
            return
        coefficients = self._modes.coefficients(self._waves.samples(points, self.dtype))
        modes = self._modes.on_rows(coefficients)
        if positions is not None:
            self._sheet.write_positions(modes, positions)
        if normals is not None:
            self._sheet.write_normals(modes, self._modes.on_rows(coefficients, 1), normals)


def _points_last(planar: Array) -> Array:
    return planar.transpose(*range(1, planar.ndim), 0)


def planar(points: Array) -> Array:
    """(3, ...) x, y and z apart, of (..., 3): the memory that an evaluator's results view."""
    last = points.ndim - 1
    return points.transpose(last, *range(last))
