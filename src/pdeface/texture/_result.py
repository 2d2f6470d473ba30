"""What the five steps leave behind: a texture and everything that led to it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pdeface.texture._grid import ScaledGrid
from pdeface.texture.points import FeaturePoints
from pdeface.texture.warp import warp

__all__ = ["UVTexture"]

FloatArray = NDArray[np.float64]
Pixels = NDArray[np.uint8]


@dataclass(frozen=True, eq=False)
class UVTexture:
    """A texture for the uv mesh, and everything that led to it.

    Attributes:
        image: (H, W, 3) uint8, step 5: row ``u H``, column ``v W / pi``, the whole face.
        warped: (H, W, 3) uint8: the same before its edge was finished; black where the photo has
            nothing.
        photo: (h, w, 3 or 4) uint8 that the meshes lie on: the given photo, or a turned copy
            if the head was tilted by more than 5 degrees.
        points: the feature points in ``photo``.
        grid: the scaled uv grid on ``photo``, step 1.
        targets: (5, 5, 2) values (u, v) of the feature points.
        source_mesh: (7, 7, 2) M_s, pixels of ``photo``, step 2.
        target_mesh: (7, 7, 2) M_t, step 3, texels of ``image``.
        grid_mesh: (7, 7, 2) M_t where it lies on the scaled grid, pixels of ``photo``.
    """

    image: Pixels
    warped: Pixels
    photo: Pixels
    points: FeaturePoints
    grid: ScaledGrid
    targets: FloatArray
    source_mesh: FloatArray
    target_mesh: FloatArray
    grid_mesh: FloatArray

    def target_image(self) -> Pixels:
        """(h, w, 3 or 4) I_t, step 4 as the paper shows it: the photo warped on to the grid.

        On it lie ``grid.nodes()`` and ``grid_mesh``, as in Fig. 6(d) to (f). ``image`` is made
        without this step between, so that the photo is resampled once.
        """
        height, width = self.photo.shape[:2]
        source = _with_border(self.source_mesh, width, height)
        return warp(self.photo, source, _with_border(self.grid_mesh, width, height))

    def uv_nodes(self, rows: int = 28, columns: int = 41) -> FloatArray:
        """(rows, columns, 2) texel positions in ``image`` of the uv mesh's nodes."""
        height, width = self.image.shape[:2]
        x, y = np.meshgrid(np.linspace(0.0, width, columns), np.linspace(0.0, height, rows))
        return np.stack([x, y], axis=-1)


def _with_border(mesh: FloatArray, width: float, height: float) -> FloatArray:
    """(9, 9, 2) the mesh and, around it, nodes on the photo's border, straight beyond its own."""
    bordered = np.pad(mesh, ((1, 1), (1, 1), (0, 0)), mode="edge")
    bordered[:, 0, 0] = min(0.0, mesh[..., 0].min() - 1.0)
    bordered[:, -1, 0] = max(width, mesh[..., 0].max() + 1.0)
    bordered[0, :, 1] = min(0.0, mesh[..., 1].min() - 1.0)
    bordered[-1, :, 1] = max(height, mesh[..., 1].max() + 1.0)
    return bordered
