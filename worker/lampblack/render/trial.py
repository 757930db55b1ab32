"""A tiny render on a graphics card, compared with the processor's; runs in the render process."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..choices import DeviceChoice, DeviceKind
from ..processors import usable_processors
from ..scene import AreaLight, Canvas
from .cards import find_cards
from .denoise import Denoiser
from .device import Card, Choice, Verdict, choose
from .passes import LightPasses
from .quality import Quality, Sampling
from .stage import Stage
from .trace import trace
from .wire import Started, Trace

SIDE = 32
LARGEST_DIFFERENCE = 0.05
"""Mean difference of two renders of the test picture, as a share of their mean light. The same
samples are traced, so it is rounding alone."""
_SAMPLING = Sampling(1.0, SIDE, 16)
_QUALITY = Quality(light=_SAMPLING, ambient=_SAMPLING, floor=_SAMPLING, mesh_stride=1)

Floats = NDArray[np.float32]


def set_up(wanted: DeviceChoice, memory: Path) -> tuple[Stage, Denoiser, Started]:
    """The scene and the denoiser on the device for ``wanted``, and what to tell the parent."""
    choice = choose(wanted, find_cards, try_card, memory)
    card = choice.card
    if card is not None:
        try:
            kind: DeviceKind = card.kind if choice.denoises else "cpu"
            denoiser = Denoiser(usable_processors(), kind)
            return Stage(card), denoiser, Started(card.kind, card.name, choice.notice)
        except RuntimeError as error:
            lost = f"{card.label} cannot be used now: {error}. The processor is used."
            choice = Choice(notice=lost[:500])
    return Stage(), Denoiser(usable_processors()), Started("cpu", "", choice.notice)


def try_card(card: Card) -> Verdict:
    """Render a ball on the processor and on ``card``.

    Raises:
        RuntimeError: Blender cannot render on it.
    """
    expected = _ball(Stage(), Denoiser(usable_processors()))
    stage = Stage(card)
    why = difference(expected, _ball(stage, Denoiser(usable_processors())))
    if why:
        return Verdict("wrong", why=f"a test picture on it came out wrong: {why}.")
    try:
        denoises = not difference(expected, _ball(stage, Denoiser(usable_processors(), card.kind)))
    except RuntimeError:
        denoises = False
    return Verdict("right", denoises)


def difference(expected: LightPasses, found: LightPasses) -> str:
    """What is wrong with ``found``; empty if it is ``expected`` but for rounding."""
    for name in ("diffuse", "glossy"):
        right, other = getattr(expected, name), getattr(found, name)
        if other.shape != right.shape or not np.isfinite(other).all():
            return f"its {name} light is no picture"
        mean = float(right.mean())
        if float(np.abs(other - right).mean()) > LARGEST_DIFFERENCE * mean:
            return f"its {name} light is {other.mean():.3f} on average, not {mean:.3f}"
    return ""


def _ball(stage: Stage, denoiser: Denoiser) -> LightPasses:
    # A card is tried once; the renderer is started often.
    from ..surface.relief import build_relief

    rows, columns = np.mgrid[0:SIDE, 0:SIDE].astype(np.float32)
    middle, radius = SIDE / 2 - 0.5, 0.4 * SIDE
    height = np.sqrt(np.maximum(radius**2 - (rows - middle) ** 2 - (columns - middle) ** 2, 0))
    relief = build_relief(height.astype(np.float32), height > 0, stride=2)
    count = len(relief.vertices)
    material = [np.full((count, 3), 0.5), np.ones(count), np.full(count, 0.4)]
    stage.set_surface(
        [relief.vertices, relief.faces, *(part.astype(np.float32) for part in material)], {}
    )
    light = AreaLight(0.2 * SIDE, 0.2 * SIDE, SIDE, size=0.5 * SIDE)
    view = (0.0, 0.0, float(SIDE), float(SIDE))
    return trace(stage, denoiser, Trace(Canvas(SIDE, SIDE), view, light, None, _QUALITY))
