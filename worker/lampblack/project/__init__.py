"""Pencil2D projects, and drawings with layers (OpenRaster, Photoshop, Krita), read without their
programs and without trust: names, sizes and counts in the files are checked."""

from .camera_layer import CameraKey
from .document import Key, Layer, Project
from .read import SUFFIXES, is_project, read_project

__all__ = ["SUFFIXES", "CameraKey", "Key", "Layer", "Project", "is_project", "read_project"]
