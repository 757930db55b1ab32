"""What shapes a surface: the drawing, and what the artist says of its depth."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from ..cache import digest as digest_of
from ..scene import DepthColour, Drawn, LayerBody


@dataclass(frozen=True, eq=False)
class HintSource:
    """The hints and strokes that were made on the drawing ``digest``, in its own pixels."""

    digest: str
    hints: tuple[Drawn, ...]


@dataclass(frozen=True, eq=False)
class DrawingShape:
    """Shapes that are equal make the same surface.

    Attributes:
        digest: of the drawing.
        layers: what the artist says of its layers.
        colours: what the artist says of its colours.
        sources: drawings with hints that count here, the nearest in time first.
    """

    digest: str
    layers: tuple[LayerBody, ...] = ()
    colours: tuple[DepthColour, ...] = ()
    sources: tuple[HintSource, ...] = ()

    @cached_property
    def key(self) -> str:
        """Names the shape: the digest alone if the artist says nothing."""
        if not self.layers and not self.colours and not self.sources:
            return self.digest
        said = [(layer.layer, layer.body) for layer in self.layers]
        hinted = [(source.digest, source.hints) for source in self.sources]
        return f"{self.digest} {digest_of(repr(said), repr(self.colours), repr(hinted))}"

    def __eq__(self, other: object) -> bool:
        return isinstance(other, DrawingShape) and self.key == other.key

    def __hash__(self) -> int:
        return hash(self.key)
