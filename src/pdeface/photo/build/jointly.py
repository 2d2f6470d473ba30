"""A ridge regression on the network's inner layer and on landmarks at once.

The layer has thousands of values, so that sums of products are kept by folds: what a fold's people
are told by the others' takes one more solution, and no pass over the samples.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ["Joint", "fit_jointly", "folds_of"]

FloatArray = NDArray[np.float64]
Floats = NDArray[np.floating]

COST = 0.04
"""What squared coefficients cost, where the features have the variance 1. Less is a
little better for people kept out; with a quarter of the people, those with a kind of skin that was
kept out wanted four times what the rest did."""

SHARE = 1.0
"""What a landmark's feature is multiplied by beside one of the layer's."""

FOLDS = 5
_FLOOR = 0.01
"""Part of the usual standard deviation of the layer's values that is added to each."""

_CHUNK = 2000


class Joint(NamedTuple):
    """What was learnt.

    Attributes:
        centre, spread: (f,) means of the layer's values, and what they are divided by.
        weights: (f, 50) of these in the identity modes.
        readout: (r, 50) of the landmarks' regressors.
    """

    centre: FloatArray
    spread: FloatArray
    weights: FloatArray
    readout: FloatArray

    def __call__(self, inner: Floats, regressors: FloatArray) -> FloatArray:
        """(n, 50) identities."""
        told = ((inner - self.centre) / self.spread).astype(np.float32) @ self.weights
        return np.asarray(told + regressors @ self.readout)


def folds_of(person: NDArray[np.int64]) -> list[NDArray[np.bool_]]:
    """Which samples are in each fold; a person is in one."""
    return [person % FOLDS == fold for fold in range(FOLDS)]


def fit_jointly(
    inner: Floats, regressors: FloatArray, identity: FloatArray, person: NDArray[np.int64]
) -> tuple[Joint, FloatArray]:
    """The regression, and (n, 50) what it says of each sample's person without having seen them.

    Args:
        inner: (n, s, f) the layer's values in s versions of each sample's picture.
        regressors: (n, r) the landmarks', of which the first is 1.
        identity: (n, 50) the truth.
        person: (n,) whose it is.
    """
    centre, spread = _standards(inner)
    sizes = np.full(regressors.shape[1], SHARE)
    sizes[0] = 1.0

    def sums(some: NDArray[np.bool_]) -> tuple[Floats, Floats]:
        return _sums((inner[some] - centre) / spread, sizes * regressors[some], identity[some])

    def solved(gram: Floats, products: Floats, count: int) -> Joint:
        cost = np.full(len(gram), COST * count * inner.shape[1], np.float32)
        cost[len(centre)] = 0.0  # the one of the constant
        found = np.linalg.solve(gram + np.diag(cost), products).astype(np.float64)
        return Joint(centre, spread, found[: len(centre)],
                     sizes[:, None] * found[len(centre) :])  # fmt: skip

    folds = folds_of(person)
    parts = [sums(fold) for fold in folds]
    gram, products = (sum(each) for each in zip(*parts, strict=True))
    held = np.zeros_like(identity)
    for out, (own, own_products) in zip(folds, parts, strict=True):
        if out.any():
            others = solved(gram - own, products - own_products, int((~out).sum()))
            held[out] = others(inner[out, 0], regressors[out])
    return solved(gram, products, len(inner)), held


def _standards(inner: Floats) -> tuple[FloatArray, FloatArray]:
    """(f,) each: the mean of each value of the layer, and what it is divided by."""
    plain = inner.reshape(-1, inner.shape[-1])
    sums, squares = np.zeros((2, plain.shape[1]))
    for start in range(0, len(plain), _CHUNK):
        some = plain[start : start + _CHUNK].astype(np.float64)
        sums += some.sum(axis=0)
        squares += (some**2).sum(axis=0)
    centre = sums / len(plain)
    spread = np.sqrt(np.maximum(squares / len(plain) - centre**2, 0.0))
    return centre, spread + _FLOOR * np.median(spread)


def _sums(inner: Floats, regressors: FloatArray, identity: FloatArray) -> tuple[Floats, Floats]:
    """(f + r, f + r) and (f + r, 50) sums of products over all versions of some samples."""
    size = inner.shape[-1] + regressors.shape[1]
    gram = np.zeros((size, size), np.float32)
    products = np.zeros((size, identity.shape[1]), np.float32)
    for start in range(0, len(inner), _CHUNK):
        some = slice(start, start + _CHUNK)
        for version in range(inner.shape[1]):
            x = np.hstack([inner[some, version], regressors[some]]).astype(np.float32)
            gram += x.T @ x
            products += x.T @ identity[some].astype(np.float32)
    return gram, products
