"""What ``import pdeface`` gives, and what it costs."""

from __future__ import annotations

import ast
import importlib
import importlib.util
import json
import subprocess
import sys
from importlib import metadata
from pathlib import Path

import pytest

import pdeface

TOPLEVEL = """
import json, sys
before = set(sys.modules)
{program}
new = {{name.partition('.')[0] for name in set(sys.modules) - before}}
print(json.dumps(sorted(new - set(sys.stdlib_module_names))))
"""

# Nothing but numpy can be imported, as on a machine where nothing else is installed.
BARE = """
import sys

class OnlyNumpy:
    def find_spec(self, name, path=None, target=None):
        room = name.partition('.')[0]
        if room in ('numpy', 'pdeface') or room in sys.stdlib_module_names:
            return None
        raise ModuleNotFoundError(f'No module named {name!r}', name=name)

sys.meta_path.insert(0, OnlyNumpy())
"""


def packages_imported_by(program: str) -> set[str]:
    result = run(TOPLEVEL.format(program=program))
    return set(json.loads(result.stdout.splitlines()[-1]))


def run(program: str, folder: Path | None = None) -> subprocess.CompletedProcess[str]:
    result = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=False, cwd=folder
    )
    assert result.returncode == 0, result.stderr
    return result


@pytest.mark.parametrize("name", pdeface.__all__)
def test_every_public_name_is_there_and_documented(name: str) -> None:
    value = getattr(pdeface, name)
    assert name in dir(pdeface)
    assert isinstance(value, str) or value.__doc__


def test_an_unknown_name_is_an_attribute_error() -> None:
    with pytest.raises(AttributeError, match="nose"):
        pdeface.nose  # noqa: B018


def test_the_version_is_that_of_the_package() -> None:
    assert metadata.version("pdeface") == pdeface.__version__


def test_type_checkers_are_told_what_run_time_does() -> None:
    tree = ast.parse(Path(pdeface.__file__).read_text(encoding="utf-8"))
    block = next(node for node in tree.body if isinstance(node, ast.If))
    told = {
        alias.name: node.module
        for node in block.body
        if isinstance(node, ast.ImportFrom) and node.module != "pdeface"
        for alias in node.names
    }
    assert told == pdeface._ROOMS


@pytest.mark.parametrize("name", sorted(pdeface._ROOMS))
def test_no_module_hides_a_public_name(name: str) -> None:
    """Importing ``pdeface.render`` as a module would replace the function of that name."""
    assert importlib.util.find_spec(f"pdeface.{name}") is None


def test_a_name_means_the_same_after_its_room_was_imported() -> None:
    room = importlib.import_module("pdeface.pictures.picture")
    assert pdeface.render is room.render
    assert callable(pdeface.render)


def test_import_pdeface_imports_no_other_package() -> None:
    assert packages_imported_by("import pdeface") == {"pdeface"}


@pytest.mark.parametrize("room", ["curves", "pde", "uvmesh", "template", "face", "archive"])
def test_the_core_imports_numpy_alone(room: str) -> None:
    assert packages_imported_by(f"import pdeface.{room}") == {"pdeface", "numpy"}


@pytest.mark.parametrize("room", ["texture", "formats", "pictures", "photo"])
def test_the_other_rooms_import_the_rest_when_it_is_used(room: str) -> None:
    assert packages_imported_by(f"import pdeface.{room}") == {"pdeface", "numpy"}


def test_the_core_works_bare(tmp_path: Path) -> None:
    program = """
import pdeface
face = pdeface.neutral()
surface = face.surface()
assert surface(0.5, 1.5).shape == surface.normal(0.5, 1.5).shape == (3,)
assert face.mesh(28, 41).vertices.shape == (1148, 3)
face.save("bare.pdeface")
assert pdeface.load("bare.pdeface") == face
pdeface.export(face, "bare.glb", mesh=(28, 41))
print("done")
"""
    assert run(BARE + program, tmp_path).stdout.split() == ["done"]


def test_a_missing_extra_is_named(tmp_path: Path) -> None:
    program = """
import pdeface.__main__
sys.exit(pdeface.__main__.main(["--version"]) - 1)
"""
    assert "pip install 'pdeface[cli]'" in run(BARE + program, tmp_path).stderr
