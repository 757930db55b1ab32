"""One full message of every type, from which most cases are made."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from lampblack.protocol import Pixels, Role, Sender, frame_digest

from .case import Tree, patched

# Pixels that no two of are alike, so that a transposed or mirrored reading is found out.
PIXELS = (np.arange(3 * 5 * 4) * 37 % 251).astype(np.uint8).reshape(3, 5, 4)
MASK = (np.arange(3 * 5) * 29 % 256).astype(np.uint8).reshape(3, 5)
INK = (np.arange(3 * 5) * 53 % 256).astype(np.uint8).reshape(3, 5)


def plane(role: str, pixels: Pixels, stride: int = 0) -> Tree:
    """The header's words for an array."""
    forms = {"pixels": "rgba8", "layer": "rgba8", "picture": "rgba8_premultiplied"}
    form = forms.get(role, "a8")
    height, width = pixels.shape[:2]
    row = width * (4 if pixels.ndim == 3 else 1)
    return {
        "role": role,
        "format": form,
        "width": width,
        "height": height,
        "stride": stride or row,
    }


def put_frame(
    planes: dict[Role, Pixels], layers: Sequence[tuple[str, Pixels]] = (), **changes: Any
) -> Tree:
    """A put_frame of these planes and layers."""
    sent = [*planes.items(), *(("layer", pixels) for _, pixels in layers)]
    named = {"layers": [name for name, _ in layers]} if layers else {}
    return {
        "type": "put_frame",
        "frame": 12,
        "digest": frame_digest(planes, layers),
        "planes": [plane(role, pixels) for role, pixels in sent],
        **named,
        **changes,
    }


def padded(pixels: Pixels, stride: int) -> bytes:
    """Rows with padding that is not zero, since it means nothing."""
    rows = np.full((pixels.shape[0], stride), 0xEE, np.uint8)
    rows[:, : pixels[0].nbytes] = pixels.reshape(pixels.shape[0], -1)
    return rows.tobytes()


DRAWING: dict[Role, Pixels] = {"pixels": PIXELS}
DIGEST = frame_digest(DRAWING)
LAYERS = [("body", PIXELS[::-1]), ("arm \u00e9", PIXELS[:, ::-1])]
CROP = {"x": 10.5, "y": -3, "width": 320, "height": 240.25}
LIGHT = {"x": 100, "y": 50.5, "z": 300}
SCENE = {"canvas": {"width": 640, "height": 480}, "lights": [LIGHT]}
PICTURE = plane("picture", PIXELS)
RIG = '{"canvas":{"width":640,"height":480},"name":"D\u00e4mmer","lights":[{"x":1,"y":2,"z":3}]}'

HELLO = {"type": "hello", "minor": 0, "client": "Pencil2D", "client_version": "0.6.6"}
SET_SCENE = {"type": "set_scene", "revision": 1, "scene": SCENE}
LOOK = {"request": 3, "frame": 12, "crop": CROP, "width": 640, "height": 481}
RENDER = {
    "type": "render",
    "request": 5,
    "frames": "1-20x2,25",
    "output": "/shots/walk_v001.%04d.png",
}
SAMPLES: dict[Sender, list[Tree]] = {
    "client": [
        HELLO | {"capabilities": ["premultiplied", "palette_2"]},
        put_frame(DRAWING, [("body", PIXELS)]) | {"camera": [2, 0, -10, 0, 2, -20.5]},
        {"type": "drop_frame", "frame": 0},
        SET_SCENE,
        {"type": "preview", **LOOK},
        {"type": "view", **LOOK, "show": "normals"},
        {"type": "get_palette", "request": 4, "frame": 12},
        {"type": "get_overlaps", "request": 6, "frame": 12},
        {
            "type": "get_rigs",
            "request": 7,
            "frame": 12,
            "side": 64,
            "presets": False,
            "rigs": [RIG],
        },
        {"type": "get_normals", "request": 8, "frame": 12, "side": 128},
        RENDER
        | {"quality": "low", "keep_finished": True, "project": "/shots/walk.pclx"}
        | {"apart": "ora"},
        {"type": "cancel", "request": 5},
        {"type": "bye", "reason": "The window was closed."},
    ],
    "worker": [
        {
            "type": "welcome",
            "minor": 0,
            "session": "0123456789abcdef" * 2,
            "worker_version": "0.1.0",
            "capabilities": ["normals"],
            "status_ms": 500,
        },
        {"type": "need_frame", "frame": 12, "digest": DIGEST},
        {
            "type": "image",
            "request": 3,
            "frame": 12,
            "digest": DIGEST,
            "revision": 7,
            "show": "lit",
            "pass": 2,
            "spp": 4,
            "converged": False,
            "crop": CROP,
            "planes": [PICTURE],
        },
        {
            "type": "palette",
            "request": 4,
            "frame": 12,
            "digest": DIGEST,
            "swatches": [
                {"colour": "#dc783c", "pixels": 9000},
                {"colour": "#00ff7f", "pixels": 12},
            ],
        },
        {
            "type": "overlaps",
            "request": 6,
            "frame": 12,
            "digest": DIGEST,
            "revision": 7,
            "overlaps": [
                {
                    "points": [{"x": 10.5, "y": 20}, {"x": 12, "y": 31.25}],
                    "front": "right",
                    "amount": 14.5,
                    "hinted": True,
                }
            ],
        },
        {
            "type": "rigs",
            "request": 7,
            "frame": 12,
            "digest": DIGEST,
            "names": ["sunset"],
            "rigs": [RIG],
            "planes": [PICTURE],
        },
        {
            "type": "normals",
            "request": 8,
            "frame": 12,
            "digest": DIGEST,
            "planes": [PICTURE],
        },
        {
            "type": "progress",
            "request": 5,
            "frame": 3,
            "share": 0.25,
            "frames_done": 1,
            "frames_total": 11,
        },
        {
            "type": "frame_done",
            "request": 5,
            "frame": 3,
            "path": "/shots/walk_v001.0003.png",
            "kept": True,
        },
        {
            "type": "done",
            "request": 5,
            "outcome": "cancelled",
            "frames_done": 2,
            "frames_total": 11,
            "frames_failed": 1,
        },
        {
            "type": "status",
            "uptime_ms": 61000,
            "revision": 7,
            "preview": "working",
            "job": "off",
            "jobs_waiting": 1,
            "frames_held": 12,
            "frames_lit": 11,
            "memory_bytes": 1500000000,
            "card": "NVIDIA H200",
        },
        {
            "type": "error",
            "code": "nothing_drawn",
            "what": "The frame is blank.",
            "remedy": "Draw a figure.",
            "details": "frame 12\nmask empty",
            "fatal": False,
            "about": "preview",
            "request": 3,
            "frame": 12,
        },
        {"type": "bye", "reason": ""},
    ],
}


def payloads(tree: Tree) -> tuple[bytes, ...]:
    """What follows the header of a sample."""
    return tuple(PIXELS.tobytes() for _ in tree.get("planes", ()))


def first_image() -> tuple[Tree, tuple[bytes, ...]]:
    """The drawing itself, unlit, while nothing better is there."""
    image = next(tree for tree in SAMPLES["worker"] if tree["type"] == "image")
    return patched(image, revision=0, spp=0, **{"pass": 0}), payloads(image)
