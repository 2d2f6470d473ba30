"""Run every benchmark: ``python -m benchmarks``, or ``make bench``."""

from __future__ import annotations

from benchmarks import combinations, evaluation, performance, startup, warp

evaluation.main()
print()
performance.main()
print()
startup.main()
print()
warp.main([])
print()
combinations.main([])
