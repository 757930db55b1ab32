"""What shapes a surface: the drawing, and what the artist says of its depth."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from ..cache import digest as digest_of
from ..scene import DepthColour, Drawn, LayerBody, Pin


@dataclass(frozen=True, eq=False)
class HintSource:
    """The hints and strokes that were made on the drawing ``digest``, in its own pixels."""

    digest: str
    hints: tuple[Drawn, ...]


@dataclass(frozen=True)
class PinSource:
    """A pin, the drawing that its frame shows, and its place (x, y) in pixels of that drawing."""

    pin: Pin
    digest: str
    place: tuple[float, float]


@dataclass(frozen=True, eq=False)
class DrawingShape:
    """Shapes that are equal make the same surface, and pin lights to the same places.

    Attributes:
        digest: of the drawing.
        layers: what the artist says of its layers.
        colours: what the artist says of its colours.
        sources: drawings with hints that count here, the nearest in time first.
        pins: what lights follow that are pinned to other drawings.
    """

    digest: str
    layers: tuple[LayerBody, ...] = ()
    colours: tuple[DepthColour, ...] = ()
    sources: tuple[HintSource, ...] = ()
    pins: tuple[PinSource, ...] = ()

    @property
    def needed(self) -> tuple[str, ...]:
        """Digests of all drawings that it is made from, its own first."""
        hinted = [source.digest for source in self.sources]
        pinned = [source.digest for source in self.pins]
        return tuple(dict.fromkeys((self.digest, *hinted, *pinned)))

    @cached_property
    def key(self) -> str:
        """Names the shape: the digest alone if the artist says nothing."""
        if not (self.layers or self.colours or self.sources or self.pins):
            return self.digest
        said = [(layer.layer, layer.body) for layer in self.layers]
        hinted = [(source.digest, source.hints) for source in self.sources]
        names = [repr(said), repr(self.colours), repr(hinted)]
        names += [repr(self.pins)] if self.pins else []
        return f"{self.digest} {digest_of(*names)}"

    def __eq__(self, other: object) -> bool:
        return isinstance(other, DrawingShape) and self.key == other.key

    def __hash__(self) -> int:
        return hash(self.key)
