"""Anatomy: what lies behind the openings of a face, each part a PDE surface of its own.

Eyeballs, the rims of the lids, the cavity of the mouth, teeth and tongue are solved from a few
closed curves by the same core as the face, and their displacements are linear like the face's.
"""

from pdeface.anatomy import textures
from pdeface.anatomy.outline import OPENINGS, SAMPLES, Margins, Outline, outline_uv
from pdeface.anatomy.part import PARTS, Part
from pdeface.anatomy.placing import Anatomy, placed

__all__ = [
    "OPENINGS",
    "PARTS",
    "SAMPLES",
    "Anatomy",
    "Margins",
    "Outline",
    "Part",
    "outline_uv",
    "placed",
    "textures",
]
