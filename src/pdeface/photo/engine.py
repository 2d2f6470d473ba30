"""MediaPipe, without what it brings along and nobody here uses."""

from __future__ import annotations

import importlib
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from types import ModuleType
from typing import Any

from pdeface.errors import require

__all__ = ["mediapipe"]

_PLOTS = "matplotlib", "matplotlib.pyplot"


def mediapipe(purpose: str) -> ModuleType:
    """The module, imported in a third of the time by leaving Matplotlib for when it plots.

    Args:
        purpose: what it is needed for, as in ``"to find faces in photos"``.

    Raises:
        MissingExtraError: it is not installed.
    """
    if "mediapipe" in sys.modules or _PLOTS[1] in sys.modules:
        return require("mediapipe", "photo", purpose)
    with _later():
        return require("mediapipe", "photo", purpose)


class _Later(ModuleType):
    """Stands for a module until something of it is wanted."""

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):  # asked by the import system
            raise AttributeError(name)
        return getattr(importlib.import_module(self.__name__), name)


@contextmanager
def _later() -> Iterator[None]:
    """While it lasts, Matplotlib is imported in name only."""
    package, plots = map(_Later, _PLOTS)
    package.__dict__["pyplot"] = plots
    sys.modules.update(dict(zip(_PLOTS, (package, plots), strict=True)))
    try:
        yield
    finally:
        for name, module in zip(_PLOTS, (package, plots), strict=True):
            if sys.modules.get(name) is module:
                del sys.modules[name]
