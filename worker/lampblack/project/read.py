"""Reading projects: from XML to a ``Project``."""

from __future__ import annotations

import re
import warnings
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from xml.etree.ElementTree import Element, tostring

from ..errors import LampblackWarning, ProjectError
from .archive import ORA, Archive, open_archive
from .attributes import check_size, number, sound_xml, whole
from .camera_layer import Between, Camera, CameraKey
from .document import Key, Kind, Layer, Project
from .easing import CURVES, LINEAR
from .kra import read_kra
from .ora import parse_stack

PENCIL2D = (".pclx", ".pcl")
PSD = (".psd", ".psb")
KRA = ".kra"
BITMAP, VECTOR, CAMERA = "1", "2", "5"
KINDS: dict[str, Kind] = {BITMAP: "bitmap", VECTOR: "vector"}
MAX_LAYERS = 1000
MAX_FRAME = 999_999
MAX_KEYS = 100_000
LONGEST = 100_000
DEFAULT_CAMERA = Camera("Camera Layer", 800, 600, (CameraKey(1),))
"""What Pencil2D adds to a project of its early versions, which has none."""

Version = tuple[int, int, int]
SUFFIXES = (*PENCIL2D, ORA, KRA, *PSD)
"""Of all files that are read as projects."""


def is_project(path: str | Path) -> bool:
    """Whether ``path`` has the suffix of a Pencil2D project, or of one drawing with layers."""
    return Path(path).suffix.lower() in SUFFIXES


def read_project(path: str | Path) -> tuple[Project, Archive]:
    """Read a project or a drawing with layers. Its pictures are read later, when they are needed.

    Raises:
        ProjectError: the file is no project, is damaged, or has a value that makes no sense.
    """
    path = Path(path)
    if path.suffix.lower() in PSD:
        from .psd import read_psd  # psd-tools takes a moment to load

        return read_psd(path)
    if path.suffix.lower() == KRA:
        return read_kra(path)
    archive = open_archive(path)
    xml, name = archive.xml(), archive.path.name
    if archive.path.suffix.lower() == ORA:
        return parse_stack(xml, name), archive
    return _blanked(parse(xml, name), archive), archive


def parse(xml: bytes, name: str) -> Project:
    """The project that ``xml`` describes; ``name`` is for the errors.

    Raises:
        ProjectError: see ``read_project``.
    """
    root = sound_xml(xml, name)
    described = [element for top in root.iter("object") for element in top.findall("layer")]
    if root.tag not in ("document", "object") or not described:
        raise ProjectError(
            f"{name} is not a project with layers.", "Open it in Pencil2D, and save it again."
        )
    if len(described) > MAX_LAYERS:
        raise ProjectError(f"{name} has more than {MAX_LAYERS} layers.", "Merge some of them.")
    moving = [element for element in described if element.get("type") == CAMERA]
    version = _version(root, moving)
    drawn = [element for element in described if element.get("type") in KINDS]
    layers = tuple(_layer(element, KINDS[element.attrib["type"]], version) for element in drawn)
    between: Between = "parameters" if version >= (0, 7) else "matrices"
    cameras = tuple(_camera(element, between) for element in moving) or (DEFAULT_CAMERA,)
    keyed: list[tuple[Key, ...] | tuple[CameraKey, ...]] = [thing.keys for thing in layers]
    keyed += [camera.keys for camera in cameras]
    length = max((key.frame for keys in keyed for key in keys), default=1)
    length = max(length, _marked_end(root))
    if length > LONGEST:
        raise ProjectError(
            f"{name} is {length} frames long; {LONGEST} is the most.", "Cut it into shots."
        )
    return Project(layers, cameras, length, whole(root.find("projectdata/fps"), "value", 12))


def _layer(element: Element, kind: Kind, version: Version) -> Layer:
    name = _name(element)
    keys: dict[int, Key] = {}
    for image in _bounded(element.findall("image"), name):
        inline = kind == "vector" and image.get("src") is None
        if (0, 7) <= version < (0, 7, 2) and not inline and not image.get("src"):
            continue  # no key there; a blank key before and since
        key = Key(
            frame=_frame(image, name),
            file=image.get("src", ""),
            left=whole(image, "topLeftX", 0),
            top=whole(image, "topLeftY", 0),
            opacity=min(1.0, max(0.0, number(image, "opacity", 1.0))),
            inline=tostring(image) if inline else b"",
        )
        keys[key.frame] = key
    ordered = tuple(keys[frame] for frame in sorted(keys))
    return Layer(
        whole(element, "id", 0), name, kind, element.get("visibility", "1") != "0", ordered
    )


def _version(root: Element, cameras: list[Element]) -> Version:
    """The version of Pencil2D that the project is of. Debian's 0.7.0 calls itself 0.0.0.0, but its
    cameras have attributes that earlier ones do not."""
    text = (root.findtext("version") or "").strip()
    told = re.match(r"v?(\d{1,3})\.(\d{1,3})(?:\.(\d{1,3}))?", text)
    version = (int(told[1]), int(told[2]), int(told[3] or 0)) if told else (0, 0, 0)
    keys = [key for camera in cameras for key in camera.findall("camera")]
    is_new = any("showPath" in camera.attrib for camera in cameras) or any(
        {"easing", "pathCPX", "pathCPY"} & set(key.attrib) for key in keys
    )
    return max(version, (0, 7, 0)) if is_new else version


def _camera(element: Element, between: Between) -> Camera:
    name = _name(element)
    width, height = whole(element, "width", 800), whole(element, "height", 600)
    check_size(width, height, f"The camera {name!r}")
    keys: dict[int, CameraKey] = {}
    for moved in _bounded(element.findall("camera"), name):
        key = CameraKey(
            frame=_frame(moved, name),
            dx=number(moved, "dx", 0),
            dy=number(moved, "dy", 0),
            turn=number(moved, "r", 0),
            scale=number(moved, "s", 1),
            easing=whole(moved, "easing", LINEAR),
        )
        if "pathCPX" in moved.attrib or "pathCPY" in moved.attrib:
            # Pencil2D saves where the camera goes; drawings move the other way.
            bend = -number(moved, "pathCPX", 0), -number(moved, "pathCPY", 0)
            key = replace(key, bend=bend)
        if abs(key.scale) < 1e-3:
            raise ProjectError(
                f"The camera {name!r} shrinks frame {key.frame} to nothing.",
                "Give its key there a larger scale, or delete the key.",
            )
        if key.easing not in CURVES and key.easing != LINEAR:
            warnings.warn(
                f"The camera {name!r} has an easing, number {key.easing}, which Lampblack does "
                "not know; it moves at a constant speed there.",
                LampblackWarning,
                stacklevel=2,
            )
            key = replace(key, easing=LINEAR)
        keys[key.frame] = key
    return Camera(name, width, height, tuple(keys[frame] for frame in sorted(keys)), between)


def _blanked(project: Project, archive: Archive) -> Project:
    """Pencil2D writes no picture for a keyframe that nobody drew on, and shows nothing there.

    Warns:
        LampblackWarning: a picture that was drawn has been lost: its place is not the origin.
    """
    lost: list[str] = []

    def blanked(layer: Layer, key: Key) -> Key:
        if key.inline or (key.file and archive.has(key.file)):
            return key
        if key.file and (key.left, key.top) != (0, 0):
            lost.append(f"frame {key.frame} of {layer.name!r}")
        return replace(key, file="")

    layers = tuple(
        replace(layer, keys=tuple(blanked(layer, key) for key in layer.keys))
        for layer in project.layers
    )
    if lost:
        named = ", ".join(lost[:8]) + (", ..." if len(lost) > 8 else "")
        warnings.warn(
            f"The pictures of {named} are not in {archive.path.name}; nothing is shown there. "
            "Restore them from a backup, or draw them again.",
            LampblackWarning,
            stacklevel=3,
        )
    return replace(project, layers=layers)


def _name(element: Element) -> str:
    return element.get("name", "")[:200]


def _bounded(elements: list[Element], name: str) -> Iterator[Element]:
    if len(elements) > MAX_KEYS:
        raise ProjectError(
            f"The layer {name!r} has more than {MAX_KEYS} keyframes.", "Cut the project into shots."
        )
    return iter(elements)


def _frame(element: Element, name: str) -> int:
    """A frame before 1 is never shown itself, but its key holds until the next one."""
    frame = whole(element, "frame", 0)
    if abs(frame) > MAX_FRAME:
        raise ProjectError(
            f"The layer {name!r} has a keyframe at {frame}.", f"The last frame is {MAX_FRAME}."
        )
    return frame


def _marked_end(root: Element) -> int:
    """The last frame of the playback range; 1 if no range is marked."""
    ranged = root.find("projectdata/isRangedPlayback")
    if ranged is None or ranged.get("value") != "true":
        return 1
    return max(1, whole(root.find("projectdata/markOutFrame"), "value", 1))
