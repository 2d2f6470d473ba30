"""Bytes that a face takes beside a mesh codec and a B-spline: ``python -m benchmarks.rates``."""
