"""The styles in which a face can be drawn, one a file.

Each is a function ``(face, camera, options) -> list of solids``.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

from pdeface.errors import InputError
from pdeface.face import Face
from pdeface.pictures.camera import Camera
from pdeface.pictures.options import Options
from pdeface.pictures.solid import Solid
from pdeface.pictures.styles.curvature import curvature
from pdeface.pictures.styles.curves import curves
from pdeface.pictures.styles.shaded import shaded
from pdeface.pictures.styles.textured import textured
from pdeface.pictures.styles.uvmesh import uvmesh

__all__ = ["STYLES", "Style", "style_named"]

Style = Callable[[Face, Camera, Options], list[Solid]]

STYLES: Final[dict[str, Style]] = {
    "textured": textured,
    "shaded": shaded,
    "uvmesh": uvmesh,
    "curves": curves,
    "curvature": curvature,
}


def style_named(name: str | None, face: Face) -> tuple[str, Style]:
    """A style by its name; for None, textured if the face has a texture and shaded if not.

    Raises:
        InputError: there is no such style, or the face has no texture to show.
    """
    if name is None:
        name = "shaded" if face.texture is None else "textured"
    if name not in STYLES:
        raise InputError(f"style is one of {', '.join(STYLES)}, got {name!r}; try 'shaded'")
    if name == "textured" and face.texture is None:
        raise InputError(
            "style 'textured' needs a face with a texture and this one has none; use style='shaded'"
        )
    return name, STYLES[name]
