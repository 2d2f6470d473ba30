"""MediaPipe is imported without Matplotlib, and gets it when it asks for it."""

from __future__ import annotations

import subprocess
import sys

import pytest

pytest.importorskip("mediapipe")

_ALONE = """
import sys
from pdeface.photo.engine import mediapipe
mediapipe("to be tested")
assert "matplotlib" not in sys.modules and "matplotlib.pyplot" not in sys.modules
from mediapipe.tasks.python.vision import drawing_utils
assert drawing_utils.plt.figure.__module__ == "matplotlib.pyplot"
import matplotlib.pyplot
assert matplotlib.pyplot is sys.modules["matplotlib.pyplot"] and matplotlib.__version__
"""

_AFTER = """
import matplotlib.pyplot as plots
from pdeface.photo.engine import mediapipe
mediapipe("to be tested")
import matplotlib.pyplot
assert matplotlib.pyplot is plots
"""


@pytest.mark.parametrize("script", [_ALONE, _AFTER], ids=["alone", "after"])
def test_matplotlib_waits_until_it_plots(script: str) -> None:
    run = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
