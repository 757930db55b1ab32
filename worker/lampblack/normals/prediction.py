"""What a network says of a drawing: normals, and what lies in front of what."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, eq=False)
class Prediction:
    """The prediction for one drawing.

    Attributes:
        normals: (H, W, 3) float32, x right, y up, z to the viewer; unit in the mask, 0 outside.
        depth: (H, W) float32 pixels of the drawing towards the viewer, about 0 on average, 0
            outside the mask. It is blurred, so it holds no slopes, but it tells the two sides of
            an occlusion apart. None: the network predicts none.
        edge: (H, W) float32, 0 to 1: how likely the pixel lies at an occlusion, on either side
            of it; 0 outside the mask. None where ``depth`` is.
    """

    normals: NDArray[np.float32]
    depth: NDArray[np.float32] | None = None
    edge: NDArray[np.float32] | None = None
