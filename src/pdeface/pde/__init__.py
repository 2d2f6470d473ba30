"""The mathematics: equation (1), its boundary-value forms, joins, and evaluation. NumPy only."""

from pdeface.pde.differential import Curvature, curvature, unit_normal
from pdeface.pde.grid import GridEvaluator
from pdeface.pde.joins import Continuity, Join
from pdeface.pde.shape_basis import ShapeBasis
from pdeface.pde.surface import PDESurface, Side

__all__ = [
    "Continuity",
    "Curvature",
    "GridEvaluator",
    "Join",
    "PDESurface",
    "ShapeBasis",
    "Side",
    "curvature",
    "unit_normal",
]
