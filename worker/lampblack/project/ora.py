"""OpenRaster files, the layers of one drawing (.ora: Krita, MyPaint, GIMP), as projects of one
frame.

Frame of reference: x right, y down, with the origin in the canvas's corner. The first layer of a
stack is the topmost (https://www.openraster.org, "Layer stack specification").
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import count
from pathlib import Path
from xml.etree.ElementTree import Element

from ..errors import ProjectError
from .attributes import (
    AGAIN,
    UNKNOWN_BLENDS,
    check_size,
    number,
    sound_xml,
    tell_of_layers,
    whole,
)
from .blend import BLENDS, Blend
from .camera_layer import Camera, CameraKey
from .document import Group, Key, Layer, Project

FOLDER = "data/"
MAX_LAYERS = 1000
MAX_DEPTH = 50
MYPAINT = b"mypaint.org/ns/openraster"
"""In the files of the one program that adds light as ``svg:plus`` says; the others blend colours by
adding them."""
PLAIN = "svg:src-over"
OPERATIONS: dict[str, tuple[Blend, bool]] = {
    PLAIN: ("normal", False),
    "svg:src-atop": ("normal", True),
    **{f"svg:{blend}": (blend, False) for blend in BLENDS if blend != "normal"},
}
"""Blend mode, and whether it clips, of each ``composite-op``."""


@dataclass(frozen=True)
class _Place:
    """Position and visibility that a stack gives to the layers in it, the groups that it is in, and
    what the file means by ``svg:plus``."""

    adds: Blend
    left: int = 0
    top: int = 0
    visible: bool = True
    depth: int = 0
    groups: tuple[Group, ...] = ()


def parse_stack(xml: bytes, name: str) -> Project:
    """The project that a ``stack.xml`` describes; ``name`` is for the errors.

    Raises:
        ProjectError: the XML is damaged, or a value makes no sense.

    Warns:
        LampblackWarning: layers have a blend mode that is not known, or are no pictures.
    """
    root = sound_xml(xml, name)
    stack = root.find("stack")
    if root.tag != "image" or stack is None:
        raise ProjectError(f"{name} describes no layers.", AGAIN)
    width, height = whole(root, "w", 0), whole(root, "h", 0)
    check_size(width, height, name)
    if sum(1 for _ in root.iter("layer")) > MAX_LAYERS:
        raise ProjectError(f"{name} has more than {MAX_LAYERS} layers.", "Merge some of them.")
    unknown = {e.get("name", "") for e in stack.iter() if _operation(e) not in OPERATIONS}
    tell_of_layers(unknown, name, UNKNOWN_BLENDS)
    # Keys are positioned relative to the middle of the canvas, as in Pencil2D.
    adds: Blend = "plus" if MYPAINT in xml else "linear-dodge"
    place = _Place(adds, -(width // 2), -(height // 2))
    found = list(_layers(stack, place, name, count()))
    tell_of_layers(
        {layer.name for layer in found if not _is_picture(layer)},
        name,
        "are text or vectors, which are left out. Turn them into pixels to see them",
    )
    layers = tuple(
        replace(layer, number=number, name=layer.name or f"Layer {number}")
        for number, layer in enumerate(reversed(found), start=1)
        if _is_picture(layer)
    )
    if not layers:
        raise ProjectError(f"{name} has no layer with a picture.", "Draw something on one.")
    return Project(layers, (Camera("Canvas", width, height, (CameraKey(1),)),), 1, 1)


def _layers(stack: Element, place: _Place, name: str, numbers: Iterator[int]) -> Iterator[Layer]:
    """The layers, topmost first; ``numbers`` are for groups."""
    if place.depth > MAX_DEPTH:
        raise ProjectError(f"{name} has groups in groups, {MAX_DEPTH} deep.", "Merge some of them.")
    for element in stack:
        opacity = min(1.0, max(0.0, number(element, "opacity", 1.0)))
        blend, clipped = OPERATIONS.get(_operation(element), ("normal", False))
        blend = place.adds if blend == "plus" else blend
        inner = _Place(
            place.adds,
            place.left + whole(element, "x", 0),
            place.top + whole(element, "y", 0),
            place.visible and element.get("visibility", "visible") == "visible",
            place.depth + 1,
            place.groups,
        )
        if element.tag == "stack":
            plain = opacity == 1 and blend == "normal" and not clipped
            if not plain or element.get("isolation") != "auto":
                group = Group(next(numbers), opacity, blend, clipped)
                inner = replace(inner, groups=(*place.groups, group))
            yield from _layers(element, inner, name, numbers)
        elif element.tag == "layer":
            # Pictures are in one folder; a name that leads out of it is refused on reading.
            file = element.get("src", "").removeprefix(FOLDER)
            key = Key(1, file, inner.left, inner.top, opacity)
            clipped |= element.get("alpha-preserve") == "true"
            label = element.get("name", "")[:200]
            yield Layer(0, label, "bitmap", inner.visible, (key,), blend, clipped, inner.groups)


def _operation(element: Element) -> str:
    return element.get("composite-op", PLAIN)


def _is_picture(layer: Layer) -> bool:
    (key,) = layer.keys
    return Path(key.file).suffix.lower() not in (".svg", ".svgz", ".txt", ".html")
