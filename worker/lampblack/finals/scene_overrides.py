"""Scene overrides: from a scene file, and settings that replace parts of it, to a scene."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from ..choices import BodyChoice, QualityName
from ..errors import SceneError
from ..files import read_bounded
from ..looks import with_style
from ..rigs import with_rig
from ..scene import (
    MAX_JSON_BYTES,
    MAX_LIGHTS,
    AreaLight,
    Canvas,
    Depth,
    Floor,
    LayerBody,
    Rig,
    Scene,
    Style,
    decode_depth,
    decode_scene,
    default_light,
    default_scene,
)


@dataclass(frozen=True)
class SceneOverrides:
    """The scene of the file, or the default scene, with some parts replaced.

    Attributes:
        file: the scene of the scene file, if there is one.
        rig: in place of the scene's lights and ambient light.
        style: in place of the scene's look and rim.
        lights: ``X,Y,Z`` each, in place of the scene's lights.
        floor: canvas line of a floor. quality: a preset.
        depth: what the artist says of the depth.
        bodies: the surface of layers by name, in place of those in the scene.
    """

    file: Scene | None = None
    rig: Rig | None = None
    style: Style | None = None
    lights: Sequence[str] = ()
    floor: float | None = None
    quality: QualityName | None = None
    depth: Depth | None = None
    bodies: Mapping[str, BodyChoice] = field(default_factory=dict)

    def __post_init__(self) -> None:
        lights_at(self.lights, Canvas(1, 1))  # mistakes are reported before any work
        if self.floor is not None:
            floor_at(self.floor)

    def scene(self, canvas: Canvas) -> Scene:
        """The scene for drawings on ``canvas``."""
        scene = self.file or default_scene(canvas.width, canvas.height)
        if self.rig is not None:
            scene = with_rig(scene, self.rig)
        if self.style is not None:
            scene = with_style(scene, self.style)
        if self.lights:
            scene = replace(scene, lights=lights_at(self.lights, canvas))
        if self.floor is not None:
            scene = replace(scene, floor=floor_at(self.floor))
        if self.depth is not None:
            scene = replace(scene, depth=self.depth)
        if self.bodies:
            kept = [body for body in scene.depth.layers if body.layer not in self.bodies]
            named = [LayerBody(layer, body) for layer, body in self.bodies.items()]
            scene = replace(scene, depth=replace(scene.depth, layers=(*kept, *named)))
        return scene if self.quality is None else replace(scene, quality=self.quality)

    @property
    def layer_bodies(self) -> tuple[LayerBody, ...]:
        """The artist's choices of the surfaces of layers, the same for all drawings."""
        return self.scene(Canvas(1, 1)).depth.layers


def read_scene(path: Path) -> Scene:
    """Load a scene file.

    Raises:
        SceneError: it cannot be read, or is not a scene.
    """
    try:
        return decode_scene(read_bounded(path, MAX_JSON_BYTES))
    except OSError as error:
        raise SceneError(
            f"The scene {path} cannot be read.",
            "Write one: lampblack scene INPUT -o FILE.json.",
            str(error),
        ) from error


def read_depth_hints(path: Path) -> Depth:
    """Load a file of depth hints: the field ``depth`` of a scene.

    Raises:
        SceneError: it cannot be read, or holds something else.
    """
    try:
        return decode_depth(read_bounded(path, MAX_JSON_BYTES))
    except OSError as error:
        raise SceneError(
            f"The hints {path} cannot be read.", "Check the file's name.", str(error)
        ) from error


def parse_light(text: str) -> tuple[float, float, float]:
    """``X,Y,Z`` in canvas pixels.

    Raises:
        SceneError: the text is not three finite numbers within the allowed range.
    """
    try:
        x, y, z = (float(part) for part in text.split(","))
    except ValueError:
        raise SceneError(
            f"{text!r} is not a light.", "Write it as X,Y,Z in pixels: --light 250,150,400."
        ) from None
    if not all(abs(value) <= 1e5 for value in (x, y, z)):
        raise SceneError(f"The light {text!r} is out of range.", "Stay within 100000 pixels.")
    return x, y, z


def lights_at(texts: Sequence[str], canvas: Canvas) -> tuple[AreaLight, ...]:
    """A default light at each ``X,Y,Z``."""
    if len(texts) > MAX_LIGHTS:
        raise SceneError(
            f"{len(texts)} lights were named; {MAX_LIGHTS} is the most.", "Leave some out."
        )
    return tuple(default_light(canvas, *parse_light(text)) for text in texts)


def floor_at(line: float) -> Floor:
    """The default floor at this canvas line.

    Raises:
        SceneError: the line is not finite, or outside the allowed range.
    """
    if not abs(line) <= 1e5:
        raise SceneError(f"The floor {line} is out of range.", "Stay within 100000 pixels.")
    return Floor(line)
