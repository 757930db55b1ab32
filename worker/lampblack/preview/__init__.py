"""The live picture: drawings prepared, light traced and pictures painted, in threads."""

from .contribution import LightContribution, contributions_of
from .live import LivePreview, PreviewListener
from .painter import Picture, PreviewImage
from .prepared import PreparedDrawing, prepare_full, prepare_quick
from .request import Show, Viewport, ViewRequest
from .state import PreviewState, RendererState
from .tracer import PreviewRenderer

__all__ = [
    "LightContribution",
    "LivePreview",
    "Picture",
    "PreparedDrawing",
    "PreviewImage",
    "PreviewListener",
    "PreviewRenderer",
    "PreviewState",
    "RendererState",
    "Show",
    "ViewRequest",
    "Viewport",
    "contributions_of",
    "prepare_full",
    "prepare_quick",
]
