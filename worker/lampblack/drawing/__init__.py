"""Drawings: read from disk, ordered by frame, decomposed into character mask, ink and fill."""

from .bodies import decompose_cel
from .cutout import character_mask
from .decompose import decompose_drawing
from .drawing import Body, Drawing
from .load import PICTURE_SUFFIXES, load_picture, read_picture, save_picture
from .mask import ink_from_picture, mask_from_picture
from .palette import Palette, Swatch
from .planes import DrawingPlanes
from .sequence import Frame, find_frames, parse_frames, select_frames

__all__ = [
    "PICTURE_SUFFIXES",
    "Body",
    "Drawing",
    "DrawingPlanes",
    "Frame",
    "Palette",
    "Swatch",
    "character_mask",
    "decompose_cel",
    "decompose_drawing",
    "find_frames",
    "ink_from_picture",
    "load_picture",
    "mask_from_picture",
    "parse_frames",
    "read_picture",
    "save_picture",
    "select_frames",
]
