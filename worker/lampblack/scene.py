"""The scene: everything that says how drawings are lit, as one frozen tree.

Canvas frame, in the drawing's own pixels: x right, y down, origin at the drawing's top left
corner, z towards the viewer, the paper at z = 0. Colours are ``#rrggbb`` in sRGB. The tree
goes to JSON and back; fields this version does not know are kept and written out again.
"""

from __future__ import annotations

import dataclasses
import functools
import inspect
from collections.abc import Hashable, Mapping
from dataclasses import dataclass, field, replace
from typing import Annotated, Any, TypeVar, get_type_hints

import msgspec
from msgspec import Meta

from .affects import Affects, marks_of, traced_part
from .choices import BodyChoice, FrontSide, QualityName
from .errors import SceneError

VERSION = 1
MAX_LIGHTS = 4
MAX_KEYS = 128
"""Of a light or a floor: so many of each fit into one message."""
MAX_JSON_BYTES = 1 << 20
MAX_HINTS, MAX_HINT_POINTS = 128, 16

Colour = Annotated[
    str,
    # Python's $ also matches before a final newline: the length shuts that door.
    Meta(pattern="^#[0-9a-f]{6}$", max_length=7, description="sRGB, lower case #rrggbb"),
]
Pixels = Annotated[float, Meta(ge=-1e5, le=1e5, description="canvas pixels")]
Unit = Annotated[float, Meta(ge=0, le=1)]
Strength = Annotated[float, Meta(ge=0, le=100)]
Diameter = Annotated[float, Meta(ge=1, le=1e5, description="diameter, canvas pixels")]
Pitch = Annotated[float, Meta(ge=5, le=85, description="degrees")]
KeyFrame = Annotated[int, Meta(ge=0, le=999_999, description="frame of the animation")]
Extra = Annotated[dict[str, Any], Affects.NOTHING]


@dataclass(frozen=True)
class LightKey:
    """A light at one frame: each field is one of ``AreaLight`` that keys can change."""

    frame: KeyFrame
    x: Pixels
    y: Pixels
    z: Pixels
    size: Diameter = 200.0
    colour: Colour = "#ffffff"
    power: Strength = 1.0
    extra: Extra = field(default_factory=dict)


@dataclass(frozen=True)
class AreaLight:
    """A disk of light facing the paper point beneath it.

    ``power`` 1 lights a white surface that faces it from the default height (half the
    canvas's long side) to exactly the drawn colour; light falls off with the square of the
    distance. ``z`` below 0 stands behind the paper.

    With ``keys``, in any order, it changes from each to the next, and holds before the first and
    after the last; its own values then count for nothing. Between two keys numbers change evenly,
    colours in linear light, and any other field holds. Of keys at one frame the last counts. See
    ``timeline.py``.
    """

    x: Pixels
    y: Pixels
    z: Pixels
    size: Diameter = 200.0
    colour: Annotated[Colour, Affects.COMPOSITE] = "#ffffff"
    power: Annotated[Strength, Affects.COMPOSITE] = 1.0
    keys: Annotated[tuple[LightKey, ...], Meta(max_length=MAX_KEYS), Affects.NOTHING] = ()
    extra: Extra = field(default_factory=dict)

    @property
    def geometry(self) -> Hashable:
        """All that shapes the light of power 1 in white, as it is without keys."""
        return traced_part(self)

    def neutral(self) -> AreaLight:
        """The same light as it is traced: white, of power 1, without keys."""
        kind: Any = type(self)
        bare = kind(x=0, y=0, z=0)
        untraced = {
            name: getattr(bare, name)
            for name, mark in marks_of(kind).items()
            if mark in {Affects.COMPOSITE, Affects.NOTHING}
        }
        return replace(self, **untraced)


@dataclass(frozen=True)
class Ambient:
    """Light from everywhere; strength 1 alone shows an open surface in its drawn colour."""

    colour: Annotated[Colour, Affects.COMPOSITE] = "#ffffff"
    strength: Annotated[Strength, Affects.COMPOSITE] = 0.3
    extra: Extra = field(default_factory=dict)


@dataclass(frozen=True)
class Material:
    """What a flat colour is made of: diffuse, glossy, both, or neither (left as drawn).

    ``gloss`` is the amount of the glossy lobe, ``roughness`` its width (the paper's glossy
    exponent, the other way round: 0 is a mirror, 1 is satin).
    """

    diffuse: Annotated[bool, Affects.COMPOSITE] = True
    glossy: bool = False
    gloss: Annotated[Unit, Affects.GLOSS] = 0.5
    roughness: Annotated[float, Meta(ge=0.02, le=1)] = 0.3
    extra: Extra = field(default_factory=dict)


@dataclass(frozen=True)
class FloorKey:
    """A floor at one frame: each field is one of ``Floor`` that keys can change."""

    frame: KeyFrame
    y: Pixels
    pitch: Pitch = 25.0
    extra: Extra = field(default_factory=dict)


@dataclass(frozen=True)
class Floor:
    """A shadow-catching plane hinged at the canvas line ``y``, z = 0.

    A horizontal floor is edge-on to the orthographic view, so the floor is pitched towards
    the viewer: ``pitch`` degrees, 0 edge-on, 90 a wall facing the viewer. ``keys`` move it as
    those of a light do.
    """

    y: Pixels
    pitch: Pitch = 25.0
    keys: Annotated[tuple[FloorKey, ...], Meta(max_length=MAX_KEYS), Affects.NOTHING] = ()
    extra: Extra = field(default_factory=dict)


@dataclass(frozen=True)
class DepthPoint:
    """A point of the canvas."""

    x: Pixels
    y: Pixels
    extra: Extra = field(default_factory=dict)


@dataclass(frozen=True)
class DepthHint:
    """A stroke along which the artist says what is in front. It wins over what was found.

    ``front`` is the side in front for a walker from the first of ``points`` to the last, as seen
    on the canvas. Frames before and after ``frame`` use the hint too: it is carried along with
    the drawing. ``amount`` is the height of the step; 0 leaves it to the program.
    """

    frame: KeyFrame
    points: Annotated[tuple[DepthPoint, ...], Meta(max_length=MAX_HINT_POINTS)] = ()
    front: FrontSide = "left"
    amount: Annotated[
        float, Meta(ge=0, le=1, description="share of the longer side of the character's box")
    ] = 0.0
    extra: Extra = field(default_factory=dict)


@dataclass(frozen=True)
class LayerBody:
    """What surface a layer of the drawing gets: see ``BodyChoice``."""

    layer: Annotated[str, Meta(max_length=200, description="the layer's name")]
    body: BodyChoice = "auto"
    extra: Extra = field(default_factory=dict)


@dataclass(frozen=True)
class Depth:
    """What the artist says of the depth of drawings."""

    hints: Annotated[tuple[DepthHint, ...], Meta(max_length=MAX_HINTS)] = ()
    layers: Annotated[tuple[LayerBody, ...], Meta(max_length=64)] = ()
    extra: Extra = field(default_factory=dict)


@dataclass(frozen=True)
class Canvas:
    """Size of the drawings this scene was made for, in pixels."""

    width: Annotated[int, Meta(ge=1, le=65536)]
    height: Annotated[int, Meta(ge=1, le=65536)]
    extra: Extra = field(default_factory=dict)

    @property
    def default_height(self) -> float:
        """Height of a light above the paper at which power 1 is calibrated, in pixels."""
        return max(self.width, self.height) / 2


@dataclass(frozen=True)
class Scene:
    """All that the artist sets. Materials are keyed by flat colour, so they survive any
    reordering of the palette; colours without one wear ``default_material``."""

    canvas: Canvas
    lights: Annotated[tuple[AreaLight, ...], Meta(max_length=MAX_LIGHTS)] = ()
    ambient: Ambient = field(default_factory=Ambient)
    materials: Annotated[dict[Colour, Material], Meta(max_length=4096)] = field(
        default_factory=dict
    )
    default_material: Material = field(default_factory=Material)
    floor: Floor | None = None
    relief_scale: Annotated[float, Meta(ge=0.01, le=10)] = 1.0
    depth: Depth = field(default_factory=Depth)
    quality: Annotated[QualityName, Affects.SAMPLING] = "low"
    version: Annotated[int, Meta(ge=VERSION, le=VERSION), Affects.NOTHING] = VERSION
    extra: Extra = field(default_factory=dict)

    def material(self, colour: str) -> Material:
        """The material of the flat colour ``#rrggbb``."""
        return self.materials.get(colour, self.default_material)

    def render_key(self, *, materials: bool = True, sampling: bool = True) -> Hashable:
        """All that shapes the traced light, but for the area lights, each of which has a
        ``geometry`` of its own.

        Args:
            materials: False where those of one drawing's colours are compared instead.
            sampling: False where it does not matter how finely light is traced.
        """
        scene = replace(self, lights=())
        if not materials:
            scene = replace(scene, materials={}, default_material=Material())
        return traced_part(scene, *(() if sampling else (Affects.SAMPLING,)))


def default_light(canvas: Canvas, x: float, y: float, z: float | None = None) -> AreaLight:
    """A white light over (x, y), at the default height unless told otherwise.

    It has more than power 1, because most of a character is turned away from its light.
    """
    return AreaLight(
        x=x,
        y=y,
        z=canvas.default_height if z is None else z,
        size=max(1.0, 0.4 * canvas.default_height),
        power=1.2,
    )


def default_scene(width: int, height: int) -> Scene:
    """One light above the upper left of a ``width`` x ``height`` canvas, no floor."""
    canvas = Canvas(width, height)
    return Scene(canvas=canvas, lights=(default_light(canvas, 0.25 * width, 0.2 * height),))


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


Node = TypeVar("Node")


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
