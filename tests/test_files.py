"""Files are written whole or not at all."""

from __future__ import annotations

import errno
import os
import stat
from pathlib import Path

import pytest

from pdeface.errors import InputError
from pdeface.files import atomic_batch, atomic_path, atomic_write


def names(folder: Path) -> list[str]:
    return sorted(entry.name for entry in folder.iterdir())


def test_writes_and_replaces(tmp_path: Path) -> None:
    target = tmp_path / "a.bin"
    atomic_write(target, b"old")
    atomic_write(str(target), b"new")
    assert target.read_bytes() == b"new"
    assert names(tmp_path) == ["a.bin"]


def test_temporary_file_is_a_neighbour_with_the_same_suffix(tmp_path: Path) -> None:
    with atomic_path(tmp_path / "picture.png") as temporary:
        assert temporary.parent == tmp_path.resolve()
        assert temporary.suffix == ".png"
        temporary.write_bytes(b"x")
        assert not (tmp_path / "picture.png").exists()
    assert names(tmp_path) == ["picture.png"]


@pytest.mark.parametrize("problem", [ValueError, KeyboardInterrupt, SystemExit])
def test_failure_keeps_the_old_file_and_leaves_no_litter(
    tmp_path: Path, problem: type[BaseException]
) -> None:
    target = tmp_path / "a.bin"
    target.write_bytes(b"old")
    with pytest.raises(problem), atomic_path(target) as temporary:
        temporary.write_bytes(b"half of the n")
        raise problem
    assert target.read_bytes() == b"old"
    assert names(tmp_path) == ["a.bin"]


def test_full_disk_is_one_clear_line(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(self: Path, data: bytes) -> int:
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(Path, "write_bytes", full)
    with pytest.raises(InputError, match=r"a\.bin.*No space left") as caught:
        atomic_write(tmp_path / "a.bin", b"data")
    assert "\n" not in str(caught.value)
    assert names(tmp_path) == []


def test_missing_folder(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="does not exist"):
        atomic_write(tmp_path / "nowhere" / "a.bin", b"")


def test_folder_that_cannot_be_written(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refused(*_: object) -> int:
        raise PermissionError(errno.EACCES, "Permission denied")

    monkeypatch.setattr(os, "open", refused)  # root may write anywhere
    with pytest.raises(InputError, match="Permission denied"):
        atomic_write(tmp_path / "a.bin", b"")


def test_path_is_a_folder(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="folder"):
        atomic_write(tmp_path, b"")
    with pytest.raises(InputError, match="folder"):
        atomic_write("", b"")


@pytest.mark.parametrize("name", ["a" * 300 + ".glb", "nul\0byte.glb"])
def test_impossible_names(tmp_path: Path, name: str) -> None:
    with pytest.raises(InputError, match="cannot write"):
        atomic_write(tmp_path / name, b"")
    assert names(tmp_path) == []


def test_a_device_is_not_replaced() -> None:
    with pytest.raises(InputError, match="device"):
        atomic_write(os.devnull, b"")
    assert not Path(os.devnull).is_file()


@pytest.mark.skipif(os.name != "posix", reason="links and modes of POSIX")
def test_links_are_followed_and_modes_kept(tmp_path: Path) -> None:
    target, link = tmp_path / "a.bin", tmp_path / "link.bin"
    target.write_bytes(b"old")
    target.chmod(0o640)
    link.symlink_to(target)
    atomic_write(link, b"new")
    assert link.is_symlink()
    assert target.read_bytes() == b"new"
    assert stat.S_IMODE(target.stat().st_mode) == 0o640


@pytest.mark.skipif(os.name != "posix", reason="modes of POSIX")
def test_a_new_file_has_the_users_usual_mode(tmp_path: Path) -> None:
    (tmp_path / "usual").write_bytes(b"")
    atomic_write(tmp_path / "ours", b"")
    assert (tmp_path / "ours").stat().st_mode == (tmp_path / "usual").stat().st_mode


def test_a_batch_appears_together(tmp_path: Path) -> None:
    with atomic_batch() as write:
        for name in ("a", "b", "c"):
            write(tmp_path / name, name.encode())
        assert not {"a", "b", "c"} & set(names(tmp_path))
    assert [(name, (tmp_path / name).read_bytes()) for name in names(tmp_path)] == [
        (name, name.encode()) for name in ("a", "b", "c")
    ]


@pytest.mark.parametrize("problem", [ValueError, KeyboardInterrupt])
def test_a_batch_that_fails_leaves_all_as_it_was(
    tmp_path: Path, problem: type[BaseException]
) -> None:
    (tmp_path / "a").write_bytes(b"old")
    with pytest.raises(problem), atomic_batch() as write:
        write(tmp_path / "a", b"new")
        write(tmp_path / "b", b"new")
        raise problem
    assert names(tmp_path) == ["a"]
    assert (tmp_path / "a").read_bytes() == b"old"


def test_a_batch_in_which_one_cannot_be_written_writes_none(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="does not exist"), atomic_batch() as write:
        write(tmp_path / "a", b"new")
        write(tmp_path / "no" / "b", b"new")
    assert names(tmp_path) == []
