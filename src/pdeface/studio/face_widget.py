"""The face of a notebook as an anywidget: weights that kernel and page share."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from typing import Any

import anywidget
import numpy as np
import traitlets

from pdeface.face import Face
from pdeface.studio.assets import folder
from pdeface.studio.geometry import Geometry
from pdeface.studio.packets import pack_arrays
from pdeface.studio.schema import schema

__all__ = ["FaceWidget"]


class FaceWidget(anywidget.AnyWidget):  # type: ignore[misc]
    """A face in a notebook; :func:`pdeface.studio.notebook.widget` makes one.

    Attributes:
        weights: of the controls, by name; assign to it, or move a slider in the page.
        mesh: (rows, columns) of the uv mesh.
        height: of the view, CSS pixels.
    """

    weights = traitlets.Dict().tag(sync=True)
    mesh = traitlets.Tuple(traitlets.Int(), traitlets.Int()).tag(sync=True)
    height = traitlets.Int().tag(sync=True)
    _esm = traitlets.Unicode().tag(sync=True)
    _css = traitlets.Unicode().tag(sync=True)
    _glb = traitlets.Bytes().tag(sync=True)
    _columns = traitlets.Bytes().tag(sync=True)
    _controls = traitlets.List().tag(sync=True)
    _curves = traitlets.Tuple(traitlets.Int(), traitlets.Int()).tag(sync=True)

    def __init__(self, face: Face, mesh: tuple[int, int], height: int) -> None:
        pages = folder()
        self._start = face
        self._geometry = Geometry(face, *mesh)
        columns = pack_arrays(self._geometry.columns(), **self._geometry.facts())
        super().__init__(
            _esm=(pages / "widget.js").read_text(encoding="utf-8"),
            _css=(pages / "widget.css").read_text(encoding="utf-8"),
            _glb=self._geometry.glb(),
            _columns=columns,
            _controls=[dataclasses.asdict(control) for control in schema().controls],
            _curves=face.curves.shape,
            weights=dict(face.weights),
            mesh=mesh,
            height=height,
        )
        self.on_msg(self._asked)

    @property
    def face(self) -> Face:
        """The face at the weights that are shown."""
        bare = self._start.with_weights(dict.fromkeys(self._start.weights, 0.0))
        return bare.with_weights(self.weights)

    @traitlets.validate("weights")  # type: ignore[untyped-decorator]
    def _checked(self, proposal: Any) -> dict[str, float]:
        """Weights that a face can have, those that are 0 left out.

        Raises:
            InputError: an unknown control, or a value out of its range.
        """
        bare = self._start.with_weights(dict.fromkeys(self._start.weights, 0.0))
        return dict(bare.with_weights(proposal["value"]).weights)

    def _asked(self, _: Any, content: Mapping[str, Any], buffers: Sequence[Any]) -> None:
        """Say where the face is exactly, which the page's own sum is near to."""
        if content.get("kind") != "exact":
            return
        weights = self._checked({"value": content.get("weights", {})})
        positions, normals = self._geometry.exact(weights, normals=True)
        answer = pack_arrays({"positions": positions[np.newaxis], "normals": normals})
        self.send({"kind": "exact", "weights": weights}, buffers=[answer])
