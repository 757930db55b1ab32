"""Messages that are nearly right."""

from __future__ import annotations

import json
import random
from collections.abc import Iterator

from lampblack.protocol import (
    Crop,
    Hello,
    Message,
    Preview,
    PutFrame,
    Render,
    SetScene,
    encode,
    frame_digest,
)
from lampblack.scene import default_scene
from support.drawings import draw_ball


def hostile(chance: random.Random, count: int) -> Iterator[list[bytes]]:
    """Messages that are nearly right: sound JSON with a field made absurd, and torn bytes."""
    picture = draw_ball(32)
    planes = {"pixels": picture}
    crop = Crop(x=0, y=0, width=32, height=32)
    sound: list[tuple[Message, dict]] = [
        (Hello(minor=0, client="fuzz", client_version="1"), {}),
        (PutFrame(frame=1, digest=frame_digest(planes)), planes),  # type: ignore[arg-type]
        (SetScene(revision=1, scene=default_scene(32, 32)), {}),
        (Preview(request=1, frame=1, crop=crop, width=32, height=32), {}),
        (Render(request=2, frames="1-3", output="/nonexistent/%04d.png"), {}),
    ]
    absurd = [
        None,
        -1,
        0,
        1e30,
        2**53,
        "",
        "x" * 300,
        [],
        {},
        True,
        float("1e308"),
        [[[[]]]],
        "\x00",
    ]

    def spoil(value: object) -> object:
        if isinstance(value, dict) and value:
            key = chance.choice([k for k in value if k not in ("lampblack", "type")] or list(value))
            return {**value, key: spoil(value[key])}
        if isinstance(value, list) and value and chance.random() < 0.7:
            place = chance.randrange(len(value))
            return [spoil(v) if i == place else v for i, v in enumerate(value)]
        return chance.choice(absurd)

    for _ in range(count):
        message, carried = chance.choice(sound)
        header, *payload = (bytes(frame) for frame in encode(message, carried))
        kind = chance.random()
        if kind < 0.7:
            tree = spoil(json.loads(header))
            header = json.dumps(tree, separators=(",", ":")).encode()
        elif kind < 0.85:
            place = chance.randrange(len(header))
            header = header[:place] + bytes([chance.randrange(256)]) + header[place + 1 :]
        else:
            payload = [chance.randbytes(chance.randrange(64)) for _ in range(chance.randrange(6))]
        yield [header, *payload]
