"""Light linking: lights that light only some colours and layers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..drawing.palette import Palette
from ..scene import AreaLight

Floats = NDArray[np.float32]


@dataclass(frozen=True)
class Link:
    """What a light lights: these flat colours, in these layers; all of them where none is named."""

    colours: tuple[str, ...] = ()
    layers: tuple[str, ...] = ()

    @staticmethod
    def of(light: AreaLight) -> Link | None:
        """The link of ``light``; None if it lights everything."""
        if not light.colours and not light.layers:
            return None
        return Link(tuple(sorted(set(light.colours))), tuple(sorted(set(light.layers))))

    def labels(self, palette: Palette) -> NDArray[np.bool_]:
        """(n + 1,) whether each label of ``palette`` is lit; the last is that past the edge."""
        lit = [not self.colours or colour in self.colours for colour in palette.colours]
        return np.array([*lit, not self.colours], np.bool_)

    def owners(self, layers: Sequence[str]) -> NDArray[np.bool_]:
        """(m + 1,) whether each of ``layers`` is lit; the last is where there is none. A drawing
        whose layers are not known is lit."""
        everything = not self.layers or not layers
        return np.array([everything or layer in self.layers for layer in (*layers, "")], np.bool_)
