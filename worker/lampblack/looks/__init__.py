"""Looks: styles to use again, and those that come with Lampblack."""

from .place import scaled_rim, with_style
from .presets import PRESETS, find_style, preset, preset_name

__all__ = ["PRESETS", "find_style", "preset", "preset_name", "scaled_rim", "with_style"]
