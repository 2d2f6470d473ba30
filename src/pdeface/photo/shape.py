"""The shape of a photo's person: camera, identity, expression and what is left of the landmarks."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from pdeface.errors import InputError
from pdeface.face import Face, neutral
from pdeface.photo.anchors import anchors
from pdeface.photo.camera import PhotoCamera
from pdeface.photo.fitting import MESH_LANDMARKS, Fit, basis, fit_view
from pdeface.photo.found import PhotoFace
from pdeface.photo.lens import DIAGONAL
from pdeface.photo.regression import expected_identity
from pdeface.photo.residual import FACING, at_level, curve_residual, facing
from pdeface.photo.unfolding import moved

__all__ = ["PhotoShape", "fit_shape", "fit_shapes"]

FloatArray = NDArray[np.float64]

_MOST = 3.0


@dataclass(frozen=True, eq=False)
class PhotoShape:
    """What the landmarks say of a face.

    Attributes:
        identity: weights of the identity modes by name, standard deviations, -3 to 3.
        expression: weights of the expressions that the photo shows, by name.
        camera: the camera that took it.
        residual: (K, M, 3) displacement of the neutral face's curves, metres, that no identity
            mode has.
        error: root mean square distance of the landmarks from where the fitted face has them,
            in eye distances, of those that face the camera: within 75 degrees.
    """

    identity: dict[str, float]
    expression: dict[str, float]
    camera: PhotoCamera
    residual: FloatArray
    error: float

    @property
    def face(self) -> Face:
        """The person at rest."""
        return self.worn_by(neutral())

    def worn_by(self, start: Face) -> Face:
        """A face at rest, of any level, with the person's identity and the residual."""
        person = moved(start, at_level(self.residual, start.curves.shape))
        return person.with_weights({**self.identity, **start.weights})


def fit_shape(face: PhotoFace, focal: float | None = None) -> PhotoShape:
    """Camera, identity and expression of one face; as :func:`fit_shapes` of one photo."""
    return fit_shapes([face], [focal])[0]


def fit_shapes(
    faces: Sequence[PhotoFace], focals: Sequence[float | None] | None = None
) -> tuple[PhotoShape, ...]:
    """One person's shape from one photo or more, and the camera and expression of each.

    The identity is what landmarks like these were found to belong to
    (:mod:`pdeface.photo.regression`), all photos together. Given that, camera and expression
    explain each photo's landmarks best; what these still differ by is a displacement of the
    curves (:mod:`pdeface.photo.residual`), which all photos share.

    Args:
        faces: one person's, in one photo each.
        focals: the photos' focal lengths, as if on a frame of 24 x 36 millimetres
            (:func:`pdeface.photo.focal_length`); None where it is not known.

    Raises:
        InputError: no face, not one focal length for each, or one that is not positive.
    """
    pixels = _pixels(faces, [None] * len(faces) if focals is None else focals)
    weights = np.clip(expected_identity(faces, pixels), -_MOST, _MOST)
    names = basis().names[: basis().identities]
    identity = dict(zip(names, weights.tolist(), strict=True))
    person = neutral().with_weights(identity)
    rest = _landmarks_at(person)
    fits = [fit_view(f, rest, p) for f, p in zip(faces, pixels, strict=True)]
    residual, fits = curve_residual(person, list(zip(faces, fits, strict=True)))
    step = _landmarks_at(moved(person, residual)) - rest
    fits = [replace(fit, points=fit.points + step) for fit in fits]
    return tuple(
        _shape(face, person, fit, identity, residual) for face, fit in zip(faces, fits, strict=True)
    )


def _shape(
    face: PhotoFace, person: Face, fit: Fit, identity: dict[str, float], residual: FloatArray
) -> PhotoShape:
    names = basis().names[basis().identities :]
    away = face.landmarks[:MESH_LANDMARKS, :2] - fit.camera.project(fit.points)
    away = away[facing(person, fit) > FACING]
    return PhotoShape(
        identity=identity,
        expression=dict(zip(names, fit.expression.tolist(), strict=True)),
        camera=fit.camera,
        residual=residual,
        error=float(np.sqrt((away**2).sum(axis=1).mean()) / face.eye_distance),
    )


def _landmarks_at(face: Face) -> FloatArray:
    """(468, 3) where the landmarks are on a face, metres."""
    return face.surface()(*anchors().uv[:MESH_LANDMARKS].T)


def _pixels(faces: Sequence[PhotoFace], focals: Sequence[float | None]) -> list[float | None]:
    """Focal lengths in pixels of the photos."""
    if not faces or len(faces) != len(focals):
        raise InputError(
            f"a shape needs faces and a focal length or None for each, got {len(faces)} faces and "
            f"{len(focals)} focal lengths; give one for each face"
        )
    for focal in focals:
        if focal is not None and not (np.isfinite(focal) and focal > 0.0):
            raise InputError(
                f"a focal length must be positive, in millimetres, got {focal}; leave it out where "
                "it is not known"
            )
    return [
        None if focal is None else focal / DIAGONAL * float(np.hypot(*face.image_size))
        for face, focal in zip(faces, focals, strict=True)
    ]
