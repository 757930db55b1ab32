"""The layers of a project apart, as its camera shows them: for programs that show a file."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ..cache import digest
from ..camera import Affine
from ..shot import PaintedLayer, PictureLayer
from .archive import Archive
from .document import Layer, Project
from .exposure_sheet import Shown, shown
from .layer_pictures import LayerPictures, Picture
from .paint import LayerPainter
from .shot import picture_through, seen_region
from .stack import is_named_as_result
from .vector import VectorPictures


@dataclass(frozen=True)
class _Apart:
    """``members``, bottom first, are painted together; what they show in each frame."""

    name: str
    members: Sequence[Layer]
    sheet: Sequence[Shown]


class ProjectLayers:
    """The layers of a project, seen through its first camera.

    A layer that touches up what is below belongs to the layer below. Hidden layers are left out,
    unless rendered frames are in sight, which may hide them.

    Raises:
        ProjectError: the camera shows nothing, or its view is too large.
    """

    def __init__(self, project: Project, archive: Archive) -> None:
        camera = project.cameras[0]
        self.size = camera.width, camera.height
        self.fps = project.fps
        self.numbers: Sequence[int] = range(1, project.length + 1)
        self._views = [camera.at(number) for number in self.numbers]
        region = seen_region(camera, self._views)
        self._region = region
        origin = camera.width // 2, camera.height // 2
        vectors = VectorPictures(archive, origin)
        self._painter = LayerPainter(LayerPictures(archive, region, origin, vectors))
        self._apart = self._sort(project)
        visible = [layer for layer in project.layers if layer.visible]
        self._whole = None
        if any(layer.touches_up or layer.groups for layer in visible):
            self._whole = self._exposed("", visible, project.length)
        self.layers: Sequence[PictureLayer] = [
            PictureLayer(one.name, one.members[0].visible) for one in self._apart
        ]

    def _sort(self, project: Project) -> list[_Apart]:
        finished = any(layer.visible and is_named_as_result(layer.name) for layer in project.layers)
        runs: list[list[Layer]] = []
        for layer in project.layers:
            if runs and layer.touches_up and layer.visible:
                runs[-1].append(layer)
            elif layer.visible or (finished and not layer.touches_up):
                runs.append([layer])
        taken: set[str] = set()
        found = []
        for run in runs:
            name = _unused(run[0].name, taken)
            taken.add(name)
            found.append(self._exposed(name, run, project.length))
        return found

    def _exposed(self, name: str, members: Sequence[Layer], length: int) -> _Apart:
        return _Apart(name, members, shown(members, length, self._painter.identity))

    def view(self, number: int) -> Affine:
        """From canvas to picture."""
        return self._views[number - 1]

    def painted(self, number: int) -> list[PaintedLayer]:
        """What the layers show in a frame, bottom first, without those that show nothing."""
        each = (self._painted(layer, number) for layer in self._apart)
        return [painted for painted in each if painted is not None]

    def whole(self, number: int) -> PaintedLayer | None:
        """All visible layers together; None if they are merely painted over each other."""
        return None if self._whole is None else self._painted(self._whole, number)

    def _painted(self, layer: _Apart, number: int) -> PaintedLayer | None:
        sheet = layer.sheet[number - 1]
        if not sheet.drawn:
            return None
        camera = self._region.through(self.view(number))

        def paint() -> Picture:
            return picture_through(self._painter.paint(layer.members, number), camera, self.size)

        return PaintedLayer(layer.name, digest(sheet.identity, camera, self.size), paint)


def _unused(name: str, taken: set[str]) -> str:
    """``name``, numbered if another layer has it."""
    number, found = 1, name
    while found in taken:
        number += 1
        found = f"{name} ({number})"
    return found
