"""The command line of a measurement: a folder in, a file of numbers out."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from pathlib import Path

from pdeface.errors import PDEFaceError

__all__ = ["run"]


def run(
    module: str, description: str | None, output: Path, build: Callable[[Path, Path], None]
) -> int:
    """Call ``build(head folder, output file)`` with what the command line says.

    Args:
        module: what stands after ``python -m``.
        description: for ``--help``.
        output: the file that is written unless another is named.
        build: measures and writes.

    Returns:
        Exit status: 2 for bad input.
    """
    parser = argparse.ArgumentParser(prog=f"python -m {module}", description=description)
    parser.add_argument("head", type=Path, help="folder with ICT-FaceKit's head")
    parser.add_argument("-o", "--output", type=Path, default=output, help="file to write (.npz)")
    arguments = parser.parse_args()
    try:
        build(arguments.head, arguments.output)
    except PDEFaceError as error:
        sys.stderr.write(f"error: {error}\n")
        return 2
    return 0
