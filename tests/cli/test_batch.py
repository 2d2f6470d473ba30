"""Many files side by side: what fails, or is killed, takes nothing else along."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
import typer

from pdeface.cli.batch import planned, work_through
from pdeface.cli.report import Report
from pdeface.errors import InputError


def work(source: Path, outputs: list[Path]) -> str:
    """What a file's text says shall become of it."""
    text = source.read_text()
    if text == "refuse":
        raise InputError("refused")
    if text == "break":
        raise ZeroDivisionError("broke")
    if text == "kill":
        os.kill(os.getpid(), signal.SIGKILL)
    for output in outputs:
        output.write_text(text)
    return "done"


def folder(tmp_path: Path, texts: dict[str, str]) -> dict[Path, list[Path]]:
    for name, text in texts.items():
        (tmp_path / name).write_text(text)
    return planned([tmp_path / name for name in texts], tmp_path, [".out"])


def test_what_fails_does_not_stop_the_rest(tmp_path: Path, capfd) -> None:
    plan = folder(tmp_path, {"a.txt": "fine", "b.txt": "refuse", "c.txt": "break", "d.txt": "fine"})
    with pytest.raises(typer.Exit) as exit_:
        work_through(plan, work, 1, Report(), "file")
    assert exit_.value.exit_code == 1
    assert {p.name for p in tmp_path.glob("*.out")} == {"a.out", "d.out"}
    captured = capfd.readouterr()
    assert "2 made, 0 kept, 2 failed" in captured.out
    assert "b.txt: refused" in captured.err
    assert "c.txt: unexpected ZeroDivisionError: broke" in captured.err


@pytest.mark.skipif(sys.platform == "win32", reason="there is no such signal")
def test_what_is_killed_is_tried_again_alone(tmp_path: Path, monkeypatch, capfd) -> None:
    # Spawned processes import this module by its name.
    monkeypatch.syspath_prepend(str(Path(__file__).parent))
    monkeypatch.setitem(sys.modules, "test_batch", sys.modules[__name__])
    monkeypatch.setattr(work, "__module__", "test_batch")
    texts = {f"{n}.txt": "fine" for n in range(6)} | {"3.txt": "kill"}
    plan = folder(tmp_path, texts)
    with pytest.raises(typer.Exit):
        work_through(plan, work, 2, Report(), "file")
    assert len(list(tmp_path.glob("*.out"))) == 5
    assert "5 made, 0 kept, 1 failed" in capfd.readouterr().out


def test_names_that_differ_in_their_suffix_alone_keep_it() -> None:
    sources = [Path("a.ply"), Path("a.obj"), Path("b.ply")]
    plan = planned(sources, Path("out"), [".glb"])
    assert [files[0].name for files in plan.values()] == ["a-ply.glb", "a-obj.glb", "b.glb"]


def slow_work(source: Path, outputs: list[Path]) -> str:
    """Says which process did it; the first to meet "kill" is killed, the next is not."""
    if source.read_text() == "kill":
        source.write_text("killed once")
        os.kill(os.getpid(), signal.SIGKILL)
    time.sleep(0.2)
    for output in outputs:
        output.write_text(str(os.getpid()))
    return "done"


CLUSTER = """
import sys, pathlib, distributed, test_batch
from pdeface.cli.batch import work_through
from pdeface.cli.report import Report
folder = pathlib.Path(sys.argv[1])
plan = test_batch.folder(folder, {f"{n}.txt": "fine" for n in range(12)} | {"5.txt": "kill"})
with distributed.LocalCluster(2, threads_per_worker=1, dashboard_address=None) as cluster:
    work_through(plan, test_batch.slow_work, 1, Report(), "file", cluster.scheduler_address)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="there is no such signal")
def test_a_cluster_loses_a_worker_and_nothing_else(tmp_path: Path) -> None:
    if os.environ.get("CI", "").lower() != "true":
        pytest.importorskip("distributed", reason="needs the extra 'cluster'")
    path = os.pathsep.join([str(Path(__file__).parent), *sys.path])
    done = subprocess.run(
        [sys.executable, "-c", CLUSTER, str(tmp_path)],
        env={**os.environ, "PYTHONPATH": path},
        capture_output=True,
        text=True,
        timeout=240,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert "12 made, 0 kept, 0 failed" in done.stdout
    assert (tmp_path / "5.txt").read_text() == "killed once"
    assert len(list(tmp_path.glob("*.out"))) == 12


def test_no_scheduler_is_one_line(tmp_path: Path, monkeypatch) -> None:
    if os.environ.get("CI", "").lower() != "true":
        pytest.importorskip("distributed", reason="needs the extra 'cluster'")
    monkeypatch.setattr("pdeface.cli.batch._PATIENCE", 0.5)
    plan = folder(tmp_path, {"a.txt": "fine"})
    with pytest.raises(InputError, match="none answers") as caught:
        work_through(plan, work, 1, Report(), "file", "tcp://127.0.0.1:9")
    assert "\n" not in str(caught.value)
