"""Surfaces: normals are inflated to a height, and the height becomes a closed relief mesh."""

from .depth_picture import depth_picture, full_size
from .export import save_mesh
from .guided import guided_filter
from .relief import Relief, build_relief, check_relief
from .solver import Solver, solve
from .visible import visible_faces

__all__ = [
    "Relief",
    "Solver",
    "build_relief",
    "check_relief",
    "depth_picture",
    "full_size",
    "guided_filter",
    "save_mesh",
    "solve",
    "visible_faces",
]
