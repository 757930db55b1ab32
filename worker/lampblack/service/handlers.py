"""Handlers of the messages of a client."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from .. import __version__
from ..choices import LIGHT_LAYER
from ..drawing import DrawingPlanes, parse_frames
from ..preview import Viewport
from ..protocol import (
    MINOR,
    Bye,
    Cancel,
    DropFrame,
    ErrorCode,
    GetNormals,
    GetOverlaps,
    GetPalette,
    GetRigs,
    Hello,
    Preview,
    PutFrame,
    Received,
    Render,
    SetScene,
    View,
    Welcome,
    error_message,
)
from ..protocol.fields import Message
from ..shot import cropped_layer
from .jobs import Job
from .service import Service
from .session import FrameContent, Question, Session

MAX_FRAMES = 100_000
MAX_CLIENTS = 8
MINOR_WITH_LIGHT = 3


def handle(service: Service, identity: bytes, received: Received) -> None:
    """Handle a valid message."""
    message = received.message
    session = service.sessions.get(identity)
    if isinstance(message, Hello):
        _hello(service, identity, message)
    elif session is None:
        service.answer(identity, error_message(ErrorCode.NOT_GREETED))
    else:
        _HANDLERS[type(message)](service, session, message, received)


def _hello(service: Service, identity: bytes, message: Hello) -> None:
    earlier = service.sessions.get(identity)
    if earlier is not None:
        service.part_with(earlier)
    if len(service.sessions) >= MAX_CLIENTS:
        service.answer(identity, error_message(ErrorCode.TOO_MANY_CLIENTS))
        return
    session = service.sessions[identity] = Session(identity, minor=message.minor)
    service.send(
        session,
        Welcome(
            minor=MINOR,
            session=session.name,
            worker_version=__version__,
            capabilities=("layers", "apart", "rigs", "normals"),
        ),
    )
    service.hurry_status()


def _put_frame(service: Service, session: Session, message: PutFrame, received: Received) -> None:
    if message.frame not in session.frames and len(session.frames) >= MAX_FRAMES:
        service.send(session, error_message(ErrorCode.TOO_MANY_FRAMES, frame=message.frame))
        return
    if planes := received.planes:
        session.asked.discard(message.digest)
        named = list(zip(message.layers, received.layers, strict=True))
        light = None
        if session.minor >= MINOR_WITH_LIGHT:
            light = next((pixels for name, pixels in named if name == LIGHT_LAYER), None)
            named = [(name, pixels) for name, pixels in named if name != LIGHT_LAYER]
        layers = filter(None, (cropped_layer(name, pixels) for name, pixels in named))
        given = DrawingPlanes(
            planes["pixels"], planes.get("mask"), planes.get("ink"), tuple(layers), light
        )
        service.preview.state.put_planes(message.digest, given)
    session.put_frame(message.frame, FrameContent(message.digest, message.camera))
    service.planner.changed()


def _drop_frame(service: Service, session: Session, message: DropFrame, received: Received) -> None:
    session.drop_frame(message.frame)
    service.planner.changed()


def _set_scene(service: Service, session: Session, message: SetScene, received: Received) -> None:
    if message.revision <= session.revision:
        service.send(
            session, error_message(ErrorCode.STALE_REVISION, details=f"{message.revision}")
        )
        return
    session.set_scene(message.revision, message.scene)
    service.planner.changed()


def _look(service: Service, session: Session, message: Preview | View, received: Received) -> None:
    if stale := session.check_request(message.request):
        service.send(session, stale)
        return
    crop = message.crop
    session.look_at(
        Viewport(
            message.request,
            message.frame,
            message.show if isinstance(message, View) else "lit",
            (crop.x, crop.y, crop.width, crop.height),
            (message.width, message.height),
        )
    )
    code = None
    if message.frame not in session.frames:
        code = ErrorCode.UNKNOWN_FRAME
    elif session.scene is None and isinstance(message, Preview):
        code = ErrorCode.NO_SCENE
    if code is not None:
        service.send(session, error_message(code, request=message.request, frame=message.frame))
    service.planner.changed()


def _ask(service: Service, session: Session, message: Question, received: Received) -> None:
    if stale := session.check_request(message.request):
        service.send(session, stale)
    elif message.frame not in session.frames:
        service.send(
            session,
            error_message(ErrorCode.UNKNOWN_FRAME, request=message.request, frame=message.frame),
        )
    elif isinstance(message, GetRigs | GetNormals) and session.scene is None:
        service.send(session, error_message(ErrorCode.NO_SCENE, request=message.request))
    else:
        session.questions = [*session.questions[-255:], message]
        service.planner.changed()


def _render(service: Service, session: Session, message: Render, received: Received) -> None:
    if stale := session.check_request(message.request):
        service.send(session, stale)
        return
    numbers = parse_frames(message.frames)
    known = numbers if message.project else [n for n in numbers if n in session.frames]
    if session.scene is None:
        service.send(session, error_message(ErrorCode.NO_SCENE, request=message.request))
    elif not known:
        service.send(
            session,
            error_message(ErrorCode.UNKNOWN_FRAME, request=message.request, frame=numbers[0]),
        )
    else:
        contents = dict(session.frames)
        job = Job(session.name, message, session.scene, contents, known)
        if not service.jobs.submit(job):
            service.send(session, error_message(ErrorCode.TOO_MANY_JOBS, request=message.request))


def _cancel(service: Service, session: Session, message: Cancel, received: Received) -> None:
    if session.viewport is not None and session.viewport.request == message.request:
        session.look_at(None)
        service.planner.changed()
    else:
        service.jobs.cancel(session.name, message.request)


def _bye(service: Service, session: Session, message: Bye, received: Received) -> None:
    service.part_with(session)


_HANDLERS: dict[type[Message], Callable[[Service, Session, Any, Received], None]] = {
    PutFrame: _put_frame,
    DropFrame: _drop_frame,
    SetScene: _set_scene,
    Preview: _look,
    View: _look,
    GetPalette: _ask,
    GetOverlaps: _ask,
    GetRigs: _ask,
    GetNormals: _ask,
    Render: _render,
    Cancel: _cancel,
    Bye: _bye,
}
