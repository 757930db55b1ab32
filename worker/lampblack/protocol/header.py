"""The header frame: strict JSON in and out."""

from __future__ import annotations

import math
from typing import Any

import msgspec

from ..errors import SceneError
from ..scene import Scene, decode_scene, encode_scene
from .errors import ErrorCode, ProtocolError
from .fields import Message
from .preview import SetScene
from .version import PREFIX


def parse_header(header: bytes) -> dict[str, Any]:
    """The header's JSON object. If a key is there twice, the last one counts.

    ``1.0`` and ``1e0`` are the integer 1.

    Raises:
        ProtocolError: not strict JSON (``BAD_JSON``), or a number that no double comes near
            (``BAD_NUMBER``), even as the value of a key that comes again.
    """
    try:
        tree = _PARSER.decode(header)
    except msgspec.ValidationError as error:  # of a number: all else fits an untyped decode
        raise ProtocolError(ErrorCode.BAD_NUMBER, str(error)) from error
    except (msgspec.DecodeError, UnicodeDecodeError) as error:
        raise ProtocolError(ErrorCode.BAD_JSON, str(error)) from error
    assert isinstance(tree, dict)  # its first bytes open an object
    return tree


def _number(text: str) -> float | int:
    """A number; refuses those that overflow or become zero, as Qt does."""
    value = float(text)
    vanished = value == 0 and any(digit in "123456789" for digit in text.lower().split("e")[0])
    if vanished or not math.isfinite(value):
        raise ValueError(f"{text[:40]} is no double")
    return int(value) if value.is_integer() and abs(value) < 1 << 53 else value


_PARSER = msgspec.json.Decoder(float_hook=_number)


def read_scene(tree: object) -> Scene:
    """The scene of set_scene, including fields that this version does not know.

    Raises:
        ProtocolError: ``BAD_SCENE``, with what is wrong in its details.
    """
    try:
        return decode_scene(msgspec.json.encode(tree))
    except SceneError as error:
        details = " ".join(part for part in (error.what, error.details) if part)
        raise ProtocolError(ErrorCode.BAD_SCENE, details) from error


def read_message(tree: dict[str, Any], kind: type[Message]) -> Message:
    """The message of type ``kind``; undeclared fields are ignored.

    Raises:
        ProtocolError: ``BAD_FIELD`` or ``BAD_SCENE``, naming the field.
    """
    if kind is SetScene and "scene" in tree:
        tree = {**tree, "scene": read_scene(tree["scene"])}
    try:
        return msgspec.convert(tree, kind)
    except msgspec.ValidationError as error:
        raise ProtocolError(ErrorCode.BAD_FIELD, str(error)) from error


def write_header(message: Message) -> bytes:
    """The header frame of a message, including defaults and the scene's unknown fields."""
    tree: dict[str, Any] = msgspec.to_builtins(message)
    if isinstance(message, SetScene):
        tree["scene"] = msgspec.json.decode(encode_scene(message.scene))
    return PREFIX + msgspec.json.encode(tree)[1:]
