"""Normals filtered over time: the same from drawing to drawing where the drawing is the same."""
