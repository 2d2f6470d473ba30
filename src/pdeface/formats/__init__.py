"""Write a face as a file that other programs read: one format a module, chosen by the suffix."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from pdeface.errors import InputError
from pdeface.face import Face, Openings
from pdeface.files import PathLike
from pdeface.formats._animation import Animation
from pdeface.formats._parts import part_on_mesh
from pdeface.formats._sample import sample
from pdeface.formats._targets import Expressions, MorphTargets, expression_names, target_names
from pdeface.formats.gltf import write_glb, write_gltf
from pdeface.formats.obj import write_obj
from pdeface.formats.obj_sequence import export_sequence
from pdeface.formats.ply import write_ply
from pdeface.formats.stl import write_stl
from pdeface.formats.vrm import write_vrm
from pdeface.pde import Join
from pdeface.relief import Relief

__all__ = [
    "SUFFIXES",
    "SUFFIXES_THAT_MOVE",
    "SUFFIXES_THAT_PLAY",
    "Animation",
    "export",
    "export_sequence",
    "expression_names",
    "part_on_mesh",
    "target_names",
]

_MESHES = (".glb", ".gltf", ".vrm", ".obj", ".ply", ".stl")
_WITH_QUADS = (".obj", ".ply")

SUFFIXES = (*_MESHES, ".pdeface")
"""Suffixes that :func:`export` knows."""

SUFFIXES_THAT_MOVE = (".glb", ".gltf", ".vrm")
"""Those whose files hold expressions as morph targets."""

SUFFIXES_THAT_PLAY = (".glb", ".gltf")
"""Those whose files hold animations."""


def export(
    face: Face,
    path: PathLike,
    mesh: tuple[int, int] = (28, 41),
    join: Join = "smooth",
    quads: bool | None = None,
    expressions: Expressions = None,
    animation: Animation | None = None,
    openings: Openings = "cut",
    visemes: bool = False,
    relief: Relief | None = None,
) -> None:
    """Write ``face`` to ``path`` in the format that its suffix names.

    Metres, +Y up, +Z forward, with the normals of the analytic surface. ``.glb``, ``.gltf`` and
    ``.vrm`` hold their texture; ``.obj`` and ``.ply`` get theirs beside them, ``me-texture.png``
    for ``me.obj``, and ``.obj`` a ``.mtl``; ``.stl`` has none. ``.pdeface`` is
    :meth:`Face.save`, which no mesh concerns.

    In ``.glb``, ``.gltf`` and ``.vrm`` expressions are morph targets by ARKit's names
    (docs/export.md), and what the face does at the moment are their default weights. All else that
    the controls of the face say is part of the mesh, as in the other formats everything is.

    Args:
        face: the face.
        path: the file to write. It appears last and whole, or stays as it was if anything fails.
        mesh: (rows, columns) of the uv mesh: samples from forehead to chin and ear to ear.
        join: ``"smooth"`` (C2) or ``"patchwise"`` (the paper's).
        quads: quads or triangles. By default OBJ has quads and PLY, whose quads many readers
            refuse, triangles; the other formats have triangles only.
        expressions: which become morph targets: ``"all"``, or some by name. By default all that
            the face can make, which are none if its curves do not lie on lids and lips.
        openings: ``"cut"`` for eyes and a mouth that open, ``"none"`` for the paper's closed face.
        animation: what morph targets and head do over time, for ``.glb`` and ``.gltf``. Of its
            expressions those that are no morph target are left out; those it does not name stay
            as the face has them.
        visemes: the fifteen visemes of speech as further morph targets, ``viseme_sil``, ...
            ``viseme_U``.
        relief: what is raised on the surface along its normals, as :func:`pdeface.scan.relief_of`
            finds it; not for ``.pdeface``.

    Raises:
        InputError: an unknown suffix or expression, a mesh, join or expression that the face
            cannot have, quads, expressions, visemes or an animation in a format without them, an
            animation of nothing that the file has, or a place that cannot be written.
        MissingExtraError: the face has a texture and Pillow is not installed.

    Example:
        >>> export(face, "me.glb", mesh=(109, 161))  # doctest: +SKIP
    """
    suffix = Path(path).suffix.lower()
    if suffix not in SUFFIXES:
        raise InputError(
            f"expected a file name that ends in {', '.join(SUFFIXES)}, got {Path(path).name!r}; "
            "the suffix picks the format"
        )
    _check(suffix, expressions, "expressions", SUFFIXES_THAT_MOVE, "them")
    _check(suffix, visemes, "visemes", SUFFIXES_THAT_MOVE, "them")
    _check(suffix, animation is not None, "an animation", SUFFIXES_THAT_PLAY, "it")
    _check(suffix, relief is not None, "a relief", _MESHES, "it")
    if suffix == ".pdeface":
        face.save(path)
        return
    _check(suffix, quads, "quads", _WITH_QUADS, "quads", " for triangles")
    if suffix in SUFFIXES_THAT_MOVE:
        targets = _morph_targets(face, mesh, join, expressions, visemes, openings)
        if relief is not None:
            raised = sample(targets.face, mesh, join, openings, relief=relief)
            targets = replace(targets, raised=raised)
        if suffix == ".vrm":
            write_vrm(face, targets, path)
        else:
            (write_glb if suffix == ".glb" else write_gltf)(face, targets, path, animation)
        return
    surface = sample(face, mesh, join, openings, relief=relief)
    if suffix == ".obj":
        write_obj(face, surface, path, quads=quads is not False)
    elif suffix == ".ply":
        write_ply(face, surface, path, quads=bool(quads))
    else:
        write_stl(surface, path)


def _check(
    suffix: str, asked: object, what: str, able: Sequence[str], it: str, instead: str = ""
) -> None:
    """Refuse what was asked of a format that has no place for it."""
    if asked and suffix not in able:
        raise InputError(
            f"{what} can be written to {', '.join(able[:-1])} and {able[-1]}, not to {suffix}; "
            f"leave {it} out{instead}"
        )


def _morph_targets(
    face: Face,
    mesh: tuple[int, int],
    join: Join,
    expressions: Expressions,
    visemes: bool,
    openings: Openings,
) -> MorphTargets:
    """The face at rest in the expressions that a file can move, and these expressions."""
    names = expression_names(face, expressions)
    resting = face.with_weights(dict.fromkeys(names, 0.0))
    every = target_names(face, names, visemes)
    weights = tuple(face.weights.get(name, 0.0) for name in every)
    return MorphTargets(resting, sample(resting, mesh, join, openings), join, every, weights)
