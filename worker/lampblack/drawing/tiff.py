"""TIFF pictures: what they hold, and which of them can be read."""

from __future__ import annotations

from PIL.TiffImagePlugin import TiffImageFile

from ..errors import DrawingError

MODES = ("1", "L", "LA", "La", "I;16", "I;16B", "P", "PA", "RGB", "RGBA", "CMYK", "YCbCr")
_BITS, _PHOTOMETRIC, _PLANES, _SAMPLE_FORMAT = 258, 262, 284, 339
_WHITE_IS_ZERO, _APART, _UNSIGNED = 0, 2, 1
_REMEDY = "Export it with 8 or 16 bits a channel, in RGB or grey, or as a PNG."


def tiff_depth(image: TiffImageFile, name: str) -> int:
    """Bits per sample of a TIFF that Pillow has opened.

    Raises:
        DrawingError: it is of a kind whose samples would be read wrongly.
    """
    tags = image.tag_v2
    depth = max(tags.get(_BITS, (1,)))
    kinds = {
        "floating-point or signed numbers": any(
            form != _UNSIGNED for form in tags.get(_SAMPLE_FORMAT, (_UNSIGNED,))
        ),
        f"{depth} bits": depth not in (1, 2, 4, 8, 16),
        f"{image.mode} colours": image.mode not in MODES,
        "16 bits in which 0 is white": depth == 16 and tags.get(_PHOTOMETRIC) == _WHITE_IS_ZERO,
        "16 bits in one plane a channel": (
            depth == 16 and tags.get(_PLANES) == _APART and image.mode != "I;16"
        ),
    }
    for kind, found in kinds.items():
        if found:
            raise unknown_tiff(name, kind)
    return int(depth)


def unknown_tiff(name: str, kind: str, details: str = "") -> DrawingError:
    return DrawingError(f"{name} is a TIFF with {kind}, which cannot be read.", _REMEDY, details)
