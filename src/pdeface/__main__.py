"""The command ``pdeface``, also as ``python -m pdeface``."""

from __future__ import annotations

import sys
from collections.abc import Sequence

__all__ = ["main"]


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit status.

    Args:
        arguments: what follows the word ``pdeface``; ``None`` takes it from ``sys.argv``.
    """
    from pdeface.errors import MissingExtraError, require

    try:
        require("typer", "cli", "for the command line")
    except MissingExtraError as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    from pdeface.cli import run

    return run(arguments)


if __name__ == "__main__":
    sys.exit(main())
