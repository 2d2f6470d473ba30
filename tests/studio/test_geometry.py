"""What the page adds up is what the library evaluates."""

from __future__ import annotations

import numpy as np
import pytest

import pdeface
from pdeface.controls import CONTROLS, together

NAMES = list(CONTROLS)
ROWS, COLUMNS = 28, 41
SKIN = ROWS * COLUMNS

ALIKE = 1e-5
"""Metres."""

LINEAR = {"noseLength": 0.4, "identity03": 1.2, "jawOpen": 0.5, "mouthSmileLeft": 0.7}


@pytest.fixture(scope="module")
def columns(visitor, unpack):
    return unpack(visitor.get("columns"))


@pytest.fixture(scope="module")
def at(visitor, unpack):
    """(V, 3) positions of all vertices at some weights."""
    return lambda weights: unpack(visitor.post("evaluate", states=[weights]))["positions"][0]


def added(columns, weights) -> np.ndarray:
    """What the page adds to the skin."""
    return sum(w * columns["skin"][NAMES.index(n)] for n, w in weights.items())


def test_evaluation_is_the_library_s(face, visitor, unpack) -> None:
    weights = {"eyeBlinkLeft": 0.6, "browInnerUp": 0.5, "noseWidth": 0.3}
    found = unpack(visitor.post("evaluate", states=[weights, {}]))
    bare = face.with_weights(dict.fromkeys(face.weights, 0.0))
    mesh = bare.with_weights(weights).mesh(ROWS, COLUMNS)
    np.testing.assert_allclose(found["positions"][0, :SKIN], mesh.vertices, atol=1e-6)
    np.testing.assert_allclose(found["normals"][:SKIN], mesh.normals, atol=1e-5)
    np.testing.assert_allclose(
        found["positions"][1, :SKIN], bare.mesh(ROWS, COLUMNS).vertices, atol=1e-6
    )


def test_the_sum_of_columns_is_the_evaluation(columns, at) -> None:
    summed = at({})[:SKIN] + added(columns, LINEAR)
    np.testing.assert_allclose(summed, at(LINEAR)[:SKIN], atol=ALIKE)
    assert np.abs(added(columns, LINEAR)).max() > 100 * ALIKE


def test_every_control_moves_the_skin_or_the_eyes(columns) -> None:
    moved = np.abs(columns["skin"]).max(axis=(1, 2)) > ALIKE
    by_parts = {int(name.split(":")[1]) for name in columns if ":" in name}
    still = [name for k, name in enumerate(NAMES) if not moved[k] and k not in by_parts]
    assert still == []


def test_curves_move_with_the_skin(columns, at, face) -> None:
    bare = face.with_weights(dict.fromkeys(face.weights, 0.0))
    moved = bare.with_weights(LINEAR).moved_curves.points.reshape(-1, 3)
    summed = at({})[-len(moved) :] + sum(
        w * columns["curves"][NAMES.index(n)] for n, w in LINEAR.items()
    )
    np.testing.assert_allclose(summed, moved, atol=ALIKE)


def test_eyes_go_where_their_lids_go(columns, at) -> None:
    """A shape control takes a part along, about; the evaluation then says where exactly."""
    k, value = NAMES.index("identity01"), 1.5
    start = SKIN
    eye = slice(start, start + 17 * 25)
    moved = at({"identity01": value})[eye].mean(axis=0) - at({})[eye].mean(axis=0)
    np.testing.assert_allclose(value * columns["shifts"][k, 0], moved, atol=2e-3)


def test_a_handle_s_response_is_what_an_edit_does(visitor, at, unpack) -> None:
    handles, by = [[20, 8, 1.0], [21, 8, 0.5]], np.array([0.002, -0.003, 0.004])
    response = unpack(visitor.post("response", handles=handles, symmetric=True))
    moves = [[c, p, *(w * by)] for c, p, w in handles]
    moves += [[c, 22 - p, *(w * by * (-1, 1, 1))] for c, p, w in handles]
    edited = visitor.post("edit", moves=moves)
    assert edited["id"] != visitor.face["id"]
    assert edited["texture"] == visitor.face["texture"]
    path = f"/api/faces/{edited['id']}/evaluate"
    answer = visitor.client.post(path, json={"rows": ROWS, "columns": COLUMNS, "states": [{}]})
    exact = unpack(answer.content)["positions"][0, :SKIN]
    np.testing.assert_allclose(at({})[:SKIN] + response["skin"] * by, exact, atol=ALIKE)
    assert np.abs(exact - at({})[:SKIN]).max() > 100 * ALIKE


def test_lids_meet_whatever_the_face_does(visitor, columns, at, unpack) -> None:
    """Columns, with what is left of each in company, and meetings are the evaluation."""
    found = unpack(visitor.get("meetings"))
    names = list(CONTROLS)
    draw = np.random.default_rng(3)
    expressions = [name for name in names if CONTROLS[name].kind == "expression"]
    for blink in (0.4, 0.8, 1.0):
        weights = dict(zip(expressions, draw.beta(0.6, 1.4, len(expressions)), strict=True))
        weights |= {"eyeBlinkLeft": blink, "eyeSquintLeft": 0.7, "eyeBlinkRight": 0.9 - blink / 2}
        weights |= {"identity03": draw.normal(), "identity07": draw.normal(), "noseWidth": 0.5}
        alone = at({})[:SKIN] + added(columns, together(weights))
        exact = at(weights)[:SKIN]
        whole = np.zeros((max(SKIN, found["vertices"].max() + 1), 3))
        for (one, other), shares in zip(found["pairs"], found["shares"], strict=True):
            moves = np.tensordot(shares, found["moves"], 1)
            whole[found["vertices"]] += (
                weights.get(names[one], 0.0) * weights.get(names[other], 0.0) * moves
            )
        assert np.abs(alone - exact).max() > 2e-4
        np.testing.assert_allclose(alone + whole[:SKIN], exact, atol=5e-5)


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("evaluate", {"states": [{"noseLenght": 1}]}, "did you mean noseLength"),
        ("evaluate", {"states": [{"noseLength": 7}]}, "must lie in"),
        ("evaluate", {"states": [{"noseLength": "1"}]}, "weights are numbers"),
        ("evaluate", {"states": []}, "states are 1 to"),
        ("evaluate", {"states": [{}], "rows": 5000, "columns": 5000}, "export finer meshes"),
        ("evaluate", {"states": [{}], "rows": "a"}, "whole numbers"),
        ("response", {"handles": [[99, 0, 1.0]]}, "a curve of 0 to 27"),
        ("response", {"handles": 3}, "handles are a list"),
        ("edit", {"moves": [[0, 0, 5.0, 0, 0]]}, "by a metre at most"),
        ("edit", {"moves": [[0, 0, "x", 0, 0]]}, "three numbers"),
        ("edit", {"moves": {"a": 1}}, "moves are a list"),
    ],
)
def test_nonsense_is_refused_in_a_line(visitor, name: str, value, message: str) -> None:
    assert message in visitor.refused(name, **value)


def test_the_paper_s_join_is_evaluated_as_well(visitor, unpack) -> None:
    weights = LINEAR
    size = {"rows": ROWS, "columns": COLUMNS, "join": "patchwise"}
    asked = unpack(visitor.post("evaluate", states=[weights], join="patchwise"))
    answer = visitor.client.get(visitor.path("model.glb"), params=size)
    assert answer.content.startswith(b"glTF")
    columns = unpack(visitor.client.get(visitor.path("columns"), params=size).content)
    rest = unpack(visitor.post("evaluate", states=[{}], join="patchwise"))["positions"][0]
    found = asked["positions"][0]
    skin = pdeface.neutral().set(**weights).mesh(28, 41, join="patchwise").vertices
    np.testing.assert_allclose(found[: len(skin)], skin, atol=1e-6)
    # No openings, so nothing behind them: the skin and the curves are all there is.
    assert len(found) == len(skin) + 28 * 46
    np.testing.assert_allclose(rest[: len(skin)] + added(columns, weights), skin, atol=ALIKE)


def test_another_join_is_refused(visitor) -> None:
    assert "'smooth' or 'patchwise'" in visitor.refused("evaluate", states=[{}], join="loose")
