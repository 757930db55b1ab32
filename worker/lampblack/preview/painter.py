"""The painter: a thread that composites traced light with drawings."""

from __future__ import annotations

import threading
from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from ..composite import composite
from ..composite.byte_composite import warm_up
from ..composite.byte_layers import ByteLayers, cut_picture
from ..composite.edges import reach_of
from ..composite.illumination import Illumination
from ..prepared import PreparedDrawing
from ..surface import clay_picture
from . import anticipation
from .anticipation import Anticipation
from .bounded import MIB, BoundedStore
from .light_store import AccumulatedLight
from .refinement import CONVERGED
from .request import ResolvedView, ViewRequest
from .state import PreviewState

Picture = NDArray[np.uint8]


@dataclass(frozen=True, eq=False)
class PreviewImage:
    """A picture for a request.

    Attributes:
        passes: number of earlier pictures of the same request, revision and drawing.
        spp: samples per pixel so far; 0 if light of it is anticipated.
        converged: no finer picture follows until something changes.
        picture: (H, W, 4) uint8 sRGB, premultiplied, at the viewport's size.
    """

    request: ViewRequest
    passes: int
    spp: int
    converged: bool
    picture: Picture


@dataclass
class _Shown:
    """The last picture sent to a client: ``content`` is all that it was made from."""

    order: tuple[int, int] = (0, 0)
    digest: str = ""
    content: Hashable = None
    passes: int = 0


@dataclass
class Painter:
    """Paints the newest request of each session for which all light is traced.

    Args:
        deliver: receives the pictures, in the painter's thread.
        report: receives the session and the error of its picture.
    """

    state: PreviewState
    deliver: Callable[[PreviewImage], None]
    report: Callable[[str, Exception], None]
    _anticipation: Anticipation = field(init=False)
    _offers: dict[str, dict[tuple[int, int], ViewRequest]] = field(default_factory=dict)
    _shown: dict[str, _Shown] = field(default_factory=dict)
    _layers: BoundedStore[Hashable, ByteLayers] = field(
        default_factory=lambda: BoundedStore(128 * MIB)
    )
    _condition: threading.Condition = field(default_factory=threading.Condition)
    _closing: bool = False

    def __post_init__(self) -> None:
        self._anticipation = Anticipation(self.state.lights)

    def offer(self, request: ViewRequest) -> None:
        """Paint ``request``, unless a newer one can be painted."""
        with self._condition:
            self._offers.setdefault(request.session, {})[request.order] = request
            self._condition.notify()

    def forget(self, session: str) -> None:
        """Forget a session that has ended."""
        with self._condition:
            self._offers.pop(session, None)
            self._shown.pop(session, None)

    def close(self) -> None:
        """End the thread."""
        with self._condition:
            self._closing = True
            self._condition.notify()

    def run(self) -> None:
        """Paint until closed."""
        warm_up()
        anticipation.warm_up()
        while True:
            with self._condition:
                self._condition.wait_for(lambda: self._closing or self._offers)
                if self._closing:
                    return
            self.step()

    def step(self) -> bool:
        """Paint for one session; False if there is nothing to paint."""
        with self._condition:
            if not self._offers:
                return False
            session, requests = self._offers.popitem()
        try:
            for order in sorted(requests, reverse=True):
                if self._paint(requests[order]):
                    break
        except Exception as error:  # an error of one client must not affect the others
            self.report(session, error)
        return True

    def prepare(self, request: ViewRequest, drawing: PreparedDrawing) -> ByteLayers:
        """The drawing's layers at the size and crop of the viewport, cached."""
        crop, size = request.viewport.crop, request.viewport.size
        rim = request.scene is not None and request.scene.rim is not None
        key = (drawing.digest, drawing.detail, crop, size, rim)
        layers = self._layers.get(key)
        if layers is None:
            x, y, width, height = crop
            step = drawing.step
            whole = drawing.compact().layers
            assert isinstance(whole, ByteLayers)
            if rim:
                unit = reach_of(drawing.edges.shape) * step / 255
                whole = replace(whole, edges=drawing.edges, edge_unit=unit)
            layers = whole.cut((x / step, y / step, width / step, height / step), size)
            self._layers.put(key, layers, layers.nbytes)
        return layers

    def _paint(self, request: ViewRequest) -> bool:
        """Paint and deliver a picture, unless it would be older or the same. False if light of the
        request is missing."""
        shown = self._shown.setdefault(request.session, _Shown())
        current = self.state.views.get(request.session)
        if current is None or current.viewport != request.viewport:
            return False
        if current.digest != request.digest or request.order < shown.order:
            return False
        drawing = self.state.drawing(request.shape)
        if drawing is None:
            return False
        if request.viewport.show == "lit":
            return self._paint_lit(request, drawing, shown)
        if not _is_shown(request, drawing.detail, shown):
            self._show(request, drawing.detail, shown, _view(drawing, request), _is_full(drawing))
        return True

    def _paint_lit(self, request: ViewRequest, drawing: PreparedDrawing, shown: _Shown) -> bool:
        view = request.resolve(drawing)
        if view is None:
            return False
        lights, sources = [], []
        for contribution in view.contributions:
            light, source = self.state.lights.get(contribution), contribution.key
            if light is None:
                anticipated = self._anticipation.of(contribution, drawing)
                if anticipated is None:
                    return False
                light, source = anticipated.light, anticipated.corrected_by
            lights.append(light)
            sources.append((contribution.key, source, light.level, light.amounts))
        content = (drawing.detail, *sources)
        if _is_shown(request, content, shown):
            return True
        converged = _is_full(drawing) and all(
            self.state.lights.level(contribution) >= CONVERGED
            for contribution in view.contributions
        )
        picture = self._composite(request, drawing, view, lights)
        spp = min((light.spp for light in lights), default=0)
        self._show(request, content, shown, picture, converged, spp)
        return True

    def _show(
        self,
        request: ViewRequest,
        content: Hashable,
        shown: _Shown,
        picture: Picture,
        converged: bool,
        spp: int = 0,
    ) -> None:
        same = shown.order == request.order and shown.digest == request.digest
        shown.passes = shown.passes + 1 if same else 0
        shown.order, shown.digest, shown.content = request.order, request.digest, content
        self.deliver(PreviewImage(request, shown.passes, spp, converged, picture))

    def _composite(
        self,
        request: ViewRequest,
        drawing: PreparedDrawing,
        view: ResolvedView,
        lights: Sequence[AccumulatedLight],
    ) -> Picture:
        pairs = [
            (contribution, (contribution.weight, light.first, light.second))
            for contribution, light in zip(view.contributions, lights, strict=True)
        ]
        on_character = [(c, found) for c, found in pairs if c.subject == "character"]
        ambient = next((found for c, found in on_character if c.is_ambient), None)
        light = Illumination(
            character=[f for c, f in on_character if c.light is not None and c.link is None],
            glows=[f for c, f in on_character if c.glow is not None],
            form=drawing.form_for(view.scene),
            linked={
                link: [found for c, found in on_character if c.link == link]
                for link in dict.fromkeys(c.link for c, _ in on_character)
                if link is not None
            },
            ambient=ambient,
            openness=None if ambient is None else ambient[1],
            floor=[found for c, found in pairs if c.subject == "floor"],
            character_area=view.character,
            floor_area=(0.0, 0.0, float(drawing.size[0]), float(drawing.size[1])),
        )
        return composite(self.prepare(request, drawing), light, view.scene, request.viewport.crop)


def _is_full(drawing: PreparedDrawing) -> bool:
    return drawing.detail == "full"


def _is_shown(request: ViewRequest, content: Hashable, shown: _Shown) -> bool:
    return (shown.order, shown.digest, shown.content) == (request.order, request.digest, content)


def _view(drawing: PreparedDrawing, request: ViewRequest) -> Picture:
    """The drawing's normals or relief in the viewport's crop, opaque in the character."""
    if request.viewport.show == "normals":
        assert drawing.normals is not None
        colour = np.rint((drawing.normals.astype(np.float32) + 1) * 127.5).astype(np.uint8)
        alpha = drawing.mask.astype(np.uint8)[..., None]
        picture = np.concatenate([colour * alpha, alpha * 255], axis=2)
    else:
        picture = clay_picture(drawing.height, drawing.mask, drawing.scale)
    scale = drawing.size[0] / picture.shape[1]
    x, y, width, height = (value / scale for value in request.viewport.crop)
    return cut_picture(picture, (x, y, width, height), request.viewport.size)
