"""Photos on the desk: found faces, points to mend by hand, textures made from them."""

from __future__ import annotations

import io
import secrets
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from numpy.typing import NDArray
from starlette.concurrency import run_in_threadpool
from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import BaseRoute, Route

from pdeface.errors import InputError, require
from pdeface.face import Face
from pdeface.images import encode_compact
from pdeface.studio.jobs import Jobs, Result, Tell
from pdeface.studio.requests import answered, as_json, json_body
from pdeface.studio.schema import PhotoInfo, PhotoPoint
from pdeface.studio.store import FaceStore, Kept
from pdeface.texture import FeaturePoints, uv_texture

__all__ = ["PhotoDesk", "photo_routes"]

Pixels = NDArray[np.uint8]

MOST_PIXELS = 50_000_000
_LIVE = 256
_KEPT = 4


@dataclass(frozen=True, eq=False)
class Photo:
    """A photo, and where its feature points are."""

    pixels: Pixels
    info: PhotoInfo


class PhotoDesk:
    """The photos that were opened last.

    Args:
        store: where faces go that are made of them.
        model: MediaPipe's model file, or None for the usual one.
    """

    def __init__(self, store: FaceStore, model: str | None = None) -> None:
        self._store, self.model = store, model
        self._photos: Kept[Photo] = Kept(_KEPT, "photo")

    def opened(self, data: bytes, tell: Tell) -> Result:
        """A photo's face: found, fitted, textured.

        Args:
            data: bytes of a JPEG or PNG.
            tell: told what is being done.

        Raises:
            InputError: no picture, too large a one, or no face in it.
            MissingExtraError: MediaPipe is not installed.
        """
        from pdeface.photo import (
            choose,
            doubts,
            feature_points,
            find_faces,
            model_file,
            photo_views,
            textured,
        )

        pixels = _pixels(data)
        tell("looking for a face")
        found = choose(find_faces(pixels, model_file(self.model)), 1, "the photo")
        tell("fitting the person's shape")
        views = photo_views([pixels], [found])
        face = views[0].shape.face.with_name("photo")
        tell("reading the texture")
        face = textured(face, views)
        notes = list(doubts(found, pixels))
        try:
            points = feature_points(found)
        except InputError as error:
            return self._store.put(face), self._kept(pixels, None, [*notes, str(error)])
        return self._store.put(face), self._kept(pixels, points, notes)

    def bundled(self) -> PhotoInfo:
        """The portrait that comes with the library, and its points."""
        from pdeface.texture import portrait

        pixels, points = portrait()[:2]
        return self._kept(pixels, points, [])

    def picture(self, key: str) -> bytes:
        """The photo as the page shows it."""
        return encode_compact(np.ascontiguousarray(self._photos.get(key).pixels))

    def warped(self, key: str, points: Any, size: int) -> Pixels:
        """(size, size, 3) the paper's texture, by five steps, with these points."""
        photo = self._photos.get(key)
        return uv_texture(photo.pixels, _points(photo.info, points), (size, size)).image

    def warped_face(self, face: Face, key: str, points: Any) -> Face:
        """The face with the paper's texture of this photo."""
        photo = self._photos.get(key)
        texture = uv_texture(photo.pixels, _points(photo.info, points)).image
        return face.with_texture(texture)

    def points_file(self, key: str, points: Any) -> bytes:
        """The points as a file that ``pdeface make --points`` reads."""
        with TemporaryDirectory(prefix="pdeface-") as folder:
            path = Path(folder) / "points.json"
            _points(self._photos.get(key).info, points).save(path)
            return path.read_bytes()

    def _kept(self, pixels: Pixels, points: FeaturePoints | None, notes: list[str]) -> PhotoInfo:
        places: Mapping[str, Any] = points.positions if points else {}
        info = PhotoInfo(
            secrets.token_hex(8),
            pixels.shape[1],
            pixels.shape[0],
            [PhotoPoint(name, float(x), float(y)) for name, (x, y) in places.items()],
            notes,
        )
        self._photos.put(info.id, Photo(pixels, info))
        return info


def _points(info: PhotoInfo, value: Any) -> FeaturePoints:
    """The points as the page has them now.

    Raises:
        InputError: others than the photo has, or no numbers.
    """
    names = {point.name for point in info.points}
    if not isinstance(value, dict) or set(value) != names:
        raise InputError("points are (x, y) by the names that the photo has; reload the page")
    return FeaturePoints(value, (info.width, info.height))


def _pixels(data: bytes) -> Pixels:
    """The texels of a photo, turned as its EXIF says.

    Raises:
        InputError: damaged, or too many pixels.
    """
    image_module = require("PIL.Image", "texture", "to read photos")
    turned = require("PIL.ImageOps", "texture", "to read photos").exif_transpose
    try:
        image = image_module.open(io.BytesIO(data), formats=("PNG", "JPEG"))
        if image.width * image.height > MOST_PIXELS:
            raise InputError(
                f"a photo may have {MOST_PIXELS // 10**6} megapixels here, got {image.width} x "
                f"{image.height}; make it smaller"
            )
        return np.array(turned(image).convert("RGB"), dtype=np.uint8)
    except InputError:
        raise
    except Exception as error:  # Pillow's decoders raise nearly anything on damaged files.
        raise InputError(
            f"the photo cannot be read ({error}); it is damaged, save it again"
        ) from error


class PhotoRoutes:
    """The endpoints of photos."""

    def __init__(self, desk: PhotoDesk, store: FaceStore, jobs: Jobs) -> None:
        self._desk, self._store, self._jobs = desk, store, jobs

    async def picture(self, request: Request) -> Response:
        """The photo itself."""
        data = await run_in_threadpool(self._desk.picture, request.path_params["id"])
        kind = "image/png" if data.startswith(b"\x89PNG") else "image/jpeg"
        return Response(data, media_type=kind)

    async def warp(self, request: Request) -> Response:
        """The texture that the points give, small: made anew while they are dragged."""
        value = await json_body(request)

        def made() -> bytes:
            from pdeface.images import encode_jpeg

            return encode_jpeg(
                self._desk.warped(request.path_params["id"], value.get("points"), _LIVE)
            )

        return Response(await run_in_threadpool(made), media_type="image/jpeg")

    async def apply(self, request: Request) -> Response:
        """A face with the paper's texture of these points."""
        value = await json_body(request)
        face = self._store.get(str(value.get("face")))
        key, points = request.path_params["id"], value.get("points")
        made = await run_in_threadpool(self._desk.warped_face, face, key, points)
        return as_json(replace(self._store.put(made), weights={}))

    async def points(self, request: Request) -> Response:
        """The points as a file."""
        value = await json_body(request)
        data = self._desk.points_file(request.path_params["id"], value.get("points"))
        return Response(data, media_type="application/octet-stream")

    async def bundled(self, request: Request) -> Response:
        """The bundled portrait."""
        return as_json(await run_in_threadpool(self._desk.bundled))


def photo_routes(desk: PhotoDesk, store: FaceStore, jobs: Jobs) -> list[BaseRoute]:
    """The routes of photos."""
    routes = PhotoRoutes(desk, store, jobs)
    return [
        Route("/api/photos/bundled", answered(routes.bundled)),
        Route("/api/photos/{id}", answered(routes.picture)),
        Route("/api/photos/{id}/warp", answered(routes.warp), methods=["POST"]),
        Route("/api/photos/{id}/points", answered(routes.points), methods=["POST"]),
        Route("/api/photos/{id}/apply", answered(routes.apply), methods=["POST"]),
    ]
