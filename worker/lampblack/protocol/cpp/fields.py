"""The fields of Python types, for the C++ generator."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Annotated, Any, get_args, get_origin, get_type_hints

import msgspec
from msgspec import Meta

REQUIRED = object()
"""Marks a field without a default."""


@dataclass(frozen=True)
class Field:
    """A field of a dataclass or message: its names in Python and JSON, its type and default."""

    name: str
    wire: str
    hint: Any
    default: Any


def fields_of(kind: type) -> list[Field]:
    """The fields of a dataclass or ``msgspec.Struct``, in order."""
    if dataclasses.is_dataclass(kind):
        hints = get_type_hints(kind, include_extras=True)
        return [
            Field(f.name, f.name, hints[f.name], _default(f.default, f.default_factory))
            for f in dataclasses.fields(kind)
        ]
    return [
        Field(f.name, f.encode_name, f.type, _default(f.default, f.default_factory))
        for f in msgspec.structs.fields(kind)
    ]


def _default(value: Any, factory: Any) -> Any:
    missing = (dataclasses.MISSING, msgspec.NODEFAULT)
    if factory not in missing:
        return factory()
    return REQUIRED if value in missing else value


def is_struct(hint: Any) -> bool:
    """Whether the type has fields."""
    return isinstance(hint, type) and (
        dataclasses.is_dataclass(hint) or issubclass(hint, msgspec.Struct)
    )


def structs_in(kinds: Iterable[type]) -> list[type]:
    """The structs and all structs in them, each once and after those that it needs."""

    def walk(hint: Any) -> Iterator[type]:
        inner = [field.hint for field in fields_of(hint)] if is_struct(hint) else get_args(hint)
        for other in inner:
            yield from walk(other)
        if is_struct(hint):
            yield hint

    return list(dict.fromkeys(struct for kind in kinds for struct in walk(kind)))


def unwrapped(hint: Any) -> tuple[Any, Meta]:
    """A type without ``Annotated``, and all of its ``Meta`` merged; the last one counts."""
    if get_origin(hint) is not Annotated:
        return hint, Meta()
    names = ("ge", "le", "pattern", "min_length", "max_length", "description")
    said = [meta for meta in hint.__metadata__ if isinstance(meta, Meta)]
    merged = {n: getattr(m, n) for m in said for n in names if getattr(m, n) is not None}
    return hint.__origin__, Meta(**merged)
