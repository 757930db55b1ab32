"""Layers of bytes and their blend modes, in both directions: what a stack of layers shows, and the
layer that makes one picture out of another.

Pictures are (H, W, 4) uint8 sRGB, straight alpha. The arithmetic is that of the W3C's "Compositing
and Blending Level 1", section 5, which OpenRaster names and paint programs follow.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal

import numpy as np
from numpy.typing import NDArray

Blend = Literal["normal", "multiply", "add"]

Picture = NDArray[np.uint8]
Floats = NDArray[np.float32]
Split = tuple[Picture, Picture]
"""A layer, and the picture that must lie beneath it."""

_LEVEL = np.float32(255)
_WITHIN = np.float32(0.4 / 255)
_TINY = np.float32(1e-6)
_CLOSE = 1e-3  # of a level: rounding of float32


def lay(beneath: Picture, layer: Picture, blend: Blend) -> Picture:
    """``layer`` over ``beneath``, rounded to bytes as a paint program does."""
    source, below = (_unit(picture) for picture in (layer, beneath))
    cover, kept = source[..., 3:], below[..., 3:]
    if blend == "multiply":
        mixed = source[..., :3] * below[..., :3]
    elif blend == "add":
        mixed = np.minimum(source[..., :3] + below[..., :3], 1)
    else:
        mixed = source[..., :3]
    light = (
        cover * (1 - kept) * source[..., :3]
        + kept * (1 - cover) * below[..., :3]
        + cover * kept * mixed
    )
    alpha = cover + kept - cover * kept
    colour = light / np.maximum(alpha, np.float32(1e-6))
    return _bytes(np.concatenate([colour, alpha], axis=2))


def multiplied(below: Picture, wanted: Picture) -> Split:
    """The least opaque layer that multiplies ``below`` to ``wanted``.

    A layer darkens and adds alpha. It cannot darken a translucent pixel without adding alpha: there
    the picture beneath has less alpha than ``below``, so that both together have what is wanted.
    What is wanted brighter is brighter in the picture beneath.
    """
    return _split(below, wanted, _multiplied)


def covered(below: Picture, wanted: Picture) -> Split:
    """The least opaque layer without a blend mode that makes ``below`` look like ``wanted``."""
    return _split(below, wanted, _covered)


def added(below: Picture, wanted: Picture) -> Split:
    """The layer that adds the light by which ``wanted`` is brighter than ``below``: opaque, on
    black. Where pixels are translucent, all is left to the picture beneath."""
    solid = (below[..., 3] == 255) & (wanted[..., 3] == 255)
    light = np.where(wanted > below, wanted - below, 0)[..., :3] * solid[..., None]
    alone = (below[..., 3] == 0) & (wanted[..., 3] > 0)
    layer, beneath = np.zeros_like(wanted), wanted.copy()
    layer[..., :3] = light
    layer[..., 3] = light.any(axis=2) * np.uint8(255)
    beneath[..., :3] -= light
    layer[alone], beneath[alone] = wanted[alone], 0
    return layer, beneath


SPLITS: dict[Blend, Callable[[Picture, Picture], Split]] = {
    "normal": covered,
    "multiply": multiplied,
    "add": added,
}


def without_colour(picture: Picture) -> Picture:
    """``picture`` with black where it is transparent, so that what looks the same is the same."""
    return np.asarray(picture * (picture[..., 3:] > 0))


def _split(
    below: Picture, wanted: Picture, solve: Callable[[Floats, Floats], tuple[Floats, Floats]]
) -> Split:
    """``solve`` for the pixels that differ. Less alpha than below comes from beneath alone."""
    layer, beneath = np.zeros_like(wanted), wanted.copy()
    differ = (below != wanted).any(axis=2) & (wanted[..., 3] >= below[..., 3])
    if differ.any():
        found = solve(_unit(below[differ]), _unit(wanted[differ]))
        layer[differ], beneath[differ] = (_bytes(part) for part in found)
    return without_colour(layer), without_colour(beneath)


def _multiplied(below: Floats, wanted: Floats) -> tuple[Floats, Floats]:
    """See ``multiplied``; (N, 4) each, alpha in whole bytes.

    With alphas s of the layer, b beneath and w of the result, 1 - w = (1 - s)(1 - b), and a pixel
    shows s (1 - b) S + b (1 - s) B + s b S B = w W. So S is at least 0 if s >= w (1 - W / B).
    """
    old, new = below[:, :3], wanted[:, :3]
    kept, whole = below[:, 3:], wanted[:, 3:]
    # Rounded up as far as it rounds back: else the least bit of a dark channel decides.
    share = (new + _WITHIN) / np.maximum(old, _TINY)
    shade = np.min(np.where(old > 0, share, 1), axis=1, keepdims=True)
    cover, beneath = _alphas(kept, whole, whole * (1 - np.clip(shade, 0, 1)))
    room = cover * (1 - beneath + beneath * old)
    tint = np.divide(whole * new - beneath * (1 - cover) * old, np.maximum(room, _TINY))
    brighter = np.divide(whole * new - cover * (1 - beneath), np.maximum(beneath, _TINY))
    lifted = np.where((tint > 1) | (cover == 0), np.maximum(brighter, old), old)
    return _joined(tint, cover), _joined(lifted, beneath)


def _covered(below: Floats, wanted: Floats) -> tuple[Floats, Floats]:
    """See ``covered``; (N, 4) each, alpha in whole bytes. The same, but a pixel shows
    s S + b (1 - s) B = w W."""
    old, new = below[:, :3], wanted[:, :3]
    kept, whole = below[:, 3:], wanted[:, 3:]
    darker = 1 - (new + _WITHIN) / np.maximum(old, _TINY)
    lighter = (new - _WITHIN - old) / np.maximum(1 - old, _TINY)
    change = np.clip(np.max(np.maximum(darker, lighter), axis=1, keepdims=True), 0, 1)
    cover, beneath = _alphas(kept, whole, whole * change)
    colour = np.divide(whole * new - beneath * (1 - cover) * old, np.maximum(cover, _TINY))
    return _joined(colour, cover), _joined(np.where(cover == 0, new, old), beneath)


def _alphas(kept: Floats, whole: Floats, least: Floats) -> tuple[Floats, Floats]:
    """The smallest alpha of a layer, at least ``least``, and that beneath it, at most ``kept``,
    that together have the alpha ``whole``; both whole bytes."""
    raised = (whole - kept) / np.maximum(1 - kept, _TINY)
    cover = np.ceil(np.maximum(least, raised) * 255 - _CLOSE) / _LEVEL
    rest = np.rint((whole - cover) / np.maximum(1 - cover, _TINY) * 255) / _LEVEL
    enough = abs(cover + kept - cover * kept - whole) <= 0.5 / 255 + _TINY
    beneath = np.where((cover >= 1) | enough, kept, np.clip(rest, 0, kept))
    return np.asarray(cover, np.float32), np.asarray(beneath, np.float32)


def _joined(colour: Floats, alpha: Floats) -> Floats:
    return np.concatenate([np.clip(colour, 0, 1), alpha], axis=1)


def _unit(picture: Picture) -> Floats:
    return picture.astype(np.float32) / _LEVEL


def _bytes(picture: Floats) -> Picture:
    return np.asarray(np.rint(np.clip(picture, 0, 1) * 255).astype(np.uint8))
