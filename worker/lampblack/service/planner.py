"""The planner: from the sessions to the view requests and drawings that the preview needs."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import islice

from ..camera import Affine
from ..drawing import Palette
from ..preview import PreviewState, ViewRequest
from ..preview.bounded import MIB, BoundedStore
from ..preview.painter import Painter
from ..preview.refinement import LOW
from ..preview.shape import DrawingShape
from ..preview.state import DrawingKey
from ..protocol import (
    ErrorCode,
    GetNormals,
    GetOverlaps,
    GetPalette,
    GetRigs,
    NeedFrame,
    Overlaps,
    Swatch,
    error_message,
)
from ..protocol import Palette as PaletteMessage
from ..protocol.fields import Message
from .faults import fault_message
from .overlaps import overlaps_on_canvas
from .rig_sketches import RigQuestion
from .session import Session

MAX_ASKED = 2
"""Most drawings requested from a client at the same time, for frames outside its viewport."""
AHEAD_SHARE = 0.7
"""Share of the memory for prepared drawings that frames outside a viewport may take."""


@dataclass
class Planner:
    """Tells the preview what is wanted. Only the owner's thread uses it.

    Args:
        sessions: all sessions by identity; shared with the owner.
        send: queues a message for a session.
        sketch: answers a request for rigs or normals, some time later.
    """

    state: PreviewState
    painter: Painter
    sessions: dict[bytes, Session]
    send: Callable[[Session, Message], None]
    sketch: Callable[[RigQuestion], None]
    _palettes: BoundedStore[str, Palette] = field(default_factory=lambda: BoundedStore(MIB))
    _warnings: BoundedStore[str, list[str]] = field(default_factory=lambda: BoundedStore(MIB))
    _dirty: bool = False

    def changed(self) -> None:
        """Note that something a client set, or a result for it, has changed."""
        self._dirty = True

    def note(self, digest: str, palette: Palette | None, warnings: list[str]) -> None:
        """Note that the preparer finished a step of a drawing."""
        if palette is not None:
            self._palettes.put(digest, palette, 64 * len(palette.swatches) + 64)
            self._warnings.put(digest, warnings, 1000)
        self.changed()

    def plan(self) -> None:
        """Update what is wanted, if something has changed."""
        if not self._dirty:
            return
        self._dirty = False
        views: dict[str, ViewRequest] = {}
        ahead: list[ViewRequest] = []
        urgent: list[DrawingKey] = []
        for session in self.sessions.values():
            view = session.view()
            if view is not None:
                views[session.name] = view
                if not self.state.is_prepared(view.digest, "full"):
                    urgent.append((view.shape, "quick"))
                urgent.append((view.shape, "full"))
                self._request_missing(session, view.shape)
                self._report_drawing(session, view)
            for question in session.questions:
                shape = session.shape(question.frame)
                urgent.append((shape, "full"))
                self._request_missing(session, shape)
            ahead += self._nearest(session)
        later: list[DrawingKey] = [(request.shape, "full") for request in ahead]
        self.state.show(views, tuple(ahead), tuple(dict.fromkeys(urgent + later)))
        for view in views.values():
            self.painter.offer(view)
        for session in self.sessions.values():
            self._answer_questions(session)

    def frames_held(self, session: Session) -> int:
        """Number of frames whose drawing is stored or prepared."""
        held = {
            digest
            for digest in {content.digest for content in session.frames.values()}
            if digest in self.state.planes or self.state.is_prepared(digest)
        }
        return sum(content.digest in held for content in session.frames.values())

    def frames_lit(self, session: Session) -> int:
        """Number of frames that can be shown at once, at low quality or better."""
        view = session.view()
        lit = set()
        for request in [*([view] if view else []), *session.ahead()]:
            drawing = self.state.drawings.get((request.shape, "full"))
            resolved = drawing and request.resolve(drawing)
            contributions = resolved.contributions if resolved else ()
            if drawing and all(self.state.lights.level(c) >= LOW for c in contributions):
                lit.add(session.sight(request.viewport.frame))
        return sum(session.sight(frame) in lit for frame in session.frames)

    def _nearest(self, session: Session) -> list[ViewRequest]:
        """View requests for frames that may come next, as many as fit into memory. Missing drawings
        are requested."""
        view = session.view()
        if view is None or view.viewport.show != "lit":
            return []
        drawing = self.state.drawings.get((view.shape, "full"))
        if drawing is None:
            return []
        room = AHEAD_SHARE * self.state.drawings.max_bytes / drawing.nbytes / len(self.sessions)
        nearest = list(islice(session.ahead(), int(room)))
        for request in nearest:
            if len(session.asked) >= MAX_ASKED:
                break
            self._request_missing(session, request.shape)
        return nearest

    def _request_missing(self, session: Session, shape: DrawingShape) -> None:
        """Request a missing drawing, and those whose hints it needs, once."""
        if (shape, "full") in self.state.drawings or self.state.failure(shape.digest) is not None:
            return
        for digest in shape.needed:
            if digest not in self.state.planes and digest not in session.asked:
                self.ask(session, digest)

    def ask(self, session: Session, digest: str) -> None:
        """Request a drawing, if a frame still shows it."""
        frame = session.frame_showing(digest)
        if frame is not None:
            session.asked.add(digest)
            self.send(session, NeedFrame(frame=frame, digest=digest))

    def _report_drawing(self, session: Session, view: ViewRequest) -> None:
        """Report the error of the visible drawing, once."""
        frame, digest = view.viewport.frame, view.digest
        failure, warnings = self.state.failure(digest), self._warnings.get(digest)
        if digest in session.informed or (failure is None and warnings is None):
            return
        session.informed.add(digest)
        if failure is not None:
            self.send(session, fault_message(failure, frame=frame))
        for sentence in warnings or []:
            code = ErrorCode.DRAWING_WARNING
            self.send(session, error_message(code, what=sentence, frame=frame))

    def _answer_questions(self, session: Session) -> None:
        waiting, session.questions = session.questions, []
        for question in waiting:
            content, shape = session.frames[question.frame], session.shape(question.frame)
            failure = self.state.failure(content.digest)
            if failure is not None:
                about = question.request, question.frame
                self.send(session, fault_message(failure, request=about[0], frame=about[1]))
                continue
            if isinstance(question, GetRigs | GetNormals):
                if not self._sketch(session, question, shape):
                    session.questions.append(question)
                continue
            answer = (
                self._palette(question, shape)
                if isinstance(question, GetPalette)
                else self._overlaps(question, shape, content.camera, session.revision)
            )
            if answer is None:
                session.questions.append(question)
            else:
                self.send(session, answer)

    def _sketch(
        self, session: Session, question: GetRigs | GetNormals, shape: DrawingShape
    ) -> bool:
        """Have rigs or normals drawn; False while the drawing is not prepared in any detail."""
        drawing = self.state.drawing(shape)
        if drawing is None or session.scene is None:
            return False
        camera = session.frames[question.frame].camera
        self.sketch(
            RigQuestion(session.name, question, shape.digest, drawing, session.scene, camera)
        )
        return True

    def _palette(self, question: GetPalette, shape: DrawingShape) -> Message | None:
        """The answer; None while the drawing is not decomposed."""
        palette = self._palettes.get(shape.digest)
        drawing = self.state.drawings.get((shape, "full"))
        if palette is None and drawing is not None:
            palette = drawing.layers.palette
        if palette is None:
            return None
        swatches = tuple(Swatch(colour=s.colour, pixels=s.pixels) for s in palette.swatches)
        about = question.request, question.frame
        return PaletteMessage(
            request=about[0], frame=about[1], digest=shape.digest, swatches=swatches
        )

    def _overlaps(
        self, question: GetOverlaps, shape: DrawingShape, camera: Affine, revision: int
    ) -> Message | None:
        """The answer; None while the drawing is not prepared."""
        drawing = self.state.drawings.get((shape, "full"))
        if drawing is None:
            return None
        return Overlaps(
            request=question.request,
            frame=question.frame,
            digest=shape.digest,
            revision=revision,
            overlaps=overlaps_on_canvas(drawing.overlaps, camera),
        )
