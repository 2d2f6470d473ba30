"""Pictures of heads from random sides, in random light, by random lenses."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pdeface.photo.build.heads import Head, mesh_normals
from pdeface.photo.build.skins import Skin
from pdeface.photo.build.wardrobe import Cover
from pdeface.pictures.camera import Camera
from pdeface.pictures.light import RIGS, Lamp, Rig, decode_srgb, light_up
from pdeface.pictures.raster_vtk import Canvas
from pdeface.pictures.solid import Solid

__all__ = ["Scene", "photograph", "random_scene"]

FloatArray = NDArray[np.float64]

_TALL = 36.0  # millimetres of the upright frame of 24 x 36 that focal lengths refer to
_MIDDLE = np.array([0.0, 0.0, 0.06])
"""About which heads turn: between the eyes and the mouth, metres."""

_HEIGHT = 0.25  # of a head, metres


@dataclass(frozen=True)
class Scene:
    """How a head is photographed.

    Attributes:
        yaw, pitch, roll: how far the head is turned to its left, up, and tilted, degrees.
        focal: focal length, of 24 x 36 millimetres.
        filling: share of the picture's height that a head takes.
        shift: (2,) where it is beside the middle, shares of the picture.
        rig: its light.
        ground: (3,) colour of the background, sRGB from 0 to 1.
        size: (width, height), pixels.
    """

    yaw: float = 0.0
    pitch: float = 0.0
    roll: float = 0.0
    focal: float = 50.0
    filling: float = 0.6
    shift: tuple[float, float] = (0.0, 0.0)
    rig: Rig = RIGS["soft"]
    ground: tuple[float, float, float] = (0.5, 0.5, 0.5)
    size: tuple[int, int] = (384, 480)

    @property
    def camera(self) -> Camera:
        """In the head's axes."""
        distance = _HEIGHT * self.focal / (self.filling * _TALL)
        yaw, pitch, roll = np.radians([-self.yaw, -self.pitch, self.roll])
        backward = np.array(
            [np.sin(yaw) * np.cos(pitch), np.sin(pitch), np.cos(yaw) * np.cos(pitch)]
        )
        right = np.array([np.cos(yaw), 0.0, -np.sin(yaw)])
        up = np.cross(backward, right)
        right, up = (
            np.cos(roll) * right + np.sin(roll) * up,
            np.cos(roll) * up - np.sin(roll) * right,
        )
        across, upwards = np.array(self.shift) * _HEIGHT / self.filling
        target = _MIDDLE + across * right + upwards * up
        fov = 2.0 * np.degrees(np.arctan(0.5 * _TALL / self.focal))
        return Camera(target + distance * backward, target, right, up, float(fov))


def random_scene(rng: np.random.Generator) -> Scene:
    """Anywhere in front of a head, mostly level."""
    lamps = tuple(
        Lamp(tuple(rng.normal((0.0, 0.4, 0.8), (0.6, 0.3, 0.2)).tolist()),
             tuple((rng.uniform(0.1, 0.7) * rng.uniform(0.85, 1.0, 3)).tolist()),
             float(rng.uniform(0.0, 0.5)))
        for _ in range(2)
    )  # fmt: skip
    sky = rng.uniform(0.2, 0.6)
    own = Rig(lamps, (sky,) * 3, (float(sky * rng.uniform(0.4, 1.0)),) * 3, rng.uniform(0.0, 0.08))
    rigs = [*RIGS.values(), own, own, own, own]
    return Scene(
        yaw=float(rng.uniform(-45.0, 45.0)),
        pitch=float(np.clip(rng.normal(0.0, 8.0), -20.0, 20.0)),
        roll=float(rng.normal(0.0, 5.0)),
        focal=float(np.exp(rng.uniform(np.log(28.0), np.log(100.0)))),
        filling=float(rng.uniform(0.4, 0.75)),
        shift=tuple(rng.uniform(-0.08, 0.08, 2).tolist()),
        rig=rigs[rng.integers(len(rigs))],
        ground=tuple(rng.uniform(0.05, 0.95, 3).tolist()),
    )


def photograph(
    head: Head,
    skin: Skin,
    scene: Scene,
    canvas: Canvas,
    covers: Sequence[Cover] = (),
    ground: FloatArray | None = None,
) -> NDArray[np.uint8]:
    """(H, W, 3) the picture.

    Args:
        head: painted with the skin.
        skin: of its face.
        scene: how it is photographed.
        canvas: draws.
        covers: what is worn.
        ground: (H, W, 3) sRGB from 0 to 1 of what is behind, instead of the scene's.
    """
    camera = scene.camera
    solids = head.solids(skin, camera, scene.rig)
    for vertices, triangles, color in covers:
        lit = light_up(vertices, mesh_normals(vertices, triangles), decode_srgb(color), camera,
                       scene.rig)  # fmt: skip
        solids.append(Solid(vertices, triangles, lit))
    pixels = canvas.draw(solids, camera, scene.size).astype(float)
    behind = np.array(scene.ground) if ground is None else ground
    picture = pixels[..., :3] + (255.0 - pixels[..., 3:]) * behind
    return np.asarray(np.clip(np.rint(picture), 0, 255), dtype=np.uint8)
