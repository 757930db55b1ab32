"""Projects of Pencil2D, and OpenRaster drawings: read without the program that wrote them, and
without trusting what is in them."""

from .archive import SUFFIXES, is_project
from .document import CameraKey, Key, Layer, Project
from .read import read_project

__all__ = ["SUFFIXES", "CameraKey", "Key", "Layer", "Project", "is_project", "read_project"]
