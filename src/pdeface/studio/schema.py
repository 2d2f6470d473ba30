"""What server and page tell each other, as types: the page's TypeScript is written from these."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache

from pdeface.controls import CONTROLS, Control
from pdeface.controls.naming import PAIRED
from pdeface.controls.presets import VRM_PRESETS
from pdeface.motion import CLIPS

__all__ = [
    "DENSITIES",
    "ArrayInfo",
    "CameraInfo",
    "ClipInfo",
    "ControlInfo",
    "Density",
    "ExportRequest",
    "FaceInfo",
    "GroupInfo",
    "JobInfo",
    "Opened",
    "PhotoInfo",
    "PhotoPoint",
    "PhotosInfo",
    "Preset",
    "ScanInfo",
    "Schema",
    "schema",
]


@dataclass(frozen=True)
class ControlInfo:
    """A control as the page shows it; ``mirror`` is its namesake on the other side."""

    name: str
    label: str
    group: str
    kind: str
    low: float
    high: float
    description: str
    mirror: str | None


@dataclass(frozen=True)
class GroupInfo:
    """Controls that are shown together."""

    name: str
    label: str
    kind: str


@dataclass(frozen=True)
class Preset:
    """Expressions by one name."""

    name: str
    label: str
    weights: Mapping[str, float]


@dataclass(frozen=True)
class Density:
    """A uv mesh to choose."""

    label: str
    rows: int
    columns: int


@dataclass(frozen=True)
class Schema:
    """All that the page has to know beforehand."""

    version: str
    controls: list[ControlInfo]
    groups: list[GroupInfo]
    presets: list[Preset]
    densities: list[Density]
    clips: list[str]
    formats: list[str]


@dataclass(frozen=True)
class FaceInfo:
    """A face that the server knows: its curves and texture by ``id``, and what it was set to.

    ``texture`` differs with the texture, and is empty without one.
    """

    id: str
    name: str
    weights: Mapping[str, float]
    texture: str
    curves: int
    points: int


@dataclass(frozen=True)
class ArrayInfo:
    """An array in a packet: float32 or int32, little-endian, ``offset`` bytes behind the header."""

    name: str
    type: str
    shape: list[int]
    offset: int


@dataclass(frozen=True)
class ExportRequest:
    """What the export dialogue asks for."""

    weights: Mapping[str, float]
    name: str
    format: str
    rows: int
    columns: int
    join: str
    expressions: bool
    visemes: bool


@dataclass(frozen=True)
class ClipInfo:
    """A motion: weights by frame, and the head's yaw, pitch and roll, radians."""

    name: str
    times: list[float]
    names: list[str]
    weights: list[list[float]]
    head: list[list[float]]
    notes: list[str]


@dataclass(frozen=True)
class PhotoPoint:
    """A feature point of the paper's Fig. 5, pixels from the photo's top-left corner."""

    name: str
    x: float
    y: float


@dataclass(frozen=True)
class CameraInfo:
    """The camera of a photo, as :class:`pdeface.photo.camera.PhotoCamera` has it.

    ``rotation`` has the rows of R one after the other.
    """

    rotation: list[float]
    scale: float
    centre: list[float]
    distance: float


@dataclass(frozen=True)
class PhotoInfo:
    """A photo that the server knows by ``id``: the points in it and the 7 x 7 mesh of Fig. 6.

    ``camera`` took it, and ``expression`` is what the face does in it.
    """

    id: str
    width: int
    height: int
    points: list[PhotoPoint]
    mesh: list[list[float]]
    camera: CameraInfo
    expression: Mapping[str, float]
    notes: list[str]


@dataclass(frozen=True)
class PhotosInfo:
    """Photos of one person, the one seen from the front first."""

    photos: list[PhotoInfo]


@dataclass(frozen=True)
class ScanInfo:
    """A scan that a face was fitted to, in the frame of the face.

    ``rms``, ``median`` and ``largest`` are millimetres from the face's front to the scan,
    ``coverage`` is the share of the front that the scan has.
    """

    id: str
    vertices: int
    rms: float
    median: float
    largest: float
    coverage: float


@dataclass(frozen=True)
class JobInfo:
    """How far a job has come: ``state`` is ``"running"``, ``"done"`` or ``"failed"``.

    ``share`` of its time is over, about.
    """

    id: str
    state: str
    message: str
    share: float
    face: FaceInfo | None
    photos: list[PhotoInfo]
    scan: ScanInfo | None


@dataclass(frozen=True)
class Opened:
    """What a file turned out to be: one of these."""

    face: FaceInfo | None
    clip: ClipInfo | None
    job: JobInfo | None


DENSITIES = (
    Density("Paper, 28 x 41", 28, 41),
    Density("Medium, 55 x 81", 55, 81),
    Density("Fine, 109 x 161", 109, 161),
    Density("Finest, 163 x 241", 163, 241),
)
"""Uv meshes of the page; the last has near 40,000 vertices."""

_KINDS = {"shape": "Conformation", "identity": "Identity", "expression": "Expression"}
_SAME_SIDE = {"jawLeft", "jawRight", "mouthLeft", "mouthRight"}


@lru_cache(maxsize=1)
def schema() -> Schema:
    """The schema of this version."""
    from pdeface import __version__
    from pdeface.formats import SUFFIXES

    groups = {(c.kind, c.group): None for c in CONTROLS.values()}
    return Schema(
        version=__version__,
        controls=[_info(control) for control in CONTROLS.values()],
        groups=[GroupInfo(group, _label(group), kind) for kind, group in groups],
        presets=[Preset(n, _label(n), dict(w)) for n, w in VRM_PRESETS.items() if w],
        densities=list(DENSITIES),
        clips=list(CLIPS),
        formats=[suffix for suffix in SUFFIXES if suffix != ".gltf"],
    )


def _info(control: Control) -> ControlInfo:
    return ControlInfo(
        control.name,
        _label(control.name),
        control.group,
        control.kind,
        control.low,
        control.high,
        control.description,
        _mirror(control.name),
    )


def _mirror(name: str) -> str | None:
    """The same control of the other side; a jaw to the left is no side of a pair."""
    for side, other in (("Left", "Right"), ("Right", "Left")):
        stem = name.removesuffix(side)
        if stem != name and (stem in PAIRED or f"{stem}{other}" in CONTROLS):
            return None if name in _SAME_SIDE else f"{stem}{other}"
    return None


def _label(name: str) -> str:
    """``eyeBlinkLeft`` as "Eye blink left"."""
    words = re.sub(r"([A-Z]+|\d+)", r" \1", name).strip().lower()
    return words[:1].upper() + words[1:]
