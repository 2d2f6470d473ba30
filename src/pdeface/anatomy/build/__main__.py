"""Measure eyes, teeth and the jaw: ``python -m pdeface.anatomy.build HEAD_FOLDER``."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from pdeface.anatomy.build.teeth import AXIS_Z, lower_and_upper, measure_arch
from pdeface.anatomy.measured import DATA
from pdeface.anatomy.outline import OPENINGS, Outline
from pdeface.errors import InputError
from pdeface.files import atomic_path
from pdeface.pde import PDESurface
from pdeface.template import neutral_curves
from pdeface.template.build.command import run
from pdeface.template.build.head import CENTIMETRE, Head, load_head

FloatArray = NDArray[np.float64]

STILL = 1e-3
"""Expressions that move no lower tooth by so much, metres, have no jaw motion."""


def main() -> int:
    """Build the file of what lies behind the openings."""
    return run("pdeface.anatomy.build", __doc__, DATA, build)


def build(folder: Path, output: Path) -> None:
    """Measure the head in ``folder`` and write ``output``."""
    path = folder / "expressions.npz"
    if not path.is_file():
        raise InputError(f"expected {path.name} in {folder}; give ICT-FaceKit's folder")
    head = load_head(folder)
    centre, radius = measure_eyeball(head)
    lower, upper = lower_and_upper(head)
    with np.load(path) as file:
        names, offsets = file["names"].tolist(), file["offsets_cm"] * CENTIMETRE
    jaw = {}
    for name, moved in zip(names, offsets[:, lower], strict=True):
        if np.abs(moved).max() > STILL:
            jaw[name] = fit_affine(head.vertices[lower], moved)
    outline = Outline.sampled(PDESurface(neutral_curves().points))
    arrays = {
        **{name: np.array(getattr(outline, name), dtype=np.float32) for name in OPENINGS},
        "eye_centre": centre,
        "eye_radius": np.array(radius),
        "axis_z": np.array(AXIS_Z),
        "jaw_names": np.array(list(jaw)),
        "jaw": np.array(list(jaw.values())),
    }
    for name, teeth in (("lower", lower), ("upper", upper)):
        arrays[f"{name}_arch"], arrays[f"{name}_gaps"] = measure_arch(head, teeth, name)
    with atomic_path(output) as temporary, open(temporary, "wb") as target:
        np.savez_compressed(target, **arrays)  # type: ignore[arg-type]
    print(f"jaw motions: {', '.join(jaw)}")
    print(f"wrote {output.name}, {output.stat().st_size / 1024:.0f} kB")


def measure_eyeball(head: Head) -> tuple[FloatArray, float]:
    """(3,) centre and radius of the sphere nearest to the left eye's sclera, least squares."""
    polygons = head.parts["M_ScleraLeft"]
    points = head.vertices[np.unique([corner for polygon in polygons for corner in polygon])]
    left = np.column_stack([2.0 * points, np.ones(len(points))])
    x = np.linalg.lstsq(left, (points**2).sum(axis=1), rcond=None)[0]
    return x[:3], float(np.sqrt(x[3] + x[:3] @ x[:3]))


def fit_affine(points: FloatArray, moved: FloatArray) -> FloatArray:
    """(3, 4) A and t of the motion d = A x + t nearest to (n, 3) displacements."""
    left = np.column_stack([points, np.ones(len(points))])
    return np.asarray(np.linalg.lstsq(left, moved, rcond=None)[0].T)


if __name__ == "__main__":
    sys.exit(main())
