"""Writing files so that a reader sees the old file or the new one, never half of one."""

from __future__ import annotations

import os
import secrets
import shutil
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

from pdeface.errors import InputError

__all__ = ["PathLike", "atomic_batch", "atomic_path", "atomic_write"]

PathLike = str | os.PathLike[str]


@contextmanager
def atomic_path(path: PathLike) -> Iterator[Path]:
    """A temporary file to write, which takes the place of ``path`` when all went well.

    It lies in the folder of ``path`` (a move within one file system cannot be caught half-way)
    and has its suffix, by which many writers choose a format. Whatever ends the block early,
    an interrupt from the keyboard included, leaves ``path`` as it was and removes the temporary
    file. A symbolic link is followed, and permissions of a replaced file are kept.

    Raises:
        InputError: the folder does not exist or cannot be written, or ``path`` is something
            other than a file.

    Example:
        >>> with atomic_path("note.txt") as temporary:  # doctest: +SKIP
        ...     temporary.write_text("all or nothing")
    """
    target = _checked_target(path)
    temporary = target.parent / f".pdeface-{secrets.token_hex(8)}{target.suffix}"
    try:
        # Made by hand rather than by tempfile, whose files only their owner can read.
        os.close(os.open(temporary, os.O_CREAT | os.O_EXCL | os.O_WRONLY, 0o666))
    except OSError as error:
        raise _cannot_write(path, error) from error
    try:
        yield temporary
        _replace(temporary, target, path)
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise


def atomic_write(path: PathLike, data: bytes) -> None:
    """Write ``data`` to ``path``, all of it or nothing.

    Raises:
        InputError: as for :func:`atomic_path`, or the disk is full.
    """
    with atomic_batch() as write:
        write(path, data)


@contextmanager
def atomic_batch() -> Iterator[Callable[[PathLike, bytes], None]]:
    """A function that writes a file; all the files appear when the block ends well, or none.

    Each is complete under another name before the first takes its place, so that only a move
    within a folder, of those that have begun, could come between them.

    Raises:
        InputError: as for :func:`atomic_path`, or the disk is full.

    Example:
        >>> with atomic_batch() as write:  # doctest: +SKIP
        ...     write("a.txt", b"both")
        ...     write("b.txt", b"or none")
    """
    with ExitStack() as stack:

        def write(path: PathLike, data: bytes) -> None:
            temporary = stack.enter_context(atomic_path(path))
            try:
                temporary.write_bytes(data)
            except OSError as error:
                raise _cannot_write(path, error) from error

        yield write


def _checked_target(path: PathLike) -> Path:
    try:
        target = Path(os.path.realpath(path))
        exists, is_file = target.exists(), target.is_file()
        folder_exists = target.parent.is_dir()
    except (OSError, ValueError) as error:
        raise _cannot_write(path, error) from error
    if target.is_dir():
        raise InputError(f"expected the name of a file to write, got the folder {path}; add a name")
    if exists and not is_file:
        # Replacing /dev/null by a file would be a bad surprise.
        raise InputError(f"{path} is a device or pipe, not a file; give the name of a file")
    if not folder_exists:
        raise InputError(
            f"cannot write {path}: the folder {target.parent} does not exist; make it first"
        )
    return target


def _replace(temporary: Path, target: Path, path: PathLike) -> None:
    try:
        if target.exists():
            shutil.copymode(target, temporary)
        os.replace(temporary, target)
    except OSError as error:
        raise _cannot_write(path, error) from error


def _cannot_write(path: PathLike, error: Exception) -> InputError:
    reason = getattr(error, "strerror", None) or str(error)
    shown = os.fspath(path).encode("unicode_escape").decode("ascii")
    return InputError(f"cannot write {shown} ({reason}); choose another place")
