"""Measure expressions and identities: ``python -m pdeface.controls.build HEAD_FOLDER``."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pdeface.controls.build.openings import Opening, split
from pdeface.controls.measured import DATA, IDENTITIES, LEVEL, slits
from pdeface.curves import curve_parameters, mirror_points
from pdeface.errors import InputError
from pdeface.files import atomic_path
from pdeface.pde.fit import fit_curves
from pdeface.template.build.chart import Chart
from pdeface.template.build.closing import close_head
from pdeface.template.build.command import run
from pdeface.template.build.cutting import cut_face
from pdeface.template.build.head import CENTIMETRE, load_head
from pdeface.template.build.parameterisation import Parameterisation

FloatArray = NDArray[np.float64]

SAMPLES = (217, 368)
IDENTITY_LEVEL = (28, 46)
FAIRNESS, DAMPING = 2e-3, 0.5
STEPS = 32767
EDGE = 0.6
# Lips part with a jerk at their corners: at half of the way they are apart where they are one.
BEYOND = 0.08


def main() -> int:
    """Build the file of measured displacements."""
    return run("pdeface.controls.build", __doc__, DATA, build)


class Sampler:
    """Moves the samples of the template with its head.

    Attributes:
        v: (V,) of the samples of a row, radians.
        openings: the mouth, the right eye and the left.
    """

    def __init__(self, folder: Path) -> None:
        head = load_head(folder)
        closed = close_head(head)
        self._scan = cut_face(closed.mesh)
        face = Parameterisation(head, closed, Chart(self._scan))
        self.v = curve_parameters(SAMPLES[1])[: SAMPLES[1] // 2]
        u = np.linspace(0.0, 1.0, SAMPLES[0])
        self._triangle, self._weights = face.chart.anchors(*face.st(u, self.v))
        self.openings = [
            _opening("mouth_seam_upper", "mouth_seam_lower", face, closed.lips[0], 5.0, 0.0, BEYOND)
        ]
        for lids in closed.lids.values():
            margins = "upper_lid_margin", "lower_lid_margin"
            self.openings.append(_opening(*margins, face, lids[0], 4.0, 1.0))

    def displacements(self, offsets: FloatArray) -> FloatArray:
        """(U, V, 3) displacements of the samples, metres, from (vertices, 3) in centimetres."""
        return _closed(self._sampled(self._scan.links @ (offsets * CENTIMETRE)), self.v)

    @property
    def rest(self) -> FloatArray:
        """(U, V, 3) where the samples lie at rest, metres."""
        return self._sampled(self._scan.vertices)

    def _sampled(self, values: FloatArray) -> FloatArray:
        corners = values[self._scan.triangles[self._triangle]]
        return np.einsum("qc,qcx->qx", self._weights, corners).reshape(SAMPLES[0], -1, 3)


def _closed(moved: FloatArray, v: FloatArray) -> FloatArray:
    """Displacements that keep the edge of the face in the plane of reflection.

    There z must stay as it is, or the curves would break and their Fourier modes ring; its
    displacement at the edge is faded out over EDGE radians.
    """
    for away, first in ((v, 0), (np.pi - v, -1)):
        fade = (1.0 - np.clip(away / EDGE, 0.0, 1.0) ** 2) ** 3
        moved = moved - moved[:, first, None] * np.array([0.0, 0.0, 1.0]) * fade[:, None]
    return moved


def _opening(
    upper: str,
    lower: str,
    face: Parameterisation,
    line: FloatArray,
    reach: float,
    upper_share: float,
    beyond: float = 0.0,
) -> Opening:
    start, end = sorted(face.uv_of(line[[0, -1]])[:, 1])
    return Opening(upper, lower, float(start), float(end), reach, upper_share, beyond=beyond)


def build(folder: Path, output: Path) -> None:
    """Measure every expression and identity mode and write ``output``."""
    paths = folder / "expressions.npz", folder / "identities.npz"
    for path in paths:
        if not path.is_file():
            raise InputError(f"expected {path.name} in {folder}; give ICT-FaceKit's folder")
    sampler = Sampler(folder)
    expressions = np.load(paths[0])
    smooth, parting = [], []
    for offsets in expressions["offsets_cm"]:
        parts = split(sampler.displacements(offsets), sampler.v, sampler.openings)
        smooth.append(_fit(parts[0], LEVEL, {}))
        parting.append(_fit(parts[1], LEVEL, slits(LEVEL[0])))
    modes = np.load(paths[1])["offsets_cm"][:IDENTITIES]
    identities = [_fit(sampler.displacements(m), IDENTITY_LEVEL, {}) for m in modes]
    arrays: dict[str, NDArray[Any]] = {"names": np.array([str(n) for n in expressions["names"]])}
    for name, values in (("smooth", smooth), ("parting", parting), ("identity", identities)):
        arrays[name], arrays[f"{name}_scale"] = _quantised(np.array(values))
    with atomic_path(output) as temporary, open(temporary, "wb") as file:
        np.savez_compressed(file, **arrays)  # type: ignore[arg-type]
    print(f"{len(smooth)} expressions, {len(identities)} identity modes")
    print(f"wrote {output.name}, {output.stat().st_size / 1024:.0f} kB")


def _fit(samples: FloatArray, shape: tuple[int, int], continuity: dict[int, Any]) -> FloatArray:
    """(K, M/2, 3) front halves of displacement curves."""
    closed = mirror_points(samples)
    fitted = fit_curves(
        closed, shape, fairness=FAIRNESS, damping=DAMPING, continuity=continuity, edge_weight=1.0
    )
    return fitted[:, : shape[1] // 2]


def _quantised(values: FloatArray) -> tuple[NDArray[np.int16], FloatArray]:
    """Values as multiples of a scale of each control: at most a micrometre lost."""
    scale = np.abs(values).max(axis=(1, 2, 3)) / STEPS
    steps = np.divide(values, scale[:, None, None, None], where=scale[:, None, None, None] > 0,
                      out=np.zeros_like(values))  # fmt: skip
    return np.rint(steps).astype(np.int16), scale


if __name__ == "__main__":
    sys.exit(main())
