"""Draw the example pictures and write their scenes, beside this file.

Run with ``python examples/draw.py``; needs numpy, scipy, pillow and the installed package. The
pictures come out the same on every run.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pose as character
from lamplighter import draw_lamplighter
from pencil2d import write_project
from PIL import Image
from pose import Foot, Pose

from lampblack.scene import Ambient, AreaLight, Canvas, Floor, Material, Scene, encode_scene

STILL_SIZE = (1000, 1000)
STILL_FLOOR = (543.0, 900.0)
FRAME_SIZE = (640, 720)
FRAME_FLOOR = (346.0, 652.0)

STAND = Pose()
HOP = (
    STAND,
    STAND,
    Pose(  # gathers itself
        squash=0.88, lean=-8, lantern_arm=(176, 222), free_arm=(48, 140), swing=-3, tail=10,
        scarf=-8, eyes_shut=True, smile=0.0,
    ),
    Pose(  # takes off
        hop=66, squash=1.06, lean=8, lantern_arm=(196, 238), free_arm=(-4, -58), palm_out=True,
        swing=9, tail=16, scarf=40, gaze=(-6, -10), smile=0.7,
        feet=(Foot(6, 10, 22), Foot(-6, 16, 28)),
    ),
    Pose(  # waves at the top
        hop=128, squash=1.0, lean=10, lantern_arm=(200, 240), free_arm=(-14, -66), palm_out=True,
        paw_turn=-10, swing=2, tail=-2, scarf=32, gaze=(4, 4), smile=1.2, hat_lift=10,
        feet=(Foot(-4, -14, -10), Foot(8, -6, 14)),
    ),
    Pose(  # comes down, hat last
        hop=72, squash=1.05, lean=2, lantern_arm=(204, 244), free_arm=(-18, -78), palm_out=True,
        paw_turn=8, swing=-8, tail=-14, scarf=-16, gaze=(-4, 10), smile=0.9, hat_lift=24,
        feet=(Foot(0, 10, 6), Foot(0, 4, -4)),
    ),
    Pose(  # lands
        squash=0.87, lean=-6, lantern_arm=(186, 230), free_arm=(-2, -65), palm_out=True,
        swing=-2, tail=8, scarf=30, eyes_shut=True, smile=0.8,
        feet=(Foot(-10), Foot(10)),
    ),
    Pose(  # settles
        squash=1.03, lean=2, lantern_arm=(190, 231), free_arm=(27, 143), swing=8, tail=-4,
        scarf=5,
    ),
)  # fmt: skip

MATERIALS = {
    character.FUR: Material(),
    character.CREAM: Material(glossy=True, gloss=0.1, roughness=0.5),
    character.SCARF: Material(),
    character.STRIPE: Material(),
    character.BRASS: Material(glossy=True, gloss=0.35, roughness=0.2),
    # The lantern shines of itself: left as drawn.
    character.GLASS: Material(diffuse=False),
    character.FLAME: Material(diffuse=False),
    character.BOOTS: Material(glossy=True, gloss=0.14, roughness=0.2),
    character.SOLES: Material(),
    character.HAT: Material(),
    character.PINK: Material(),
    character.WHITE: Material(glossy=True, gloss=0.2, roughness=0.15),
    character.BLACK: Material(diffuse=False, glossy=True, gloss=0.8, roughness=0.12),
}


def draw_still() -> Image.Image:
    """The character at rest, 1000 x 1000."""
    return draw_lamplighter(STILL_SIZE, STILL_FLOOR, scale=0.96, line=1.0, pose=STAND).picture()


def draw_frame(pose: Pose) -> Image.Image:
    """One frame of the hop, 640 x 720."""
    return draw_lamplighter(FRAME_SIZE, FRAME_FLOOR, scale=0.575, line=0.68, pose=pose).picture()


def light(size: tuple[int, int], floor_y: float) -> Scene:
    """A warm key light from the upper left front and a cool one from behind on the right."""
    width, height = size
    canvas = Canvas(width, height)
    reach = canvas.default_height
    key = AreaLight(
        x=0.0, y=0.05 * height, z=1.5 * reach, size=0.4 * reach, colour="#ffe3b8", power=4.2
    )
    rim = AreaLight(
        x=width, y=0.35 * height, z=-0.4 * reach, size=0.5 * reach, colour="#8db7ff", power=2.0
    )
    return Scene(
        canvas=canvas,
        lights=(key, rim),
        ambient=Ambient(colour="#dfe6ff", strength=0.3),
        materials=MATERIALS,
        floor=Floor(y=floor_y),
        quality="medium",
    )


def main() -> None:
    """Write every picture and scene."""
    here = Path(__file__).parent
    frames = here / "animation"
    frames.mkdir(exist_ok=True)
    draw_still().save(here / "character.png", optimize=True)
    hop = [draw_frame(pose) for pose in HOP]
    for number, picture in enumerate(hop, start=1):
        picture.save(frames / f"lamplighter.{number:04d}.png", optimize=True)
    project = here / "lamplighter.pclx"
    write_project(project, [np.asarray(p.convert("RGBA")) for p in hop], 2, 12, "Lamplighter")
    # The soles reach a little below the line on which the character stands.
    still = light(STILL_SIZE, STILL_FLOOR[1] + 6)
    (here / "character.scene.json").write_bytes(encode_scene(still))
    moving = encode_scene(replace(light(FRAME_SIZE, FRAME_FLOOR[1] + 4), quality="low"))
    (here / "animation.scene.json").write_bytes(moving)
    (here / "lamplighter.pclx.lampblack.json").write_bytes(moving)


if __name__ == "__main__":
    main()
