"""A forward pass of FLAME's size in numpy, with random numbers: what a frame of it costs.

5,023 vertices; 150 shape directions (100 of identity, 50 of expression); 36 pose correctives (the
rotations of four joints less the identity); five joints, regressed from the shaped vertices;
linear blend skinning. The steps are those of the model's paper (Li, Bolkart, Black, Li and Romero,
ACM Transactions on Graphics 36(6), 2017) and of SMPL, on which it builds. Single precision.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

VERTICES, IDENTITIES, EXPRESSIONS, JOINTS = 5023, 100, 50, 5
PARENTS = (-1, 0, 1, 1, 1)
"""The root, the neck on it, and jaw and eyes on the neck."""

Array = NDArray[np.float32]


class Flame:
    """Coefficients and joint rotations to vertices."""

    def __init__(self, seed: int = 0) -> None:
        rng = np.random.default_rng(seed)

        def drawn(*shape: int) -> Array:
            return rng.standard_normal(shape, np.float32) * np.float32(0.01)

        self.template = drawn(VERTICES, 3)
        self.shapes = drawn(VERTICES * 3, IDENTITIES + EXPRESSIONS)
        self.correctives = drawn(VERTICES * 3, 9 * (JOINTS - 1))
        regressor = rng.random((JOINTS, VERTICES), np.float32)
        self.regressor = regressor / regressor.sum(axis=1, keepdims=True)
        skin = rng.random((VERTICES, JOINTS), np.float32)
        self.skin = skin / skin.sum(axis=1, keepdims=True)

    def __call__(self, coefficients: Array, pose: Array) -> Array:
        """(5023, 3) vertices for (150,) coefficients and (5, 3) axes times angles."""
        shaped = self.template + (self.shapes @ coefficients).reshape(-1, 3)
        turns = rotations(pose)
        feature = (turns[1:] - np.eye(3, dtype=np.float32)).reshape(-1)
        posed = shaped + (self.correctives @ feature).reshape(-1, 3)
        transforms = chain(turns, self.regressor @ shaped)
        blended = (self.skin @ transforms.reshape(JOINTS, 12)).reshape(-1, 3, 4)
        return (blended[..., :3] @ posed[..., None])[..., 0] + blended[..., 3]


def rotations(pose: Array) -> Array:
    """(J, 3, 3) rotations of axes times angles, by Rodrigues' formula."""
    angle = np.sqrt((pose * pose).sum(axis=1)) + np.float32(1e-8)
    x, y, z = (pose / angle[:, None]).T
    none = np.zeros_like(x)
    cross = np.stack([none, -z, y, z, none, -x, -y, x, none], axis=1).reshape(-1, 3, 3)
    sine, cosine = np.sin(angle)[:, None, None], np.cos(angle)[:, None, None]
    return np.eye(3, dtype=np.float32) + sine * cross + (1 - cosine) * (cross @ cross)


def chain(turns: Array, joints: Array) -> Array:
    """(J, 3, 4) transforms of each joint along the tree, relative to the pose at rest."""
    world = np.zeros((JOINTS, 4, 4), np.float32)
    for joint, parent in enumerate(PARENTS):
        own = np.eye(4, dtype=np.float32)
        own[:3, :3] = turns[joint]
        own[:3, 3] = joints[joint] - (joints[parent] if parent >= 0 else 0)
        world[joint] = own if parent < 0 else world[parent] @ own
    result = world[:, :3].copy()
    result[..., 3] -= (world[:, :3, :3] @ joints[..., None])[..., 0]
    return result
