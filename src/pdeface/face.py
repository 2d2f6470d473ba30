"""The face as a value: boundary curves, how they make a surface, and a texture."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from importlib import import_module
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from pdeface import images, template
from pdeface.archive import FaceRecord, pack, unpack
from pdeface.compact import MAGIC, Compact, pack_compact, unpack_compact
from pdeface.controls import (
    CONTROLS,
    Control,
    Displacement,
    checked_weights,
    has_lids,
    posed,
    random_weights,
    slits,
)
from pdeface.curves import BoundaryCurves
from pdeface.errors import FileFormatError, InputError
from pdeface.files import PathLike, atomic_write
from pdeface.pde import Join, PDESurface
from pdeface.pde.surface import check_parameters
from pdeface.sampler import sampler
from pdeface.template import neutral_curves
from pdeface.uvmesh import FaceMesh, UVMesh

if TYPE_CHECKING:
    from pdeface.studio.face_widget import FaceWidget

__all__ = ["Face", "Openings", "load", "neutral", "random"]

FloatArray = NDArray[np.float64]

Openings = Literal["cut", "none"]
"""Whether eyes and mouth are openings of a mesh."""

SUFFIX = ".pdeface"
_LARGEST_FILE = 512 << 20


@dataclass(frozen=True, eq=False)
class Face:
    """A face: immutable, compared by value, saved and loaded without loss.

    Attributes:
        curves: the closed boundary curves, metres.
        texture: (H, W, 3 or 4) uint8, read-only, or None. Texel [0, 0] lies at u = 0, v = 0: the
            forehead on the subject's right, which is the left of an ordinary photo.
        a: relative rate of smoothing between u and v, 1 or more (equation 1 of the paper).
        modes: N, the number of Fourier modes solved one by one (equation 6).
        name: what to call the face in files and pictures.
        notes: free text by topic, such as ``{"licence": "CC0", "source": "..."}``.
        weights: values of the controls (:mod:`pdeface.controls`) that are not 0, read-only.

    Raises:
        InputError: parameters, pixels, texts or weights that no face has.

    Example:
        >>> import numpy as np
        >>> face = Face(BoundaryCurves(np.random.default_rng(0).normal(size=(4, 8, 3))))
        >>> face.with_name("Ada").mesh(10, 12).vertices.shape
        (120, 3)
    """

    curves: BoundaryCurves
    texture: NDArray[np.uint8] | None = None
    a: float = 1.0
    modes: int = 6
    name: str = ""
    notes: Mapping[str, str] = field(default_factory=dict)
    weights: Mapping[str, float] = field(default_factory=dict)
    # The texture as a PNG or JPEG file, when it came as one: not to be compressed twice.
    _encoded: bytes | None = field(default=None, init=False, repr=False)

    def __post_init__(self) -> None:
        if not isinstance(self.curves, BoundaryCurves):
            raise InputError(
                f"a face needs BoundaryCurves, got {type(self.curves).__name__}; "
                "wrap the points: BoundaryCurves(points)"
            )
        check_parameters(self.a, self.modes)
        _check_texts([self.name, *self.notes.keys(), *self.notes.values()])
        fields = {"a": float(self.a), "modes": int(self.modes)}
        weights = MappingProxyType(checked_weights(self.weights))
        texture = None if self.texture is None else _frozen(images.check_pixels(self.texture))
        notes = MappingProxyType(dict(self.notes))
        for key, value in {
            **fields,
            "texture": texture,
            "notes": notes,
            "weights": weights,
        }.items():
            object.__setattr__(self, key, value)

    @property
    def controls(self) -> tuple[tuple[Control, float], ...]:
        """Every control with its present value, in the order in which they are listed."""
        return tuple((control, self.weights.get(name, 0.0)) for name, control in CONTROLS.items())

    def set(self, *, clamp: bool = False, **weights: float) -> Face:
        """The same face with these values of its controls, the others as they are.

        Args:
            clamp: bring values into their range instead of refusing them.
            weights: values by name, such as ``eyeBlinkRight=1.0``; 0 is neutral.

        Raises:
            InputError: an unknown name (the message offers the nearest), or a value that is not
                a number in its control's range.

        Example:
            >>> neutral().set(jawOpen=0.5).weights["jawOpen"]
            0.5
        """
        return self.with_weights(weights, clamp=clamp)

    def with_weights(self, weights: Mapping[str, float], *, clamp: bool = False) -> Face:
        """As :meth:`set`, from a mapping."""
        changed = {**dict.fromkeys(weights, 0.0), **checked_weights(weights, clamp=clamp)}
        return self._changed(weights={**self.weights, **changed})

    @property
    def displacement(self) -> Displacement:
        """What the controls add to the curves."""
        return posed(self.curves.points, self.weights, self.a, self.modes)

    @property
    def moved_curves(self) -> BoundaryCurves:
        """The curves where the controls have moved them: what the surface passes through."""
        if not self.weights:
            return self.curves
        moved = self.displacement
        return self.curves.displaced(moved.smooth + moved.parting)

    def surface(self, join: Join = "smooth") -> PDESurface:
        """The PDE surface through the moved curves; u in [0, 1], v in radians, period 2 pi.

        Under the smooth join the face is C2 everywhere but between lids and lips, where
        expressions part it. What closes the lids to the last tenth of a millimetre is added to
        a mesh that is cut (:mod:`pdeface.margins`), and not to this surface.
        """
        points, parting, _ = self._layers(join)
        surface = PDESurface(points, a=self.a, modes=self.modes, join=join)
        if parting is None:
            return surface
        slit = slits(self.curves.shape[0])
        return surface + PDESurface(parting, a=self.a, modes=self.modes, continuity=slit)

    def _layers(self, join: Join) -> tuple[FloatArray, FloatArray | None, FloatArray]:
        """Data points; the displacement that parts the surface, if any does; and the margins'."""
        moved = self.displacement if self.weights else Displacement(np.zeros(()), np.zeros(()))
        points = self.curves.points + moved.smooth
        if join == "smooth" and moved.parting.any():
            return points, moved.parting, moved.margins
        return points + moved.parting, None, moved.margins

    def mesh(
        self,
        rows: int = 28,
        columns: int = 41,
        *,
        join: Join = "smooth",
        extent: Literal["face", "loop"] = "face",
        openings: Openings = "cut",
    ) -> FaceMesh:
        """The surface sampled on a uv mesh, with the analytic normals.

        Args:
            rows, columns: samples along u and v.
            join: ``"smooth"`` (C2) or ``"patchwise"`` (the paper's).
            extent: ``"face"`` for 0 <= v <= pi, ``"loop"`` for the closed curves.
            openings: ``"cut"`` for a face whose eyes and mouth are open, where it has lids and
                lips and the mesh is fine enough; ``"none"`` for the paper's, closed everywhere.
        """
        grid = self.uv_mesh(rows, columns, join=join, extent=extent, openings=openings)
        points, parting, margins = self._layers(join)
        if parting is not None:
            points = np.concatenate([points, parting])
        shape = self.curves.shape
        evaluator = sampler(shape, grid, self.a, self.modes, join, parting is not None)
        vertices, normals = evaluator.positions_and_normals(points, margins)
        return FaceMesh(
            vertices=vertices,
            normals=normals,
            texcoords=grid.texcoords,
            quads=grid.quads,
            fans=grid.fans,
            triangles=grid.triangles,
            grid=(rows, columns),
        )

    def uv_mesh(
        self,
        rows: int = 28,
        columns: int = 41,
        *,
        join: Join = "smooth",
        extent: Literal["face", "loop"] = "face",
        openings: Openings = "cut",
    ) -> UVMesh:
        """The uv mesh on which :meth:`mesh` samples the face; arguments as there."""
        if openings not in ("cut", "none"):
            raise InputError(f"openings are 'cut' or 'none', got {openings!r}")
        cut = openings == "cut" and join == "smooth" and extent == "face" and self.has_lids
        return UVMesh(rows, columns, extent, template.openings() if cut else ())

    @property
    def has_lids(self) -> bool:
        """Whether curves lie on lids and lips, so that expressions can move them."""
        return has_lids(self.curves.shape[0])

    def with_curves(self, curves: BoundaryCurves) -> Face:
        """The same face through other curves."""
        return self._changed(curves=curves)

    def with_texture(self, image: Any) -> Face:
        """The same face with another texture.

        Args:
            image: (H, W, 3 or 4) uint8; or the bytes of a PNG or JPEG file, which are then kept
                and written as they are (turned by no EXIF); or None for no texture.

        Raises:
            InputError: not such an image; FileFormatError if its bytes are damaged.
        """
        if isinstance(image, bytes):
            changed = replace(self, texture=images.decode(image))
            object.__setattr__(changed, "_encoded", image)
            return changed
        return replace(self, texture=image)

    def with_name(self, name: str) -> Face:
        """The same face under another name."""
        return self._changed(name=name)

    def with_notes(self, notes: Mapping[str, str]) -> Face:
        """The same face with these notes added to its own."""
        return self._changed(notes={**self.notes, **notes})

    def texture_file(self, *, compact: bool = False) -> bytes | None:
        """The texture as the bytes of a picture file, or None.

        A PNG, or the JPEG file that it came from. ``compact``, which viewers like, makes a
        JPEG of other textures as well where that is smaller.
        """
        if self.texture is None:
            return None
        kept = self._encoded
        if kept is not None and (not compact or images.media_type(kept) == "image/jpeg"):
            return kept
        return (images.encode_compact if compact else images.encode_png)(self.texture)

    def save(self, path: PathLike, *, compact: float | None = None) -> None:
        """Write a ``.pdeface`` file (docs/file-format.md), all of it or nothing.

        Args:
            path: ends in ``.pdeface``.
            compact: None for a file that holds the face without loss; or the root mean square
                error of the curves' points that is allowed, metres, for one of a few hundred
                bytes (:meth:`compact`).

        Raises:
            InputError: another suffix, a place that cannot be written, or curves that no compact
                file can hold.
        """
        if Path(path).suffix.lower() != SUFFIX:
            raise InputError(
                f"a face is saved as {SUFFIX}, got {Path(path).name!r}; "
                "use pdeface.export for other formats"
            )
        atomic_write(path, pack(self._record()) if compact is None else self.compact(compact).data)

    def widget(self, *, mesh: tuple[int, int] = (55, 81), height: int = 480) -> FaceWidget:
        """The face in a Jupyter notebook, with sliders; as :func:`pdeface.widget`."""
        # The one way up, where people look for it: by name, so that this room imports none above.
        shown: FaceWidget = import_module("pdeface.studio.notebook").widget(
            self, mesh=mesh, height=height
        )
        return shown

    def compact(self, error: float) -> Compact:
        """The face in few bytes: its curves, predicted from the neutral face, to within an error.

        Args:
            error: root mean square distance of the curves' points that is allowed, metres.

        Raises:
            InputError: curves that are not closed by reflection, or an error that is no length.

        Example:
            >>> random(3).compact(1e-4).shape_bytes < 200
            True
        """
        return pack_compact(self._record(), error)

    def _record(self) -> FaceRecord:
        return FaceRecord(
            self.curves,
            self.a,
            self.modes,
            self.name,
            self.notes,
            self.texture_file(),
            self.weights,
        )

    def _changed(self, **changes: Any) -> Face:
        changed = replace(self, **changes)
        object.__setattr__(changed, "_encoded", self._encoded)
        return changed

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Face):
            return NotImplemented
        if (self.texture is None) != (other.texture is None):
            return False
        mine, theirs = (
            (f.curves, f.a, f.modes, f.name, dict(f.notes), dict(f.weights)) for f in (self, other)
        )
        if mine != theirs or self.texture is None or other.texture is None:
            return mine == theirs
        return np.array_equal(self.texture, other.texture)

    def __reduce__(self) -> tuple[Any, ...]:
        # Through the constructor: a pickled array comes back writable, and views do not pickle.
        curves = (self.curves.points, self.curves.mirror_z)
        texts = self.name, dict(self.notes), dict(self.weights)
        return _restored, (curves, self.texture, self.a, self.modes, *texts, self._encoded)

    def __repr__(self) -> str:
        texture = "no texture"
        if self.texture is not None:
            texture = f"texture {self.texture.shape[1]} x {self.texture.shape[0]}"
        name = f"{self.name!r}, " if self.name else ""
        return f"Face({name}{self.curves!r}, {texture})"


def neutral(level: str = "28x46") -> Face:
    """The neutral face, measured on a scanned head (see NOTICE).

    Args:
        level: ``"28x46"`` (the paper's, also called ``"paper"``), ``"55x92"`` or ``"109x184"``:
            boundary curves x points on each. The first is the default, because it already looks
            like the head that it was measured on, lids and lips included; the others add the rims
            of the nostrils and finer lids.

    Raises:
        InputError: no such level.
    """
    notes = {"source": "measured on the neutral head of ICT-FaceKit; see NOTICE"}
    return Face(neutral_curves(level), name="neutral", notes=notes)


def random(seed: int | None = None, level: str = "28x46") -> Face:
    """A random person, drawn from how the heads of ICT-FaceKit differ.

    Args:
        seed: the same seed gives the same person; None one who was never seen.
        level: as for :func:`neutral`.
    """
    name = "random" if seed is None else f"random {seed}"
    return neutral(level).with_name(name).with_weights(random_weights(seed))


def load(path: PathLike) -> Face:
    """The face in a ``.pdeface`` file.

    Raises:
        InputError: no file there, or one that cannot be read.
        FileFormatError: the file is damaged, newer than this library, or something else.
        MissingExtraError: it has a texture and Pillow is not installed.
    """
    data = _read(path)
    try:
        record = (unpack_compact if data.startswith(MAGIC) else unpack)(data)
        texts = record.name, record.notes, record.weights
        face = Face(record.curves, None, record.a, record.modes, *texts)
        return face if record.texture is None else face.with_texture(record.texture)
    except InputError as error:
        raise FileFormatError(f"{path}: {error}") from error


def _read(path: PathLike) -> bytes:
    try:
        size = os.stat(path).st_size
        data = Path(path).read_bytes() if size <= _LARGEST_FILE else b""
    except FileNotFoundError as error:
        raise InputError(f"expected a {SUFFIX} file, found none at {path}; check it") from error
    except IsADirectoryError as error:
        raise InputError(f"expected a {SUFFIX} file, got the folder {path}; name one") from error
    except (OSError, ValueError) as error:
        raise InputError(f"cannot read {path!r}: {error}; check its name and rights") from error
    if size > _LARGEST_FILE:
        raise FileFormatError(
            f"expected a {SUFFIX} file of at most {_LARGEST_FILE >> 20} MiB, "
            f"{path} has {size >> 20} MiB; choose another"
        )
    return data


def _check_texts(texts: list[str]) -> None:
    for text in texts:
        if not isinstance(text, str):
            raise InputError(
                f"the name and the notes of a face are texts, got {type(text).__name__}; "
                "convert it to str"
            )
        if any("\ud800" <= c <= "\udfff" for c in text):
            raise InputError(f"{text!r} holds half a character; decode it as UTF-8")


def _frozen(pixels: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """The pixels read-only; copied unless nobody else can write them."""
    if not pixels.flags.writeable and pixels.base is None:
        return pixels
    pixels = np.array(pixels, order="C")
    pixels.setflags(write=False)
    return pixels


def _restored(
    curves: tuple[Any, float],
    texture: NDArray[np.uint8] | None,
    a: float,
    modes: int,
    name: str,
    notes: Mapping[str, str],
    weights: Mapping[str, float],
    encoded: bytes | None,
) -> Face:
    face = Face(BoundaryCurves(*curves), texture, a, modes, name, notes, weights)
    object.__setattr__(face, "_encoded", encoded)
    return face
