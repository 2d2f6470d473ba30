"""The face in a notebook, as its kernel has it: what the page is given and what it says back."""

from __future__ import annotations

import importlib.util
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pdeface
from pdeface.studio import assets

if os.environ.get("CI", "").lower() != "true":
    pytest.importorskip("anywidget", reason="needs the extra 'widget'")
SIZE = (28, 41)
HERE = Path(__file__).parent
PROGRAMS = ("chromium", "chromium-browser", "google-chrome")
CELLS = (
    "import pdeface\nshown = pdeface.neutral().set(noseLength=0.25).widget(mesh=(28, 41))\nshown",
    "print(shown.face.weights['noseLength'])",
    "shown.weights = {'jawOpen': 0.5}",
)


@pytest.fixture
def shown(face: pdeface.Face) -> Any:
    try:
        assets.folder()
    except pdeface.PDEFaceError as error:
        pytest.skip(str(error))
    return face.widget(mesh=SIZE, height=300)


def test_it_begins_with_the_face(shown, face, unpack) -> None:
    assert shown.face == face
    assert shown.weights == {"noseLength": 0.25}
    state = shown.get_state()
    assert state["_glb"].startswith(b"glTF")
    assert "export" in state["_esm"]
    columns = unpack(state["_columns"])["skin"]
    assert columns.shape == (len(state["_controls"]), 28 * 41, 3)
    assert (state["height"], state["_curves"]) == (300, (28, 46))


def test_python_and_page_share_the_weights(shown, face) -> None:
    heard = []
    shown.observe(lambda change: heard.append(change["new"]), "weights")
    shown.weights = {"jawOpen": 0.5, "noseLength": 0.0}
    assert shown.weights == {"jawOpen": 0.5}
    # As the page's message arrives.
    shown.set_state({"weights": {"mouthSmileLeft": 0.75}})
    assert heard == [{"jawOpen": 0.5}, {"mouthSmileLeft": 0.75}]
    assert dict(shown.face.weights) == {"mouthSmileLeft": 0.75}
    assert shown.face.curves == face.curves


def test_weights_that_cannot_be_are_refused(shown) -> None:
    for wrong in ({"jawOpen": 7.0}, {"noControl": 0.5}):
        with pytest.raises(pdeface.errors.InputError):
            shown.weights = wrong
    assert shown.weights == {"noseLength": 0.25}


def test_the_page_is_told_where_the_face_is_exactly(shown, unpack, monkeypatch) -> None:
    sent = []
    monkeypatch.setattr(shown, "send", lambda content, buffers: sent.append((content, buffers)))
    weights = {"eyeBlinkLeft": 1.0, "eyeWideLeft": 1.0}
    shown._handle_custom_msg({"kind": "exact", "weights": weights}, [])
    ((content, (packet,)),) = sent
    assert content == {"kind": "exact", "weights": weights}
    shown.weights = weights
    skin = shown.face.mesh(*SIZE).vertices
    np.testing.assert_allclose(unpack(packet)["positions"][0, : len(skin)], skin, atol=1e-6)


def test_a_notebook_shows_the_face_and_hears_its_sliders(shown, tmp_path) -> None:
    if importlib.util.find_spec("jupyterlab") is None:
        pytest.skip("JupyterLab is not installed")
    browser = next(filter(None, map(shutil.which, PROGRAMS)), None)
    if browser is None or shutil.which("node") is None:
        pytest.skip("Node.js and a browser are needed")
    if not (HERE.parent / "browser" / "node_modules" / "playwright-core").is_dir():
        pytest.skip("Playwright is not installed; run: npm ci --prefix tests/browser")
    cells = [
        {"cell_type": "code", "execution_count": None, "id": f"cell{n}", "metadata": {},
         "outputs": [], "source": text}
        for n, text in enumerate(CELLS)
    ]  # fmt: skip
    kernel = {"name": "python3", "display_name": "Python 3", "language": "python"}
    book = {"nbformat": 4, "nbformat_minor": 5, "metadata": {"kernelspec": kernel}, "cells": cells}
    (tmp_path / "face.ipynb").write_text(json.dumps(book), encoding="utf-8")
    command = ["node", str(HERE / "notebook.mjs"), browser, sys.executable, str(tmp_path)]
    answer = subprocess.run(command, capture_output=True, text=True, check=False, timeout=300)
    assert answer.returncode == 0, answer.stderr
    report = json.loads(answer.stdout)
    assert report["sliders"] == len(shown.get_state()["_controls"])
    assert report["seen"]
    assert report["told"].strip() == "1.0"
    assert report["moved"]
    assert report["nose"] == "0"
