"""Normals: a network predicts the normal map of a line drawing."""
