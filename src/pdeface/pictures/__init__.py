"""Pictures of faces: curves, uv mesh, clay, texture and curvature, from any side."""

from pdeface.pictures.filming import film
from pdeface.pictures.picture import render
from pdeface.pictures.sheet import contact_sheet, demo_sheet

__all__ = ["contact_sheet", "demo_sheet", "film", "render"]
