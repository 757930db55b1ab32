"""A render child with a graphics card that is none: fake_card.py BEHAVIOUR DEVICE MEMORY.

The processor traces for the card, so that what a card does right, wrong or no more can be tested
where there is none.
"""

from __future__ import annotations

import os
import sys
from typing import Any

import numpy as np

from lampblack.render import child

if __name__ == "__main__" and len(sys.argv) > 3:  # with a DEVICE: the child
    child.private_stdout()  # Blender may print when it is imported

from lampblack.render import cards, denoise, stage, survey, trace, trial
from lampblack.render.device import Card
from lampblack.render.passes import LightPasses

LATER = 1
"""Renders before it fails: those of one drawing, whose lights are traced as one."""
CARD = Card("cuda", "Paper Card", "CUDA_paper_00")


def main(behaviour: str) -> None:
    """Behave as ``behaviour`` says, then as the child."""
    denoise.DEVICE_TYPES["cuda"] = denoise.DEVICE_TYPES["cpu"]
    traced = trace.trace
    seen = 0

    def find() -> list[Card]:
        if behaviour == "search dies":
            os.abort()
        if behaviour == "search fails":
            raise RuntimeError("the driver is older than the card")
        return [CARD]

    def use(scene: Any, card: Card) -> None:
        if behaviour == "fails":
            raise RuntimeError("the card is asleep")
        if behaviour == "dies":
            os.abort()
        scene["card"] = True

    def trace_on_card(stage: Any, *given: Any) -> LightPasses:
        nonlocal seen
        if not stage.scene.get("card"):
            return traced(stage, *given)
        seen += 1
        if behaviour == "dies later" and seen > LATER:
            os.abort()
        if behaviour == "fails later" and seen > LATER:
            raise RuntimeError("Out of memory in cuMemAlloc")
        light = traced(stage, *given)
        dark = np.zeros_like(light.diffuse)
        return LightPasses(dark, dark) if behaviour == "black" else light

    cards.find_cards = trial.find_cards = find
    stage.use_card = use
    trace.trace = trace_on_card
    if behaviour in ("black", "no denoiser"):
        trial.trace = trace_on_card
    if behaviour == "no denoiser":
        denoise.DEVICE_TYPES["cuda"] = denoise.DEVICE_TYPES["hip"]
    if len(sys.argv) == 2:  # without a DEVICE: the survey
        survey.main()
    else:
        child.main()


if __name__ == "__main__":
    main(sys.argv.pop(1))
