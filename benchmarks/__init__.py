"""Benchmarks: commands, never timed tests. ``python -m benchmarks`` runs them all."""
