"""From what clients set to what has to be made: looks, models, drawings to ask for."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field

import msgspec

from ..drawing import Palette
from ..protocol import ErrorCode, NeedFrame, Swatch, error_message
from ..protocol import Palette as PaletteMessage
from ..protocol.fields import Message
from .bounded import BoundedStore
from .model import Grade
from .painter import Painter
from .session import Session
from .snapshot import Snapshot
from .source import LOW, sources_of
from .studio import MIB, Studio

MAX_ASKED = 2
"""Drawings asked of a client at once, for frames that it does not look at."""
AHEAD_SHARE = 0.7
"""Of the room for models, what frames that are not looked at may take."""


@dataclass
class Planner:
    """Tells the other threads what is wanted; of the owner's thread alone.

    Args:
        sessions: all there are, by identity; the owner's own.
        send: queues a message for a session.
    """

    studio: Studio
    painter: Painter
    sessions: dict[bytes, Session]
    send: Callable[[Session, Message], None]
    _palettes: BoundedStore[str, Palette] = field(default_factory=lambda: BoundedStore(MIB))
    _notices: BoundedStore[str, list[str]] = field(default_factory=lambda: BoundedStore(MIB))
    _dirty: bool = False

    def changed(self) -> None:
        """Something that a client set, or that was made for it, is another."""
        self._dirty = True

    def note(self, digest: str, palette: Palette | None, noticed: list[str]) -> None:
        """The modeller got on with a drawing."""
        if palette is not None:
            self._palettes.put(digest, palette, 64 * len(palette.swatches) + 64)
            self._notices.put(digest, noticed, 1000)
        self.changed()

    def plan(self) -> None:
        """Tell the other threads what is wanted now, if that has changed."""
        if not self._dirty:
            return
        self._dirty = False
        wanted: dict[str, Snapshot] = {}
        ahead: list[Snapshot] = []
        urgent: list[tuple[str, Grade]] = []
        for session in self.sessions.values():
            snapshot = session.snapshot()
            if snapshot is not None:
                wanted[session.name] = snapshot
                if (snapshot.digest, "fine") not in self.studio.models:
                    urgent.append((snapshot.digest, "coarse"))
                urgent.append((snapshot.digest, "fine"))
                self._need(session, snapshot.digest)
                self._tell_of_drawing(session, snapshot)
            for _, frame in session.palettes:
                urgent.append((session.frames[frame].digest, "fine"))
                self._need(session, session.frames[frame].digest)
            ahead += self._nearest(session)
        later: list[tuple[str, Grade]] = [(snapshot.digest, "fine") for snapshot in ahead]
        moved = any(self.studio.wanted.get(name) != look for name, look in wanted.items())
        self.studio.update(
            wanted=wanted,
            ahead=tuple(ahead),
            models_wanted=tuple(dict.fromkeys(urgent + later)),
            changed=time.monotonic() if moved else self.studio.changed,
        )
        for snapshot in wanted.values():
            self.painter.offer(snapshot)
        for session in self.sessions.values():
            self._answer_palettes(session)

    def frames_held(self, session: Session) -> int:
        """Frames whose drawing is held, or a model of it."""
        held = {
            digest
            for digest in {shown.digest for shown in session.frames.values()}
            if digest in self.studio.planes or self.studio.model(digest)
        }
        return sum(shown.digest in held for shown in session.frames.values())

    def frames_lit(self, session: Session) -> int:
        """Frames that can be shown at once, at low quality or better."""
        snapshot = session.snapshot()
        lit = set()
        for seen in [*([snapshot] if snapshot else []), *session.ahead()]:
            model = self.studio.models.get((seen.digest, "fine"))
            if model is not None and all(
                self.studio.lights.rung(source) >= LOW for source in sources_of(seen, model)
            ):
                lit.add(session.sight(seen.look.frame))
        return sum(session.sight(frame) in lit for frame in session.frames)

    def _nearest(self, session: Session) -> list[Snapshot]:
        """Frames ahead, as many as there is room for; those not held are asked for."""
        snapshot = session.snapshot()
        if snapshot is None or snapshot.look.show != "lit":
            return []
        model = self.studio.models.get((snapshot.digest, "fine"))
        if model is None:
            return []
        room = AHEAD_SHARE * self.studio.models.max_bytes / model.nbytes / len(self.sessions)
        nearest = [seen for seen, _ in zip(session.ahead(), range(int(room)), strict=False)]
        for seen in nearest:
            if len(session.asked) >= MAX_ASKED:
                break
            self._need(session, seen.digest)
        return nearest

    def _need(self, session: Session, digest: str) -> None:
        """Ask for a drawing that is not held, once."""
        held = digest in self.studio.planes or (digest, "fine") in self.studio.models
        if held or digest in session.asked or digest in self.studio.failed:
            return
        self.ask(session, digest)

    def ask(self, session: Session, digest: str) -> None:
        """Ask for a drawing, if a frame still shows it."""
        frame = session.frame_showing(digest)
        if frame is not None:
            session.asked.add(digest)
            self.send(session, NeedFrame(frame=frame, digest=digest))

    def _tell_of_drawing(self, session: Session, snapshot: Snapshot) -> None:
        """Tell, once, what is wrong with the drawing that is looked at."""
        frame, digest = snapshot.look.frame, snapshot.digest
        failure, notices = self.studio.failed.get(digest), self._notices.get(digest)
        if digest in session.told or (failure is None and notices is None):
            return
        session.told.add(digest)
        if failure is not None:
            self.send(session, msgspec.structs.replace(failure, frame=frame))
        for sentence in notices or []:
            code = ErrorCode.DRAWING_WARNING
            self.send(session, error_message(code, what=sentence, frame=frame))

    def _answer_palettes(self, session: Session) -> None:
        waiting, session.palettes = session.palettes, []
        for request, frame in waiting:
            digest = session.frames[frame].digest
            palette, failure = self._palettes.get(digest), self.studio.failed.get(digest)
            model = self.studio.models.get((digest, "fine"))
            if failure is not None:
                self.send(session, msgspec.structs.replace(failure, request=request, frame=frame))
            elif palette is not None or model is not None:
                swatches = (palette or model.sheet.palette).swatches  # type: ignore[union-attr]
                message = PaletteMessage(
                    request=request,
                    frame=frame,
                    digest=digest,
                    swatches=tuple(Swatch(colour=s.colour, pixels=s.pixels) for s in swatches),
                )
                self.send(session, message)
            else:
                session.palettes.append((request, frame))
