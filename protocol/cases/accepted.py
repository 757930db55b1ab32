"""Messages to accept."""

from __future__ import annotations

from collections.abc import Iterator

from lampblack.scene import MAX_KEYS

from .case import Case, patched
from .samples import (
    DIGEST,
    DRAWING,
    HELLO,
    INK,
    LAYERS,
    LIGHT,
    MASK,
    PIXELS,
    SAMPLES,
    SCENE,
    SET_SCENE,
    first_image,
    padded,
    payloads,
    plane,
    put_frame,
)

SCENE_OF_LATER = {
    "canvas": {"width": 1, "height": 65536, "dpi": 300},
    "mood": {"name": "dusk", "x": [1, None, {"deep": 0.5}]},
    "lights": [
        {"x": -100000, "y": 1e5, "z": 0.5, "size": 1, "colour": "#0a0b0c", "power": 100}
        | {"gobo": [1, {"deep": None}]}
    ],
    "ambient": {"colour": "#ffffff", "strength": 0, "map": "sky"},
    "materials": {"#ff0000": {"glossy": True, "gloss": 1, "roughness": 0.02, "sheen": 0.5}},
    "default_material": {"diffuse": False, "weave": 3},
    "floor": {"y": 470.5, "pitch": 85, "wet": True},
    "relief_scale": 0.01,
    "quality": "final",
    "version": 1,
}
"""Every field at a value other than its default, most at an end of their range, and fields that
this version does not know at every depth."""

KEYED_SCENE = {
    "canvas": {"width": 640, "height": 480},
    "lights": [
        {"x": 7, "y": 7, "z": 7, "tag": "keyed"}
        | {
            "keys": [
                {"frame": 13, "x": 560, "y": 40.5, "z": -120, "size": 31, "power": 0}
                | {"colour": "#ff8000", "ease": "out"},
                {"frame": 1, "x": -80, "y": 300, "z": 320, "colour": "#0a0b0c", "power": 2.5},
                {"frame": 5, "x": 999, "y": 999, "z": 999},
                {"frame": 24, "x": 560, "y": 40.5, "z": 320.25, "size": 1000, "colour": "#00ff7f"},
                {"frame": 5, "x": 120.1, "y": 60, "z": 0.1, "colour": "#ffffff", "power": 1e-3},
            ]
        },
        LIGHT | {"keys": [{"frame": 999999, "x": 1, "y": 2, "z": 3}]},
        LIGHT | {"keys": []},
        LIGHT,
    ],
    "floor": {"y": 1, "wet": True}
    | {
        "keys": [
            {"frame": 20, "y": -10.5, "pitch": 85},
            {"frame": 6.0, "y": 470, "ease": None},
        ]
    },
}
"""Keys out of order, two at one frame, one alone, and none."""


DEPTH_SCENE = SCENE | {
    "depth": {
        "hints": [{"frame": 3, "front": "joined", "amount": 1}],
        "layers": [{"layer": "arm", "body": "flat"}],
        "strokes": [
            {"frame": 0, "brush": "turn", "radius": 1, "amount": 1, "later": [1]}
            | {"points": [{"x": -1.5, "y": 2}, {"x": 100000, "y": -100000, "z": None}]},
            {"frame": 999999},
            {"frame": 2, "brush": "round"},
            {"frame": 2, "brush": "hollow"},
        ],
        "colours": [{"colour": "#0a0b0c", "volume": 4, "nearer": -1}, {"colour": "#ffffff"}],
    }
}
"""All that can be said of depth, at the ends of its ranges, and the least that can be said."""


def accepted() -> Iterator[Case]:
    """Messages to accept."""
    for sender, trees in SAMPLES.items():
        for tree in trees:
            yield Case(f"{tree['type']}-from-{sender}", sender, tree, payloads(tree))
    yield from accepted_json()
    yield from accepted_planes()
    yield Case("scene-unknown-fields-are-kept", "client", patched(SET_SCENE, scene=SCENE_OF_LATER))
    yield Case(
        "scene-keyed-lights",
        "client",
        patched(SET_SCENE, scene=KEYED_SCENE),
        frames=(0, 1, 2, 4, 5, 6, 7, 9, 12, 13, 18, 20, 23, 24, 25, 999999),
    )
    most = [{"frame": frame, "y": 1} for frame in range(MAX_KEYS)]
    keyed = {**SCENE, "floor": {"y": 1, "keys": most}}
    yield Case("scene-128-keys", "client", patched(SET_SCENE, scene=keyed))
    lights = [
        LIGHT,
        {**LIGHT, "kind": "sun", "name": "S\u00fcnne", "on": False},
        LIGHT | {"solo": True},
    ]
    lights += [LIGHT] * 5
    yield Case(
        "scene-eight-lights", "client", patched(SET_SCENE, scene={**SCENE, "lights": lights})
    )
    yield Case("scene-corrected-depth", "client", patched(SET_SCENE, scene=DEPTH_SCENE))
    yield Case("revision-largest-integer", "client", patched(SET_SCENE, revision=9007199254740991))
    yield Case("image-before-any-scene", "worker", *first_image())
    yield Case(
        "error-of-a-code-from-the-future",
        "worker",
        {"type": "error", "code": "paper_jam_2", "what": "Paper jam."},
    )


def accepted_json() -> Iterator[Case]:
    """What JSON allows, and so do we."""

    def raw(name: str, rest: bytes) -> Case:
        return Case(name, "client", b'{"lampblack":1,' + rest)

    yield raw("json-white-space", b' \t\r\n"type" : "cancel" ,\n "request":\t5 }\r\n ')
    yield raw("json-type-need-not-be-first", b'"request":5,"type":"cancel"}')
    yield raw(
        "json-duplicate-key-last-counts",
        b'"type":"hello","request":"x","type":"cancel","request":5}',
    )
    yield raw("json-duplicate-key-escaped", b'"type":"cancel","request":6,"\\u0072equest":5}')
    yield raw("json-unknown-fields-ignored", b'"type":"cancel","request":5,"a":{"b":[null]}}')
    yield raw("json-magic-twice", b'"type":"cancel","request":5,"lampblack":9}')
    yield raw("json-integer-with-fraction", b'"type":"cancel","request":5.0}')
    yield raw("json-integer-with-exponent", b'"type":"cancel","request":50E-1}')
    yield raw("json-zero-with-large-exponent", b'"type":"drop_frame","frame":0e999}')
    yield raw("json-negative-zero", b'"type":"drop_frame","frame":-0}')
    yield raw("json-smallest-double", b'"type":"cancel","request":5,"x":5e-324}')
    yield raw("json-32-levels", b'"type":"cancel","request":5,"x":' + b"[" * 31 + b"]" * 31 + b"}")
    yield raw(
        "json-brackets-in-strings-are-no-levels",
        b'"type":"bye","reason":"' + b"[{" * 40 + b'\\"[\\\\"}',
    )
    yield raw("json-escapes", b'"type":"bye","reason":"\\"\\\\\\/\\b\\f\\n\\r\\t\\u00e9\\u0000"}')
    yield raw("json-surrogate-pair", b'"type":"bye","reason":"\\ud83d\\ude00 \\uD83D\\uDE00"}')
    yield raw("json-noncharacter", '"type":"bye","reason":"\ufffe\uffff\u2028"}'.encode())
    yield Case(
        "length-counts-code-points",
        "client",
        patched(HELLO, client="\U0001f58c" * 64),
    )


def accepted_planes() -> Iterator[Case]:
    """Planes in all their ways."""
    yield Case("put_frame-announced", "client", put_frame({}, digest=DIGEST))
    for name, planes in {
        "put_frame-mask": {"pixels": PIXELS, "mask": MASK},
        "put_frame-ink": {"pixels": PIXELS, "ink": INK},
        "put_frame-mask-and-ink": {"pixels": PIXELS, "mask": MASK, "ink": INK},
        "put_frame-one-pixel": {"pixels": PIXELS[:1, :1], "mask": MASK[:1, :1]},
    }.items():
        data = tuple(pixels.tobytes() for pixels in planes.values())
        yield Case(name, "client", put_frame(planes), data)  # type: ignore[arg-type]
    yield Case(
        "put_frame-padded-rows",
        "client",
        patched(
            put_frame({"pixels": PIXELS, "mask": MASK}),
            planes=[plane("pixels", PIXELS, 24), plane("mask", MASK, 8)],
        ),
        (padded(PIXELS, 24), padded(MASK, 8)),
    )
    for name, planes in {
        "put_frame-layers": {"pixels": PIXELS},
        "put_frame-layers-mask-and-ink": {"pixels": PIXELS, "mask": MASK, "ink": INK},
    }.items():
        data = tuple(p.tobytes() for p in (*planes.values(), *(p for _, p in LAYERS)))
        yield Case(name, "client", put_frame(planes, LAYERS), data)  # type: ignore[arg-type]
    most = [("", PIXELS)] * 16
    yield Case("put_frame-16-layers", "client", put_frame(DRAWING, most), (PIXELS.tobytes(),) * 17)
    yield Case(
        "put_frame-camera-turned",
        "client",
        put_frame(DRAWING, camera=[0, -1.5, 480, 1.5, 0, 0]),
        (PIXELS.tobytes(),),
    )
