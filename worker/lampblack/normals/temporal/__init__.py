"""Normals that hold still from drawing to drawing."""
