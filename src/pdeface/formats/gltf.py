"""glTF 2.0, as one binary file (GLB) or as JSON with everything inside it (.gltf)."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pdeface.controls.neck import PIVOT
from pdeface.errors import MissingExtraError
from pdeface.face import Face
from pdeface.files import PathLike, atomic_write
from pdeface.formats._animation import Animation, add_animation
from pdeface.formats._gltf_builder import GltfBuilder
from pdeface.formats._parts import PartSample, sampled_parts
from pdeface.formats._sample import Sample
from pdeface.formats._shared import GENERATOR, ROUGHNESS, SKIN, linear
from pdeface.formats._targets import MorphTargets
from pdeface.images import encode_compact, encode_plain, has_holes, media_type

__all__ = ["add_face", "begin", "build_gltf", "write_glb", "write_gltf"]

Triple = tuple[float, float, float]

_LINEAR, _LINEAR_MIPMAP_LINEAR, _CLAMP_TO_EDGE = 9729, 9987, 33071

MATT = frozenset({"mouth", "lids"})
"""Parts so dark or so narrow that their normals may stay as they are: a third of a file's bytes."""

PART_ROUGHNESS = {"eye": 0.15, "lids": 0.6, "mouth": 0.5, "teeth": 0.3, "tongue": 0.45}
"""Of what is wet, and shines."""

STILL = 1e-6
"""Metres that a vertex may be moved by an expression and be stored as not moved by it."""

STILL_BEHIND = 5e-5
"""The like for the rims of the lids, the mouth and all else behind the skin."""

UNTURNED = 3e-3
"""The like for unit normals. It changes shading by three quarters of a grey level of 256 at most,
on the few vertices that an expression turns by a sixth of a degree and no more."""


def write_glb(
    face: Face, targets: MorphTargets, path: PathLike, animation: Animation | None = None
) -> None:
    """Write a GLB with its texture embedded.

    Raises:
        InputError: more than 4 GiB, an animation of nothing, or a place that cannot be written.
    """
    atomic_write(path, build_gltf(face, targets, animation).to_glb())


def write_gltf(
    face: Face, targets: MorphTargets, path: PathLike, animation: Animation | None = None
) -> None:
    """Write a .gltf with buffer and texture embedded.

    Raises:
        InputError: an animation of nothing, or a place that cannot be written.
    """
    atomic_write(path, build_gltf(face, targets, animation).to_gltf())


def build_gltf(
    face: Face, targets: MorphTargets, animation: Animation | None = None
) -> GltfBuilder:
    """The document: one scene, the head, below it the face, one mesh of one primitive.

    Args:
        face: whose texture, name and notes go into the file.
        targets: the mesh, and the expressions that move it.
        animation: what they and the head do over time.

    Raises:
        InputError: the animation moves none of them and no head.
    """
    document = begin(face)
    head, node = add_face(document, face, targets)
    if animation is not None:
        add_animation(document, animation, targets.names, targets.weights, node, head)
    document.add("scenes", nodes=[head])
    return document


def begin(face: Face) -> GltfBuilder:
    """A document without objects that says who made it, and whose the face is."""
    document = GltfBuilder(GENERATOR)
    if "copyright" in face.notes:
        document.asset["copyright"] = face.notes["copyright"]
    return document


def add_face(
    document: GltfBuilder, face: Face, targets: MorphTargets, at: Triple = PIVOT
) -> tuple[int, int]:
    """Add the face, and above it the head: a node that turns about the neck.

    A node turns about its own origin, so that the head is a node in the neck, and the face one
    below it that is moved back by as much.

    Args:
        document: to which they are added.
        face: whose texture and name go into the file.
        targets: the mesh, and the expressions that move it.
        at: where the neck is in the node that the head will belong to, metres; by default where
            the face is then in its own frame.

    Returns:
        The nodes of the head and of the face.
    """
    name = face.name or "face"
    primitive = _add_primitive(
        document, targets.raised or targets.surface, _add_material(document, face)
    )
    morphs: dict[str, Any] = {}
    if targets.names:
        primitive["targets"] = _add_targets(
            document, targets.differences(), len(targets.surface.vertices), STILL
        )
    primitives = [primitive, *add_parts(document, targets)]
    if targets.names:
        # The specification has no place for names; this one every program knows.
        morphs = {"weights": targets.weights, "extras": {"targetNames": targets.names}}
    mesh = document.add("meshes", name=name, primitives=primitives, **morphs)
    back = [0.0 - coordinate for coordinate in PIVOT]
    node = document.add("nodes", name=name, mesh=mesh, translation=back)
    return document.add("nodes", name="head", translation=list(at), children=[node]), node


def add_parts(document: GltfBuilder, targets: MorphTargets) -> Iterator[dict[str, Any]]:
    """Add what lies behind the openings of the face: a primitive each, with the same targets."""
    materials: dict[bytes, int] = {}
    for part in sampled_parts(targets):
        key = part.texture.tobytes()
        if key not in materials:
            materials[key] = _add_part_material(document, part)
        primitive = _add_primitive(document, part, materials[key])
        if targets.names:
            primitive["targets"] = _add_targets(
                document,
                part.differences,
                len(part.vertices),
                STILL_BEHIND,
                part.material not in MATT,
            )
        yield primitive


def _add_part_material(document: GltfBuilder, part: PartSample) -> int:
    surface = {
        "metallicFactor": 0.0,
        "roughnessFactor": PART_ROUGHNESS[part.material],
        "baseColorTexture": {"index": _add_image(document, _encoded(part.texture))},
    }
    return document.add("materials", name=part.material, pbrMetallicRoughness=surface)


@lru_cache(maxsize=32)
def _encoded_bytes(shape: tuple[int, ...], pixels: bytes) -> bytes:
    texture = np.frombuffer(pixels, np.uint8).reshape(shape)
    try:
        return encode_compact(texture)
    except MissingExtraError:
        return encode_plain(texture)


def _encoded(texture: NDArray[np.uint8]) -> bytes:
    """A picture file of a part's texture, which is the same for many faces."""
    return _encoded_bytes(texture.shape, texture.tobytes())


def _add_primitive(
    document: GltfBuilder, surface: Sample | PartSample, material: int
) -> dict[str, Any]:
    return {
        "attributes": {
            "POSITION": document.add_accessor(surface.vertices, "vertices", bounds=True),
            "NORMAL": document.add_accessor(surface.normals, "vertices"),
            "TEXCOORD_0": document.add_accessor(surface.texcoords, "vertices"),
        },
        "indices": document.add_indices(surface.triangles, len(surface.vertices)),
        "material": material,
    }


def _add_targets(
    document: GltfBuilder,
    differences: Iterable[tuple[NDArray[np.float32], NDArray[np.float32]] | None],
    count: int,
    still: float,
    normals: bool = True,
) -> list[dict[str, int]]:
    """Positions and normals of each target; all targets that move nothing are one accessor."""
    targets: list[dict[str, int]] = []
    nothing: dict[str, int] = {}
    for difference in differences:
        if difference is None and nothing:
            targets.append(nothing)
            continue
        moved, turned = difference or (np.zeros((count, 3), np.float32),) * 2
        target = {"POSITION": document.add_differences(moved, still, bounds=True)}
        if normals:
            target["NORMAL"] = document.add_differences(turned, UNTURNED)
        targets.append(target)
        if difference is None:
            nothing = targets[-1]
    return targets


def _add_material(document: GltfBuilder, face: Face) -> int:
    surface: dict[str, object] = {"metallicFactor": 0.0, "roughnessFactor": ROUGHNESS}
    texture = _add_texture(document, face)
    if texture is None:
        surface["baseColorFactor"] = [*(round(linear(c), 4) for c in SKIN), 1.0]
    else:
        surface["baseColorTexture"] = {"index": texture}
    # A face is a mask: seen from behind, it would otherwise be gone. Texels are there or not,
    # so that blending, and the sorting it needs in a viewer, would be of no use.
    cut_out = face.texture is not None and has_holes(face.texture)
    return document.add(
        "materials",
        name="skin",
        doubleSided=True,
        alphaMode="MASK" if cut_out else None,
        pbrMetallicRoughness=surface,
    )


def _add_texture(document: GltfBuilder, face: Face) -> int | None:
    data = face.texture_file(compact=True)
    return None if data is None else _add_image(document, data)


def _add_image(document: GltfBuilder, data: bytes) -> int:
    image = document.add(
        "images", name="texture", mimeType=media_type(data), bufferView=document.add_view(data)
    )
    # The edge of the texture is the edge of the face: no colour may wrap round from ear to ear.
    sampler = document.add(
        "samplers",
        magFilter=_LINEAR,
        minFilter=_LINEAR_MIPMAP_LINEAR,
        wrapS=_CLAMP_TO_EDGE,
        wrapT=_CLAMP_TO_EDGE,
    )
    return document.add("textures", sampler=sampler, source=image)
