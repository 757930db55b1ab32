"""Krita's files (.kra): the layers of a drawing, or of an animation, as projects.

Frame of reference: x right, y down, with the origin in the canvas's corner. The first layer is the
topmost. Krita counts frames from 0; frame 1 here is its frame 0.
"""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from itertools import count
from pathlib import Path
from xml.etree.ElementTree import Element

from ..errors import LampblackWarning, ProjectError
from .archive import Archive, Zipped
from .attributes import (
    UNKNOWN_BLENDS,
    check_size,
    number,
    sound_xml,
    tell_of_layers,
    whole,
)
from .blend import Blend
from .camera_layer import Camera, CameraKey
from .document import Group, Key, Layer, Mask, Project
from .kra_pictures import MERGED, KraFile, Stored

MAX_LAYERS = 1000
MAX_DEPTH = 50
LONGEST = 100_000
BLENDS: dict[str, Blend] = {
    "normal": "normal",
    "multiply": "multiply",
    "screen": "screen",
    "overlay": "overlay",
    "darken": "darken",
    "lighten": "lighten",
    "dodge": "color-dodge",
    "burn": "color-burn",
    "hard_light": "hard-light",
    "soft_light": "soft-light",
    "soft_light_svg": "soft-light",
    "diff": "difference",
    "exclusion": "exclusion",
    "add": "linear-dodge",
    "linear_dodge": "linear-dodge",
    "linear_burn": "linear-burn",
    "linear light": "linear-light",
    "vivid_light": "vivid-light",
    "pin_light": "pin-light",
    "subtract": "subtract",
    "divide": "divide",
    "hue": "hue",
    "saturation": "saturation",
    "color": "color",
    "luminize": "luminosity",
    "darker color": "darker-color",
    "lighter color": "lighter-color",
    "erase": "dst-out",
    "destination-in": "dst-in",
    "destination-atop": "dst-atop",
}
LEFT_OUT = (
    "are vectors, fills, filters, clones or files of their own, which are left out. Turn them into "
    "paint layers to see them"
)
WITHOUT = "have layer styles or masks other than of transparency, and are shown without"
RGB8 = "RGBA"
"""Krita's name of RGB with 8 bits and alpha."""


def read_kra(path: Path) -> tuple[Project, Archive]:
    """The project that a file of Krita holds. One with layers in other colours than RGB with 8 bits
    is read as the one picture that Krita stored with them.

    Raises:
        ProjectError: the file is damaged, or a value makes no sense.

    Warns:
        LampblackWarning: something in the file is not shown as Krita shows it.
    """
    if not path.is_file():
        raise ProjectError(f"There is no drawing at {path}.", "Check the name and the folder.")
    archive = Zipped(path, "maindoc.xml")
    root = sound_xml(archive.xml(), path.name)
    for element in root.iter():
        element.tag = element.tag.rpartition("}")[2]
    image = root.find("IMAGE")
    top = None if image is None else image.find("layers")
    if image is None or top is None:
        raise ProjectError(
            f"{path.name} describes no layers.", "Open it in Krita, and save it again."
        )
    size = whole(image, "width", 0), whole(image, "height", 0)
    check_size(*size, path.name)
    if sum(1 for _ in image.iter("layer")) > MAX_LAYERS:
        raise ProjectError(f"{path.name} has more than {MAX_LAYERS} layers.", "Merge some of them.")
    files = KraFile(archive, image.get("name", ""), size)
    reader = _Reader(path.name, files)
    layers = reader.layers(top) if _is_rgb8(image) else (_merged(path.name, files),)
    if not layers:
        raise ProjectError(f"{path.name} has no layer with a picture.", "Draw something on one.")
    length = 1
    if any(len(layer.keys) > 1 for layer in layers):
        last = whole(image.find("animation/range"), "to", 0)
        length = max(1, last + 1, *(key.frame for layer in layers for key in layer.keys))
    if length > LONGEST:
        raise ProjectError(
            f"{path.name} is {length} frames long; {LONGEST} is the most.", "Cut it into shots."
        )
    fps = whole(image.find("animation/framerate"), "value", 24)
    canvas = Camera("Canvas", *size, (CameraKey(1),))
    return Project(layers, (canvas,), length, max(1, fps)), files


def _is_rgb8(image: Element) -> bool:
    """Whether all that is painted is in RGB with 8 bits."""
    named = [image, *image.iter("layer")]
    return all(element.get("colorspacename", RGB8) == RGB8 for element in named)


def _merged(name: str, files: KraFile) -> Layer:
    warnings.warn(
        f"{name} is in other colours than RGB with 8 bits: its layers are lit as one picture. "
        "Convert it (Image > Convert Image Colour Space) to keep them apart.",
        LampblackWarning,
        stacklevel=3,
    )
    width, height = files.size
    key = Key(1, MERGED, -(width // 2), -(height // 2))
    return Layer(1, "Background", "bitmap", True, (key,))


@dataclass(frozen=True)
class _Place:
    """What the groups around a layer say of it."""

    visible: bool = True
    opacity: float = 1.0
    groups: tuple[Group, ...] = ()
    depth: int = 0


@dataclass
class _Reader:
    name: str
    files: KraFile
    _numbers: Iterator[int] = field(default_factory=lambda: count(1))
    _unknown: set[str] = field(default_factory=set)
    _left_out: set[str] = field(default_factory=set)
    _without: set[str] = field(default_factory=set)

    def layers(self, top: Element) -> tuple[Layer, ...]:
        """The layers that can be drawn, lowest first."""
        found = tuple(self._siblings(top, _Place()))
        tell_of_layers(self._unknown, self.name, UNKNOWN_BLENDS)
        tell_of_layers(self._left_out, self.name, LEFT_OUT)
        tell_of_layers(self._without, self.name, WITHOUT)
        return found

    def _siblings(self, layers: Element, place: _Place) -> Iterator[Layer]:
        if place.depth > MAX_DEPTH:
            raise ProjectError(
                f"{self.name} has groups in groups, {MAX_DEPTH} deep.", "Merge some of them."
            )
        for element in reversed(layers.findall("layer")):
            yield from self._one(element, place)

    def _one(self, element: Element, place: _Place) -> Iterator[Layer]:
        label = element.get("name", "")[:200]
        visible = place.visible and element.get("visible", "1") != "0"
        opacity = min(1.0, max(0.0, number(element, "opacity", 255) / 255))
        blend = self._blend(element, label)
        masks = self._masks(element, label, visible)
        # Krita's "inherit alpha" switches off the last of the channels.
        clipped = element.get("channelflags", "").endswith("0")
        kind = element.get("nodetype")
        if kind == "grouplayer":
            children = element.find("layers")
            within = replace(place, visible=visible, depth=place.depth + 1)
            if element.get("passthrough") == "1":
                # Krita applies its opacity to each of the layers, and no masks.
                within = replace(within, opacity=place.opacity * opacity)
            else:
                group = Group(next(self._numbers), opacity * place.opacity, blend, clipped, masks)
                within = replace(within, opacity=1.0, groups=(*place.groups, group))
            if children is not None:
                yield from self._siblings(children, within)
        elif kind == "paintlayer":
            keys = self._keys(element, opacity * place.opacity, masks)
            index = next(self._numbers)
            yield Layer(
                index, label or f"Layer {index}", "bitmap", visible, keys, blend, clipped,
                place.groups,
            )  # fmt: skip
        elif visible:
            self._left_out.add(label)

    def _blend(self, element: Element, label: str) -> Blend:
        named = element.get("compositeop", "normal")
        if named not in BLENDS:
            self._unknown.add(label)
        return BLENDS.get(named, "normal")

    def _keys(self, element: Element, opacity: float, masks: tuple[Mask, ...]) -> tuple[Key, ...]:
        """The drawings of a paint layer, by frame."""
        width, height = self.files.size
        still = Key(1, "", -(width // 2), -(height // 2), opacity, masks=masks)
        drawn: list[tuple[int, str, Element | None]] = [(1, element.get("filename", ""), element)]
        if element.get("keyframes"):
            root = sound_xml(self.files.layer(element.get("keyframes", "")), self.name)
            for part in root.iter():
                part.tag = part.tag.rpartition("}")[2]
            drawn = [
                (whole(key, "time", 0) + 1, key.get("frame", ""), key.find("offset"))
                for channel in root.findall("channel")
                if channel.get("name") == "content"
                for key in channel.findall("keyframe")
            ] or drawn  # fmt: skip
        keys: dict[int, Key] = {}
        for frame, file, at in drawn[:LONGEST]:
            if not 1 <= frame <= LONGEST:
                raise ProjectError(
                    f"{self.name} has a keyframe at {frame - 1}.",
                    f"The last is {LONGEST - 1}; move it.",
                )
            self.files.stored[file] = Stored((whole(at, "x", 0), whole(at, "y", 0)))
            keys[frame] = replace(still, frame=frame, file=file)
        return tuple(keys[frame] for frame in sorted(keys))

    def _masks(self, element: Element, label: str, visible: bool) -> tuple[Mask, ...]:
        width, height = self.files.size
        masks: list[Mask] = []
        styled = element.get("layerstyle")
        # Masks of a group are among its layers.
        for mask in (*element.findall("masks/mask"), *element.findall("layers/mask")):
            if mask.get("visible", "1") == "0":
                continue
            if mask.get("nodetype") != "transparencymask":
                styled = "mask"
                continue
            file = f"{mask.get('filename', '')}.pixelselection"
            self.files.stored[file] = Stored((whole(mask, "x", 0), whole(mask, "y", 0)), mask=True)
            masks.append(Mask(file, -(width // 2), -(height // 2)))
        if styled and visible:
            self._without.add(label)
        return tuple(masks)
