"""The types of :mod:`pdeface.studio.schema` in TypeScript; ``make docs`` writes them.

python -m pdeface.studio.typescript > client/src/schema.ts
"""

from __future__ import annotations

import dataclasses
import sys
import types
import typing
from collections.abc import Mapping
from typing import Any

from pdeface.studio import schema

__all__ = ["typescript"]

_HEADER = "// Written by `python -m pdeface.studio.typescript` from src/pdeface/studio/schema.py.\n"
_NAMES = {str: "string", float: "number", int: "number", bool: "boolean", type(None): "null"}


def typescript() -> str:
    """The text of ``client/src/schema.ts``."""
    kinds = [
        kind
        for kind in vars(schema).values()
        if isinstance(kind, type)
        and dataclasses.is_dataclass(kind)
        and kind.__module__ == schema.__name__
    ]
    return _HEADER + "".join(map(_interface, kinds))


def _interface(kind: type) -> str:
    hints = typing.get_type_hints(kind)
    lines = [f"  readonly {name}: {_type(hint)};" for name, hint in hints.items()]
    comment = " ".join((kind.__doc__ or "").split())
    return "\n".join(
        ["", f"/** {comment} */", f"export interface {kind.__name__} {{", *lines, "}\n"]
    )


def _type(hint: Any) -> str:
    if hint in _NAMES:
        return _NAMES[hint]
    if dataclasses.is_dataclass(hint):
        return str(getattr(hint, "__name__", hint))
    origin, arguments = typing.get_origin(hint), typing.get_args(hint)
    if origin is list:
        return f"readonly ({_type(arguments[0])})[]"
    if origin is Mapping:
        return f"Readonly<Record<string, {_type(arguments[1])}>>"
    if origin in (types.UnionType, typing.Union):
        return " | ".join(map(_type, arguments))
    raise TypeError(f"no TypeScript is known for {hint!r}; use a type that the others use")


if __name__ == "__main__":
    sys.stdout.write(typescript())
