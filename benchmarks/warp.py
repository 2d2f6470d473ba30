"""The two-pass mesh warp beside cv2.remap and scikit-image's piecewise-affine warp.

    python benchmarks/warp.py [SIZE ...]

One thread (OpenCV is told so, nothing else here uses more); one image of SIZE x SIZE x 3 bytes,
256 and 1024 by default; one pair of 7 x 7 meshes. The calls take turns, so that a busy machine
slows all of them; of each the best counts. What is compared is not equal: cv2.remap reads four
pixels by a map computed beforehand, and neither it nor scikit-image weights by area. The mesh
warp's time includes its checks and splines.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Sequence

import cv2
import numpy as np
from numpy.typing import NDArray
from skimage.transform import PiecewiseAffineTransform
from skimage.transform import warp as skimage_warp

from pdeface.texture import warp

Call = Callable[[], object]
Mesh = NDArray[np.float64]


def main(arguments: Sequence[str]) -> None:
    cv2.setNumThreads(1)
    print("Two-pass mesh warp, 7 x 7 nodes, RGB bytes, 1 thread; best of several, in turns")
    for size in [int(argument) for argument in arguments] or [256, 1024]:
        times = measure(calls(size), seconds=6.0)
        ours, remap = times["pdeface, numba"], times["cv2.remap, bilinear"]
        piecewise = times["scikit-image, piecewise affine"]
        print(f"\n{size} x {size}")
        for name, seconds in times.items():
            print(f"  {name:32} {1e3 * seconds:9.2f} ms {seconds / ours:8.2f} x pdeface, numba")
        print(f"  pdeface takes {ours / remap:.2f} times as long as cv2.remap (reach at 1024: 5)")
        print(f"  pdeface is {piecewise / ours:.0f} times as fast as scikit-image (reach: 20)")


def calls(size: int) -> dict[str, Call]:
    rng = np.random.default_rng(1)
    image = smooth_image(size, rng)
    source, target = moved(size, rng), moved(size, rng)
    x, y = remap_maps(source, target, size)
    affine = PiecewiseAffineTransform.from_estimate(
        target.reshape(-1, 2) - 0.5, source.reshape(-1, 2) - 0.5
    )
    return {
        "pdeface, numba": lambda: warp(image, source, target, engine="numba"),
        "pdeface, numpy": lambda: warp(image, source, target, engine="numpy"),
        "cv2.remap, bilinear": lambda: cv2.remap(image, x, y, cv2.INTER_LINEAR),
        "scikit-image, piecewise affine": lambda: skimage_warp(image, affine),
    }


def measure(calls: dict[str, Call], seconds: float) -> dict[str, float]:
    """Best time of each call; those that take long have fewer turns."""
    times = {name: [timed(call), timed(call)][1:] for name, call in calls.items()}
    for turn in range(200):
        for name, call in calls.items():
            if sum(times[name]) < seconds / len(calls) or turn < 2:
                times[name].append(timed(call))
    return {name: min(values) for name, values in times.items()}


def timed(call: Call) -> float:
    start = time.perf_counter()
    call()
    return time.perf_counter() - start


def smooth_image(size: int, rng: np.random.Generator) -> NDArray[np.uint8]:
    coarse = rng.integers(0, 256, (size // 16, size // 16, 3), dtype=np.uint8)
    return np.asarray(cv2.resize(coarse, (size, size), interpolation=cv2.INTER_CUBIC))


def moved(size: int, rng: np.random.Generator) -> Mesh:
    """A regular mesh whose inner nodes are moved by up to a fortieth of the image."""
    x, y = np.meshgrid(np.linspace(0.0, size, 7), np.linspace(0.0, size, 7))
    mesh = np.stack([x, y], axis=-1)
    mesh[1:-1, 1:-1] += rng.uniform(-size / 40, size / 40, (5, 5, 2))
    return mesh


def remap_maps(source: Mesh, target: Mesh, size: int) -> tuple[NDArray[np.float32], ...]:
    """Where the warp takes each pixel from: the coordinates, warped as an image themselves."""
    y, x = np.mgrid[0:size, 0:size].astype(np.float64)
    places = warp(np.stack([x, y], axis=-1), source, target)
    return tuple(np.ascontiguousarray(places[..., k], np.float32) for k in range(2))


if __name__ == "__main__":
    main(sys.argv[1:])
