"""The page's files, built from ``client/`` by Vite into this package."""

from __future__ import annotations

from pathlib import Path

from pdeface.errors import PDEFaceError

__all__ = ["folder"]

_BUILT = Path(__file__).parent / "static"


def folder() -> Path:
    """The folder of the built page.

    Raises:
        PDEFaceError: it was not built.
    """
    if not (_BUILT / "index.html").is_file():
        raise PDEFaceError(
            "the studio's page has not been built, as in an editable install; with Node.js, run: "
            "npm ci --prefix client && npm run build --prefix client (or: make client)"
        )
    return _BUILT
