"""The scene, and the one to start with."""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import dataclass, field, replace
from typing import Annotated

from msgspec import Meta

from ..affects import Affects, traced_part
from ..choices import QualityName
from .depth import Depth
from .floor import Floor
from .lights import Ambient, AreaLight, PaintedLight
from .look import Look, Rim
from .materials import Material
from .values import Colour, Extra

VERSION = 1
MAX_LIGHTS = 8


@dataclass(frozen=True)
class Canvas:
    """Size of the drawings this scene was made for, in pixels."""

    width: Annotated[int, Meta(ge=1, le=65536, description="pixels")]
    height: Annotated[int, Meta(ge=1, le=65536, description="pixels")]
    extra: Extra = field(default_factory=dict)

    @property
    def default_height(self) -> float:
        """Height of a light above the paper at which power 1 is calibrated, in pixels."""
        return max(self.width, self.height) / 2


@dataclass(frozen=True)
class Scene:
    """All that the artist sets. Materials are keyed by flat colour, so they survive any
    reordering of the palette; colours without one wear ``default_material``."""

    canvas: Canvas
    lights: Annotated[
        tuple[AreaLight, ...], Meta(max_length=MAX_LIGHTS, description="its lamps and suns")
    ] = ()
    ambient: Ambient = field(default_factory=Ambient)
    painted_light: PaintedLight = field(default_factory=PaintedLight)
    materials: Annotated[
        dict[Colour, Material],
        Meta(max_length=4096, description="a Material for each flat colour, by #rrggbb"),
    ] = field(default_factory=dict)
    default_material: Material = field(default_factory=Material)
    floor: Floor | None = None
    look: Annotated[Look, Affects.COMPOSITE] = field(default_factory=Look)
    rim: Annotated[Rim | None, Affects.COMPOSITE] = None
    relief_scale: Annotated[
        float, Meta(ge=0.01, le=10, description="volume of the whole character: 0.5 is flatter")
    ] = 1.0
    depth: Depth = field(default_factory=Depth)
    quality: Annotated[
        QualityName, Meta(description="noise and detail of rendered frames"), Affects.SAMPLING
    ] = "low"
    version: Annotated[
        int, Meta(ge=VERSION, le=VERSION, description="of this format"), Affects.NOTHING
    ] = VERSION
    extra: Extra = field(default_factory=dict)

    def material(self, colour: str) -> Material:
        """The material of the flat colour ``#rrggbb``."""
        return self.materials.get(colour, self.default_material)

    @property
    def brightest(self) -> float:
        """The largest emission of its materials."""
        worn = (self.default_material, *self.materials.values())
        return max(material.emission for material in worn)

    def render_key(self, *, materials: bool = True, sampling: bool = True) -> Hashable:
        """All that shapes the traced light, but for the area lights, each of which has a
        ``geometry`` of its own.

        Args:
            materials: False where those of one drawing's colours are compared instead.
            sampling: False where it does not matter how finely light is traced.
        """
        scene = replace(self, lights=())
        if not materials:
            scene = replace(scene, materials={}, default_material=Material())
        return traced_part(scene, *(() if sampling else (Affects.SAMPLING,)))


def default_light(canvas: Canvas, x: float, y: float, z: float | None = None) -> AreaLight:
    """A white light over (x, y), at the default height unless told otherwise.

    It has more than power 1, because most of a character is turned away from its light.
    """
    return AreaLight(
        x=x,
        y=y,
        z=canvas.default_height if z is None else z,
        size=max(1.0, 0.4 * canvas.default_height),
        power=1.2,
    )


def default_scene(width: int, height: int) -> Scene:
    """One light above the upper left of a ``width`` x ``height`` canvas, no floor."""
    canvas = Canvas(width, height)
    return Scene(canvas=canvas, lights=(default_light(canvas, 0.25 * width, 0.2 * height),))
