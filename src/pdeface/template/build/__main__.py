"""Measure the template: ``python -m pdeface.template.build HEAD_FOLDER [-o FILE]``."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

from pdeface.curves import curve_parameters, mirror_points
from pdeface.files import atomic_path
from pdeface.pde.fit import fit_curves
from pdeface.template import DATA
from pdeface.template.build.chart import Chart
from pdeface.template.build.closing import close_head
from pdeface.template.build.command import run
from pdeface.template.build.cutting import MIRROR_Z, cut_face
from pdeface.template.build.features import measure_columns, measure_features
from pdeface.template.build.head import load_head
from pdeface.template.build.measure import measure
from pdeface.template.build.openings import measure_openings
from pdeface.template.build.parameterisation import Parameterisation
from pdeface.template.layout import LEVELS

SAMPLES = (217, 368)
# Too little of either, and the sharp edges of the wings of the nose ring across the cheeks: along u
# where rows are few, along v where columns are many. Chosen in raking light.
FAIRNESS = {"28x46": 2e-2, "55x92": 5e-3, "109x184": 5e-3}
DAMPING = {"28x46": 0.5, "55x92": 1.0, "109x184": 4.0}


def main() -> int:
    """Build the template file and print how near it is to the head."""
    return run("pdeface.template.build", __doc__, DATA, build)


def build(folder: Path, output: Path) -> None:
    """Measure every level on the head in ``folder`` and write ``output``."""
    head = load_head(folder)
    closed = close_head(head)
    scan = cut_face(closed.mesh)
    face = Parameterisation(head, closed, Chart(scan))
    rows, around = SAMPLES
    v = curve_parameters(around)[: around // 2]
    samples = mirror_points(face.points(np.linspace(0.0, 1.0, rows), v), MIRROR_Z)
    arrays = {
        "mirror_z": np.float64(MIRROR_Z),
        "features": measure_features(face),
        "columns": measure_columns(face, head),
        "openings": measure_openings(face, closed),
    }
    for name, shape in LEVELS.items():
        # What is measured is what ships: single precision, and the reflection made exact.
        points = fit_curves(samples, shape, fairness=FAIRNESS[name], damping=DAMPING[name])
        half = points[:, : shape[1] // 2].astype(np.float32)
        arrays[f"curves_{name}"] = half
        accuracy = measure(mirror_points(half.astype(np.float64), MIRROR_Z), scan)
        print(
            f"{name}: RMS {accuracy.rms:.3f} mm, median {accuracy.median:.3f} mm, "
            f"95 % {accuracy.p95:.2f} mm, normals {accuracy.normal:.2f} degrees, "
            f"{accuracy.folds} folded cells"
        )
    with atomic_path(output) as temporary, open(temporary, "wb") as file:
        np.savez_compressed(file, **arrays)  # type: ignore[arg-type]
    print(f"wrote {output.name}, {output.stat().st_size / 1024:.0f} kB")


if __name__ == "__main__":
    sys.exit(main())
