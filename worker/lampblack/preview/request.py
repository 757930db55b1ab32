"""What a client wants to see at one moment, as one value that never changes."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

from ..camera import Affine, scene_in_view
from ..composite.resample import Box
from ..prepared import Detail, PreparedDrawing
from ..scene import Scene
from .contribution import LightContribution, character_area, contributions_of

Show = Literal["lit", "normals", "relief"]


@dataclass(frozen=True)
class Viewport:
    """What the client looks at: ``size`` device pixels (width, height) of ``crop``, in pixels
    of the frame's drawing."""

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
        character: what of the character is traced, pixels of the drawing.
        contributions: all that has to be traced.
    """

    scene: Scene
    character: Box
    contributions: tuple[LightContribution, ...]


@dataclass(frozen=True)
class ViewRequest:
    """A viewport with all that it shows.

    Attributes:
        session: whose it is.
        viewport: what is looked at.
        digest: the drawing that the frame shows.
        camera: canvas to view, see the specification's section 4.
        revision: of the scene; 0 before the first.
        scene: in canvas pixels, as it is at the frame; None before the first.
    """

    session: str
    viewport: Viewport
    digest: str
    camera: Affine
    revision: int
    scene: Scene | None
    _resolved: dict[Detail, ResolvedView] = field(
        default_factory=dict, init=False, repr=False, compare=False
    )

    @property
    def order(self) -> tuple[int, int]:
        """Rises with what is newer."""
        return self.viewport.request, self.revision

    def resolve(self, drawing: PreparedDrawing) -> ResolvedView | None:
        """The scene on ``drawing``, prepared from the drawing of ``digest``; None without a scene.

        It is worked out once for each detail, and then shared by all threads: should two of them
        ask at once, both find the same.
        """
        if self.scene is None:
            return None
        found = self._resolved.get(drawing.detail)
        if found is None:
            scene = scene_in_view(self.scene, self.camera, drawing.size)
            character = character_area(drawing, self.viewport.crop)
            found = ResolvedView(scene, character, contributions_of(scene, drawing, character))
            self._resolved[drawing.detail] = found
        return found
