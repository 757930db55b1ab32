"""Light hand-drawn animation with real global illumination.

The packages follow the data: ``drawing`` -> ``normals`` -> ``surface`` -> ``render`` ->
``composite``; ``pipeline`` joins them and ``scene`` says how a frame is to be lit.
"""

__version__ = "0.1.0"
