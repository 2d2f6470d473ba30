"""MediaPipe's face landmarker: photo in, faces out."""

from __future__ import annotations

import os
import sys
import threading
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pdeface.errors import InputError
from pdeface.files import PathLike
from pdeface.photo import _views
from pdeface.photo.engine import mediapipe
from pdeface.photo.found import PhotoFace
from pdeface.photo.mirrors import evened, unmirrored
from pdeface.photo.model import model_file
from pdeface.photo.network import Network
from pdeface.photo.traits import find_traits

__all__ = ["faces_both_ways", "faces_in", "find_faces", "glances", "landmarker"]

FloatArray = NDArray[np.float64]
Pixels = NDArray[np.uint8]

_MOST_FACES = 20
_stderr_lock = threading.Lock()


def find_faces(photo: Any, model: PathLike | None = None) -> list[PhotoFace]:
    """The faces in a photo, the largest first; an empty list where there is none.

    The whole photo and its halves are looked at first. Where that shows nothing, so are the photo
    with a margin (for a face that fills it) and then its quarters (for a small face). What is found
    is looked at again from near by, and in the mirror as well, and each has its traits.

    Args:
        photo: (H, W, 3 or 4) uint8, upright, as :func:`pdeface.texture.read_photo` returns it.
        model: the model's file; None for the one that :func:`pdeface.photo.model_file` finds.

    Raises:
        InputError: not such an array, or the model cannot be had or read.
        MissingExtraError: MediaPipe is not installed.
    """
    pixels = _checked(photo)
    with _quiet():
        mediapipe("to find faces in photos")
    path = model_file(model)
    with _quiet(), landmarker(path) as detect:
        for views in _views.tries(pixels):
            faces = faces_in(views, detect, pixels.shape)
            # Many looks find many things. A face is one also when it is looked at alone.
            closer = [_views.around(face, pixels) for face in _views.distinct(faces)]
            if faces := _views.distinct(faces_both_ways(closer, detect, pixels.shape)):
                return _with_traits(faces, pixels, path)
    return []


def _with_traits(faces: Iterable[PhotoFace], photo: Pixels, model: Path) -> list[PhotoFace]:
    network = Network(model)
    return [replace(f, traits=find_traits(network, photo, f.landmarks)) for f in faces]


@contextmanager
def glances(model: PathLike | None = None) -> Iterator[Callable[[Any], list[PhotoFace]]]:
    """A function that looks once at each picture it is given, for as long as the block runs.

    What :func:`find_faces` does by many looks at one photo, this leaves to who knows where the face
    is, or has many pictures.

    Args:
        model: as for :func:`find_faces`.

    Yields:
        A function from (H, W, 3) uint8 pixels to the faces in them, the largest first.

    Raises:
        InputError, MissingExtraError: as for :func:`find_faces`.
    """
    with _quiet():
        mediapipe("to find faces in pictures")
    path = model_file(model)
    with _quiet(), landmarker(path) as detect:

        def look(pixels: Any) -> list[PhotoFace]:
            view = _views.View(_checked(pixels), (0.0, 0.0), (pixels.shape[1], pixels.shape[0]))
            return _views.distinct(faces_in([view], detect, pixels.shape))

        yield look


def _checked(photo: Any) -> Pixels:
    pixels = np.asarray(photo)
    if pixels.dtype != np.uint8 or pixels.ndim != 3 or pixels.shape[2] not in (3, 4):
        raise InputError(
            "a photo must be an array of uint8 with the shape (height, width, 3 or 4), "
            f"got {pixels.dtype} {pixels.shape}; read it with pdeface.texture.read_photo"
        )
    if pixels.size == 0:
        raise InputError(f"a photo must have pixels, got the shape {pixels.shape}; use another")
    return pixels


@contextmanager
def landmarker(model: Path) -> Iterator[Any]:
    """A function from (h, w, 3) pixels to MediaPipe's result."""
    engine = mediapipe("to find faces in photos")
    from mediapipe.tasks.python import BaseOptions, vision

    try:
        options = vision.FaceLandmarkerOptions(
            base_options=BaseOptions(model_asset_buffer=model.read_bytes()),
            num_faces=_MOST_FACES,
            output_face_blendshapes=True,
            output_facial_transformation_matrixes=True,
        )
        landmarker = vision.FaceLandmarker.create_from_options(options)
    except Exception as error:  # MediaPipe raises nearly anything on a file that is no model
        raise InputError(
            f"expected MediaPipe's face_landmarker.task, got {model}, which it cannot read; "
            "download the model again"
        ) from error

    def detect(pixels: Pixels) -> Any:
        data = np.ascontiguousarray(pixels)
        image = engine.Image(image_format=engine.ImageFormat.SRGB, data=data)
        return landmarker.detect(image)

    try:
        yield detect
    finally:
        landmarker.close()  # its destructor fails when the interpreter ends


def faces_in(views: Iterable[_views.View], detect: Any, shape: tuple[int, ...]) -> list[PhotoFace]:
    """What is found in each view, in the coordinates of a photo of (height, width, ...)."""
    faces = []
    for view in views:
        found = detect(view.pixels)
        for marks, scores, pose in zip(
            found.face_landmarks,
            found.face_blendshapes,
            found.facial_transformation_matrixes,
            strict=True,
        ):
            # Fractions of the view's width and height, depth of its width.
            fractions = np.array([(mark.x, mark.y, mark.z) for mark in marks])
            names = {score.category_name: float(score.score) for score in scores}
            names.pop("_neutral", None)
            places = view.to_photo(fractions)
            matrix = np.asarray(pose, dtype=np.float64)
            faces.append(PhotoFace(places, names, matrix, (shape[1], shape[0])))
    return faces


def faces_both_ways(
    views: Iterable[_views.View], detect: Any, shape: tuple[int, ...]
) -> list[PhotoFace]:
    """As :func:`faces_in`, each view being looked at in the mirror as well."""
    faces: list[PhotoFace] = []
    for view in views:
        mirrored = faces_in([view.mirrored], detect, shape)
        faces += evened(
            faces_in([view], detect, shape), [unmirrored(face, view.middle) for face in mirrored]
        )
    return faces


@contextmanager
def _quiet() -> Iterator[None]:
    """Keep what MediaPipe's libraries log off the terminal; they write to descriptor 2."""
    with _stderr_lock:
        if sys.stderr is not None:
            sys.stderr.flush()
        kept, nowhere = os.dup(2), os.open(os.devnull, os.O_WRONLY)
        try:
            os.dup2(nowhere, 2)
            yield
        finally:
            os.dup2(kept, 2)
            os.close(kept)
            os.close(nowhere)
