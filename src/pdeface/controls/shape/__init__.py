"""Conformation: who a face is, as named displacements of its curves (section 2.3 of the paper).

``SHAPE_CONTROLS`` names the controls, ``displacement`` gives what one does to the curves at +1. The
surface is linear in the curves, and so in every control.
"""

from pdeface.controls.shape.catalogue import COMBINABLE_RANGE, SHAPE_CONTROLS, displacement

__all__ = ["COMBINABLE_RANGE", "SHAPE_CONTROLS", "displacement"]
