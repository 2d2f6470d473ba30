"""Evaluating a face on a uv mesh, beside other surfaces and beside plain memory.

    python -m benchmarks.evaluation

Everything in single precision on one thread, except SciPy and geomdl, which have double only.
All surfaces are made of the same 28 x 23 points (the front halves of 28 curves of 46) and are
evaluated on 0 <= v <= pi. "fill" writes one number everywhere in memory of the same size that is
at hand, as the other calls of its table that write over memory do; "new" ones allocate it.
"""

from __future__ import annotations

from benchmarks.timing import Call, machine, ratio, side_by_side

# isort: split
from statistics import median

import numpy as np
from geomdl import BSpline, utilities
from numpy.typing import NDArray
from scipy.interpolate import BSpline as Basis
from scipy.interpolate import RectBivariateSpline

from pdeface.curves import curve_parameters, mirror_points
from pdeface.pde import GridEvaluator
from pdeface.pde.differential import write_unit_normals

LEVEL = (28, 46)
MESHES = ((28, 41), (271, 161), (1081, 641))


def main() -> None:
    print(f"Evaluation on a uv mesh. {machine()}")
    for rows, columns in MESHES:
        report(f"{rows} x {columns}", one_face(rows, columns), seconds=8.0)
    report("1,000 faces, 28 x 41", many_faces(1000), seconds=8.0)


def report(title: str, calls: dict[str, Call], seconds: float) -> None:
    samples = side_by_side(calls, seconds)
    peers = [name for name in ("SciPy, positions", "SciPy, with normals") if name in calls]
    print(f"\n{title:<34}" + f"{'ms':>12}{'x fill':>10}" + "".join(f"{p:>22} /" for p in peers))
    for name in calls:
        line = (
            f"  {name:<32}{1e3 * median(samples[name]):12.4f}{ratio(samples, name, 'fill'):10.2f}"
        )
        print(line + "".join(f"{ratio(samples, peer, name):24.2f}" for peer in peers))


def face(faces: int | None = None) -> NDArray[np.float64]:
    """Points of smooth mirrored curves about the size of a face, or of so many faces."""
    rng = np.random.default_rng(1)
    u, v = np.linspace(0.0, 1.0, LEVEL[0])[:, None], curve_parameters(LEVEL[1])[: LEVEL[1] // 2]
    half = np.stack([-0.08 * np.cos(v) + 0 * u, 0.2 - 0.25 * u + 0 * v, 0.1 * np.sin(v) + 0 * u])
    half = np.moveaxis(half, 0, -1) + rng.normal(scale=1e-4, size=(faces or 1, *half.shape[1:], 3))
    points = mirror_points(half, -0.02)
    return points if faces else points[0]


def one_face(rows: int, columns: int) -> dict[str, Call]:
    """The calls to compare on one uv mesh."""
    points = face()
    u, v = np.linspace(0.0, 1.0, rows), np.linspace(0.0, np.pi, columns)
    single = GridEvaluator(LEVEL, u, v, mirrored=True, dtype=np.float32)
    double = GridEvaluator(LEVEL, u, v, mirrored=True)
    out, normals, out_double = single.empty(), single.empty(), double.empty()
    memory = np.empty((3, rows, columns), np.float32)
    along_u, along_v, control = b_spline(points, u, v)
    calls: dict[str, Call] = {
        "fill": lambda: memory.fill(1.0),
        "fill, new": lambda: np.full((3, rows, columns), 1.0, np.float32),
        "pdeface, positions": lambda: single.positions(points, out=out),
        "pdeface, positions, new": lambda: single.positions(points),
        "pdeface, with normals": lambda: single.positions_and_normals(points, out=(out, normals)),
        "pdeface, positions, double": lambda: double.positions(points, out=out_double),
        "bicubic B-spline, two products": lambda: np.matmul(along_u @ control, along_v, out=memory),
        **scipy_calls(points, u, v),
    }
    if rows * columns < 10_000:  # a minute and more on the larger ones
        calls["geomdl, positions"] = geomdl_call(points, rows, columns)
    return calls


def many_faces(count: int) -> dict[str, Call]:
    """Each face with curves of its own, on the paper's uv mesh."""
    points = face(count)
    points_single = points.astype(np.float32)
    evaluator = GridEvaluator(
        LEVEL,
        np.linspace(0.0, 1.0, 28),
        np.linspace(0.0, np.pi, 41),
        mirrored=True,
        dtype=np.float32,
    )
    out, normals = evaluator.empty(count), evaluator.empty(count)
    memory = np.empty((count, 28, 41, 3), np.float32)
    weights = np.random.default_rng(2).random((count, 52), np.float32)
    basis = np.ascontiguousarray(evaluator.positions(points[:52])).reshape(52, -1)
    return {
        "fill": lambda: memory.fill(1.0),
        "positions, single points": lambda: evaluator.positions(points_single, out=out),
        "positions, double points": lambda: evaluator.positions(points, out=out),
        "with normals, single points": lambda: evaluator.positions_and_normals(
            points_single, out=(out, normals)
        ),
        "52 weights, by a vertex basis": lambda: np.matmul(
            weights, basis, out=memory.reshape(count, -1)
        ),
    }


def scipy_calls(
    points: NDArray[np.float64], u: NDArray[np.float64], v: NDArray[np.float64]
) -> dict[str, Call]:
    count = LEVEL[1] // 2
    knots = np.linspace(0.0, 1.0, LEVEL[0]), curve_parameters(LEVEL[1])[:count]
    splines = [RectBivariateSpline(*knots, points[:, :count, axis]) for axis in range(3)]
    normals, scratch = np.empty((3, len(u), len(v))), np.empty((2, len(u), len(v)))

    def with_normals() -> None:
        """Planar and without temporaries, as here."""
        positions()
        s_u, s_v = ([s(u, v, *order) for s in splines] for order in ((1, 0), (0, 1)))
        write_unit_normals(np.stack(s_u), np.stack(s_v), normals, scratch)

    def positions() -> object:
        return [spline(u, v) for spline in splines]

    return {"SciPy, positions": positions, "SciPy, with normals": with_normals}


def b_spline(
    points: NDArray[np.float64], u: NDArray[np.float64], v: NDArray[np.float64]
) -> tuple[NDArray[np.float32], ...]:
    """Bases (U, 28) and (23, V) of clamped cubic B-splines, and (3, 28, 23) control points."""

    def basis(count: int, t: NDArray[np.float64]) -> NDArray[np.float32]:
        knots = np.concatenate([np.zeros(3), np.linspace(0.0, 1.0, count - 2), np.ones(3)])
        return np.asarray(Basis.design_matrix(t, knots, 3).toarray(), np.float32)

    count = LEVEL[1] // 2
    control = np.ascontiguousarray(points[:, :count].transpose(2, 0, 1), np.float32)
    return basis(LEVEL[0], u), np.ascontiguousarray(basis(count, v / np.pi).T), control


def geomdl_call(points: NDArray[np.float64], rows: int, columns: int) -> Call:
    count = LEVEL[1] // 2
    surface = BSpline.Surface()
    surface.degree_u = surface.degree_v = 3
    surface.set_ctrlpts(points[:, :count].reshape(-1, 3).tolist(), LEVEL[0], count)
    surface.knotvector_u = utilities.generate_knot_vector(3, LEVEL[0])
    surface.knotvector_v = utilities.generate_knot_vector(3, count)
    surface.sample_size_u, surface.sample_size_v = rows, columns
    return surface.evaluate


if __name__ == "__main__":
    main()
