"""Rigs: lights to use again, and those that come with Lampblack."""

from .place import rig_of, with_rig
from .presets import PRESETS, find_rig, preset, preset_name

__all__ = ["PRESETS", "find_rig", "preset", "preset_name", "rig_of", "with_rig"]
