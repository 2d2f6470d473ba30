"""Three-dimensional faces as solutions of a partial differential equation.

A face is a small set of closed boundary curves; a fourth-order elliptic equation turns them into
a smooth surface that passes through every curve and has exact normals at any resolution::

    import pdeface

    face = pdeface.neutral()
    face.curves.points                 # (K, M, 3) metres: all that the shape is made of
    surface = face.surface()
    surface(0.5, 1.57)                 # a point on the midline, beside the nose
    pdeface.export(face, "face.glb", mesh=(109, 161))

    pdeface.random(7).set(jawOpen=0.5, eyeBlinkLeft=1.0)   # a person, doing something

Metres and radians; +Y is up, +Z forward, +X the subject's left.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pdeface import errors
    from pdeface.curves import BoundaryCurves
    from pdeface.face import Face, load, neutral, random
    from pdeface.formats import export
    from pdeface.pde import PDESurface
    from pdeface.performer import Performer
    from pdeface.pictures import render
    from pdeface.studio.notebook import widget
    from pdeface.uvmesh import UVMesh

__all__ = [
    "BoundaryCurves",
    "Face",
    "PDESurface",
    "Performer",
    "UVMesh",
    "__version__",
    "errors",
    "export",
    "load",
    "neutral",
    "random",
    "render",
    "widget",
]

__version__ = "0.1.0"

# Where each public name lives. Nothing is imported before it is used: `import pdeface` costs next
# to nothing, and a face needs no more of the optional dependencies than what is done with it.
_ROOMS = {
    "BoundaryCurves": "pdeface.curves",
    "Face": "pdeface.face",
    "PDESurface": "pdeface.pde",
    "Performer": "pdeface.performer",
    "UVMesh": "pdeface.uvmesh",
    "export": "pdeface.formats",
    "load": "pdeface.face",
    "neutral": "pdeface.face",
    "random": "pdeface.face",
    "render": "pdeface.pictures",
    "widget": "pdeface.studio.notebook",
}


def __getattr__(name: str) -> object:
    if name == "errors":
        return import_module("pdeface.errors")
    if name not in _ROOMS:
        raise AttributeError(f"module 'pdeface' has no attribute {name!r}")
    value: object = getattr(import_module(_ROOMS[name]), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
