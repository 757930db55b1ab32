"""A thread that answers requests for rigs and normals with pictures of them."""

from __future__ import annotations

import queue
import threading
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field

from ..camera import Affine
from ..errors import SceneError
from ..lasting import lasting_thread
from ..prepared import PreparedDrawing
from ..preview.rig_pictures import placed, placed_presets, rig_pictures
from ..preview.sketch import normals_picture
from ..protocol import (
    ErrorCode,
    GetNormals,
    GetRigs,
    Normals,
    Pixels,
    Rigs,
    Role,
    error_message,
)
from ..protocol.fields import Message
from ..protocol.rigs import MAX_RIGS
from ..rigs import PRESETS
from ..scene import Rig, Scene, decode_rig, encode_rig
from .faults import fault_message

MAX_WAITING = 32


@dataclass(frozen=True)
class RigQuestion:
    """A request of the session ``session``, with the drawing that its frame shows."""

    session: str
    message: GetRigs | GetNormals
    digest: str
    drawing: PreparedDrawing
    scene: Scene
    camera: Affine


@dataclass
class RigSketches:
    """Sketches rigs in a thread of its own, so that the live light does not wait.

    Args:
        deliver: sends a message and planes to a session; called from the thread.
    """

    deliver: Callable[[str, Message, Mapping[Role, Pixels] | None], None]
    _waiting: queue.Queue[RigQuestion | None] = field(
        default_factory=lambda: queue.Queue(MAX_WAITING)
    )
    _thread: threading.Thread | None = None

    def ask(self, question: RigQuestion) -> None:
        """Answer ``question`` soon; with an error, if too many wait already."""
        if self._thread is None:
            self._thread = lasting_thread("RigSketches", self._run, lambda error: None)
            self._thread.start()
        try:
            self._waiting.put_nowait(question)
        except queue.Full:
            about = question.message.request
            self.deliver(
                question.session, error_message(ErrorCode.TOO_MANY_JOBS, request=about), None
            )

    def stop(self) -> None:
        """Tell the thread to end after the picture that it makes."""
        if self._thread is None:
            return
        while True:
            try:
                self._waiting.put_nowait(None)
                break
            except queue.Full:
                with suppress(queue.Empty):
                    self._waiting.get_nowait()

    def _run(self) -> None:
        while (question := self._waiting.get()) is not None:
            message = question.message
            try:
                answer, pictures = answered(question)
            except SceneError as error:
                fault = error_message(
                    ErrorCode.BAD_FIELD, what=error.what, remedy=error.remedy,
                    details=error.details, about="get_rigs",
                    request=message.request, frame=message.frame,
                )  # fmt: skip
                self.deliver(question.session, fault, None)
            except Exception as error:  # an error of one client must not affect the others
                about = message.request, message.frame
                fault = fault_message(error, request=about[0], frame=about[1])
                self.deliver(question.session, fault, None)
            else:
                self.deliver(question.session, answer, {"picture": pictures})


def answered(question: RigQuestion) -> tuple[Rigs | Normals, Pixels]:
    """The answer to ``question``, and its picture.

    Raises:
        SceneError: one of the client's rigs cannot be used.
    """
    message, scene = question.message, question.scene
    if isinstance(message, GetNormals):
        about = message.request, message.frame
        return (
            Normals(request=about[0], frame=about[1], digest=question.digest),
            normals_picture(question.drawing, message.side),
        )
    own = [placed(decode_rig(text.encode()), scene) for text in message.rigs]
    names: list[str] = []
    rigs: list[Rig] = []
    if message.presets:
        rigs += placed_presets(question.drawing, scene, question.camera)
        names += PRESETS
    rigs += own
    names += [""] * len(own)
    rigs, names = rigs[:MAX_RIGS], names[:MAX_RIGS]
    pictures = rig_pictures(
        question.drawing, scene, question.camera, rigs, message.side, message.frame
    )
    answer = Rigs(
        request=message.request,
        frame=message.frame,
        digest=question.digest,
        names=tuple(names),
        rigs=tuple(encode_rig(rig).decode().strip() for rig in rigs),
    )
    return answer, pictures
