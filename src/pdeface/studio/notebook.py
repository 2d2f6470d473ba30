"""A face in a notebook: what :meth:`pdeface.Face.widget` is made by."""

from __future__ import annotations

from typing import TYPE_CHECKING

from pdeface.errors import require
from pdeface.face import Face

if TYPE_CHECKING:
    from pdeface.studio.face_widget import FaceWidget

__all__ = ["widget"]


def widget(face: Face, *, mesh: tuple[int, int] = (55, 81), height: int = 480) -> FaceWidget:
    """The face as a widget of Jupyter, with a slider for every control.

    Sliders move the face without the kernel; ``widget.weights`` and ``widget.face`` follow them,
    and the page follows what is assigned to ``widget.weights``.

    Args:
        face: what is shown at first.
        mesh: (rows, columns) of the uv mesh, at most 60,000 vertices.
        height: of the view, CSS pixels.

    Raises:
        InputError: a mesh that is too fine.
        MissingExtraError: anywidget is not installed.
        PDEFaceError: the page has not been built, as in an editable install.

    Example:
        >>> shown = pdeface.neutral().widget()  # doctest: +SKIP
        >>> shown.weights = {"jawOpen": 0.5}  # doctest: +SKIP
        >>> shown.face.save("face.pdeface")  # doctest: +SKIP
    """
    require("anywidget", "widget", "to show faces in notebooks")
    from pdeface.studio.face_widget import FaceWidget

    return FaceWidget(face, mesh, height)
