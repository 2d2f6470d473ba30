"""Memory that is freed goes back to the system."""

from __future__ import annotations

import ctypes
import sys

__all__ = ["give_back_what_is_freed"]

_MMAP_THRESHOLD, _ARENA_MAX = -3, -8
_LARGE = 1 << 20


def give_back_what_is_freed() -> None:
    """Have glibc map every array of a mebibyte and more by itself, and unmap it when it is freed.

    By itself it raises that limit with every array that is freed, to 32 MiB, and holds what is
    smaller; a server of many threads, of which each has a heap of its own, so comes to hold several
    times of what it uses. Elsewhere nothing is done.
    """
    if not sys.platform.startswith("linux"):
        return
    try:
        tell = ctypes.CDLL(None).mallopt
    except (AttributeError, OSError):  # another library of C
        return
    tell(_MMAP_THRESHOLD, _LARGE)
    tell(_ARENA_MAX, 2)
