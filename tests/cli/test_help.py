"""Every command has help with examples, docs/cli.md holds it, and it comes at once."""

from __future__ import annotations

import json
import shlex
import subprocess
import sys

import pytest
import typer

import pdeface
from pdeface.cli.app import app
from pdeface.cli.reference import reference

GROUP = typer.main.get_command(app)
COMMANDS = GROUP.commands
NAMES = sorted(COMMANDS)


def examples(name: str) -> list[list[str]]:
    """The words of each example in a command's help."""
    lines = COMMANDS[name].help.splitlines()
    return [shlex.split(line) for line in lines if line.strip().startswith("pdeface ")]


def test_the_commands_are_those_of_the_readme(root) -> None:
    text = (root / "README.md").read_text(encoding="utf-8")
    assert NAMES == [
        "animate",
        "controls",
        "export",
        "fit",
        "info",
        "make",
        "paper",
        "points",
        "render",
        "studio",
    ]
    assert all(f"pdeface {name}" in text for name in NAMES)


def test_the_docs_are_fresh(root) -> None:
    written = (root / "docs" / "cli.md").read_text(encoding="utf-8")
    assert written == reference(), "docs/cli.md is stale; run: make docs"


@pytest.mark.parametrize("name", NAMES)
def test_help_says_what_for_each_option_and_shows_examples(pdeface_command, name) -> None:
    outcome = pdeface_command(name, "--help")
    assert outcome.status == 0
    assert "Examples:" in outcome.out
    assert examples(name)
    assert all(getattr(p, "help", None) for p in COMMANDS[name].params)


@pytest.mark.parametrize("words", [w for name in NAMES for w in examples(name)], ids=" ".join)
def test_every_example_can_be_parsed(words) -> None:
    with COMMANDS[words[1]].make_context(words[1], words[2:]) as context:
        assert context.command.name == words[1]


@pytest.mark.parametrize("words", [[], ["-h"], ["--help"]])
def test_no_words_are_a_question_for_help(pdeface_command, words) -> None:
    outcome = pdeface_command(*words)
    assert outcome.status == 0
    assert outcome.out.startswith("Usage: pdeface")


def test_version(pdeface_command) -> None:
    assert pdeface_command("--version").out == f"pdeface {pdeface.__version__}\n"


def test_help_imports_nothing_slow() -> None:
    program = """
import json, sys
from pdeface.__main__ import main
main(["--help"])
print(json.dumps(sorted({name.partition(".")[0] for name in sys.modules})))
"""
    result = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True
    )
    imported = set(json.loads(result.stdout.splitlines()[-1]))
    assert "typer" in imported
    assert not imported & {"numpy", "rich", "numba", "pyvista", "vtkmodules", "PIL", "scipy"}
