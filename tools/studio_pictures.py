"""Take a picture of every screen of the studio: ``python tools/studio_pictures.py out/studio``.

Node.js, Chromium, ``npm ci --prefix tests/browser`` and a built page (``make client``) are needed.
"""

from __future__ import annotations

import argparse
import json
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
from PIL import Image

import pdeface
from pdeface.texture import portrait

HERE = Path(__file__).resolve().parent
BROWSERS = ("chromium", "chromium-browser", "google-chrome")
SIZES = ["1440x900", "1280x720", "1180x820", "820x1180"]


def write_camera(path: Path) -> None:
    """What the camera sees: the portrait, in a picture of 640 x 480."""
    picture = Image.new("RGB", (640, 480), (120, 120, 120))
    picture.paste(Image.fromarray(portrait()[0]).resize((480, 480)), (80, 0))
    light, blue, red = picture.convert("YCbCr").split()
    halves = [plane.resize((320, 240)).tobytes() for plane in (blue, red)]
    frame = b"FRAME\n" + light.tobytes() + b"".join(halves)
    path.write_bytes(b"YUV4MPEG2 W640 H480 F10:1 Ip A1:1 C420jpeg\n" + 20 * frame)


def write_files(folder: Path, scan: Path | None) -> dict[str, str]:
    """What is opened: a photo, a scan, a face, a recording, and what is none of these."""
    files = {
        name: folder / of
        for name, of in {
            "photo": "portrait.jpg",
            "scan": "head.ply",
            "face": "someone.pdeface",
            "recording": "take.csv",
            "wrong": "notes.txt",
        }.items()
    }
    Image.fromarray(portrait()[0]).save(files["photo"], quality=95)
    pdeface.random(4).with_name("Someone").save(files["face"])
    if scan:
        files["scan"] = scan
    else:
        pdeface.export(pdeface.random(7), files["scan"], mesh=(217, 321))
    jaw = np.sin(np.linspace(0.0, 7.0, 60)) ** 2
    lines = [f"00:00:01:{n:02d}.000,61,{open_:.3f},{n / 59:.3f}" for n, open_ in enumerate(jaw)]
    text = "\n".join(["Timecode,BlendshapeCount,JawOpen,MouthSmileLeft", *lines])
    files["recording"].write_text(text + "\n", encoding="utf-8")
    files["wrong"].write_text("no face at all\n", encoding="utf-8")
    return {name: str(path) for name, path in files.items()}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("out", type=Path)
    parser.add_argument("--only", nargs="*", default=[], help="scenes, by how their names begin")
    parser.add_argument("--sizes", nargs="*", default=SIZES)
    parser.add_argument("--themes", nargs="*", default=["dark", "light"])
    parser.add_argument("--scan", type=Path, help="a head scan to open")
    parser.add_argument("--plain", action="store_true", help="as drawn without a graphics card")
    parser.add_argument("--touch", action="store_true", help="on a screen that is touched")
    parser.add_argument("--jpeg", type=int, default=0, help="quality; without, PNG")
    parser.add_argument("--wait", type=int, default=700, help="milliseconds before each picture")
    wishes = parser.parse_args()
    work = wishes.out.resolve() / "files"
    work.mkdir(parents=True, exist_ok=True)
    write_camera(work / "camera.y4m")
    job = {
        "out": str(wishes.out.resolve()), "python": sys.executable,
        "browser": next(filter(None, map(shutil.which, BROWSERS))),
        "camera": str(work / "camera.y4m"), "files": write_files(work, wishes.scan),
        "only": wishes.only, "sizes": wishes.sizes, "themes": wishes.themes, "wait": wishes.wait,
        "card": not wishes.plain, "touch": wishes.touch, "jpeg": wishes.jpeg,
    }  # fmt: skip
    path = work / "job.json"
    path.write_text(json.dumps(job), encoding="utf-8")
    subprocess.run(["node", str(HERE / "studio_pictures.mjs"), str(path)], check=True)


if __name__ == "__main__":
    main()
