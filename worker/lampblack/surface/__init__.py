"""Surfaces: normals are inflated to a height, and the height becomes a closed relief mesh."""

from .corrections import Corrections, character_length, normals_of
from .depth_picture import clay_picture, depth_picture, full_size
from .guided import guided_filter
from .inflate_overlaps import dividing_lines, overlap_votes, solve_with_overlaps
from .overlap import Overlap
from .relief import Relief, build_relief, check_relief, joined_reliefs
from .solver import Solver, solve
from .stacking import Base, Sheet, stack
from .visible import visible_faces

__all__ = [
    "Base",
    "Corrections",
    "Overlap",
    "Relief",
    "Sheet",
    "Solver",
    "build_relief",
    "character_length",
    "check_relief",
    "clay_picture",
    "depth_picture",
    "dividing_lines",
    "full_size",
    "guided_filter",
    "joined_reliefs",
    "normals_of",
    "overlap_votes",
    "solve",
    "solve_with_overlaps",
    "stack",
    "visible_faces",
]
