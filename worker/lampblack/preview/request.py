"""View requests: what a client shows at one moment, as an immutable value."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

from ..camera import Affine, scene_in_view
from ..composite.resample import Box
from ..pins import followed
from ..prepared import Detail, PreparedDrawing
from ..scene import Scene
from .contribution import LightContribution, character_area, contributions_of
from .shape import DrawingShape

Show = Literal["lit", "normals", "relief"]


@dataclass(frozen=True)
class Viewport:
    """What a client shows: ``crop``, in pixels of the frame's drawing, at ``size`` (width, height)
    device pixels."""

    request: int
    frame: int
    show: Show
    crop: Box
    size: tuple[int, int]


@dataclass(frozen=True)
class ResolvedView:
    """The scene of a request on its drawing.

    Attributes:
        scene: in pixels of the drawing.
        character: the traced part of the character, in pixels of the drawing.
        contributions: all light to trace.
    """

    scene: Scene
    character: Box
    contributions: tuple[LightContribution, ...]


@dataclass(frozen=True)
class ViewRequest:
    """A viewport with its drawing and scene.

    Attributes:
        session: name of the session.
        viewport: the client's viewport.
        shape: the drawing that the frame shows, and what shapes its surface.
        camera: from canvas to view, see section 4 of the specification.
        revision: revision of the scene; 0 before the first.
        scene: the scene at the frame, in canvas pixels; None before the first.
    """

    session: str
    viewport: Viewport
    shape: DrawingShape
    camera: Affine
    revision: int
    scene: Scene | None
    _resolved: dict[Detail, ResolvedView] = field(
        default_factory=dict, init=False, repr=False, compare=False
    )

    @property
    def digest(self) -> str:
        """Digest of the drawing that the frame shows."""
        return self.shape.digest

    @property
    def order(self) -> tuple[int, int]:
        """A sort key: newer requests are greater."""
        return self.viewport.request, self.revision

    def resolve(self, drawing: PreparedDrawing) -> ResolvedView | None:
        """The scene on ``drawing``, which is prepared from ``shape``; None without a
        scene.

        It is computed once per detail and shared by all threads. If two threads compute it at the
        same time, both get the same result.
        """
        if self.scene is None:
            return None
        found = self._resolved.get(drawing.detail)
        if found is None:
            scene = scene_in_view(self.scene, self.camera, drawing.size)
            a, b, c, d, e, f = self.camera
            scene = followed(
                scene,
                {
                    pin: (x - (a * pin.x + b * pin.y + c), y - (d * pin.x + e * pin.y + f))
                    for pin, (x, y) in drawing.pinned.items()
                },
            )
            character = character_area(drawing, self.viewport.crop)
            found = ResolvedView(scene, character, contributions_of(scene, drawing, character))
            self._resolved[drawing.detail] = found
        return found
