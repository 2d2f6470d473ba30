"""``pdeface studio``: one face by hand, in the browser."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from pdeface.cli.options import ModelOption
from pdeface.errors import require

if TYPE_CHECKING:
    from pdeface import Face
    from pdeface.photo import PhotoView

__all__ = ["studio"]


def studio(
    source: Annotated[
        Path | None,
        typer.Argument(metavar="[PHOTO|FACE]", help="A portrait or a .pdeface file to begin with; "
                       "without it, the bundled portrait."),
    ] = None,
    port: Annotated[
        int | None,
        typer.Option("--port", metavar="N", min=0, max=65535, help="Port to listen at; by default "
                     "the first free one from 8640 on; 0 for any."),
    ] = None,
    host: Annotated[
        str,
        typer.Option("--host", metavar="ADDRESS", help="Address to listen at. Any other than this "
                     "machine's own is guarded by a token in the address that is printed."),
    ] = "127.0.0.1",
    browser: Annotated[
        bool, typer.Option("--browser/--no-browser", help="Open the page in the browser.")
    ] = True,
    model: ModelOption = None,
) -> None:  # fmt: skip
    """Shape, animate and export one face by hand, in the browser.

    Serves a page on this machine: the face in 3D with its boundary curves, a slider for every
    control, photos, motion, and files to open and to export. Nothing leaves the machine. It ends
    with Ctrl+C.

    \b
    Examples:
      pdeface studio
      pdeface studio me.pdeface
      pdeface studio me.jpg --port 9000
      pdeface studio --no-browser
    """
    # The products are small: threads would cost ten times more than they bring.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    require("uvicorn", "studio", "to serve the studio")
    require("starlette", "studio", "to serve the studio")
    from pdeface.studio.apart import apart
    from pdeface.studio.assets import folder
    from pdeface.studio.server import serve

    folder()  # before a photo is worked on for nothing
    # Apart: what it takes to make a face of a photo would stay with the server for good.
    face, photos = apart(_first, source, model)
    given = str(model) if model else None
    serve(face, host=host, port=port, browser=browser, model=given, photos=photos)


def _first(
    _: object, source: Path | None, model: Path | None
) -> tuple[Face, tuple[PhotoView, ...]]:
    """The face to begin with, and the photos that it was made of."""
    import pdeface
    from pdeface.cli.making import made_from
    from pdeface.cli.report import Report
    from pdeface.cli.wishes import Wishes

    if source is not None and source.suffix.lower() == ".pdeface":
        return pdeface.load(source), ()
    wishes = Wishes(
        points=None, face_number=1, model=model, neutral_shape=False, texture=None, delight=False,
        level=None, random=None, weights={}, clamp=False, mesh=(55, 81), join="smooth",
        openings="cut", visemes=False, expressions=None,
    )  # fmt: skip
    sources = [] if source is None else [source]
    return made_from(sources, wishes, wishes.start(), Report(quiet=True))
