"""The lit picture taken apart into layers, one for each term of the composite."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..drawing.drawing import Drawing
from ..render.passes import Passes
from ..scene import Material, Scene
from .blend import SPLITS, Blend, Picture, without_colour
from .float_kernel import composite_float, composite_unrounded
from .form import Form
from .illumination import Illumination

Stage = NDArray[Any]
"""(H, W, 4) sRGB with straight alpha, uint8 or float32 in 0 to 1."""
Floats = NDArray[np.float32]
Edges = NDArray[np.uint8]
Layer = tuple[str, Blend, Picture]
"""Name, blend mode, and (H, W, 4) uint8 sRGB with straight alpha."""

_UNIT = np.ones(3, np.float32), np.ones((1, 1, 3), np.float32), np.zeros((1, 1, 3), np.float32)
_NOISE = 1 / 1020  # of float pictures: the drawing under unit light is the drawing


def _without_gloss(scene: Scene) -> Scene:
    materials = {name: replace(one, gloss=0.0) for name, one in scene.materials.items()}
    default = replace(scene.default_material, gloss=0.0)
    worn = (*scene.materials.values(), scene.default_material)
    if not any(material.glossy and material.gloss for material in worn):
        return scene
    return replace(scene, materials=materials, default_material=default)


def _without_rim(scene: Scene) -> Scene:
    return scene if scene.rim is None else replace(scene, rim=None)


def _without_glow(scene: Scene) -> Scene:
    if not scene.look.glow or not scene.brightest:
        return scene
    return replace(scene, look=replace(scene.look, glow=0.0))


TERMS: tuple[tuple[str, Callable[[Scene], Scene]], ...] = (
    ("highlight", _without_gloss),
    ("rim", _without_rim),
    ("glow", _without_glow),
)
"""Terms that add light, lowest first: the name of each, and the scene without it."""

LAYERS: tuple[tuple[str, Blend], ...] = (
    ("drawing", "normal"),
    ("floor_shadow", "multiply"),
    ("shade", "multiply"),
    ("light", "add"),
    *((name, "add") for name, _ in TERMS),
)
"""Names and blend modes of the layers, lowest first."""


@dataclass(frozen=True)
class Stages:
    """A picture in its stages, all of one size and type.

    Attributes:
        drawn: as drawn. floor: with the shadow on the floor.
        lit: with the light, then with each of ``TERMS`` in turn; the last is the lit picture.
    """

    drawn: Stage
    floor: Stage
    lit: tuple[Stage, ...]

    @staticmethod
    def unlit(drawn: Stage) -> Stages:
        """The stages of a picture that is shown as drawn."""
        return Stages(drawn, drawn, (drawn,) * (1 + len(TERMS)))

    def seen(self, finish: Callable[[Stage], Stage]) -> Stages:
        """Every stage after ``finish``, which is called once for each picture."""
        done: dict[int, Stage] = {}
        for picture in (self.drawn, self.floor, *self.lit):
            if id(picture) not in done:
                done[id(picture)] = finish(picture)
        return Stages(
            done[id(self.drawn)], done[id(self.floor)], tuple(done[id(one)] for one in self.lit)
        )


def byte_stages(
    drawing: Drawing,
    passes: Passes,
    scene: Scene,
    edges: Edges | None = None,
    form: Form | None = None,
) -> Stages:
    """The stages of a lit drawing in bytes. The last is what ``composite`` returns; ``edges`` are
    as there, and ``form`` as in ``Illumination``."""
    return _stages(drawing, passes, scene, edges, form, composite_float, drawing.pixels)


def float_stages(
    drawing: Drawing,
    passes: Passes,
    scene: Scene,
    edges: Edges | None = None,
    form: Form | None = None,
) -> Stages:
    """The same before rounding, in 0 to 1."""
    drawn = drawing.pixels.astype(np.float32) / 255
    return _stages(drawing, passes, scene, edges, form, composite_unrounded, drawn)


def _stages(
    drawing: Drawing,
    passes: Passes,
    scene: Scene,
    edges: Edges | None,
    form: Form | None,
    composite: Callable[[Drawing, Illumination, Scene, Edges | None], Stage],
    drawn: Stage,
) -> Stages:
    scenes = [scene]
    for _, without in reversed(TERMS):
        scenes.insert(0, without(scenes[0]))
    lit: list[Stage] = []
    for before, now in zip([None, *scenes], scenes, strict=False):
        same = before is not None and now is before
        light = Illumination.of(passes, now, form)
        lit.append(lit[-1] if same else composite(drawing, light, now, edges))
    floor = drawn
    if scene.floor is not None:
        plain = replace(
            scene, materials={}, default_material=Material(diffuse=False), rim=None, floor=None
        )
        shadow = Illumination([_UNIT], floor=Illumination.of(passes, scene).floor)
        bare = composite(drawing, Illumination([_UNIT]), plain, None)
        cast = composite(drawing, shadow, replace(plain, floor=scene.floor), None)
        apart = abs(cast.astype(np.float32) - bare)
        level = 0 if cast.dtype == np.uint8 else _NOISE
        floor = np.where((apart > level).any(axis=2, keepdims=True), cast, drawn)
    return Stages(drawn, floor, tuple(lit))


def apart_bytes(stages: Stages, *, blended: bool = True) -> list[Layer]:
    """The layers of the last stage, lowest first. Laid over one another they show it: exactly
    where the pixels of the drawing are opaque or empty, and to within rounding elsewhere.

    They are made from the top down: each layer is what makes the stage below it into what is
    wanted, and what it cannot do is wanted from those beneath. The drawing takes the rest.

    Args:
        blended: False makes layers without blend modes.
    """
    drawn, floor, *lit = map(without_colour, (stages.drawn, stages.floor, *stages.lit))
    same = floor[..., 3:] == lit[0][..., 3:]
    below = [drawn, floor, np.where(same, np.minimum(floor, lit[0]), lit[0]), *lit]
    wanted = lit[-1]
    layers: list[Layer] = []
    for (name, blend), beneath in reversed(list(zip(LAYERS[1:], below, strict=False))):
        used: Blend = blend if blended else "normal"
        layer, wanted = SPLITS[used](beneath, wanted)
        layers.insert(0, (name, used, layer))
    return [("drawing", "normal", wanted), *layers]


def apart_linear(stages: Stages, light: Callable[[Floats], Floats]) -> dict[str, Floats]:
    """The layers by name, to be combined in scene-linear light: the drawing, (H, W, 4), times
    ``floor_shadow`` times ``shade``, plus all others, (H, W, 3), is the colour of the last stage.

    Args:
        light: from a stage to scene-linear light, premultiplied.
    """
    drawn, floor, *lit = (light(stage) for stage in (stages.drawn, stages.floor, *stages.lit))
    layers = {"drawing": drawn, "floor_shadow": _share(drawn, floor)}
    so_far = drawn[..., :3] * layers["floor_shadow"]
    layers["shade"] = _share(so_far, lit[0])
    so_far = so_far * layers["shade"]
    for (name, _), picture in zip(LAYERS[3:], lit, strict=True):
        layers[name] = picture[..., :3] - so_far
        so_far = picture[..., :3]
    return layers


def _share(below: Floats, wanted: Floats) -> Floats:
    """The factor, at most 1, that darkens ``below`` to ``wanted``."""
    old, new = below[..., :3], wanted[..., :3]
    return np.where(old > 0, np.minimum(new / np.maximum(old, np.float32(1e-6)), 1), 1).astype(
        np.float32
    )
