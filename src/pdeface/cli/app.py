"""The commands together, and what becomes of their errors."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import Annotated

import typer

import pdeface
from pdeface.cli import (
    animate,
    controls,
    export,
    fit,
    info,
    make,
    paper,
    points,
    render,
    studio,
)
from pdeface.errors import InputError, PDEFaceError

__all__ = ["app", "run"]

# Exit statuses. Usage and input are the caller's to mend (2); all else went wrong here (1).
FAILED = 1
BAD_INPUT = 2
INTERRUPTED = 130

# Plain help: Typer's rich mode would take as long to import as all the rest.
app = typer.Typer(
    name="pdeface",
    rich_markup_mode=None,
    add_completion=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)
app.command("make")(make.make)
app.command("points")(points.points)
app.command("fit")(fit.fit)
app.command("export")(export.export)
app.command("render")(render.render)
app.command("animate")(animate.animate)
app.command("info")(info.info)
app.command("controls")(controls.controls)
app.command("paper")(paper.paper)
app.command("studio")(studio.studio)


def _show_version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"pdeface {pdeface.__version__}")
        raise typer.Exit


@app.callback()
def _pdeface(
    version: Annotated[
        bool,
        typer.Option(
            "--version", callback=_show_version, is_eager=True, help="Show the version and exit."
        ),
    ] = False,
    debug: Annotated[
        bool, typer.Option("--debug", help="Show the traceback of an unexpected error.")
    ] = False,
) -> None:
    """3D faces as solutions of a partial differential equation.

    \b
    Examples:
      pdeface make -o face.glb -o face.pdeface    the bundled portrait as a textured face
      pdeface make me.jpg -o me.glb               a photo of your own
      pdeface fit head.ply -o face.pdeface        a scan of a head
      pdeface export face.pdeface -o face.obj     another format, any mesh size
      pdeface render face.pdeface -o face.png     a picture of it
      pdeface animate face.pdeface talk -o a.glb  a face that talks
      pdeface info face.pdeface                   what it is made of
      pdeface controls --kind expression          what it can be set to
      pdeface studio                              all of this by hand, in the browser

    'pdeface COMMAND --help' tells more, with examples.
    """


def run(arguments: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit status; an error is one line on stderr.

    Args:
        arguments: what follows the word ``pdeface``; ``None`` takes it from ``sys.argv``.
    """
    words = list(sys.argv[1:] if arguments is None else arguments)
    debug = "--debug" in words
    try:
        status = app(args=words or ["--help"], prog_name="pdeface", standalone_mode=False)
        sys.stdout.flush()
    except typer.TyperException as error:  # a wrong option, a missing argument
        return _fail(f"{error.format_message()}{_hint(error)}", error.exit_code)
    except (KeyboardInterrupt, typer.Abort):
        return INTERRUPTED
    except BrokenPipeError:  # the reader of our output, such as `head`, had enough
        sys.stdout = None  # nothing more to flush at exit
        return FAILED
    except PDEFaceError as error:
        return _fail(str(error), BAD_INPUT if isinstance(error, InputError) else FAILED)
    except OSError as error:
        return _fail(str(error), FAILED)
    except Exception as error:
        if debug:
            raise
        what = f"{type(error).__name__}: {error}"
        return _fail(f"unexpected {what} ('pdeface --debug ...' shows where)", FAILED)
    return status if isinstance(status, int) else 0


def _fail(message: str, status: int) -> int:
    typer.echo(f"error: {' '.join(message.split())}", err=True)
    return status


def _hint(error: typer.TyperException) -> str:
    context = getattr(error, "ctx", None)
    return f" (see '{context.command_path} --help')" if context is not None else ""
