"""The painter: a thread that lays light at hand over drawings, and sends the pictures."""

from __future__ import annotations

import threading
from collections.abc import Hashable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ..camera import scene_in_view
from ..composite.light_sheet import Light, add_up, light_sheet, warm_up
from ..composite.shadow import FAINT
from ..composite.sheet import Sheet, cut_picture
from ..protocol import Crop, ErrorCode, Image, error_message
from .bounded import BoundedStore
from .model import Model
from .snapshot import Snapshot
from .source import CONVERGED, Source, figure_area, sources_of
from .studio import MIB, Developed, Studio

Picture = NDArray[np.uint8]


@dataclass
class _Shown:
    """What a client was sent last."""

    order: tuple[int, int] = (0, 0)
    digest: str = ""
    content: Hashable = None
    passes: int = 0


@dataclass
class Painter:
    """Paints the newest snapshot of each session whose light is all at hand."""

    studio: Studio
    _todo: dict[str, dict[tuple[int, int], Snapshot]] = field(default_factory=dict)
    _shown: dict[str, _Shown] = field(default_factory=dict)
    _condition: threading.Condition = field(default_factory=threading.Condition)
    _closing: bool = False
    _sheets: BoundedStore[Hashable, Sheet] = field(default_factory=lambda: BoundedStore(128 * MIB))

    def offer(self, snapshot: Snapshot) -> None:
        """Paint ``snapshot`` if nothing newer can be painted."""
        with self._condition:
            self._todo.setdefault(snapshot.session, {})[snapshot.order] = snapshot
            self._condition.notify()

    def forget(self, session: str) -> None:
        """The session is over."""
        with self._condition:
            self._todo.pop(session, None)
            self._shown.pop(session, None)

    def close(self) -> None:
        """End the thread."""
        with self._condition:
            self._closing = True
            self._condition.notify()

    def run(self) -> None:
        """Paint until closed."""
        warm_up()
        while True:
            with self._condition:
                self._condition.wait_for(lambda: self._closing or self._todo)
                if self._closing:
                    return
                session, snapshots = self._todo.popitem()
            try:
                for order in sorted(snapshots, reverse=True):
                    if self._paint(snapshots[order]):
                        break
            except Exception as error:  # one client's trouble is not the others'
                details = repr(error)
                self.studio.deliver(
                    session, error_message(ErrorCode.INTERNAL, details=details), None
                )

    def _paint(self, snapshot: Snapshot) -> bool:
        """Paint and send, unless that would show something older or nothing new; False if the
        snapshot's light is not at hand."""
        shown = self._shown.setdefault(snapshot.session, _Shown())
        current = self.studio.wanted.get(snapshot.session)
        if current is None or current.look != snapshot.look:
            return False
        if current.digest != snapshot.digest or snapshot.order < shown.order:
            return False
        model = self.studio.model(snapshot.digest)
        if model is None:
            return False
        if snapshot.look.show != "lit":
            self._send(snapshot, model, shown, (), _view(model, snapshot), model.grade == "fine")
            return True
        sources = sources_of(snapshot, model)
        lights = [self.studio.lights.get(source) for source in sources]
        found = [light for light in lights if light is not None]
        if snapshot.scene is None or len(found) < len(sources):
            return False
        self._send_lit(snapshot, model, shown, sources, found)
        return True

    def _send_lit(
        self,
        snapshot: Snapshot,
        model: Model,
        shown: _Shown,
        sources: tuple[Source, ...],
        lights: list[Developed],
    ) -> None:
        content = tuple(
            (s.key, light.rung, light.amounts) for s, light in zip(sources, lights, strict=True)
        )
        if (snapshot.order, snapshot.look, content) == (shown.order, snapshot.look, shown.content):
            return
        converged = model.grade == "fine" and all(
            self.studio.lights.rung(source) >= CONVERGED for source in sources
        )
        picture = self._lit(snapshot, model, sources, lights)
        spp = min((light.spp for light in lights), default=0)
        self._send(snapshot, model, shown, content, picture, converged, spp)

    def _send(
        self,
        snapshot: Snapshot,
        model: Model,
        shown: _Shown,
        content: Hashable,
        picture: Picture,
        converged: bool,
        spp: int = 0,
    ) -> None:
        content = content or model.grade
        same = shown.order == snapshot.order and shown.digest == snapshot.digest
        if same and shown.content == content:
            return
        shown.passes = shown.passes + 1 if same else 0
        shown.order, shown.digest, shown.content = snapshot.order, snapshot.digest, content
        x, y, width, height = snapshot.look.crop
        image = Image(
            request=snapshot.look.request,
            frame=snapshot.look.frame,
            digest=snapshot.digest,
            revision=snapshot.revision,
            show=snapshot.look.show,
            pass_=shown.passes,
            spp=spp,
            converged=converged,
            crop=Crop(x=x, y=y, width=width, height=height),
        )
        self.studio.deliver(snapshot.session, image, {"picture": picture})

    def prepare(self, snapshot: Snapshot, model: Model) -> Sheet:
        """The drawing's layers at the size and crop of the look, kept for the next time."""
        look = snapshot.look
        key = (model.digest, model.grade, look.crop, look.size)
        sheet = self._sheets.get(key)
        if sheet is None:
            x, y, width, height = look.crop
            step = model.step
            sheet = model.sheet.cut((x / step, y / step, width / step, height / step), look.size)
            self._sheets.put(key, sheet, sheet.nbytes)
        return sheet

    def _lit(
        self,
        snapshot: Snapshot,
        model: Model,
        sources: tuple[Source, ...],
        lights: list[Developed],
    ) -> Picture:
        assert snapshot.scene is not None
        scene = scene_in_view(snapshot.scene, snapshot.camera, model.size)
        figure = [
            (s.weight, d) for s, d in zip(sources, lights, strict=True) if s.subject == "figure"
        ]
        ground = [
            (s.weight, d) for s, d in zip(sources, lights, strict=True) if s.subject == "floor"
        ]
        light = Light(
            diffuse=add_up([(weight, developed.first) for weight, developed in figure]),
            glossy=add_up([(weight, developed.second) for weight, developed in figure]),
            figure=figure_area(model, snapshot.look.crop),
            floor=_shadow(ground),
            ground=(0.0, 0.0, float(model.size[0]), float(model.size[1])),
        )
        return light_sheet(self.prepare(snapshot, model), snapshot.look.crop, light, scene)


def _shadow(ground: list[tuple[NDArray[np.float32], Developed]]) -> NDArray[np.float32] | None:
    """The floor's light with the figure over that without, all sources together."""
    if not ground:
        return None
    cast = add_up([(weight, developed.first) for weight, developed in ground])
    free = add_up([(weight, developed.second) for weight, developed in ground])
    return np.asarray((cast + FAINT) / (free + FAINT))


def _view(model: Model, snapshot: Snapshot) -> Picture:
    """The model's normals or relief in the look's crop, opaque in the figure."""
    if snapshot.look.show == "normals":
        colour = model.normals
    else:
        low, high = float(model.height.min()), float(model.height.max())
        grey = np.clip((model.height - low) / max(high - low, 1e-6), 0, 1) * 255
        colour = np.repeat(np.rint(grey)[..., None], 3, axis=2).astype(np.uint8)
    alpha = model.mask.astype(np.uint8)[..., None]
    return _cut(np.concatenate([colour * alpha, alpha * 255], axis=2), model, snapshot)


def _cut(picture: Picture, model: Model, snapshot: Snapshot) -> Picture:
    """The look's crop of a premultiplied picture of the whole drawing."""
    scale = model.size[0] / picture.shape[1]
    x, y, width, height = (value / scale for value in snapshot.look.crop)
    return cut_picture(picture, (x, y, width, height), snapshot.look.size)
