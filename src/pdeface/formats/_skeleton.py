"""The bones that a humanoid avatar must have, as empty nodes in a T-pose.

An adult 1.7 metres tall, feet on the ground, palms towards it, facing +Z. The head, which is one of
them, comes with its face. Of the others nothing is seen: programs for avatars ask for a body to
turn.
"""

from __future__ import annotations

from pdeface.formats._gltf_builder import GltfBuilder

__all__ = ["HEAD_IN_NECK", "add_skeleton"]

Triple = tuple[float, float, float]

_NECK: Triple = (0.0, 1.39, 0.0)
_HEAD: Triple = (0.0, 1.47, 0.0)

# (parent, place in the model, metres) of each bone, parents first; of pairs, the left one.
_MIDDLE: dict[str, tuple[str, Triple]] = {
    "hips": ("root", (0.0, 0.92, 0.0)),
    "spine": ("hips", (0.0, 1.02, 0.0)),
    "chest": ("spine", (0.0, 1.15, 0.0)),
    "neck": ("chest", _NECK),
}
_PAIRS: dict[str, tuple[str, Triple]] = {
    "UpperArm": ("chest", (0.17, 1.36, 0.0)),
    "LowerArm": ("UpperArm", (0.44, 1.36, 0.0)),
    "Hand": ("LowerArm", (0.69, 1.36, 0.0)),
    "UpperLeg": ("hips", (0.09, 0.88, 0.0)),
    "LowerLeg": ("UpperLeg", (0.09, 0.47, 0.0)),
    "Foot": ("LowerLeg", (0.09, 0.08, 0.0)),
}

HEAD_IN_NECK: Triple = (_HEAD[0] - _NECK[0], _HEAD[1] - _NECK[1], _HEAD[2] - _NECK[2])
"""Where the head's node lies in the neck's, metres."""


def add_skeleton(document: GltfBuilder, head: int) -> tuple[int, dict[str, int]]:
    """Add all bones but the head, and hang the head from them.

    Args:
        document: to which they are added.
        head: the node of the head, at :data:`HEAD_IN_NECK` and without a parent.

    Returns:
        The root, which stands on the ground, and the node of each bone by its name in VRM.
    """
    bones = _bones()
    nodes = {"head": head}
    # A node names its children, so that these are added first.
    for name in reversed(bones):
        children = [nodes[child] for child in bones if bones[child][0] == name]
        children += [head] if name == "neck" else []
        nodes[name] = document.add(
            "nodes", name=name, translation=_offset(bones, name), children=children or None
        )
    hips = nodes["hips"]
    return document.add("nodes", name="root", children=[hips]), nodes


def _bones() -> dict[str, tuple[str, Triple]]:
    bones = dict(_MIDDLE)
    for side, sign in (("left", 1.0), ("right", -1.0)):
        for name, (parent, (x, y, z)) in _PAIRS.items():
            above = side + parent if parent in _PAIRS else parent
            bones[side + name] = (above, (sign * x, y, z))
    return bones


def _offset(bones: dict[str, tuple[str, Triple]], name: str) -> list[float]:
    """Where a bone lies in its parent, metres; to a micrometre, free of the dust of subtraction."""
    parent, place = bones[name]
    origin = bones[parent][1] if parent in bones else (0.0, 0.0, 0.0)
    return [round(a - b, 6) for a, b in zip(place, origin, strict=True)]
