"""docs/cli.md, written from the help of every command: ``python -m pdeface.cli.reference``."""

from __future__ import annotations

import typer
from typer.testing import CliRunner

from pdeface.cli.app import app

__all__ = ["reference"]

_HEAD = """\
# Command line

Written by `make docs` from the help of every command; a test fails when it is stale.
"""
_WIDTH = 88


def reference() -> str:
    """The text of docs/cli.md."""
    commands = getattr(typer.main.get_command(app), "commands", {})
    sections = [_section("pdeface"), *(_section("pdeface", name) for name in commands)]
    return "\n".join([_HEAD, *sections])


def _section(*words: str) -> str:
    result = CliRunner().invoke(app, [*words[1:], "--help"], terminal_width=_WIDTH)
    lines = [line.rstrip() for line in result.output.strip().splitlines()]
    return "\n".join([f"## {' '.join(words)}", "", "```text", *lines, "```", ""])


if __name__ == "__main__":
    typer.echo(reference(), nl=False)
