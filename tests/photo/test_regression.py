"""The regression finds what it was taught, levels what is tilted, and treats both sides alike."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("scipy", reason="needs the extra 'template'")

from pdeface.photo import portrait_face, regression
from pdeface.photo.build import jointly, learning
from pdeface.photo.build.learning import Rows, learn, mirror_signs, write
from pdeface.photo.mirrors import partners
from pdeface.photo.regression import (
    Learnt,
    expected_identity,
    features,
    learnt,
    levelled,
    regressors,
)
from pdeface.photo.traits import Reading, traits_of


def test_what_ships_has_the_shapes_it_says() -> None:
    known = learnt()
    ways, others = len(known.modes), len(known.centre)
    assert known.mean.shape == (478, 3)
    assert known.modes.shape == (ways, 3 * 478)
    inputs = regressors(np.zeros((1, ways)), np.zeros((1, others)))
    assert known.readout.shape == (2, 2, inputs.shape[1], 50)
    assert known.variance.shape == known.common.shape == (2, 50, 50)
    assert np.linalg.eigvalsh(known.variance).min() > 0.0


def test_ways_count_by_pose_as_well() -> None:
    known = learnt()
    ways, others = np.zeros(len(known.modes)), np.zeros(len(known.centre))
    ways[3] = 2.0
    ahead = regressors(ways, others)
    others[0] = 0.5
    aside = regressors(ways, others)
    changed = np.flatnonzero(ahead != aside)
    np.testing.assert_allclose(sorted(aside[changed]), [0.5, 1.0])


def test_levelling_undoes_turn_size_and_place() -> None:
    mean, angle = learnt().mean, 0.3
    c, s = np.cos(angle), np.sin(angle)
    turn = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    marks, back, size = levelled(7.0 * mean @ turn + (3.0, 2.0, 1.0), mean)
    np.testing.assert_allclose(marks, mean - mean.mean(axis=0), atol=1e-9)
    np.testing.assert_allclose(turn @ back, np.eye(3), atol=1e-9)
    assert size == pytest.approx(7.0)


def test_turning_or_enlarging_a_photo_changes_nothing() -> None:
    face = portrait_face()
    turned = face.landmarks.copy()
    turned[:, :2] = 2.0 * turned[:, :2] @ ((0.0, 1.0), (-1.0, 0.0))
    turned[:, 2] *= 2.0
    same = replace(face, landmarks=turned)
    one, other = (expected_identity([f], [None]) for f in (face, same))
    np.testing.assert_allclose(one, other, atol=1e-6)


def test_a_mirrored_photo_is_of_the_mirrored_person() -> None:
    face, other = portrait_face(), partners(learnt().mean)
    scores = {n.replace("Left", "-").replace("Right", "Left").replace("-", "Right"): v
              for n, v in face.scores.items()}  # fmt: skip
    marks = face.landmarks[other] * (-1.0, 1.0, 1.0)
    assert face.traits is not None
    for traits in (None, face.traits):
        turned = None if traits is None else traits * mirror_signs()
        image = replace(face, landmarks=marks, scores=scores, traits=turned)
        own = replace(face, traits=traits)
        found, mirrored = (expected_identity([f], [None]) for f in (own, image))
        np.testing.assert_allclose(mirrored, found * mirror_signs(), atol=0.05)


def test_traits_are_added_to_what_landmarks_say_beside_them() -> None:
    face = portrait_face()
    assert face.traits is not None
    one, other = (
        expected_identity([replace(face, traits=traits)], [None])
        for traits in (face.traits, face.traits + np.eye(50)[3])
    )
    variance = learnt().variance[1]
    kept = variance @ np.linalg.inv(variance + regression._STRANGE * np.eye(50))
    np.testing.assert_allclose(other - one, kept[:, 3], atol=1e-9)
    assert 0.5 < kept[3, 3] < 1.0
    without = replace(face, traits=None)
    np.testing.assert_allclose(
        expected_identity([face, without], [None, None]),
        expected_identity([without, without], [None, None]),
    )


def test_what_depends_on_features_linearly_is_learnt(monkeypatch, tmp_path) -> None:
    """Landmarks tell six weights of people kept out, an inner layer of twenty values four more."""
    rng = np.random.default_rng(0)
    monkeypatch.setattr(learning, "RIDGE", 1e-4)
    monkeypatch.setattr(learning, "WAYS", 6)
    monkeypatch.setattr(jointly, "COST", 1e-4)
    identity = rng.normal(size=(600, 50))
    identity[300:] = identity[:300] * mirror_signs()
    ways = rng.normal(size=(6, 3 * 478)) / 500.0
    others = rng.normal(size=(600, 58))
    inner = np.repeat((identity[:, 6:10] @ rng.normal(size=(4, 20)))[:, None], 2, axis=1)
    rows = Rows(identity[:, :6] @ ways, others, identity, np.arange(600) % 300 // 2, inner)
    found, reading, held = learn(rows, learnt().mean)
    half = identity[:300]
    alone, beside = (1.0 - ((each - half) ** 2).mean(axis=0) / (half**2).mean(axis=0)
                     for each in held)  # fmt: skip
    assert alone[:6].min() > 0.95
    assert alone[6:].max() < 0.1
    assert beside[:10].min() > 0.95
    assert beside[10:].max() < 0.1
    write(tmp_path / "identity.npz", found)
    write(tmp_path / "traits.npz", reading)
    for name, kind in (("identity", Learnt), ("traits", Reading)):
        with np.load(tmp_path / f"{name}.npz") as file:
            assert set(file.files) == set(kind._fields)
    read = traits_of(np.stack([inner[:300, 0], inner[300:, 0]], axis=1), reading)
    left = half[:, 6:10] - read[:, 6:10]
    assert (left.var(axis=0) / half[:, 6:10].var(axis=0)).max() < 0.05


def test_a_longer_lens_is_told_by_its_feature_alone() -> None:
    face, mean = portrait_face(), learnt().mean
    (near, one), (far, other) = (features(face, focal, mean) for focal in (300.0, 900.0))
    np.testing.assert_array_equal(near, far)
    np.testing.assert_array_equal(one[:-1], other[:-1])
    assert one[-1] == pytest.approx(3.0 * other[-1])
