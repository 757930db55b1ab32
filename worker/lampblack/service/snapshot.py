"""What a client wants to see at one moment, as one value that never changes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from ..camera import Affine
from ..composite.sheet import Box
from ..scene import Scene

Show = Literal["lit", "normals", "relief"]


@dataclass(frozen=True)
class Look:
    """What the client looks at: ``size`` device pixels (width, height) of ``crop``, in pixels
    of the frame's drawing."""

    request: int
    frame: int
    show: Show
    crop: Box
    size: tuple[int, int]


@dataclass(frozen=True)
class Snapshot:
    """A look with all that it shows.

    Attributes:
        session: whose it is.
        look: what is looked at.
        digest: the drawing that the frame shows.
        camera: canvas to view, see the specification's section 4.
        revision: of the scene; 0 before the first.
        scene: in canvas pixels, as it is at the frame; None before the first.
    """

    session: str
    look: Look
    digest: str
    camera: Affine
    revision: int
    scene: Scene | None

    @property
    def order(self) -> tuple[int, int]:
        """Rises with what is newer."""
        return self.look.request, self.revision
