"""52 expression weights to the vertices of a face, frame after frame, beside other face models.

    python -m benchmarks.performance

Single precision, one thread. The other models have their published sizes and random numbers,
whose products take as long as those of the real ones: FLAME as benchmarks/flame.py has it, and
ICT-FaceKit's expressions as a dense product, 26,719 vertices by 53.
"""

from __future__ import annotations

from benchmarks.timing import Call, machine, ratio, side_by_side

# isort: split
from statistics import median

import numpy as np

from benchmarks.flame import EXPRESSIONS, IDENTITIES, JOINTS, VERTICES, Flame
from pdeface import Performer, UVMesh, neutral

SMALL, LARGE = (28, 41), (271, 161)
FRAMES = 1000
ICT_VERTICES, ICT_EXPRESSIONS = 26_719, 53
BATCHES = (1, 8, 64)


def main() -> None:
    print(f"52 weights to vertices. {machine()}")
    against_flame(seconds=6.0)
    against_fill(seconds=8.0)
    for frames in BATCHES:
        against_ict(frames, seconds=6.0)


def weights(frames: int) -> np.ndarray:
    return np.random.default_rng(1).random((frames, 52), np.float32)


def against_flame(seconds: float) -> None:
    """One frame at a time."""
    performer, flame = Performer(neutral(), UVMesh(*SMALL)), Flame()
    own, out = weights(1)[0], performer.empty()
    rng = np.random.default_rng(2)
    coefficients = rng.random(IDENTITIES + EXPRESSIONS, np.float32)
    pose = rng.random((JOINTS, 3), np.float32)
    samples = side_by_side(
        {
            "pdeface": lambda: performer.positions(own, out=out),
            "FLAME's size": lambda: flame(coefficients, pose),
        },
        seconds,
    )
    faster = ratio(samples, "FLAME's size", "pdeface")
    nodes = SMALL[0] * SMALL[1]
    print(f"\nOne frame at a time, {SMALL[0]} x {SMALL[1]}")
    report(samples, {"pdeface": nodes, "FLAME's size": VERTICES})
    print(f"  faster per frame {faster:.0f} x, per vertex {faster * nodes / VERTICES:.1f} x")


def against_fill(seconds: float) -> None:
    """Many frames, beside the time that numpy takes to write one number over the results."""
    performer = Performer(neutral(), UVMesh(*SMALL))
    own, out = weights(FRAMES), performer.empty(FRAMES)
    memory = np.empty(out.shape, np.float32)
    dense = np.random.default_rng(3).random((52, memory[0].size), np.float32)
    flat = memory.reshape(FRAMES, -1)
    samples = side_by_side(
        {
            "fill": lambda: memory.fill(1.0),
            "pdeface": lambda: performer.positions(own, out=out),
            "one dense product": lambda: np.matmul(own, dense, out=flat),
        },
        seconds,
    )
    print(f"\n{FRAMES} frames in a batch, {SMALL[0]} x {SMALL[1]}")
    report(samples, dict.fromkeys(samples, FRAMES * SMALL[0] * SMALL[1]))
    for name in list(samples)[1:]:
        print(f"  {name}: {ratio(samples, name, 'fill'):.1f} x fill")
    operations = 2 * 52 * memory.size
    rate = 1e-9 * operations / median(samples["pdeface"])
    square = np.random.default_rng(4).random((768, 768), np.float32)
    peak = side_by_side({"square": lambda: np.matmul(square, square)}, 2.0)
    best = 1e-9 * 2 * 768**3 / median(peak["square"])
    print(f"  {rate:.0f} GFlop/s; a product of square matrices reaches {best:.0f}")


def against_ict(frames: int, seconds: float) -> None:
    """A large uv mesh beside a dense model of half as many vertices."""
    performer = Performer(neutral(), UVMesh(*LARGE))
    own, out = weights(frames), performer.empty(frames)
    rng = np.random.default_rng(5)
    basis = rng.random((ICT_EXPRESSIONS, 3 * ICT_VERTICES), np.float32)
    theirs = rng.random((frames, ICT_EXPRESSIONS), np.float32)
    vertices = np.empty((frames, 3 * ICT_VERTICES), np.float32)
    calls: dict[str, Call] = {
        "pdeface": lambda: performer.positions(own, out=out),
        "ICT-FaceKit's size": lambda: np.matmul(theirs, basis, out=vertices),
    }
    samples = side_by_side(calls, seconds)
    nodes = LARGE[0] * LARGE[1]
    print(f"\n{frames} frame{'s' * (frames > 1)} at a time, {LARGE[0]} x {LARGE[1]}")
    report(samples, {"pdeface": frames * nodes, "ICT-FaceKit's size": frames * ICT_VERTICES})
    faster = ratio(samples, "ICT-FaceKit's size", "pdeface") * nodes / ICT_VERTICES
    print(f"  faster per vertex {faster:.2f} x")


def report(samples: dict[str, list[float]], vertices: dict[str, int]) -> None:
    for name, times in samples.items():
        time = median(times)
        print(f"  {name:<28}{1e3 * time:10.4f} ms{1e9 * time / vertices[name]:8.2f} ns a vertex")


if __name__ == "__main__":
    main()
