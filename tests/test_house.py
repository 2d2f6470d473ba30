"""The house stands as designed: who imports whom, and how large a room may grow."""

from __future__ import annotations

import ast
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

SOURCE = Path(__file__).resolve().parents[1] / "src" / "pdeface"
MODULES = sorted(SOURCE.rglob("*.py"))
WAYS_IN = (SOURCE / "cli", SOURCE / "studio")
ROOMS = [
    path
    for path in MODULES
    if path.parent not in WAYS_IN and path.name != "__main__.py" and path != SOURCE / "__init__.py"
]
FEWEST_MODULES = 20
LONGEST_MODULE = 500


def names(paths: list[Path]) -> list[str]:
    return [str(path.relative_to(SOURCE)) for path in paths]


def imports(tree: ast.Module) -> Iterator[tuple[str, list[str]]]:
    """(module, names imported from it) of every import statement, late ones included."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            for alias in node.names:
                yield alias.name, []
        elif isinstance(node, ast.ImportFrom):
            yield node.module or "", [alias.name for alias in node.names]


def test_the_modules_are_found() -> None:
    assert len(MODULES) > FEWEST_MODULES


def test_data_flows_one_way(root: Path) -> None:
    """The contracts in pyproject.toml; import-linter sees imports inside functions too."""
    program = "import sys; from importlinter.cli import lint_imports; sys.exit(lint_imports())"
    result = subprocess.run(
        [sys.executable, "-c", program], cwd=root, capture_output=True, text=True, check=False
    )
    assert result.returncode == 0, result.stdout + result.stderr


@pytest.mark.parametrize("path", MODULES, ids=names(MODULES))
def test_a_module_is_short_and_says_what_it_is(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    assert len(text.splitlines()) <= LONGEST_MODULE
    assert ast.get_docstring(ast.parse(text))


@pytest.mark.parametrize("path", ROOMS, ids=names(ROOMS))
def test_rooms_import_rooms_and_not_the_whole_house(path: Path) -> None:
    """The public names in pdeface/__init__.py would let a lower room reach a higher one."""
    allowed = {p.stem for p in SOURCE.iterdir()} | {"__version__"}
    for module, imported in imports(ast.parse(path.read_text(encoding="utf-8"))):
        assert module != "pdeface" or (imported and set(imported) <= allowed)


@pytest.mark.parametrize("path", MODULES, ids=names(MODULES))
def test_every_relative_is_called_by_its_full_name(path: Path) -> None:
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        assert not (isinstance(node, ast.ImportFrom) and node.level > 0)


def test_no_source_is_ignored_by_git(root: Path) -> None:
    """A pattern such as ``build/`` in .gitignore would keep a package of that name out."""
    command = ["git", "check-ignore", "--no-index", "--stdin"]
    listed = "\n".join(str(path.relative_to(root)) for path in MODULES)
    try:
        result = subprocess.run(
            command, cwd=root, input=listed, capture_output=True, text=True, check=False
        )
    except FileNotFoundError:
        pytest.skip("git is not installed")
    if result.returncode == 128:
        pytest.skip("not a git repository")
    assert result.stdout == ""
