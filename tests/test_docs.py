"""What the documents say can be done, can be done."""

from __future__ import annotations

import re
import shlex
import subprocess
from pathlib import Path

import pytest
import typer

from pdeface.cli.app import app

ROOT = Path(__file__).resolve().parents[1]
PAGES = sorted([*ROOT.glob("*.md"), *ROOT.glob("docs/**/*.md")])
README = (ROOT / "README.md").read_text(encoding="utf-8")
COMMANDS = typer.main.get_command(app).commands


def blocks(language: str) -> list[str]:
    return re.findall(rf"^```{language}\n(.*?)^```", README, re.DOTALL | re.MULTILINE)


def lines(command: str) -> list[list[str]]:
    """The words of each line of the README's shell blocks that calls a command."""
    words = [
        shlex.split(line, comments=True) for block in blocks("sh") for line in block.split("\n")
    ]
    return [line for line in words if line[:1] == [command]]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_every_link_within_the_repository_leads_somewhere(page: Path) -> None:
    targets = re.findall(r"\]\(([^)#]+)[^)]*\)", page.read_text(encoding="utf-8"))
    local = [target for target in targets if "://" not in target]
    assert [target for target in local if not (page.parent / target).exists()] == []


@pytest.mark.parametrize("number", range(len(blocks("python"))))
def test_the_python_in_the_readme_runs(number: int, tmp_path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    exec(compile(blocks("python")[number], "README.md", "exec"), {})


@pytest.mark.parametrize("words", lines("pdeface"), ids=" ".join)
def test_the_commands_in_the_readme_can_be_parsed(words: list[str]) -> None:
    with COMMANDS[words[1]].make_context(words[1], words[2:]) as context:
        assert context.command.name == words[1]


@pytest.mark.parametrize("words", lines("make"), ids=" ".join)
def test_the_goals_in_the_readme_exist(words: list[str]) -> None:
    result = subprocess.run([*words, "--dry-run"], cwd=ROOT, capture_output=True, check=False)
    assert result.returncode == 0, result.stderr


def test_the_readme_shows_how() -> None:
    assert blocks("python")
    assert {words[1] for words in lines("pdeface")} == set(COMMANDS)
    assert ["make", "demo"] in lines("make")
    assert ["make", "test"] in lines("make")
