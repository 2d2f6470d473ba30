"""Compact faces: shapes in a few hundred bytes, predicted from the neutral face."""

from __future__ import annotations

from pdeface.compact.file import MAGIC, Compact, pack_compact, unpack_compact

__all__ = ["MAGIC", "Compact", "pack_compact", "unpack_compact"]
