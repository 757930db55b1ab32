"""Blender as a child process draws lines: the only place here that imports ``bpy``."""
