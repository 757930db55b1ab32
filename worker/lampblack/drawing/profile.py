"""Colour profiles of pictures: whatever a file says of its colours becomes sRGB."""

from __future__ import annotations

import io
import warnings

import numpy as np
from PIL import Image, ImageCms

from ..colour import srgb
from ..errors import LampblackWarning

SRGB_GAMMA = 1 / 2.2
"""What a PNG's gamma says of a picture in sRGB."""
_MODES = {"GRAY": "L", "RGB ": "RGB", "CMYK": "CMYK"}


def to_srgb(image: Image.Image, name: str) -> Image.Image:
    """``image`` as RGBA in sRGB. Its ICC profile is applied by LittleCMS; without one, the gamma
    of a PNG (``gAMA``, without ``sRGB``) is. ``name`` is for the warnings.

    Warns:
        LampblackWarning: the profile cannot be used; the colours are taken for sRGB.
    """
    profile = image.info.get("icc_profile")
    if profile:
        try:
            return _through_profile(image, profile)
        except (ImageCms.PyCMSError, OSError, ValueError, KeyError) as error:
            warnings.warn(
                f"The colour profile of {name} cannot be used ({error}); its colours are taken "
                "for sRGB.",
                LampblackWarning,
                stacklevel=2,
            )
    gamma = None if profile else gamma_of(image)
    plain = image.convert("RGBA")
    if gamma is None:
        return plain
    levels = srgb((np.arange(256) / 255) ** (1 / gamma))
    table = np.rint(np.clip(levels, 0, 1) * 255).astype(int).tolist()
    return plain.point(table * 3 + list(range(256)))


def gamma_of(image: Image.Image) -> float | None:
    """The power of the light that the samples are, in the primaries of sRGB: that of a PNG, or 1 if
    the ICC profile is linear. None if the samples are sRGB, or in another colour space."""
    profile = image.info.get("icc_profile")
    if profile:
        try:
            return 1.0 if _is_linear(profile) else None
        except (ImageCms.PyCMSError, OSError, ValueError, KeyError):
            return None
    gamma = image.info.get("gamma")
    if not gamma or "srgb" in image.info or abs(gamma - SRGB_GAMMA) < 0.01:
        return None
    return float(gamma)


def _is_linear(profile: bytes) -> bool:
    """Whether a profile is sRGB without its curve."""
    own = ImageCms.ImageCmsProfile(io.BytesIO(profile))
    if own.profile.xcolor_space != "RGB ":
        return False
    ramp = np.arange(256, dtype=np.uint8)
    tones = np.zeros((4, 256, 3), np.uint8)
    tones[0], tones[1, :, 0], tones[2, :, 1], tones[3, :, 2] = ramp[:, None], ramp, ramp, ramp
    picture = Image.fromarray(tones)
    seen = ImageCms.profileToProfile(picture, own, ImageCms.createProfile("sRGB"), outputMode="RGB")
    return bool(np.abs(np.asarray(seen) - srgb(tones / 255) * 255).max() < 3)


def _through_profile(image: Image.Image, profile: bytes) -> Image.Image:
    own = ImageCms.ImageCmsProfile(io.BytesIO(profile))
    plain = image.convert("RGBA")
    mode = _MODES[own.profile.xcolor_space]
    source = image if image.mode == mode else plain.convert(mode)
    seen = ImageCms.profileToProfile(source, own, ImageCms.createProfile("sRGB"), outputMode="RGB")
    assert seen is not None
    seen.putalpha(plain.getchannel("A"))
    return seen
