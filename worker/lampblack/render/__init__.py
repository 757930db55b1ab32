"""Rendering: Cycles in a child process traces the light passes of a relief.

The child imports this package, too: it has nothing else here, so that the child loads what it uses.
"""
