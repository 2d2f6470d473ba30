"""Timing calls side by side. Import this before numpy: it holds BLAS to one thread."""

from __future__ import annotations

import os
import platform
import time
from collections.abc import Callable
from importlib.metadata import version
from statistics import median

for _variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[_variable] = "1"

Call = Callable[[], object]

# One sample takes at least so long: short calls are repeated within it.
SAMPLE = 1e-3


def side_by_side(calls: dict[str, Call], seconds: float, least: int = 5) -> dict[str, list[float]]:
    """Seconds that a call takes, many samples of each, ``least`` or more.

    The calls take turns, so that a busy machine slows all of them, and each is called once
    before it is timed, so that each finds its own memory in the cache.
    """
    repeats = {}
    for name, call in calls.items():
        call()
        repeats[name] = max(1, round(SAMPLE / _timed(call, 1)))
    samples: dict[str, list[float]] = {name: [] for name in calls}
    start = time.perf_counter()
    while time.perf_counter() - start < seconds or len(samples[next(iter(calls))]) < least:
        for name, call in calls.items():
            call()
            samples[name].append(_timed(call, repeats[name]))
    return samples


def _timed(call: Call, repeats: int) -> float:
    start = time.perf_counter()
    for _ in range(repeats):
        call()
    return (time.perf_counter() - start) / repeats


def ratio(samples: dict[str, list[float]], name: str, other: str) -> float:
    """How many times as long ``name`` takes: the median over the turns that they shared."""
    return median(a / b for a, b in zip(samples[name], samples[other], strict=True))


def machine() -> str:
    """What the numbers belong to."""
    coretype = os.environ.get("OPENBLAS_CORETYPE", "not set")
    return (
        f"Python {platform.python_version()}, numpy {version('numpy')}, {platform.machine()}, "
        f"1 thread, OPENBLAS_CORETYPE {coretype}"
    )
