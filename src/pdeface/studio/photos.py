"""Photos on the desk: found faces, points to mend by hand, textures made from them."""

from __future__ import annotations

import secrets
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from pdeface.errors import InputError
from pdeface.face import Face
from pdeface.images import encode_compact
from pdeface.studio.apart import apart
from pdeface.studio.jobs import Result, Tell
from pdeface.studio.photo_reading import lens_of, pixels_of
from pdeface.studio.schema import CameraInfo, PhotoInfo, PhotoPoint
from pdeface.studio.store import FaceStore, Kept
from pdeface.texture import FeaturePoints, photo_mesh, portrait, uv_texture

if TYPE_CHECKING:
    from pdeface.photo import PhotoFace, PhotoView

__all__ = ["MOST_PHOTOS", "PhotoDesk"]

Pixels = NDArray[np.uint8]
Views = tuple["PhotoView", ...]

MOST_PHOTOS = 8
"""Of one person."""

_KEPT, _PEOPLE = 10, 3


@dataclass(frozen=True, eq=False)
class Photo:
    """A photo, the focal length that it states, and the face that was found in it."""

    pixels: Pixels
    focal: float | None
    found: PhotoFace | None = None


class PhotoDesk:
    """The photos that were opened last, and the people in them.

    Args:
        store: where faces go that are made of them.
        model: MediaPipe's model file, or None for the usual one.
        first: photos that the studio was started with, as they were fitted; none for the bundled
            portrait.
    """

    def __init__(self, store: FaceStore, model: str | None = None, first: Views = ()) -> None:
        self._store, self.model, self._first = store, model, first
        self._photos: Kept[Photo] = Kept(_KEPT, "photo")
        self._people: Kept[Views] = Kept(_PEOPLE, "person")
        self._textures: Kept[Pixels] = Kept(_PEOPLE, "texture")

    def add(self, data: bytes) -> str:
        """Keep a photo, and say its id.

        Args:
            data: bytes of a JPEG or PNG.

        Raises:
            InputError: no picture, or too large a one.
        """
        key = secrets.token_hex(8)
        self._photos.put(key, Photo(pixels_of(data), lens_of(data)))
        return key

    def opened(self, data: bytes, tell: Tell) -> Result:
        """A photo's face: found, fitted, textured; as :meth:`person` of one photo."""
        return self.person([self.add(data)], tell)

    def person(self, keys: Sequence[str], tell: Tell) -> Result:
        """The face of the person in some photos, and the photos as they were fitted.

        Args:
            keys: ids of photos.
            tell: told what is being done.

        Raises:
            InputError: no face in one of them, or too many photos.
            MissingExtraError: MediaPipe is not installed.
        """
        if not 1 <= len(keys) <= MOST_PHOTOS:
            raise InputError(
                f"a person has 1 to {MOST_PHOTOS} photos here, got {len(keys)}; leave some out"
            )
        photos = [self._photos.get(key) for key in keys]
        views, order, texture = apart(_fitted, photos, self.model, tell=tell)
        # The photos themselves are here already.
        views = tuple(
            view._replace(photo=photos[n].pixels) for view, n in zip(views, order, strict=True)
        )
        infos = self._kept(views, [keys[n] for n in order])
        self._textures.put(_name(keys), texture)
        face = views[0].shape.face.with_name("photo").with_texture(texture)
        return Result(self._store.put(face), infos)

    def first(self) -> list[PhotoInfo]:
        """The photos that the studio was started with; else the bundled portrait."""
        from pdeface.photo import photo_views, portrait_face

        if not self._first:
            self._first = photo_views([portrait()[0]], [portrait_face()])
        return self._kept(self._first, [secrets.token_hex(8) for _ in self._first])

    def picture(self, key: str) -> bytes:
        """The photo as the page shows it."""
        return encode_compact(np.ascontiguousarray(self._photos.get(key).pixels))

    def mesh(self, key: str, points: Any) -> list[list[float]]:
        """The 7 x 7 mesh over a photo with these points, pixels, row after row."""
        return _mesh(self._points(key, points))

    def texture(self, keys: Sequence[str], way: str, points: Any, size: int | None) -> Pixels:
        """(H, W, 3) the texture that photos give.

        Args:
            keys: ids of the photos of a person, the one that is warped first.
            way: ``"project"``, or ``"warp"`` for the paper's five steps.
            points: where the feature points of the first photo are; for the warp.
            size: texels across and down; None for what keeps the photos' detail.

        Raises:
            InputError: another way, unknown photos, or points that cannot be used.
        """
        if way == "warp":
            pixels = self._photos.get(keys[0]).pixels
            shape = (size, size) if size else None
            return uv_texture(pixels, self._points(keys[0], points), shape).image
        if way != "project":
            raise InputError(f"a texture is made by 'project' or by 'warp', got {way!r}")
        texture = self._projected(keys)
        if size is None:
            return texture
        rows, columns = (np.arange(size) * side // size for side in texture.shape[:2])
        return texture[rows[:, None], columns]

    def textured(self, face: Face, keys: Sequence[str], way: str, points: Any) -> Face:
        """The face with the texture of these photos."""
        return face.with_texture(self.texture(keys, way, points, None))

    def points_file(self, key: str, points: Any) -> bytes:
        """The points as a file that ``pdeface make --points`` reads."""
        with TemporaryDirectory(prefix="pdeface-") as folder:
            path = Path(folder) / "points.json"
            self._points(key, points).save(path)
            return path.read_bytes()

    def _kept(self, views: Views, keys: Sequence[str]) -> list[PhotoInfo]:
        """Put the photos of a person on the desk, and say what the page is told of them."""
        for key, view in zip(keys, views, strict=True):
            self._photos.put(key, Photo(view.photo, self._focal(key), view.found))
        self._people.put(_name(keys), views)
        return [_info(key, view) for key, view in zip(keys, views, strict=True)]

    def _focal(self, key: str) -> float | None:
        return self._photos.get(key).focal if key in self._photos else None

    def _projected(self, keys: Sequence[str]) -> Pixels:
        """The texture read through the fitted face, once for each person."""
        from pdeface.photo import projected_texture

        name = _name(keys)
        if name not in self._textures:
            self._textures.put(name, projected_texture(self._people.get(name)))
        return self._textures.get(name)

    def _points(self, key: str, value: Any) -> FeaturePoints:
        """The points as the page has them now.

        Raises:
            InputError: unknown names, or no numbers.
        """
        height, width = self._photos.get(key).pixels.shape[:2]
        if not isinstance(value, dict):
            raise InputError("points are (x, y) by the names that the photo has; reload the page")
        return FeaturePoints(value, (width, height))


def _fitted(
    tell: Tell, photos: Sequence[Photo], model: str | None
) -> tuple[Views, list[int], Pixels]:
    """The person in some photos: views, the number of the photo of each, and the texture."""
    from pdeface.photo import photo_views, projected_texture

    count = len(photos)
    found = [_face_in(photo, n, count, model, tell) for n, photo in enumerate(photos, 1)]
    tell("fitting the person's shape", 0.4)
    views = photo_views([p.pixels for p in photos], found, [p.focal for p in photos])
    tell("reading the texture", 0.75)
    numbers = {id(photo.pixels): n for n, photo in enumerate(photos)}
    small = tuple(view._replace(photo=view.photo[:1, :1]) for view in views)
    return small, [numbers[id(view.photo)] for view in views], projected_texture(views)


def _face_in(photo: Photo, number: int, count: int, model: str | None, tell: Tell) -> PhotoFace:
    """The face in a photo, which is looked for once."""
    from pdeface.photo import choose, find_faces, model_file

    if photo.found is not None:
        return photo.found
    name = "the photo" if count == 1 else f"photo {number} of {count}"
    tell(f"looking for a face in {name}", 0.4 * (number - 0.5) / count)
    return choose(find_faces(photo.pixels, model_file(model)), 1, name)


def _name(keys: Sequence[str]) -> str:
    """Of a person, by the photos in whatever order."""
    return " ".join(sorted(keys))


def _mesh(points: FeaturePoints) -> list[list[float]]:
    rounded: list[list[float]] = photo_mesh(points).reshape(-1, 2).round(2).tolist()
    return rounded


def _info(key: str, view: PhotoView) -> PhotoInfo:
    from pdeface.photo import doubts, feature_points

    notes = doubts(view.found, view.photo)
    places, mesh = {}, []
    try:
        points = feature_points(view.found)
        places, mesh = dict(points.positions), _mesh(points)
    except InputError as error:  # turned too far for the paper's way, not for the other
        notes = [*notes, str(error)]
    camera = view.shape.camera
    return PhotoInfo(
        key,
        view.photo.shape[1],
        view.photo.shape[0],
        [PhotoPoint(name, float(x), float(y)) for name, (x, y) in places.items()],
        mesh,
        CameraInfo(
            camera.rotation.ravel().round(7).tolist(),
            camera.scale,
            camera.centre.tolist(),
            camera.distance,
        ),
        {name: round(weight, 4) for name, weight in view.shape.expression.items() if weight > 5e-4},
        notes,
    )
