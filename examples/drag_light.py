"""Record a dragged light: what a live client is sent while the hand moves, as an animated GIF.

    python examples/drag_light.py docs/images/dragged-light.gif

Every picture comes from ``lampblack serve`` through its socket, at the pace at which it came.
"""

from __future__ import annotations

import math
import sys
import tempfile
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from lampblack.atomic import atomic_file
from lampblack.drawing import load_picture
from lampblack.protocol import Image as Lit
from lampblack.scene import Scene, decode_scene
from lampblack.service.client import Client, Worker

HERE = Path(__file__).parent
SIDE = 360
SECONDS = 5.0
HERTZ = 60


def dragged(scene: Scene, share: float) -> Scene:
    """The scene with its first light a ``share`` of the way round the character."""
    angle = 2 * math.pi * share - 2.2
    light = scene.lights[0]
    x, y = 500 + 430 * math.cos(angle), 430 + 330 * math.sin(angle)
    return replace(scene, lights=(replace(light, x=x, y=y), *scene.lights[1:]))


def record(client: Client, scene: Scene) -> list[tuple[float, NDArray[np.uint8], Scene]]:
    """Drag at ``HERTZ``; when each picture came (seconds), it, and the scene it shows."""
    scenes = {client.set_scene(dragged(scene, 0)): dragged(scene, 0)}
    client.look(1, (SIDE, SIDE), (0.0, 0.0, 1000.0, 1000.0))
    client.picture(120, lambda image: image.converged)
    shown = []
    start = time.monotonic()
    while (now := time.monotonic() - start) < SECONDS:
        moved = dragged(scene, now / SECONDS)
        scenes[client.set_scene(moved)] = moved
        until = start + now + 1 / HERTZ
        while (left := until - time.monotonic()) > 0:
            received = client.receive(left)
            if received and isinstance(received.message, Lit):
                came = time.monotonic() - start
                picture = np.array(received.planes["picture"])
                shown.append((came, picture, scenes[received.message.revision]))
    return shown


def paint(picture: NDArray[np.uint8], scene: Scene) -> Image.Image:
    """A premultiplied picture on white, and where the light is."""
    white = picture[..., :3] + (255 - picture[..., 3:])
    image = Image.fromarray(white.astype(np.uint8))
    light, scale = scene.lights[0], SIDE / 1000
    x, y = light.x * scale, light.y * scale
    pen = ImageDraw.Draw(image)
    pen.ellipse((x - 7, y - 7, x + 7, y + 7), fill=light.colour, outline="#402010", width=2)
    return image


def main(target: Path) -> None:
    """Record and write ``target``."""
    scene = decode_scene((HERE / "character.scene.json").read_bytes())
    with (
        tempfile.TemporaryDirectory() as folder,
        Worker(Path(folder)) as worker,
        worker.connect() as client,
    ):
        client.hello()
        client.announce(1, load_picture(HERE / "character.png"))
        shown = record(client, scene)
    # A GIF is shown in steps of 20 ms at best: of the pictures of one step the last is kept.
    steps = {int(came / 0.06): paint(picture, at) for came, picture, at in shown}
    first, *others = (
        image.quantize(128, dither=Image.Dither.NONE) for _, image in sorted(steps.items())
    )
    pace = round(1000 * SECONDS / len(steps) / 20) * 20
    with atomic_file(target) as file:
        first.save(file, "GIF", save_all=True, append_images=others, duration=pace, loop=0)
    sys.stdout.write(f"{len(shown)} pictures in {SECONDS} s, {len(steps)} kept\n")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
