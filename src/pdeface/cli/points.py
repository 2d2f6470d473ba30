"""``pdeface points``: the feature points of a photo, as a file to look at and to mend."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from pdeface.cli.landmarks import face_in
from pdeface.cli.options import FaceNumberOption, ModelOption, QuietOption, check_outputs
from pdeface.cli.report import Report

__all__ = ["points"]


def points(
    photo: Annotated[Path, typer.Argument(metavar="PHOTO", help="A portrait from the front.")],
    out: Annotated[
        Path, typer.Option("-o", "--out", metavar="OUT", help="File to write, ending in .json.")
    ],
    face_number: FaceNumberOption = 1,
    model: ModelOption = None,
    quiet: QuietOption = False,
) -> None:
    """Find the 25 feature points of a face in a photo.

    The file (docs/points.md) can be mended by hand; 'pdeface make PHOTO --points FILE' takes it.
    The points are found on this machine, by MediaPipe; the photo is sent nowhere.

    \b
    Examples:
      pdeface points me.jpg -o me.json
      pdeface points us.jpg -o her.json --face 2
    """
    check_outputs([out], [photo, model], [".json"])
    from pdeface.photo import feature_points
    from pdeface.texture import read_photo

    report = Report(quiet)
    found = face_in(photo, read_photo(photo), face_number, model, report)
    feature_points(found).save(out)
    report.wrote(out)
