"""What a field of the scene changes: said on the field, and read by everything that keeps light."""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Hashable
from enum import Enum
from typing import Any, get_type_hints


class Affects(Enum):
    """What a field of the scene changes, where that is not the traced light itself.

    A field without a mark shapes the traced light: whatever is kept is then traced again when
    the field changes, so that a new field cannot show a stale picture.
    """

    COMPOSITE = "how traced light is composited"
    GLOSS = "how much of the glossy light there is: other light stands in until it is traced"
    SAMPLING = "how finely light is traced"
    NOTHING = "nothing of the light"


def traced_part(node: Any, *ignored: Affects) -> Hashable:
    """All that shapes traced light in ``node``, a part of the scene, as a value to compare.

    Args:
        ignored: fields with these marks are left out as well.
    """
    if dataclasses.is_dataclass(node) and not isinstance(node, type):
        leave = {Affects.COMPOSITE, Affects.NOTHING, *ignored}
        return tuple(
            (name, traced_part(getattr(node, name), *ignored))
            for name, mark in marks_of(type(node)).items()
            if mark not in leave
        )
    if isinstance(node, tuple | list):
        return tuple(traced_part(item, *ignored) for item in node)
    if isinstance(node, dict):
        return tuple((key, traced_part(node[key], *ignored)) for key in sorted(node))
    return node  # type: ignore[no-any-return]


@functools.cache
def marks_of(kind: type[Any]) -> dict[str, Affects | None]:
    """The mark of each field of a part of the scene."""
    hints = get_type_hints(kind, include_extras=True)
    return {
        one.name: next(
            (m for m in getattr(hints[one.name], "__metadata__", ()) if isinstance(m, Affects)),
            None,
        )
        for one in dataclasses.fields(kind)
    }
