"""The description of a Pencil2D project: layers and their keyframes.

Pencil2D's frame of reference: x right, y *down*, with the origin at the centre of the view of a
camera that has not moved. Frames count from 1. A keyframe holds until the
next one; it may come before frame 1.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from .blend import Blend
from .camera_layer import Camera
from .keyframes import held

Kind = Literal["bitmap", "vector"]


@dataclass(frozen=True)
class Mask:
    """A grey picture of how much of a layer or group shows: nothing where it is black.

    Attributes:
        file: the picture's name; see ``Key``.
        left, top: position of its top left corner.
        outside: its grey beyond its edges, 0 to 255.
        density: of the mask itself, 0 to 1; at 0 all shows.
    """

    file: str
    left: int = 0
    top: int = 0
    outside: int = 0
    density: float = 1.0


@dataclass(frozen=True)
class Key:
    """A drawing on a layer.

    Attributes:
        file: name in the project's data folder; empty for a blank drawing.
        left, top: position of a bitmap's top left corner.
        opacity: 0 to 1.
        masks: all of them are applied.
        inline: XML of a vector drawing that is in the description itself, as Pencil 0.4 wrote it.
    """

    frame: int
    file: str
    left: int = 0
    top: int = 0
    opacity: float = 1.0
    inline: bytes = b""
    masks: tuple[Mask, ...] = ()

    @property
    def blank(self) -> bool:
        """Whether nothing is drawn."""
        return not self.file and not self.inline


@dataclass(frozen=True)
class Group:
    """Layers that are painted together on nothing, and then blended with what is below.

    Attributes:
        clipped: the group shows only where what is below is.
        masks: all of them are applied.
        passes: its layers are blended with what is below one by one; opacity and masks mix the
            result with what was there before.
    """

    number: int
    opacity: float = 1.0
    blend: Blend = "normal"
    clipped: bool = False
    masks: tuple[Mask, ...] = ()
    passes: bool = False

    @property
    def touches_up(self) -> bool:
        """Whether it changes what is below rather than covering it."""
        return self.clipped or self.blend != "normal"


@dataclass(frozen=True)
class Layer:
    """A layer of drawings; ``keys`` by frame. Hidden layers are not shown.

    Attributes:
        blend: how it is blended with what is below.
        clipped: it shows only where what is below is.
        groups: the groups that it is in, outermost first.
    """

    number: int
    name: str
    kind: Kind
    visible: bool
    keys: tuple[Key, ...]
    blend: Blend = "normal"
    clipped: bool = False
    groups: tuple[Group, ...] = ()

    @property
    def touches_up(self) -> bool:
        """Whether it changes what is below rather than covering it."""
        own = self.clipped or self.blend != "normal"
        return own or any(group.touches_up for group in self.groups)

    def key_at(self, frame: int) -> Key | None:
        """The drawing that ``frame`` shows; None before the first key."""
        return held(self.keys, frame)


@dataclass(frozen=True)
class Project:
    """A project without its pictures.

    Attributes:
        layers: layers of drawings, bottom first.
        cameras: in the project's order.
        length: number of the last frame.
        fps: frames per second.
    """

    layers: tuple[Layer, ...]
    cameras: tuple[Camera, ...]
    length: int
    fps: int
