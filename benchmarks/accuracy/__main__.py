"""How near faces from photos are to heads that are known: ``python -m benchmarks.accuracy``.

Synthetic: pictures of random heads of ICT-FaceKit, at rest and with expressions, and of
MakeHuman's, of many skins, in two lights, from 0, 20 and 40 degrees aside, by lenses of 35 to 85
mm; bare heads before an even wall, or dressed. The whole pipeline looks at each, knowing the lens
as it would from EXIF. Scores are those of the NoW challenge (seven landmarks, then rigid; distance
from the scan to the surface, millimetres) and by region those of REALY, of other data than theirs.
Needs the extras photo, render and bench, the model (docs/photos.md) and the two sets of heads.
"""

from __future__ import annotations

import argparse
from pathlib import Path

from benchmarks.accuracy.cases import Sitting, results, subjects
from benchmarks.accuracy.report import report
from pdeface.photo.model import model_file
from pdeface.pictures.raster_vtk import Canvas


def main(arguments: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(prog="benchmarks.accuracy", description=__doc__)
    parser.add_argument("heads", type=Path, help="folder with ict_facekit and makehuman")
    parser.add_argument("--people", type=int, default=24, help="random people; 6 for a small run")
    parser.add_argument("--dressed", action="store_true", help="with hair, clothes, grounds")
    parser.add_argument("--model", type=Path, help="MediaPipe's face_landmarker.task")
    options = parser.parse_args(arguments)
    model, canvas, rows = model_file(options.model), Canvas(), []
    for number, (group, subject) in enumerate(subjects(options.heads, model, options.people)):
        rows += results(group, Sitting(subject, number, options.dressed), model, canvas)
    report(rows)


if __name__ == "__main__":
    main()
