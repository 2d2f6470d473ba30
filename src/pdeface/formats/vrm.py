"""VRM 1.0, the format of avatars: a GLB that says which node is the head and how it smiles.

Specification: https://github.com/vrm-c/vrm-specification/tree/master/specification/VRMC_vrm-1.0
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from pdeface.controls.arkit import EYE_RANGE
from pdeface.controls.neck import PIVOT
from pdeface.controls.presets import VRM_PRESETS
from pdeface.face import Face
from pdeface.files import PathLike, atomic_write
from pdeface.formats._gltf_builder import GltfBuilder
from pdeface.formats._skeleton import HEAD_IN_NECK, add_skeleton
from pdeface.formats._targets import MorphTargets
from pdeface.formats.gltf import add_face, begin
from pdeface.template import feature_points

__all__ = ["add_vrm", "build_vrm", "write_vrm"]

Json = dict[str, Any]

LICENCE = "https://vrm.dev/licenses/1.0/"
"""The one licence of VRM 1.0; what it permits depends on the other statements."""

_EYES = ("right_eye_middle", "left_eye_middle")


def write_vrm(face: Face, targets: MorphTargets, path: PathLike) -> None:
    """Write an avatar with its texture embedded.

    Raises:
        InputError: more than 4 GiB, or a place that cannot be written.
    """
    atomic_write(path, build_vrm(face, targets).to_glb())


def build_vrm(face: Face, targets: MorphTargets) -> GltfBuilder:
    """The document of :func:`~pdeface.formats.gltf.build_gltf` with a body below the head.

    Args:
        face: whose texture, name and notes go into the file.
        targets: the mesh, and the expressions that move it.
    """
    document = begin(face)
    head, node = add_face(document, face, targets, at=HEAD_IN_NECK)
    root, bones = add_skeleton(document, head)
    document.add("scenes", nodes=[root])
    add_vrm(document, targets.face, targets.names, node, bones)
    return document


def add_vrm(
    document: GltfBuilder, face: Face, names: Sequence[str], node: int, bones: Mapping[str, int]
) -> None:
    """Add the extension: who may use it, which node is what, what the morph targets mean.

    Args:
        document: to which it is added.
        face: at rest.
        names: the morph targets of the face's mesh, in their order.
        node: that shows this mesh.
        bones: node by name of bone.
    """
    document.extensions["VRMC_vrm"] = {
        "specVersion": "1.0",
        "meta": _meta(face),
        "humanoid": {"humanBones": {name: {"node": bone} for name, bone in bones.items()}},
        "firstPerson": {"meshAnnotations": [{"node": node, "type": "thirdPersonOnly"}]},
        "expressions": _expressions(names, node),
        "lookAt": _look_at(face),
    }


def _meta(face: Face) -> Json:
    """What VRM wants said of an avatar. Whose face this is we cannot know, so nothing is allowed
    that its owner does not allow: these are the specification's own defaults, spelt out."""
    meta: Json = {
        "name": face.name or "face",
        "authors": [face.notes.get("author") or "unknown"],
        "licenseUrl": LICENCE,
        "avatarPermission": "onlyAuthor",
        "allowExcessivelyViolentUsage": False,
        "allowExcessivelySexualUsage": False,
        "commercialUsage": "personalNonProfit",
        "allowPoliticalOrReligiousUsage": False,
        "allowAntisocialOrHateUsage": False,
        "creditNotation": "required",
        "allowRedistribution": False,
        "modification": "prohibited",
    }
    if "copyright" in face.notes:
        meta["copyrightInformation"] = face.notes["copyright"]
    return meta


def _expressions(names: Sequence[str], node: int) -> Json:
    """The presets that these targets can make, and each target by its own name."""
    places = {name: index for index, name in enumerate(names)}

    def bound(weights: Mapping[str, float]) -> Json:
        binds = [{"node": node, "index": places[n], "weight": w} for n, w in weights.items()]
        return {"isBinary": False, **({"morphTargetBinds": binds} if binds else {})}

    # Half a smile would be another expression, so a preset is whole or not there.
    possible = {name: w for name, w in VRM_PRESETS.items() if set(w) <= set(places)}
    presets = {name: {**bound(w), **_overrides(name, w)} for name, w in possible.items()}
    return {"preset": presets, "custom": {name: bound({name: 1.0}) for name in names}}


def _overrides(name: str, weights: Mapping[str, float]) -> Json:
    """Lids that an emotion has lowered already would be driven through the cheeks by a blink."""
    lowers = "eyeBlinkLeft" in weights and not name.startswith("blink")
    return {"overrideBlink": "blend"} if lowers else {}


def _look_at(face: Face) -> Json:
    """Where the eyes are and how far they turn; they do so by the presets ``look...``."""
    places, surface = feature_points(), face.surface()
    right, left = (surface(*places[eye]) for eye in _EYES)
    middle = 0.5 * (right + left) - PIVOT
    ranges = {"inputMaxValue": round(math.degrees(EYE_RANGE), 3), "outputScale": 1.0}
    sides = ("HorizontalInner", "HorizontalOuter", "VerticalDown", "VerticalUp")
    return {
        "type": "expression",
        "offsetFromHeadBone": [round(x, 6) for x in middle.tolist()],
        **{f"rangeMap{side}": ranges for side in sides},
    }
