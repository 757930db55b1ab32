"""Scenes as JSON. Fields that this version does not know are kept, and written out again."""

from __future__ import annotations

import dataclasses
import functools
import inspect
from collections.abc import Mapping
from typing import Any, TypeVar, get_type_hints

import msgspec

from ..errors import SceneError
from .depth import Depth
from .rig import Rig
from .scene import VERSION, Scene
from .style import Style

MAX_JSON_BYTES = 1 << 20

Node = TypeVar("Node")


def encode_scene(scene: Scene) -> bytes:
    """The scene as indented JSON, unknown fields included."""
    return msgspec.json.format(msgspec.json.encode(_to_builtins(scene)), indent=2) + b"\n"


def decode_scene(data: bytes) -> Scene:
    """Read a scene from JSON.

    Raises:
        SceneError: not JSON, too large, of another version, or a value out of range.
    """
    tree = _json_object(data, "scene")
    version = tree.get("version", VERSION)
    if version != VERSION:
        raise SceneError(
            f"The scene has version {version!r}; this Lampblack reads version {VERSION}.",
            "Update Lampblack, or write a fresh scene: lampblack scene.",
        )
    try:
        return _from_builtins(tree, Scene)
    except (msgspec.ValidationError, RecursionError) as error:
        raise SceneError(
            "The scene has a field that cannot be used.", "Correct it and try again.", str(error)
        ) from error


def encode_rig(rig: Rig) -> bytes:
    """The rig as indented JSON, unknown fields included."""
    return msgspec.json.format(msgspec.json.encode(_to_builtins(rig)), indent=2) + b"\n"


def decode_rig(data: bytes) -> Rig:
    """Read a rig from JSON.

    Raises:
        SceneError: not JSON, too large, of another version, or a value out of range.
    """
    return _decode_reusable(data, Rig, "rig")


def encode_style(style: Style) -> bytes:
    """The style as indented JSON, unknown fields included."""
    return msgspec.json.format(msgspec.json.encode(_to_builtins(style)), indent=2) + b"\n"


def decode_style(data: bytes) -> Style:
    """Read a style from JSON.

    Raises:
        SceneError: not JSON, too large, of another version, or a value out of range.
    """
    return _decode_reusable(data, Style, "look")


def _decode_reusable(data: bytes, kind: type[Node], what: str) -> Node:
    tree = _json_object(data, what)
    version = tree.get("version", VERSION)
    if version != VERSION:
        raise SceneError(
            f"The {what} has version {version!r}; this Lampblack reads version {VERSION}.",
            f"Update Lampblack, or save the {what} again.",
        )
    try:
        return _from_builtins(tree, kind)
    except (msgspec.ValidationError, RecursionError) as error:
        raise SceneError(
            f"The {what} has a field that cannot be used.", "Correct it and try again.", str(error)
        ) from error


def decode_depth(data: bytes) -> Depth:
    """Read what the artist says of the depth, from JSON: the field ``depth`` of a scene.

    Raises:
        SceneError: not JSON, too large, or a value out of range.
    """
    tree = _json_object(data, "hints")
    try:
        return _from_builtins(tree, Depth)
    except (msgspec.ValidationError, RecursionError) as error:
        raise SceneError(
            "The file of hints has a field that cannot be used.",
            "Correct it and try again.",
            str(error),
        ) from error


def _json_object(data: bytes, what: str) -> dict[str, Any]:
    if len(data) > MAX_JSON_BYTES:
        raise SceneError(
            f"The {what} file is {len(data)} bytes long; {MAX_JSON_BYTES} is the most.",
            f"Check that this is a {what} file.",
        )
    try:
        tree = msgspec.json.decode(data)
    except (msgspec.DecodeError, UnicodeDecodeError, RecursionError) as error:
        raise SceneError(
            f"The {what} file is not valid JSON.",
            "Write a fresh one: lampblack scene." if what == "scene" else "",
            str(error),
        ) from error
    if not isinstance(tree, dict):
        raise SceneError(f"The {what} file does not hold a JSON object.")
    return tree


def scene_schema() -> dict[str, Any]:
    """JSON Schema of the scene, as written to ``protocol/scene.schema.json``."""
    schema = msgspec.json.schema(Scene)
    for definition in schema["$defs"].values():
        definition["properties"].pop("extra", None)
        normalize_schema(definition)
    return schema


def normalize_schema(definition: dict[str, Any]) -> None:
    """Make one object's schema the same, in place, whichever release of msgspec wrote it.

    Some leave docstrings indented, and some leave out a default that is an empty mapping.
    """
    if "description" in definition:
        definition["description"] = inspect.cleandoc(definition["description"])
    for member in definition.get("properties", {}).values():
        if member.get("default") == {}:
            del member["default"]


def _from_builtins(tree: Mapping[str, Any], kind: type[Node]) -> Node:
    """Build ``kind`` from decoded JSON; fields it does not declare go to its ``extra``."""
    return msgspec.convert(_gather_extra(tree, kind), kind)


def _gather_extra(value: Any, hint: Any) -> Any:
    """Move undeclared fields of every object into its ``extra`` field, recursively."""
    if isinstance(hint, type) and dataclasses.is_dataclass(hint) and isinstance(value, dict):
        hints = _type_hints(hint)
        known = {
            name: _gather_extra(value[name], hints[name])
            for name in hints
            if name != "extra" and name in value
        }
        known["extra"] = {name: v for name, v in value.items() if name not in known}
        return known
    arguments = [a for a in getattr(hint, "__args__", ()) if a is not Ellipsis]
    if isinstance(value, list) and arguments:
        return [_gather_extra(item, arguments[0]) for item in value]
    if isinstance(value, dict) and len(arguments) == 2 and arguments[0] is not type(None):
        if dataclasses.is_dataclass(arguments[0]):  # Optional[dataclass]
            return _gather_extra(value, arguments[0])
        return {key: _gather_extra(item, arguments[1]) for key, item in value.items()}
    return value


_type_hints = functools.cache(get_type_hints)


def _to_builtins(value: Any) -> Any:
    """Plain containers for JSON, with every ``extra`` spread back into its object. Keys are left
    out where there are none."""
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        fields = {f.name: _to_builtins(getattr(value, f.name)) for f in dataclasses.fields(value)}
        if not fields.get("keys", True):
            del fields["keys"]
        return {**fields.pop("extra"), **fields}
    if isinstance(value, tuple | list):
        return [_to_builtins(item) for item in value]
    if isinstance(value, dict):
        return {key: _to_builtins(item) for key, item in value.items()}
    return value
