"""Surfaces: normals are inflated to a height, and the height becomes a closed relief mesh."""

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
    "guided_filter",
    "save_mesh",
    "solve",
    "visible_faces",
]
