"""Motion: tracks of expression weights over time, read from recordings or built in."""

from pdeface.controls.presets import VRM_PRESETS
from pdeface.controls.visemes import VISEMES
from pdeface.motion.clips import CLIPS, clip
from pdeface.motion.frames import Frames
from pdeface.motion.livelink import read_livelink
from pdeface.motion.names import ARKIT_NAMES
from pdeface.motion.reading import SUFFIXES, read, write
from pdeface.motion.track import Pose, Track

__all__ = [
    "ARKIT_NAMES",
    "CLIPS",
    "SUFFIXES",
    "VISEMES",
    "VRM_PRESETS",
    "Frames",
    "Pose",
    "Track",
    "clip",
    "read",
    "read_livelink",
    "write",
]
