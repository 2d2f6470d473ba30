"""Heavy work in a process of its own, which takes its memory with it when it ends.

MediaPipe alone holds more memory than all the rest of the server, and gives none of it back.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from multiprocessing import get_context
from typing import TYPE_CHECKING, Any, TypeVar

from numpy.typing import NDArray

from pdeface.errors import PDEFaceError

if TYPE_CHECKING:
    from multiprocessing.connection import Connection

__all__ = ["Arrays", "Telling", "apart"]

Value = TypeVar("Value")
Arrays = Mapping[str, NDArray[Any]]
Heard = Callable[[str, float], None]
Seen = Callable[[Arrays], None]


class Telling:
    """What work in another process says of itself, to the process that waits for it.

    Args:
        there: where it is said.
    """

    def __init__(self, there: Connection) -> None:
        self._there = there

    def __call__(self, text: str, share: float = 0.0) -> None:
        """Say what is being done, and about what share of the time is over."""
        self._there.send(("told", (text, share)))

    def show(self, arrays: Arrays) -> None:
        """Show what has been made so far."""
        self._there.send(("shown", (arrays,)))


def apart(
    work: Callable[..., Value],
    *arguments: Any,
    tell: Heard | None = None,
    show: Seen | None = None,
) -> Value:
    """What ``work(tell, *arguments)`` returns, done in another process.

    Args:
        work: a function of a module; arguments and result go from process to process. Its first
            argument is a :class:`Telling`.
        arguments: for it.
        tell: hears what the work says of its progress.
        show: is given what the work shows of its progress.

    Raises:
        PDEFaceError: the process ended without a word, as when memory runs out; and whatever the
            work raises.
    """
    # A fork of a process with threads may hang; a spawned one begins anew.
    context = get_context("spawn")
    # The products are small: threads would cost many times more than they bring.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    here, there = context.Pipe()
    process = context.Process(target=_done, args=(there, work, arguments), daemon=True)
    process.start()
    there.close()
    try:
        while True:
            kind, value = here.recv()
            if kind == "done":
                result: Value = value
                return result
            if kind == "failed":
                raise value
            hears = {"told": tell, "shown": show}[kind]
            if hears is not None:
                hears(*value)
    except EOFError:
        raise PDEFaceError(
            "the work ended before its time, perhaps for want of memory; close other programs and "
            "try again"
        ) from None
    finally:
        here.close()
        process.kill()
        process.join()


def _done(there: Connection, work: Callable[..., Any], arguments: tuple[Any, ...]) -> None:
    try:
        there.send(("done", work(Telling(there), *arguments)))
    except Exception as error:  # whatever it is, who waits must hear of it
        there.send(("failed", _portable(error)))


def _portable(error: Exception) -> Exception:
    """The error itself if it can travel, else its text."""
    import pickle

    try:
        pickle.loads(pickle.dumps(error))
        return error
    except Exception:  # what an error of another library holds is beyond all knowledge
        return PDEFaceError(f"unexpected {type(error).__name__}: {error}")
