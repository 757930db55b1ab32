"""Light hand-drawn animation with real global illumination.

``lampblack.light`` lights one drawing. The packages follow the data: ``drawing`` -> ``normals`` ->
``surface`` -> ``render`` -> ``composite``; ``pipeline`` joins them and ``scene`` says how a frame
is to be lit.
"""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .api import light

__all__ = ["__version__", "light"]
__version__ = "0.3.0"


def __getattr__(name: str) -> Any:
    """``light``, which takes seconds to import, when it is first asked for."""
    if name == "light":
        from .api import light

        return light
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
