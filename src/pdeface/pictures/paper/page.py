"""The page beside the redrawn figures: point by point, what agrees and what differs."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from pdeface.pictures.paper.panels import Figure

__all__ = ["page"]

HEAD: Final = """\
# The paper's figures, redrawn

*PDE Face: A Novel 3D Face Model* shows its method in nine figures. Eight of them are redrawn here
from this project's own data by `pdeface paper`, to be held beside the paper; below each stands
what agrees with it and what differs, and why. Lengths are in millimetres and angles in degrees,
measured when the figures were drawn.
"""

TAIL: Final = """\
## The figure that is not redrawn

Fig. 7 is a diagram of how texture mapping relates its spaces.
"""


def page(figures: Sequence[Figure]) -> str:
    """The page as Markdown text."""
    return "\n".join([HEAD, *map(_section, figures), TAIL])


def _section(figure: Figure) -> str:
    lines = [
        f"## Fig. {figure.number}",
        "",
        figure.caption,
        "",
        f"![Fig. {figure.number}]({figure.file_name})",
        "",
        "**Agrees**",
        "",
        *(f"- {text}" for text in figure.agrees),
        "",
        "**Differs**",
        "",
        *(f"- {text}" for text in figure.differs),
        "",
    ]
    return "\n".join(lines)
