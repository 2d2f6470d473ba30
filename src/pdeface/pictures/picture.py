"""One picture of one face."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from pdeface.face import Face, Openings
from pdeface.files import PathLike
from pdeface.pde import Join
from pdeface.pictures.camera import Camera, View, frame
from pdeface.pictures.canvas import picture_of
from pdeface.pictures.colour_bar import BAND, with_colour_bar
from pdeface.pictures.ground import STUDIO, background_image, over
from pdeface.pictures.image_file import check_suffix, write_image
from pdeface.pictures.options import PAPER_MESH, Options, check_size
from pdeface.pictures.styles import style_named
from pdeface.pictures.styles.curvature import QUANTITY, curvature_limit

__all__ = ["face_camera", "render"]

FloatArray = NDArray[np.floating[Any]]
Pixels = NDArray[np.uint8]


def render(
    face: Face,
    path: PathLike | None = None,
    view: View = "front",
    style: str | None = None,
    mesh: tuple[int, int] | None = None,
    join: Join = "smooth",
    size: tuple[int, int] = (800, 1000),
    background: Any = STUDIO,
    transparent: bool = False,
    *,
    light: str | None = None,
    loops: bool = False,
    colour_bar: bool = True,
    openings: Openings = "cut",
) -> Pixels:
    """Draw a face, off screen, and write the picture if a path is given.

    The camera has a portrait lens and stands equally far from the face in every view, so that
    pictures of one face have one scale.

    Args:
        face: the face.
        path: file to write (.png, .jpg or .webp), or None.
        view: ``"front"``, ``"three-quarter"``, ``"profile"`` (of the subject's left side; their
            mirror images end in ``-right``); an azimuth in degrees, positive where the camera
            moves towards the subject's left; or (azimuth, elevation), positive from above.
        style: ``"textured"``, ``"shaded"`` (clay), ``"uvmesh"`` (the cells of the mesh),
            ``"curves"`` (boundary curves with their data points) or ``"curvature"`` (mean
            curvature, in 1/m). None: textured if the face has a texture, otherwise shaded.
        mesh: (rows, columns) of the uv mesh; None for 28 x 41 in style ``"uvmesh"`` and for one
            too fine to see in the others.
        join: ``"smooth"`` (C2) or ``"patchwise"`` (the paper's).
        size: (width, height), pixels.
        background: ``"studio"`` (a soft gradient), a colour by name or ``"#rrggbb"``, or three
            numbers from 0 to 1.
        transparent: no background: the result has an alpha channel.
        light: ``"studio"``, ``"soft"``, or ``"raking"`` (from the sides, to judge how fair a
            surface is); None for the style's own.
        loops: style ``"curves"``: the closed curves, with the back halves.
        openings: ``"cut"``, eyes and mouth where the face has lids and lips, or ``"none"`` for the
            paper's, closed everywhere.
        colour_bar: style ``"curvature"``: say below the face what the colours mean.

    Returns:
        (H, W, 3) uint8; (H, W, 4) if transparent, alpha not premultiplied.

    Raises:
        InputError: a view, style, light, size or colour that there is not, a texture asked for
            that the face does not have, or a place that cannot be written.
        MissingExtraError: Pillow is not installed and the picture needs it.

    Example:
        >>> import pdeface
        >>> image = pdeface.render(pdeface.neutral(), view=35)  # doctest: +SKIP
    """
    size = check_size(size)
    if path is not None:
        check_suffix(path, transparent)
    name, draw = style_named(style, face)
    options = Options(mesh=mesh, join=join, light=light, loops=loops, openings=openings)
    legend = name == "curvature" and colour_bar and not transparent
    room = (size[0], max(1, round(size[1] * (1.0 - BAND)))) if legend else size
    camera = face_camera(face, view, room, loops=loops and name == "curves")
    picture = picture_of(draw(face, camera, options), camera, room)
    if transparent:
        image = _straight(picture)
    else:
        below = np.zeros((size[1] - room[1], size[0], 4))
        image = over(np.concatenate([picture, below]), background_image(background, size))
    if legend:
        image = with_colour_bar(image, curvature_limit(face, options), QUANTITY)
    if path is not None:
        write_image(path, image)
    return image


def face_camera(face: Face, view: View, size: tuple[int, int], loops: bool = False) -> Camera:
    """The camera that frames a face, or its closed curves."""
    points = face.moved_curves.points if loops else face.mesh(*PAPER_MESH).vertices
    return frame(points, view, size[0] / size[1])


def _straight(picture: FloatArray) -> Pixels:
    """(H, W, 4) bytes with alpha not premultiplied."""
    alpha = picture[..., 3:]
    color = picture[..., :3] / np.maximum(alpha, 1e-6)
    straight = np.concatenate([color * (alpha > 0.0), alpha], axis=-1)
    return np.round(255.0 * np.clip(straight, 0.0, 1.0)).astype(np.uint8)
