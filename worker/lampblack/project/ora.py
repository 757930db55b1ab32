"""OpenRaster files, the layers of one drawing (.ora: Krita, MyPaint, GIMP), as projects of one
frame.

Frame of reference: x right, y down, with the origin in the canvas's corner. The first layer of a
stack is the topmost (https://www.openraster.org, "Layer stack specification").
"""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from dataclasses import dataclass
from xml.etree.ElementTree import Element

from ..errors import LampblackWarning, ProjectError
from .attributes import check_size, number, sound_xml, whole
from .document import Camera, CameraKey, Key, Layer, Project

FOLDER = "data/"
MAX_LAYERS = 1000
MAX_DEPTH = 50
PLAIN = "svg:src-over"


@dataclass(frozen=True)
class _Group:
    """Position, opacity and visibility that a stack gives to the layers in it."""

    left: int = 0
    top: int = 0
    opacity: float = 1.0
    visible: bool = True
    depth: int = 0


def parse_stack(xml: bytes, name: str) -> Project:
    """The project that a ``stack.xml`` describes; ``name`` is for the errors. Groups are resolved:
    their opacity, position and visibility are applied to their layers.

    Raises:
        ProjectError: the XML is damaged, or a value makes no sense.

    Warns:
        LampblackWarning: layers have a blend mode that is not supported.
    """
    root = sound_xml(xml, name)
    stack = root.find("stack")
    if root.tag != "image" or stack is None:
        raise ProjectError(f"{name} describes no layers.", "Save it again.")
    width, height = whole(root, "w", 0), whole(root, "h", 0)
    check_size(width, height, name)
    if sum(1 for _ in root.iter("layer")) > MAX_LAYERS:
        raise ProjectError(f"{name} has more than {MAX_LAYERS} layers.")
    blended = {e.get("name", "") for e in stack.iter() if e.get("composite-op", PLAIN) != PLAIN}
    if blended:
        named = ", ".join(map(repr, sorted(blended)[:8]))
        warnings.warn(
            f"{name}: {named} have blend modes that Lampblack does not know; they are shown as "
            "if they had none.",
            LampblackWarning,
            stacklevel=2,
        )
    # Keys are positioned relative to the middle of the canvas, as in Pencil2D.
    found = list(_layers(stack, _Group(-(width // 2), -(height // 2)), name))
    layers = tuple(
        Layer(number, label or f"Layer {number}", "bitmap", visible, (key,))
        for number, (label, visible, key) in enumerate(reversed(found), start=1)
    )
    return Project(layers, (Camera("Canvas", width, height, (CameraKey(1),)),), 1, 1)


def _layers(stack: Element, group: _Group, name: str) -> Iterator[tuple[str, bool, Key]]:
    """Name, visibility and picture of each layer, topmost first."""
    if group.depth > MAX_DEPTH:
        raise ProjectError(f"{name} has groups in groups, {MAX_DEPTH} deep.")
    for element in stack:
        inner = _Group(
            group.left + whole(element, "x", 0),
            group.top + whole(element, "y", 0),
            group.opacity * min(1.0, max(0.0, number(element, "opacity", 1.0))),
            group.visible and element.get("visibility", "visible") == "visible",
            group.depth + 1,
        )
        if element.tag == "stack":
            yield from _layers(element, inner, name)
        elif element.tag == "layer":
            # Pictures are in one folder; a name that leads out of it is refused on reading.
            file = element.get("src", "").removeprefix(FOLDER)
            key = Key(1, file, inner.left, inner.top, inner.opacity)
            yield element.get("name", "")[:200], inner.visible, key
