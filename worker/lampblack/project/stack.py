"""The layers of a project sorted by role: lit, below and above."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, get_args

from ..choices import LIGHT_LAYER, LayerRole
from ..errors import LampblackWarning, ProjectError
from ..scene import Scene
from .document import Layer, Project

Roles = Mapping[str, LayerRole]
"""Roles by layer name."""

ROLES_FIELD = "pencil2d_layers"
"""The scene's extra field in which the Pencil2D plugin stores the roles."""
RESULT_LAYER = "Lit"
"""The layer of rendered frames that the Pencil2D plugin adds; it is never lit itself. Taken apart,
they are several layers: "Lit: shade" and so on."""


@dataclass(frozen=True)
class Stack:
    """The layers that are shown, each list bottom first.

    Attributes:
        below, above: layers shown unlit, under and over the lit ones.
        lit: layers of characters and their lines, lit as one drawing.
        line: those of ``lit`` that contain only line.
        light: layers whose paint is light; they are not shown.
    """

    below: tuple[Layer, ...]
    lit: tuple[Layer, ...]
    line: tuple[Layer, ...]
    above: tuple[Layer, ...]
    light: tuple[Layer, ...] = ()


def stack_layers(project: Project, roles: Roles) -> Stack:
    """Sort the layers by role. If any layer has the role ``character`` or ``line``, layers without
    a role are background. Otherwise every visible layer is lit, except ``background``. The paint of
    a layer named Light is light, unless it has the role of a character or a line. A layer that is
    clipped, and has no role of its own, has that of the layer that it is clipped to.

    If the project has a visible layer of rendered frames, layers with a role are lit even when
    they are hidden: the artist may have hidden them behind the result.

    Raises:
        ProjectError: no layer is lit.
    """
    _check_names(project, roles)
    named = "character" in roles.values() or "line" in roles.values()
    painted = [layer for layer in project.layers if is_painted_light(layer.name, roles)]
    drawn = [
        layer for layer in project.layers if layer not in painted and not _is_result(layer, roles)
    ]
    finished = any(layer.visible and _is_result(layer, roles) for layer in project.layers)
    each = _roles_of_all(drawn, roles, "background" if named else "character")
    lit = [
        layer
        for layer, role in zip(drawn, each, strict=True)
        if role != "background" and (layer.visible or (finished and layer.name in roles))
    ]
    if not lit:
        raise ProjectError(
            "None of the visible layers of the project is lit.",
            "Name one with --character, or make it visible in your drawing program.",
            f"Layers: {_names(project)}",
        )
    shown = [layer for layer in drawn if layer in lit or layer.visible]
    top = shown.index(lit[-1])
    return Stack(
        below=tuple(layer for layer in shown[:top] if layer not in lit),
        lit=tuple(lit),
        line=tuple(
            layer
            for layer, role in zip(drawn, each, strict=True)
            if role == "line" and layer in lit
        ),
        above=tuple(shown[top + 1 :]),
        light=tuple(layer for layer in painted if layer.visible),
    )


def roles_of(scene: Scene) -> dict[str, LayerRole]:
    """The roles that the Pencil2D plugin stored in ``scene``; malformed ones are ignored."""
    kept: Any = scene.extra.get(ROLES_FIELD)
    if not isinstance(kept, dict):
        return {}
    return {name: role for name, role in kept.items() if role in get_args(LayerRole)}


def _roles_of_all(layers: list[Layer], roles: Roles, usual: LayerRole) -> list[LayerRole]:
    """The role of each of ``layers``, bottom first."""
    found: list[LayerRole] = []
    base = usual
    for layer in layers:
        clipped = layer.clipped or any(group.clipped for group in layer.groups)
        role = roles.get(layer.name, base if clipped else usual)
        if not clipped:
            base = role
        found.append(role)
    return found


def is_painted_light(name: str, roles: Roles) -> bool:
    """Whether the paint of a layer of this name is light."""
    return name == LIGHT_LAYER and roles.get(name, "background") == "background"


def is_named_as_result(name: str) -> bool:
    """Whether a layer of this name holds rendered frames, if no role says otherwise."""
    return name == RESULT_LAYER or name.startswith(f"{RESULT_LAYER}: ")


def _is_result(layer: Layer, roles: Roles) -> bool:
    return is_named_as_result(layer.name) and layer.name not in roles


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
