"""Style ``textured``: the face wearing its texture."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pdeface.face import Face
from pdeface.pictures.camera import Camera
from pdeface.pictures.inside import inside
from pdeface.pictures.light import encode_srgb, rig_named
from pdeface.pictures.options import Options
from pdeface.pictures.skin import skin
from pdeface.pictures.solid import Solid
from pdeface.pictures.styles.shaded import CLAY

__all__ = ["textured"]


def textured(face: Face, camera: Camera, options: Options) -> list[Solid]:
    """The texture under nearly even light: a photo brings its own."""
    rig = rig_named(options.light or "soft")
    face_itself = skin(options.sample(face), (1.0, 1.0, 1.0), camera, rig, _opaque(face.texture))
    return [*face_itself, *(inside(face, camera, rig, head=options.head) if options.is_cut else [])]


def _opaque(texture: NDArray[np.uint8] | None) -> NDArray[np.uint8] | None:
    """(H, W, 3) texels, with clay where the texture is transparent."""
    if texture is None or texture.shape[2] == 3:
        return texture
    clay = 255.0 * encode_srgb(np.array(CLAY))
    alpha = texture[..., 3:] / 255.0
    return np.round(alpha * texture[..., :3] + (1.0 - alpha) * clay).astype(np.uint8)
