"""Faces from scans: any head scan in, boundary curves out.

    from pdeface.scan import fit_scan, measure, read_scan

    fit = fit_scan(read_scan("head.ply"), level=(55, 92))
    fit.face.save("face.pdeface")
    print(measure(fit).to_scan.rms, "mm")

Scans are read by trimesh and nearest places found by SciPy (extra ``scan``); landmarks that are not
given are found by MediaPipe (extra ``photo``) on this machine. Nothing is sent anywhere.
"""

from __future__ import annotations

from pdeface.scan.alignment import Landmarks
from pdeface.scan.fitting import ScanFit, fit_scan
from pdeface.scan.landmark_file import load_landmarks
from pdeface.scan.landmarks import find_landmarks
from pdeface.scan.measures import Away, Measures, Spread, distances, measure
from pdeface.scan.nearest import Target
from pdeface.scan.reading import make_scan, read_scan
from pdeface.scan.relief import relief_of
from pdeface.scan.surface import Scan
from pdeface.scan.texture import texture_of

__all__ = [
    "Away",
    "Landmarks",
    "Measures",
    "Scan",
    "ScanFit",
    "Spread",
    "Target",
    "distances",
    "find_landmarks",
    "fit_scan",
    "load_landmarks",
    "make_scan",
    "measure",
    "read_scan",
    "relief_of",
    "texture_of",
]
