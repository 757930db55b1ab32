"""Measures networks and other methods against exact normals, and flicker over time."""
