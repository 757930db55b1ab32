"""Which layers of a project are lit, and which lie beneath and above them."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, get_args

from ..choices import LayerRole
from ..errors import LampblackWarning, ProjectError
from ..scene import Scene
from .document import Layer, Project

Roles = Mapping[str, LayerRole]
"""By layer name."""

ROLES_FIELD = "pencil2d_layers"
"""Where the drawing tool keeps the roles: among the scene's unknown fields."""
RESULT_LAYER = "Lit"
"""What the drawing tool names the layer of its results: it is never lit again."""


@dataclass(frozen=True)
class Stack:
    """The layers that are shown, each list bottom first.

    Attributes:
        below, above: shown as they are, under and over what is lit.
        lit: characters and their lines, lit as one drawing.
        line: those of ``lit`` that hold nothing but line.
    """

    below: tuple[Layer, ...]
    lit: tuple[Layer, ...]
    line: tuple[Layer, ...]
    above: tuple[Layer, ...]


def stack_layers(project: Project, roles: Roles) -> Stack:
    """Sort the layers. Without a ``character`` or a ``line``, all that is visible is lit but
    what is ``background``; otherwise, layers without a role are background.

    Where a layer of results lies, its sources may have been hidden behind it: those that have
    a role are lit all the same.

    Raises:
        ProjectError: there is nothing to light.
    """
    _check_names(project, roles)
    named = "character" in roles.values() or "line" in roles.values()
    drawn = [layer for layer in project.layers if not _is_result(layer, roles)]
    finished = any(layer.visible and _is_result(layer, roles) for layer in project.layers)
    lit = [
        layer
        for layer in drawn
        if roles.get(layer.name, "background" if named else "character") != "background"
        and (layer.visible or (finished and layer.name in roles))
    ]
    if not lit:
        raise ProjectError(
            "None of the project's visible layers is to be lit.",
            "Name one with --character, or show it in Pencil2D.",
            f"Layers: {_names(project)}",
        )
    shown = [layer for layer in drawn if layer in lit or layer.visible]
    top = shown.index(lit[-1])
    return Stack(
        below=tuple(layer for layer in shown[:top] if layer not in lit),
        lit=tuple(lit),
        line=tuple(layer for layer in lit if roles.get(layer.name) == "line"),
        above=tuple(shown[top + 1 :]),
    )


def roles_of(scene: Scene) -> dict[str, LayerRole]:
    """The roles that the drawing tool keeps in ``scene``; what is malformed counts for nothing."""
    kept: Any = scene.extra.get(ROLES_FIELD)
    if not isinstance(kept, dict):
        return {}
    return {name: role for name, role in kept.items() if role in get_args(LayerRole)}


def _is_result(layer: Layer, roles: Roles) -> bool:
    return layer.name == RESULT_LAYER and layer.name not in roles


def _check_names(project: Project, roles: Roles) -> None:
    unknown = [name for name in roles if name not in {layer.name for layer in project.layers}]
    if unknown:
        warnings.warn(
            f"The project has no layer {unknown[0]!r}. Its layers: {_names(project)}.",
            LampblackWarning,
            stacklevel=3,
        )


def _names(project: Project) -> str:
    return ", ".join(repr(layer.name) for layer in project.layers[:40])
