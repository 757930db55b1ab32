"""The preparer: a thread that prepares drawings, the most urgent first."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass, field, replace

import numpy as np

from ..drawing import Drawing, DrawingPlanes, Palette
from ..errors import LampblackError
from ..hints import HintedDrawing, carry_hints
from ..normals.temporal.temporal_filter import TemporalFilter
from ..pins import carried_place
from ..pipeline import Pipeline
from ..prepared import PreparedDrawing
from ..scene import Pin, default_scene
from ..warning_collector import collect_warnings
from .contribution import preview_surface
from .shape import DrawingShape
from .state import DrawingKey, PreviewState


class _SupersededError(Exception):
    """A more urgent drawing is wanted."""


@dataclass
class Preparer:
    """Prepares the drawings in ``state.wanted``.

    Args:
        pipeline: prepares drawings; its renderer is not used.
        done: called after each step of a drawing, with its digest, its palette if that is known,
            and warnings.
    """

    state: PreviewState
    pipeline: Pipeline
    done: Callable[[str, Palette | None, list[str]], None]
    _decomposed: tuple[tuple[str, str], Drawing] | None = None
    _temporal_filter: TemporalFilter = field(default_factory=TemporalFilter)

    def run(self) -> None:
        """Prepare drawings until the state closes."""
        self._warm_up()
        while True:
            with self.state.condition:
                self.state.condition.wait_for(lambda: self.state.closing or self._next())
            if self.state.closing:
                return
            self.step()

    def step(self) -> bool:
        """Prepare the most urgent drawing; False if there is none, or its planes are missing."""
        key = self._next()
        planes = None if key is None else self.state.planes.get(key[0].digest)
        if key is None or planes is None:
            return False
        shape, detail = key
        digest = shape.digest
        try:
            if detail == "quick":
                with collect_warnings():
                    prepared = self.pipeline.prepare_quick(
                        planes, shape.key, shape.layers
                    ).compact()
            else:
                prepared = self._prepare_full(key, planes)
        except _SupersededError:
            return True
        except Exception as error:  # an error of one drawing must not end all previews
            self.state.fail(digest, error)
        else:
            self.state.drawings.put(key, prepared, prepared.nbytes)
            if detail == "full":
                self.state.drawings.drop((shape, "quick"))
        self.done(digest, None, [])
        return True

    def _warm_up(self) -> None:
        """Load the network and compiled functions before the first drawing."""
        disk = np.zeros((64, 64, 4), np.uint8)
        disk[12:52, 12:52] = 120, 120, 120, 255
        with collect_warnings(), suppress(LampblackError):
            preview_surface(self.pipeline.prepare_quick(DrawingPlanes(disk)), default_scene(64, 64))

    def _next(self) -> DrawingKey | None:
        """The most urgent drawing that is not yet prepared and can be."""
        for key in self.state.wanted:
            shape, _ = key
            if key in self.state.drawings or self.state.failure(shape.digest) is not None:
                continue
            if all(digest in self.state.planes for digest in shape.needed):
                return key
        return None

    def _prepare_full(self, key: DrawingKey, planes: DrawingPlanes) -> PreparedDrawing:
        """Raises _SupersededError: a more urgent drawing is wanted."""
        shape, _ = key
        said = shape.digest, repr(shape.layers)
        if self._decomposed is None or self._decomposed[0] != said:
            with collect_warnings() as warnings:
                drawing = planes.decompose(shape.layers)
            self._decomposed = said, drawing
            self.done(shape.digest, drawing.palette, warnings)

        def give_way(share: float) -> None:
            if self.state.closing or self._next() != key:
                raise _SupersededError

        drawing = self._decomposed[1]
        give_way(0)
        carried = carry_hints(self._hinted(shape, drawing), drawing, self._temporal_filter)
        hints = *carried, *shape.colours
        prepared = self.pipeline.prepare(
            drawing, hints=hints, digest=shape.key, progress=give_way, with_normals=True
        ).compact()
        self._decomposed = None
        return replace(prepared, pinned=self._pinned(shape, drawing))

    def _pinned(self, shape: DrawingShape, drawing: Drawing) -> dict[Pin, tuple[float, float]]:
        """Where the pins of other drawings are in ``drawing``; those that cannot be read are
        left out."""
        found = {}
        for source in shape.pins:
            planes = self.state.planes.get(source.digest)
            if planes is None:
                continue
            with collect_warnings(), suppress(LampblackError):
                made_on = planes.decompose(shape.layers)
                place = carried_place(
                    source.place, source.pin.layer, made_on, drawing, self._temporal_filter
                )
                if place is not None:
                    found[source.pin] = place
        return found

    def _hinted(self, shape: DrawingShape, drawing: Drawing) -> Iterator[HintedDrawing]:
        """The drawings with hints that count for ``drawing``; those that cannot be read have no
        say."""
        for source in shape.sources:
            if source.digest == shape.digest:
                yield HintedDrawing(drawing, source.hints)
                continue
            planes = self.state.planes.get(source.digest)
            if planes is not None:
                with collect_warnings(), suppress(LampblackError):
                    yield HintedDrawing(planes.decompose(), source.hints)
