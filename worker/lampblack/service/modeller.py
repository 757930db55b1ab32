"""The modeller: a thread that makes models of drawings, the most urgent first."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field

import numpy as np

from ..drawing import Drawing, Palette
from ..errors import LampblackError, NothingDrawnError
from ..pipeline import Pipeline
from ..protocol import ErrorCode, error_message
from ..scene import default_scene
from .model import Grade, Model, coarse_model, fine_model, take_planes_apart
from .noticed import noticed_warnings
from .studio import Studio

Order = tuple[str, Grade]


class _Superseded(Exception):
    """Something more urgent came up."""


@dataclass
class Modeller:
    """Works off ``studio.models_wanted``.

    Args:
        pipeline: predicts and inflates; its renderer is not used.
        done: told of every model and palette, by digest, and of what was noticed about it.
    """

    studio: Studio
    pipeline: Pipeline
    done: Callable[[str, Palette | None, list[str]], None]
    _drawing: tuple[str, Drawing, list[str]] | None = field(default=None)

    def run(self) -> None:
        """Make models until the studio closes."""
        self._warm_up()
        while True:
            with self.studio.condition:
                self.studio.condition.wait_for(lambda: self.studio.closing or self._next())
                if self.studio.closing:
                    return
                order = self._next()
            if order is not None:
                self._make(order)

    def _warm_up(self) -> None:
        """Load the network and what is compiled, before the first drawing comes."""
        disk = np.zeros((64, 64, 4), np.uint8)
        disk[12:52, 12:52] = 120, 120, 120, 255
        with noticed_warnings(), suppress(LampblackError):
            coarse_model("", {"pixels": disk}, self.pipeline).surface(default_scene(64, 64))

    def _next(self) -> Order | None:
        """The most urgent model that is missing and can be made."""
        for order in self.studio.models_wanted:
            digest, _ = order
            if order in self.studio.models or digest in self.studio.failed:
                continue
            if digest in self.studio.planes:
                return order
        return None

    def _make(self, order: Order) -> None:
        digest, grade = order
        planes = self.studio.planes.get(digest)
        if planes is None:
            return
        try:
            if grade == "coarse":
                with noticed_warnings():
                    model = coarse_model(digest, planes, self.pipeline)
            else:
                model = self._fine(order)
        except _Superseded:
            return
        except NothingDrawnError as error:
            self._fail(digest, ErrorCode.NOTHING_DRAWN, error)
        except LampblackError as error:
            self._fail(digest, ErrorCode.DRAWING_UNUSABLE, error)
        except MemoryError:
            self._fail(digest, ErrorCode.OUT_OF_MEMORY, LampblackError(""))
        except Exception as error:
            self._fail(digest, ErrorCode.INTERNAL, LampblackError("", details=repr(error)))
        else:
            self.studio.models.put(order, model, model.nbytes)
            if grade == "fine":
                self.studio.models.drop((digest, "coarse"))
            self.done(digest, None, [])

    def _fine(self, order: Order) -> Model:
        digest, _ = order
        if self._drawing is None or self._drawing[0] != digest:
            planes = self.studio.planes.get(digest)
            if planes is None:
                raise _Superseded
            with noticed_warnings() as noticed:
                drawing = take_planes_apart(planes)
            self._drawing = digest, drawing, noticed
            self.done(digest, drawing.palette, noticed)

        def give_way(share: float) -> None:
            if self.studio.closing or self._next() != order:
                raise _Superseded

        drawing = self._drawing[1]
        give_way(0)
        self.pipeline.height(drawing, give_way)
        model = fine_model(digest, drawing, self.pipeline)
        self._drawing = None
        return model

    def _fail(self, digest: str, code: ErrorCode, error: LampblackError) -> None:
        message = error_message(code, what=error.what, remedy=error.remedy, details=error.details)
        with self.studio.condition:
            self.studio.failed[digest] = message
            while len(self.studio.failed) > 1000:
                self.studio.failed.pop(next(iter(self.studio.failed)))
        self.done(digest, None, [])
