"""Scans: told by their content, fitted, and measured against any face."""

from __future__ import annotations

import threading
from types import SimpleNamespace

import numpy as np
import pytest
from starlette.applications import Starlette
from starlette.testclient import TestClient

import pdeface
from pdeface.errors import InputError
from pdeface.scan import Scan
from pdeface.studio.jobs import Jobs, job_routes
from pdeface.studio.scans import Watched, scan_suffix


@pytest.mark.parametrize("suffix", [".ply", ".obj", ".stl", ".glb"])
def test_scans_are_told_by_their_content(tmp_path, suffix: str) -> None:
    path = tmp_path / f"scan{suffix}"
    pdeface.export(pdeface.neutral(), path)
    assert scan_suffix(path.read_bytes()) == suffix


@pytest.mark.parametrize(
    "data", [b"", b"ply", b"v of nothing", b"solid gold", bytes(90), b"\x89PNG\r\n\x1a\n"]
)
def test_what_is_no_scan_is_not_taken_for_one(data: bytes) -> None:
    assert scan_suffix(data) == ""


def test_a_scan_of_nothing_fails_with_a_line(finished, sent) -> None:
    job = sent(b"v 0 0 0\nv 0 1 0\nv 1 0 0\nf 1 2 3\n").json()["job"]
    assert "vertices" in finished(job["id"], "failed")["message"]


def test_a_scan_becomes_a_face_that_is_measured_against_it(
    client, finished, sent, unpack, told_model, tmp_path
) -> None:
    path = tmp_path / "head.ply"
    person = pdeface.neutral().set(noseLength=0.8)
    pdeface.export(person, path, mesh=(109, 161))
    done = finished(sent(path.read_bytes()).json()["job"]["id"], "done")
    assert done["face"]["curves"] >= 28
    scan = done["scan"]
    assert scan["median"] < 0.1 < scan["largest"]
    assert scan["coverage"] > 0.9

    def away(**weights: float) -> np.ndarray:
        asked = {"face": done["face"]["id"], "rows": 28, "columns": 41, "weights": weights}
        answer = client.post(f"/api/scans/{scan['id']}/distances", json=asked)
        return unpack(answer.content)["away"]

    found = away()
    assert found.shape == (28 * 41,)
    known = found[found >= 0.0]
    assert len(known) > 0.9 * len(found)
    assert np.median(known) < 0.1
    # Elsewhere the face is as near as before; the nose is as far as the control moves it.
    moved = away(noseLength=-1.0)
    step = np.linalg.norm(
        pdeface.neutral().set(noseLength=-1.0).mesh(28, 41).vertices
        - pdeface.neutral().mesh(28, 41).vertices, axis=1,
    )  # fmt: skip
    assert np.median(np.abs(moved - found)[step < 1e-5]) < 0.01
    assert moved.max() > 1.0 > np.percentile(known, 99)

    drawn = unpack(client.get(f"/api/scans/{scan['id']}").content)
    assert drawn["vertices"].shape[1] == 3
    assert drawn["triangles"].max() < len(drawn["vertices"])
    assert np.ptp(drawn["vertices"], axis=0) == pytest.approx(
        np.ptp(person.mesh(109, 161).vertices, axis=0), rel=0.05
    )


def test_a_fit_is_shown_round_by_round() -> None:
    """The scan once; then places of the face, whichever grid the round has."""
    shown = []
    scan = Scan(np.eye(3), np.array([[0, 1, 2]]))
    teller = SimpleNamespace(show=shown.append)
    watched = Watched(teller)
    for rows, columns in ((55, 46), (217, 184)):
        u, v = np.linspace(0.0, 1.0, rows), (np.arange(columns) + 0.5) / columns
        across, down = np.meshgrid(v, u)
        watched(scan, np.stack([across, down, across - down], axis=-1))
    first, coarse, fine = shown
    assert set(first) == {"vertices", "triangles"}
    assert coarse["face"].dtype == np.float32
    assert coarse["face"].shape == (55, 46, 3)
    np.testing.assert_allclose(fine["face"], coarse["face"], atol=1e-6)


def test_what_a_job_shows_is_sent_to_the_page(unpack) -> None:
    jobs = Jobs()
    ready = threading.Event()

    def work(tell):
        ready.wait(10)
        tell.show({"face": np.arange(3.0)})
        raise InputError("enough")

    app = Starlette(routes=job_routes(jobs))
    with TestClient(app) as page, page.websocket_connect("/api/jobs") as socket:
        info = jobs.start("looking", work)
        assert socket.receive_json()["message"] == "looking"
        ready.set()
        assert unpack(socket.receive_bytes())["face"].tolist() == [0, 1, 2]
        assert socket.receive_json()["id"] == info.id


def test_a_scan_that_is_not_there_is_told_of(client, visitor) -> None:
    asked = {"face": visitor.face["id"], "rows": 28, "columns": 41, "weights": {}}
    answer = client.post("/api/scans/0123/distances", json=asked)
    assert answer.status_code == 422
    assert "knows no scan" in answer.json()["error"]
    assert client.get("/api/scans/0123").status_code == 422
