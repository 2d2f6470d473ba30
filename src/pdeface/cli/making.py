"""From photos to a face and its files: the work of ``pdeface make`` for one person."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from pdeface.cli.landmarks import face_in
from pdeface.cli.moves import chosen_expressions, speaking
from pdeface.cli.report import Report
from pdeface.cli.wishes import Wishes

if TYPE_CHECKING:
    from pdeface import Face
    from pdeface.photo import PhotoView

__all__ = ["made_from", "write_all"]


def made_from(
    photos: Sequence[Path], wishes: Wishes, start: Face, report: Report
) -> tuple[Face, tuple[PhotoView, ...]]:
    """The face of the person in the photos, and what was found in them.

    Args:
        photos: files; none for the bundled portrait.
        wishes: the options.
        start: from :meth:`Wishes.start`.
        report: where progress and warnings go.

    Raises:
        InputError: a photo or its points cannot be used.
    """
    if wishes.points is not None:
        return _warped(photos[0], wishes.points, start, report), ()
    views = _views(photos, wishes, report)
    face = wishes.shaped(start, views)
    with report.step("reading the texture from the photo" + "s" * (len(views) > 1)):
        from pdeface.photo import textured

        face = textured(face, views, texture=wishes.texture or "project", delight=wishes.delight)
    if photos:
        return face.with_name(photos[0].stem), views
    return face.with_notes({"photo": "Eileen Collins; NASA, public domain"}), views


def _views(photos: Sequence[Path], wishes: Wishes, report: Report) -> tuple[PhotoView, ...]:
    from pdeface.photo import focal_length, photo_views, portrait_face
    from pdeface.texture import portrait, read_photo

    if photos:
        images = [read_photo(path) for path in photos]
        found = [
            face_in(path, image, wishes.face_number, wishes.model, report)
            for path, image in zip(photos, images, strict=True)
        ]
    else:
        images, found = [portrait()[0]], [portrait_face()]
    focals = [focal_length(path) for path in photos] or None
    with report.step("fitting the person's shape"):
        views = photo_views(images, found, focals)
    if photos:
        _warn_of_covers(views, report)
    return views


def _warn_of_covers(views: tuple[PhotoView, ...], report: Report) -> None:
    from pdeface.photo import COVERED, covered

    for view in views:
        if (share := covered(view)) > COVERED:
            report.warn(
                f"about {100.0 * share:.0f} per cent of the face is not of its skin's colour; "
                "glasses, hair or a hard shadow over it will be part of the texture"
            )


def _warped(photo: Path, points: Path, start: Face, report: Report) -> Face:
    """By the paper's route: the photo and its points alone."""
    from pdeface.texture import FeaturePoints, read_photo, uv_texture

    # The points first: they are read in no time, and a mistake in them is likelier.
    places = FeaturePoints.load(points)
    image = read_photo(photo)
    with report.step("warping the photo onto the uv mesh"):
        return start.with_name(photo.stem).with_texture(uv_texture(image, places).image)


def write_all(face: Face, outputs: Sequence[Path], wishes: Wishes, report: Report) -> None:
    """Write the face to every output, by its suffix."""
    import pdeface
    from pdeface.pictures.image_file import FORMATS as PICTURES

    moving = chosen_expressions(face, wishes.expressions, outputs)
    talking = speaking(wishes.visemes, face, outputs)
    for path in outputs:
        with report.step(f"writing {path}") as progress:
            if path.suffix.lower() in PICTURES:
                from pdeface.pictures import demo_sheet

                demo_sheet(face, path, progress=progress)
            else:
                pdeface.export(
                    face,
                    path,
                    mesh=wishes.mesh,
                    join=wishes.join,
                    expressions=moving[path],
                    openings=wishes.openings,
                    visemes=path in talking,
                )
        report.wrote(path)
