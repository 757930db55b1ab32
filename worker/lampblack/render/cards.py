"""Graphics cards as Cycles sees them; runs in the render process."""

from __future__ import annotations

from typing import Any

import bpy

from .device import PREFERENCE, Card


def find_cards() -> list[Card]:
    """The cards of this machine, each once for every way to it. A broken driver may end the
    process here, which is why Blender, too, asks late.

    Raises:
        RuntimeError: this Blender has no Cycles.
    """
    try:
        import _cycles
    except ImportError as error:
        raise RuntimeError("this Blender has no Cycles") from error
    return [
        Card(kind, str(found[0]), str(found[2]))
        for kind in PREFERENCE
        for found in _cycles.available_devices(kind.upper())
        if found[1] == kind.upper()
    ]


def use_card(scene: Any, card: Card) -> None:
    """Trace ``scene`` on ``card`` alone.

    Raises:
        RuntimeError: Blender does not have it.
    """
    preferences = bpy.context.preferences.addons["cycles"].preferences
    wanted = card.kind.upper()
    preferences.compute_device_type = wanted
    preferences.refresh_devices()
    for device in preferences.devices:
        device.use = device.type == wanted and device.id == card.identity
    if preferences.get_num_gpu_devices() != 1:  # Cycles would trace on the processor in silence
        raise RuntimeError(f"Blender cannot use {card.label}")
    scene.cycles.device = "GPU"
