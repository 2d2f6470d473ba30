"""What ``--set``, ``--expressions`` and ``--visemes`` say, checked before any work is done."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from pdeface.errors import InputError

if TYPE_CHECKING:
    from pdeface import Face

__all__ = ["chosen_expressions", "parse_weights", "speaking", "with_weights"]


def parse_weights(texts: Iterable[str] | None) -> dict[str, float]:
    """Values by name of ``["noseLength=0.4,jawOpen=1", "eyeBlinkLeft=0.5"]``; the last one counts.

    Raises:
        InputError: not such a text, or a value that is no number.
    """
    weights: dict[str, float] = {}
    for part in (part.strip() for text in texts or () for part in text.split(",")):
        name, equals, value = (word.strip() for word in part.partition("="))
        if not (name and equals and value):
            raise InputError(f"--set needs NAME=VALUE, got '{part}'; for example --set jawOpen=0.5")
        try:
            weights[name] = float(value)
        except ValueError:
            raise InputError(f"--set {name} needs a number, got '{value}'") from None
    return weights


def with_weights(face: Face, weights: Mapping[str, float], clamp: bool) -> Face:
    """The face with these values of its controls.

    Raises:
        InputError: an unknown control, a value out of range, or a face that it cannot move.
    """
    changed = face.with_weights(weights, clamp=clamp)
    if changed.weights:
        # Curves that cannot do it refuse here, rather than when some files have been written.
        changed.surface()
    return changed


def chosen_expressions(
    face: Face, text: str | None, outputs: Sequence[Path]
) -> dict[Path, tuple[str, ...]]:
    """The expressions that go into each of the output files.

    Args:
        face: whose they are.
        text: ``"all"``, ``"none"``, names with commas between them, or None for the default.
        outputs: the files, of which some may be of a format that holds expressions.

    Raises:
        InputError: a name of no expression, a face that cannot make them, or no such output.
    """
    from pdeface.formats import SUFFIXES_THAT_MOVE, expression_names

    moving = [out for out in outputs if out.suffix.lower() in SUFFIXES_THAT_MOVE]
    names = expression_names(face, _asked_for(text)) if moving or text else ()
    if text and names and not moving:
        raise InputError(
            f"--expressions needs an output that ends in {' or '.join(SUFFIXES_THAT_MOVE)}, got "
            f"{', '.join(map(str, outputs))}; add one, or leave the option out"
        )
    return {out: names if out in moving else () for out in outputs}


def speaking(visemes: bool, face: Face, outputs: Sequence[Path]) -> frozenset[Path]:
    """The output files that get visemes: those that can, if they are asked for.

    Raises:
        InputError: visemes and no such output, or a face that cannot make them.
    """
    from pdeface.formats import SUFFIXES_THAT_MOVE, target_names

    able = frozenset(out for out in outputs if out.suffix.lower() in SUFFIXES_THAT_MOVE)
    if visemes and not able:
        raise InputError(
            f"--visemes needs an output that ends in {' or '.join(SUFFIXES_THAT_MOVE)}, got "
            f"{', '.join(map(str, outputs))}; add one, or leave the option out"
        )
    target_names(face, (), visemes)
    return able if visemes else frozenset()


def _asked_for(text: str | None) -> Sequence[str] | None:
    if text is None or text == "all":
        return text
    return () if text == "none" else [name.strip() for name in text.split(",")]
