"""Pencil2D projects and OpenRaster drawings, read without Pencil2D and without trust: names, sizes
and counts in the files are checked."""

from .archive import SUFFIXES, is_project
from .camera_layer import CameraKey
from .document import Key, Layer, Project
from .read import read_project

__all__ = ["SUFFIXES", "CameraKey", "Key", "Layer", "Project", "is_project", "read_project"]
