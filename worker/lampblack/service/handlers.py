"""What each message of a client does."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from .. import __version__
from ..drawing import parse_frames
from ..normals.temporal.neighbours import REACH, neighbour_keys
from ..protocol import (
    MINOR,
    Bye,
    Cancel,
    DropFrame,
    ErrorCode,
    GetPalette,
    Hello,
    Pixels,
    Preview,
    PutFrame,
    Render,
    Role,
    SetScene,
    View,
    Welcome,
    error_message,
)
from ..protocol.fields import Message
from .job import Job, job_scene
from .session import Session, Shown
from .snapshot import Look

if TYPE_CHECKING:
    from .server import Server

MAX_FRAMES = 100_000
MAX_CLIENTS = 8

Planes = dict[Role, Pixels]


def handle(server: Server, identity: bytes, message: Message, planes: Planes) -> None:
    """Act upon a message that was found sound."""
    session = server.sessions.get(identity)
    if isinstance(message, Hello):
        _hello(server, identity, message)
    elif session is None:
        server.answer(identity, error_message(ErrorCode.NOT_GREETED))
    else:
        _HANDLERS[type(message)](server, session, message, planes)


def _hello(server: Server, identity: bytes, message: Hello) -> None:
    earlier = server.sessions.get(identity)
    if earlier is not None:
        server.part_with(earlier)
    if len(server.sessions) >= MAX_CLIENTS:
        server.answer(identity, error_message(ErrorCode.TOO_MANY_CLIENTS))
        return
    session = server.sessions[identity] = Session(identity)
    server.send(session, Welcome(minor=MINOR, session=session.name, worker_version=__version__))
    server.hurry_status()


def _put_frame(server: Server, session: Session, message: PutFrame, planes: Planes) -> None:
    if message.frame not in session.frames and len(session.frames) >= MAX_FRAMES:
        server.send(session, error_message(ErrorCode.TOO_MANY_FRAMES, frame=message.frame))
        return
    if planes:
        session.asked.discard(message.digest)
        server.studio.planes.put(
            message.digest, planes, sum(plane.nbytes for plane in planes.values())
        )
        with server.studio.condition:
            server.studio.condition.notify_all()
    before = session.frames.get(message.frame)
    if before is not None and before.digest != message.digest:
        session.asked.discard(before.digest)  # a client does not send what no frame shows
    session.frames[message.frame] = Shown(message.digest, message.camera)
    server.planner.changed()


def _drop_frame(server: Server, session: Session, message: DropFrame, planes: Planes) -> None:
    before = session.frames.pop(message.frame, None)
    if before is not None:
        session.asked.discard(before.digest)
    session.palettes = [wait for wait in session.palettes if wait[1] != message.frame]
    server.planner.changed()


def _set_scene(server: Server, session: Session, message: SetScene, planes: Planes) -> None:
    if message.revision <= session.revision:
        server.send(session, error_message(ErrorCode.STALE_REVISION, details=f"{message.revision}"))
        return
    session.revision, session.scene = message.revision, message.scene
    server.planner.changed()


def _look(server: Server, session: Session, message: Preview | View, planes: Planes) -> None:
    if stale := session.rises(message.request):
        server.send(session, stale)
        return
    crop = message.crop
    session.look = Look(
        message.request,
        message.frame,
        message.show if isinstance(message, View) else "lit",
        (crop.x, crop.y, crop.width, crop.height),
        (message.width, message.height),
    )
    code = None
    if message.frame not in session.frames:
        code = ErrorCode.UNKNOWN_FRAME
    elif session.scene is None and isinstance(message, Preview):
        code = ErrorCode.NO_SCENE
    if code is not None:
        server.send(session, error_message(code, request=message.request, frame=message.frame))
    server.planner.changed()


def _get_palette(server: Server, session: Session, message: GetPalette, planes: Planes) -> None:
    if stale := session.rises(message.request):
        server.send(session, stale)
    elif message.frame not in session.frames:
        server.send(
            session,
            error_message(ErrorCode.UNKNOWN_FRAME, request=message.request, frame=message.frame),
        )
    else:
        session.palettes = [*session.palettes[-255:], (message.request, message.frame)]
        server.planner.changed()


def _render(server: Server, session: Session, message: Render, planes: Planes) -> None:
    if stale := session.rises(message.request):
        server.send(session, stale)
        return
    numbers = parse_frames(message.frames)
    known = [(number, session.frames[number]) for number in numbers if number in session.frames]
    if session.scene is None:
        server.send(session, error_message(ErrorCode.NO_SCENE, request=message.request))
    elif not known:
        server.send(
            session,
            error_message(ErrorCode.UNKNOWN_FRAME, request=message.request, frame=numbers[0]),
        )
    else:
        job = Job(
            session.name,
            message.request,
            known,
            job_scene(session.scene, message.quality),
            message.output,
            message.keep_finished,
            neighbour_keys([shown.digest for _, shown in sorted(session.frames.items())], REACH),
        )
        if not server.jobs.submit(job):
            server.send(session, error_message(ErrorCode.TOO_MANY_JOBS, request=message.request))


def _cancel(server: Server, session: Session, message: Cancel, planes: Planes) -> None:
    if session.look is not None and session.look.request == message.request:
        session.look = None
        server.planner.changed()
    else:
        server.jobs.cancel(session.name, message.request)


def _bye(server: Server, session: Session, message: Bye, planes: Planes) -> None:
    server.part_with(session)


_HANDLERS: dict[type[Message], Callable[[Server, Session, Any, Planes], None]] = {
    PutFrame: _put_frame,
    DropFrame: _drop_frame,
    SetScene: _set_scene,
    Preview: _look,
    View: _look,
    GetPalette: _get_palette,
    Render: _render,
    Cancel: _cancel,
    Bye: _bye,
}
