"""One job for each of many files, side by side: none that fails stops the others."""

from __future__ import annotations

import concurrent.futures
import functools
import multiprocessing
import time
from collections.abc import Callable, Generator, Iterator, Mapping, Sequence
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Literal, NamedTuple

import typer

from pdeface.cli.report import Report
from pdeface.errors import InputError, PDEFaceError, require

__all__ = ["Outcome", "Work", "planned", "work_through"]

SOME_FAILED = 1
_RETRIES = 2
_PATIENCE = 10.0
"""Seconds in which a scheduler must answer."""

Work = Callable[[Path, list[Path]], str]
"""From an input and its outputs, which it writes, to what there is to say about them."""


class Outcome(NamedTuple):
    """What became of one input."""

    source: Path
    state: Literal["made", "kept", "failed"]
    seconds: float
    message: str


def planned(
    sources: Sequence[Path], target: Path, suffixes: Sequence[str]
) -> dict[Path, list[Path]]:
    """The files of each input; inputs that differ in their suffix alone keep it in the name."""
    names = [source.stem.casefold() for source in sources]
    plan = {}
    for source, name in zip(sources, names, strict=True):
        stem = source.stem if names.count(name) == 1 else source.name.replace(".", "-")
        plan[source] = [target / f"{stem}{suffix}" for suffix in suffixes]
    return plan


def work_through(
    plan: Mapping[Path, list[Path]],
    work: Work,
    jobs: int,
    report: Report,
    what: str,
    cluster: str | None = None,
) -> None:
    """Do the work for every input, with a table of what became of each.

    Outputs that are newer than their input are kept: work that was broken off goes on.

    Args:
        plan: outputs by input.
        work: what to do; it must be possible to pickle it.
        jobs: how many inputs at once.
        report: where warnings and the table go.
        what: an input is, in a word.
        cluster: address of a Dask scheduler whose workers do it instead; they must see the files.

    Raises:
        InputError: no scheduler answers there.
        MissingExtraError: Dask is asked for and not installed.
        typer.Exit: with status 1, if some failed.
    """
    outcomes = []
    for outcome in report.counted(_outcomes(plan, work, jobs, what, cluster), len(plan), "faces"):
        outcomes.append(outcome)
        if outcome.state == "failed":
            report.warn(f"{outcome.source.name}: {outcome.message}")
    _tell(outcomes, report, what)
    if any(outcome.state == "failed" for outcome in outcomes):
        raise typer.Exit(SOME_FAILED)


def _outcomes(
    plan: Mapping[Path, list[Path]], work: Work, jobs: int, what: str, cluster: str | None
) -> Iterator[Outcome]:
    """The outcome of every input, as they come."""
    todo = {}
    for source, outputs in plan.items():
        if _is_newer(outputs, source):
            yield Outcome(source, "kept", 0.0, f"newer than its {what}")
        else:
            todo[source] = outputs
    one = functools.partial(_one, work=work)
    if cluster is not None:
        yield from _on_cluster(todo, one, cluster)
        return
    if jobs == 1 or len(todo) < 2:
        for source, outputs in todo.items():
            yield one(source, outputs)
        return
    broken = yield from _together(todo, one, jobs)
    # A process that was killed breaks its pool, and takes along what the others were at. Each of
    # these is tried once more, in a pool of its own.
    for source in broken:
        again = {source: todo[source]}
        if (yield from _together(again, one, 1)):
            yield Outcome(source, "failed", 0.0, "its process was killed")


def _together(
    todo: Mapping[Path, list[Path]], one: Callable[[Path, list[Path]], Outcome], jobs: int
) -> Generator[Outcome, None, list[Path]]:
    """Yields outcomes; returns the inputs whose process was killed."""
    # Fresh processes: MediaPipe's threads do not survive a fork.
    context = multiprocessing.get_context("spawn")
    broken = []
    with concurrent.futures.ProcessPoolExecutor(jobs, mp_context=context) as pool:
        running = {pool.submit(one, source, outputs): source for source, outputs in todo.items()}
        try:
            for done in concurrent.futures.as_completed(running):
                try:
                    outcome = done.result()
                except BrokenProcessPool:
                    broken.append(running[done])
                else:
                    yield outcome
        except (KeyboardInterrupt, GeneratorExit):
            pool.shutdown(wait=False, cancel_futures=True)
            raise
    return broken


def _on_cluster(
    todo: Mapping[Path, list[Path]], one: Callable[[Path, list[Path]], Outcome], address: str
) -> Iterator[Outcome]:
    """Outcomes from the workers of a Dask cluster; what a lost worker was at goes to another."""
    distributed = require("distributed", "cluster", "to work on a Dask cluster")
    with _client(distributed, address) as client:
        running = {}
        for source, outputs in todo.items():
            # Workers have working folders of their own.
            places = source.absolute(), [output.absolute() for output in outputs]
            future = client.submit(one, *places, pure=False, retries=_RETRIES)
            running[future] = source
        while running:
            # Not as_completed: it waits for ever for what was done, and lost with its worker.
            for done in distributed.wait(list(running), return_when="FIRST_COMPLETED").done:
                source = running.pop(done)
                try:
                    yield done.result()._replace(source=source)
                except Exception as error:  # its workers were lost, again and again
                    yield Outcome(source, "failed", 0.0, f"{type(error).__name__} on the cluster")


@contextmanager
def _client(distributed: Any, address: str) -> Iterator[Any]:
    try:
        client = distributed.Client(address, timeout=_PATIENCE)
    except (OSError, ValueError, TimeoutError) as error:
        raise InputError(
            f"expected a Dask scheduler at {address}, none answers there; start one, such as "
            "tcp://127.0.0.1:8786"
        ) from error
    with client:
        yield client


def _is_newer(outputs: Sequence[Path], source: Path) -> bool:
    """Whether all outputs are there and none is older than the input: files come whole."""
    times = [output.stat().st_mtime for output in outputs if output.is_file()]
    return len(times) == len(outputs) and min(times) >= source.stat().st_mtime


def _one(source: Path, outputs: list[Path], work: Work) -> Outcome:
    began = time.monotonic()
    try:
        message = work(source, outputs)
    except PDEFaceError as error:
        return Outcome(source, "failed", time.monotonic() - began, str(error))
    except Exception as error:  # one input, whatever is wrong with it, does not stop the rest
        message = f"unexpected {type(error).__name__}: {error}"
        return Outcome(source, "failed", time.monotonic() - began, message)
    return Outcome(source, "made", time.monotonic() - began, message)


def _tell(outcomes: Sequence[Outcome], report: Report, what: str) -> None:
    rows = [
        (o.source.name, o.state, f"{o.seconds:.1f} s" if o.seconds else "", o.message)
        for o in sorted(outcomes)
    ]
    report.table((what, "face", "time", ""), rows)
    counts = {
        state: sum(o.state == state for o in outcomes) for state in ("made", "kept", "failed")
    }
    report.say(", ".join(f"{count} {state}" for state, count in counts.items()))
