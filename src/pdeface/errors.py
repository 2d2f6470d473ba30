"""How this library says no.

Every error that a user can cause derives from :class:`PDEFaceError` and its message is one
line with three parts: what was expected, what came, what to do.
"""

from __future__ import annotations

import importlib
from types import ModuleType

__all__ = ["FileFormatError", "InputError", "MissingExtraError", "PDEFaceError", "require"]


class PDEFaceError(Exception):
    """Base of every error that this library raises on purpose."""


class InputError(PDEFaceError, ValueError):
    """A value from outside (an argument, a point, a number) cannot be used."""


class FileFormatError(InputError):
    """A file is damaged, newer than this library, or not what its name says."""


class MissingExtraError(PDEFaceError, ImportError):
    """An optional dependency is needed and absent."""


def require(module: str, extra: str, purpose: str) -> ModuleType:
    """Import an optional dependency, or say by name what to install.

    Args:
        module: the module to import, such as ``"pyvista"``.
        extra: the extra of this package that brings it, such as ``"render"``.
        purpose: what it is needed for, as in ``"to draw pictures"``.

    Raises:
        MissingExtraError: the module is not installed.
    """
    try:
        return importlib.import_module(module)
    except ImportError as error:
        raise MissingExtraError(
            f"{module} is needed {purpose} and is not installed; "
            f"run: pip install 'pdeface[{extra}]'"
        ) from error
