"""What a client wants to see at one moment, as one value that never changes."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Literal

from ..composite.sheet import Box
from ..scene import AreaLight, Canvas, Scene

Affine = tuple[float, float, float, float, float, float]
IDENTITY: Affine = (1.0, 0.0, 0.0, 0.0, 1.0, 0.0)

Show = Literal["lit", "normals", "relief"]


@dataclass(frozen=True)
class Look:
    """What the client looks at: ``size`` device pixels (width, height) of ``crop``, in pixels
    of the frame's drawing."""

    request: int
    frame: int
    show: Show
    crop: Box
    size: tuple[int, int]


@dataclass(frozen=True)
class Snapshot:
    """A look with all that it shows.

    Attributes:
        session: whose it is.
        look: what is looked at.
        digest: the drawing that the frame shows.
        camera: canvas to view, see the specification's section 4.
        revision: of the scene; 0 before the first.
        scene: in canvas pixels; None before the first.
    """

    session: str
    look: Look
    digest: str
    camera: Affine
    revision: int
    scene: Scene | None

    @property
    def order(self) -> tuple[int, int]:
        """Rises with what is newer."""
        return self.look.request, self.revision


def scene_in_view(scene: Scene, camera: Affine, size: tuple[int, int]) -> Scene:
    """``scene`` in the pixels of a drawing of ``size`` (width, height), through its camera."""
    if camera == IDENTITY:
        return replace(scene, canvas=Canvas(*size))
    a, b, c, d, e, f = camera
    scale = math.sqrt(abs(a * e - b * d))
    width, height = (
        min(65536, max(1, round(side * scale)))
        for side in (scene.canvas.width, scene.canvas.height)
    )
    canvas = Canvas(width, height)

    def seen(light: AreaLight) -> AreaLight:
        return replace(
            light,
            x=a * light.x + b * light.y + c,
            y=d * light.x + e * light.y + f,
            z=light.z * scale,
            size=max(1.0, light.size * scale),
        )

    floor = scene.floor
    if floor is not None:
        floor = replace(floor, y=d * scene.canvas.width / 2 + e * floor.y + f)
    lights = tuple(seen(light) for light in scene.lights)
    return replace(scene, canvas=canvas, lights=lights, floor=floor)
