"""The studio's reach: ``python -m benchmarks.studio``.

Headless Chromium, 640 x 400, at the page's own density; medians of 40 moves. It needs the page
(make client), Node.js, Chromium, and Playwright (npm ci --prefix tests/browser).
"""

from __future__ import annotations

import gzip
import json
import shutil
import subprocess
import sys
from pathlib import Path

import pdeface
from pdeface.studio.assets import folder

HERE = Path(__file__).parent
PROGRAMS = ("chromium", "chromium-browser", "google-chrome")


def main() -> None:
    browser = next(filter(None, map(shutil.which, PROGRAMS)), None)
    if browser is None:
        sys.exit(f"no browser is installed; one of {', '.join(PROGRAMS)} is needed")
    size = sum(len(gzip.compress(p.read_bytes())) for p in folder().rglob("*") if p.is_file())
    print(f"page: {size / 1e6:.2f} MB compressed")
    script = ["node", str(HERE / "reach.mjs"), browser, sys.executable]
    answer = subprocess.run(script, capture_output=True, text=True, check=True)
    found = json.loads(answer.stdout)
    print(f"pdeface {pdeface.__version__}, {found['renderer']}")
    print(
        f"page ready, warm: a face after {found['ready']:.0f} ms, its sliders {found['moves']:.0f}"
    )
    print(f"a frame by itself: {found['frame']:.1f} ms")
    print(f"slider to pixels: {found['slider']:.1f} ms; 40 moves drew {found['drawn']} frames")
    print(f"curve: first response {found['response']:.1f} ms, then {found['curve']:.1f} ms a move")
    print(f"server: {found['memory']:.0f} MB at most")


main()
