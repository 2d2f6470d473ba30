"""Conformation: who a face is, as named displacements of its curves (section 2.3 of the paper)."""

from pdeface.controls.shape.catalogue import SHAPE_CONTROLS, displacement

__all__ = ["SHAPE_CONTROLS", "displacement"]
