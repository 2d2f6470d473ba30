"""Learn the regression of :mod:`pdeface.photo.regression` from samples.

Every sample is taken with its mirror image: half as much chance, and no preference for a side.
"""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pdeface.controls.measured import IDENTITIES, identities
from pdeface.files import atomic_path
from pdeface.photo.build.jointly import Joint, fit_jointly, folds_of
from pdeface.photo.build.samples import Numbers
from pdeface.photo.found import PhotoFace
from pdeface.photo.mirrors import ACROSS, other_side, partners
from pdeface.photo.regression import Learnt, features, levelled, regressors, score_names
from pdeface.photo.traits import Reading

__all__ = ["Held", "Rows", "learn", "mean_landmarks", "rows_of", "write"]

FloatArray = NDArray[np.float64]

WAYS = 100
"""Principal ways in which landmarks differ that are looked at."""

RIDGE = 0.05
"""What squared coefficients cost, where the features have the variance 1; by cross-validation."""

_STORED = {"modes": np.float16, "readout": np.float16, "weights": np.int8}
_AXES = np.array([1.0, -1.0, -1.0])


class Rows(NamedTuple):
    """Samples as the regression sees them.

    Attributes:
        marks: (n, 1434) how levelled landmarks differ from their mean.
        others: (n, f) the other features.
        identity: (n, 50) the weights to be found.
        person: (n,) whose they are.
        inner: (n, 2, 8192) what the network makes of the picture, and of it spoiled.
    """

    marks: FloatArray
    others: FloatArray
    identity: FloatArray
    person: NDArray[np.int64]
    inner: NDArray[np.floating]


class Held(NamedTuple):
    """(n, 50) what is said of people kept out, by landmarks alone and beside the traits."""

    alone: FloatArray
    beside: FloatArray


def mean_landmarks(samples: Numbers) -> FloatArray:
    """(478, 3) mean of all levelled landmarks, its own mirror image, looking ahead."""
    left, _, right = np.linalg.svd(samples["pose"][:, :3, :3])
    marks = samples["landmarks"] * _AXES
    ahead = np.einsum("nki,nij->nkj", marks - marks.mean(axis=1, keepdims=True), left @ right)
    mean = np.mean(ahead / np.linalg.norm(ahead, axis=(1, 2), keepdims=True), axis=0)
    other = partners(mean)
    for _ in range(4):
        mean = 0.5 * (mean + mean[other] * ACROSS)
        mean = mean / np.linalg.norm(mean)
        mean = np.mean([levelled(m, mean)[0] for m in marks], axis=0)
    mean = 0.5 * (mean + mean[other] * ACROSS)
    return np.asarray(mean / np.linalg.norm(mean))


def rows_of(samples: Numbers, mean: FloatArray) -> Rows:
    """All samples, and after them their mirror images."""
    names = score_names()
    order, other = [names.index(other_side(name)) for name in names], partners(mean)
    marks, others = [], []
    for mirror in (False, True):
        for points, scores, focal in zip(
            samples["landmarks"].astype(np.float64),
            samples["scores"],
            samples["focal"],
            strict=True,
        ):
            if mirror:
                points, scores = points[other] * ACROSS, scores[order]
            named = dict(zip(names, scores.tolist(), strict=True))
            face = PhotoFace(points, named, np.eye(4), (1, 1))
            shape, rest = features(face, float(focal), mean)
            marks.append(shape)
            others.append(rest)
    weights = samples["identity"][:, :IDENTITIES]
    identity = np.concatenate([weights, weights * mirror_signs()])
    inner = samples["inner"]
    return Rows(
        marks=np.array(marks),
        others=np.array(others),
        identity=identity,
        person=np.tile(samples["person"], 2),
        inner=np.concatenate([inner[:, [0, 2]], inner[:, [1, 3]]]),
    )


def mirror_signs() -> FloatArray:
    """(50,) 1 for modes that are their own mirror image, -1 for those that are its negative."""
    signs = []
    for mode in range(IDENTITIES):
        moved = identities({mode: 1.0}, (28, 46))
        front = moved[:, : moved.shape[1] // 2]
        signs.append(np.sign(np.sum(front * front[:, ::-1] * ACROSS)))
    return np.array(signs)


def learn(rows: Rows, mean: FloatArray) -> tuple[Learnt, Reading, Held]:
    """The regression, the reading of traits, and what they say of people they have not seen."""
    _, sizes, ways = np.linalg.svd(rows.marks, full_matrices=False)
    modes = ways[:WAYS] / (sizes[:WAYS, None] / np.sqrt(len(rows.marks)))
    centre, spread = rows.others.mean(axis=0), rows.others.std(axis=0)
    spread = np.where(spread > 0.0, spread, 1.0)
    others = (rows.others - centre) / spread
    unfocused = others.copy()
    unfocused[:, -1] = 0.0
    full, blind = (regressors(rows.marks @ modes.T, each) for each in (others, unfocused))
    alone = np.zeros_like(rows.identity)
    for out in folds_of(rows.person):
        alone[out] = full[out] @ _ridge(full[~out], rows.identity[~out])
    joint, beside = fit_jointly(rows.inner, full, rows.identity, rows.person)
    half, signs = len(beside) // 2, mirror_signs()
    held = Held(alone[:half], 0.5 * (beside[:half] + signs * beside[half:]))
    # How a mirror changes the regressors: traits are means of both sides, and so are these.
    mirror = np.linalg.lstsq(full[:half], full[half:], rcond=None)[0]
    even = 0.5 * (joint.readout + mirror @ joint.readout * signs)
    readout = [[_ridge(x, rows.identity) for x in (blind, full)], [even] * 2]
    agreements = zip(*(_agreement(each, rows.person) for each in held), strict=True)
    variance, common = map(np.array, agreements)
    known = Learnt(mean, modes, centre, spread, np.array(readout), variance, common)
    return known, _reading(joint, signs), held


def _reading(joint: Joint, signs: FloatArray) -> Reading:
    scale = np.abs(joint.weights).max(axis=0) / 127.0
    weights = np.rint(joint.weights / scale).astype(np.int8)
    return Reading(joint.centre, joint.spread, weights, scale, signs)


def _ridge(x: FloatArray, y: FloatArray) -> FloatArray:
    cost = np.full(x.shape[1], RIDGE * len(x))
    cost[0] = 0.0
    return np.asarray(np.linalg.solve(x.T @ x + np.diag(cost + 1e-9), x.T @ y))


def _agreement(held: FloatArray, person: NDArray[np.int64]) -> tuple[FloatArray, FloatArray]:
    """(50, 50) covariances of what is read out of one photo, and between two of one person.

    Both of the people of whom there are several pictures, and of their mirror images.
    """
    pairs = [(i, j) for i in range(len(held)) for j in (i + 1, i + 2)
             if j < len(held) and person[i] == person[j]]  # fmt: skip
    one, other = np.array(pairs).T
    several = held[np.union1d(one, other)]
    variance = several.T @ several / len(several)
    common = held[one].T @ held[other] / len(one)
    signs = mirror_signs()
    alike = 0.5 * (1.0 + np.outer(signs, signs))  # a mirror turns all other entries about
    return alike * variance, alike * 0.5 * (common + common.T)


def write(path: Path, learnt: Learnt | Reading) -> None:
    """Write what ships."""
    numbers = {name: value.astype(_STORED.get(name, np.float32))
               for name, value in learnt._asdict().items()}  # fmt: skip
    with atomic_path(path) as temporary, open(temporary, "wb") as file:
        np.savez_compressed(file, **numbers)
