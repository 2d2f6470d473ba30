"""How near faces from photos are to heads that are known: ``python -m benchmarks.accuracy``."""
