"""Normals: a network predicts the normal map of a line drawing, from all it was taught."""
