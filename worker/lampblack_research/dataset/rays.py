"""Rays against a mesh."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from lampblack.errors import LampblackError


class RayScene:
    """A mesh that rays can meet, traced by Embree.

    Args:
        triangles: (F, 3, 3) float32, the corners of every face.

    Raises:
        LampblackError: the ray tracer is not installed.
    """

    def __init__(self, triangles: NDArray[np.float32]) -> None:
        try:
            from embreex.mesh_construction import TriangleMesh
            from embreex.rtcore_scene import EmbreeScene
        except ImportError as error:
            raise LampblackError(
                "The ray tracer embreex is not installed.",
                "Install what research needs: pip install 'lampblack[research]'.",
                str(error),
            ) from error
        self._scene = EmbreeScene()
        TriangleMesh(self._scene, np.ascontiguousarray(triangles, np.float32))

    def first(
        self, origins: NDArray[np.float32], directions: NDArray[np.float32]
    ) -> dict[str, NDArray[Any]]:
        """The first hits of (N, 3) rays: ``primID``, -1 for none, ``u``, ``v``, ``tfar``, and
        ``Ng``, the normal of the face, not of unit length."""
        hits: dict[str, NDArray[Any]] = self._scene.run(
            origins, directions, query="INTERSECT", output=True
        )
        return hits

    def blocked(
        self, origins: NDArray[np.float32], directions: NDArray[np.float32]
    ) -> NDArray[np.bool_]:
        """(N,) whether anything lies on the rays from (N, 3) ``origins``."""
        return np.asarray(self._scene.run(origins, directions, query="OCCLUDED") >= 0)
