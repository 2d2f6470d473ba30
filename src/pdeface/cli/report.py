"""What a command tells while it works: progress on stderr, files written on stdout."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TypeVar

import typer

__all__ = ["Report"]

T = TypeVar("T")


class Report:
    """Progress and results of one command.

    Args:
        quiet: tell nothing.
    """

    def __init__(self, quiet: bool = False) -> None:
        self._quiet = quiet

    @contextmanager
    def step(self, what: str) -> Iterator[Callable[[str], None]]:
        """Show ``what`` with a spinner for as long as the block runs, if a person may see it.

        Yields:
            A function that changes the text shown.
        """
        if self._quiet:
            yield _nothing
            return
        from rich.console import Console
        from rich.text import Text

        console = Console(stderr=True)
        if not console.is_terminal:  # a spinner would fill a log
            yield _nothing
            return
        with console.status(Text(what)) as status:
            yield lambda text: status.update(Text(text))

    def counted(self, items: Iterable[T], total: int, what: str) -> Iterator[T]:
        """The items as they come, with a bar of how many have, if a person may see it."""
        if self._quiet:
            yield from items
            return
        from rich.console import Console
        from rich.progress import Progress

        console = Console(stderr=True)
        if not console.is_terminal:
            yield from items
            return
        with Progress(console=console, transient=True) as progress:
            task = progress.add_task(what, total=total)
            for item in items:
                progress.advance(task)
                yield item

    def table(self, titles: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
        """Print a table on stdout."""
        if self._quiet:
            return
        from rich.console import Console
        from rich.table import Table
        from rich.text import Text

        table = Table(*titles)
        for row in rows:
            table.add_row(*(Text(cell) for cell in row))
        Console().print(table)

    def say(self, text: str) -> None:
        """Print a line on stdout."""
        if not self._quiet:
            typer.echo(text)

    def note(self, text: str) -> None:
        """Tell, on stderr, what the user may want to know or change."""
        if not self._quiet:
            typer.echo(f"note: {text}", err=True)

    def warn(self, text: str) -> None:
        """Tell, on stderr, what will make the result a poor one."""
        if not self._quiet:
            typer.echo(f"warning: {text}", err=True)

    def wrote(self, *paths: Path) -> None:
        """Tell that a file was written, or all those of a sequence, and how large they are."""
        if self._quiet:
            return
        size = size_in_words(sum(path.stat().st_size for path in paths))
        if len(paths) == 1:
            typer.echo(f"wrote {paths[0]} ({size})")
        else:
            typer.echo(f"wrote {paths[0]} to {paths[-1].name} ({len(paths)} files, {size})")


def size_in_words(count: int) -> str:
    """``4.2 kB`` for 4200 bytes."""
    if count < 1000:
        return f"{count} B"
    value = float(count)
    for unit in ("kB", "MB", "GB"):
        value /= 1000.0
        if value < 999.5 or unit == "GB":
            break
    return f"{value:.3g} {unit}"


def _nothing(text: str) -> None:
    pass
