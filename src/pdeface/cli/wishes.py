"""What ``pdeface make`` is asked for, apart from which photos and which files: one value."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from pdeface.cli.moves import with_weights
from pdeface.cli.options import Join

if TYPE_CHECKING:
    from pdeface import Face
    from pdeface.photo import PhotoView

__all__ = ["Wishes"]


@dataclass(frozen=True)
class Wishes:
    """The options of one ``pdeface make``; it crosses to other processes.

    Attributes:
        points: file of feature points, for the paper's warp.
        face_number: which face of a photo with several.
        model: MediaPipe's model, or None for the default one.
        neutral_shape: whether to keep the neutral face's shape.
        texture: how the texture is made, or None for the usual way.
        delight: whether to divide the light out of it.
        level: of the neutral face, or None.
        random: seed of a random person, or None.
        weights, clamp: values of controls.
        mesh, join, openings, visemes, expressions: of exported files.
    """

    points: Path | None
    face_number: int
    model: Path | None
    neutral_shape: bool
    texture: Literal["project", "warp"] | None
    delight: bool
    level: str | None
    random: int | None
    weights: Mapping[str, float]
    clamp: bool
    mesh: tuple[int, int]
    join: Join
    openings: Literal["cut", "none"]
    visemes: bool
    expressions: str | None

    def start(self) -> Face:
        """The face before any photo: neutral or random, with the controls that were set."""
        import pdeface

        levels = {"level": self.level} if self.level else {}
        if self.random is None:
            face = pdeface.neutral(**levels).with_name("portrait")
        else:
            face = pdeface.random(self.random, **levels)
        return with_weights(face, self.weights, self.clamp)

    def shaped(self, start: Face, views: tuple[PhotoView, ...]) -> Face:
        """The face with the shape of the person in the photos, unless another is asked for."""
        if self.random is not None or self.neutral_shape:
            return start
        return views[0].shape.worn_by(start)
