"""Builds random cartoon characters: implicit surfaces, surfaces of revolution, faces, bodies."""
