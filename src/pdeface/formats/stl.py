"""STL, binary: triangles and nothing else. Written by hand: it is one structured array."""

from __future__ import annotations

import numpy as np

from pdeface.files import PathLike, atomic_write
from pdeface.formats._sample import Sample

__all__ = ["write_stl"]

_FACET = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


def write_stl(surface: Sample, path: PathLike) -> None:
    """Write the triangles, in metres; STL itself knows no unit.

    Raises:
        InputError: a place that cannot be written.
    """
    facets = np.zeros(len(surface.triangles), _FACET)
    facets["corners"] = surface.vertices[surface.triangles]
    corners = facets["corners"].astype(np.float64)
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(across, axis=1, keepdims=True)
    facets["normal"] = np.divide(across, length, out=np.zeros_like(across), where=length > 0.0)
    # A header that began with "solid" would be taken for the text form.
    header = b"pdeface, binary STL, metres, +Y up, +Z forward".ljust(80)
    count = np.uint32(len(facets)).astype("<u4").tobytes()
    atomic_write(path, header + count + facets.tobytes())
