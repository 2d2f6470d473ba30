"""Sheet: from the modes on the rows to positions and normals on the whole uv mesh."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import DTypeLike, NDArray

from pdeface.pde.differential import write_unit_normals
from pdeface.pde.stations import Stations
from pdeface.pde.waves import Waves

__all__ = ["Sheet"]

Array = NDArray[np.floating]

# Numbers in a block of tangents: what a block needs stays in a processor's second cache.
BLOCK = 16_000


class Sheet:
    """The last and largest product: the waves along v.

    Args:
        waves: of the curves.
        v: (V,) radians.
        stations: where only some rows have modes, how the others follow.
        dtype: precision of the products.
    """

    def __init__(
        self, waves: Waves, v: NDArray[np.float64], stations: Stations | None, dtype: DTypeLike
    ) -> None:
        self._waves, self._wave_slopes = (waves.synthesis(v, d).astype(dtype) for d in (0, 1))
        self._stations = stations
        self._block_rows = max(1, BLOCK // len(v))

    def write_positions(self, modes: Array, out: Array) -> None:
        """Write (3, faces, U, V) positions.

        Args:
            modes: (3, faces R, waves) value of each wave on each row or station.
            out: written.
        """
        for place, left, right in self._factors(modes, self._waves, out):
            np.matmul(left, right, out=place)

    def write_normals(self, modes: Array, u_modes: Array, out: Array) -> None:
        """Write (3, faces, U, V) unit normals, a block of rows at a time.

        Args:
            modes: as for :meth:`write_positions`.
            u_modes: their u-derivatives.
            out: written.
        """
        buffers = np.empty((8, self._block_rows, out.shape[-1]), out.dtype)
        along_u = self._factors(u_modes, self._waves, out)
        along_v = self._factors(modes, self._wave_slopes, out)
        for (place, left_u, right_u), (_, left_v, right_v) in zip(along_u, along_v, strict=True):
            for start in range(0, place.shape[1], self._block_rows):
                rows = slice(start, start + self._block_rows)
                normals = place[:, rows]
                s_u, s_v, scratch = np.split(buffers[:, : normals.shape[1]], (3, 6))
                np.matmul(left_u[..., rows, :], right_u, out=s_u)
                np.matmul(left_v[..., rows, :], right_v, out=s_v)
                write_unit_normals(s_u, s_v, normals, scratch)

    def _factors(
        self, modes: Array, waves: Array, out: Array
    ) -> Iterator[tuple[Array, Array, Array]]:
        """Places (3, rows, V) in ``out`` and the two matrices whose product belongs there."""
        if self._stations is None:
            yield out.reshape(3, -1, out.shape[-1]), modes, waves
            return
        stations = self._stations
        buffer = np.empty((3, stations.largest_group, out.shape[-1]), out.dtype)
        for face, own in enumerate(np.split(modes, out.shape[1], axis=1)):
            for group, runs in stations.groups:
                values = np.matmul(own[:, group], waves, out=buffer[:, : group.stop - group.start])
                for rows, nodes, weights in runs:
                    yield out[:, face, rows], weights, values[:, nodes]
