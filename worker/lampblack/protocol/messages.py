"""All messages, by sender and by type on the wire."""

from __future__ import annotations

from typing import Literal, get_args

import msgspec

from .fields import Message
from .frames import (
    DropFrame,
    GetOverlaps,
    GetPalette,
    NeedFrame,
    Overlaps,
    Palette,
    PutFrame,
)
from .job import Cancel, Done, FrameDone, Progress, Render
from .normals import GetNormals, Normals
from .preview import Image, Preview, SetScene, View
from .rigs import GetRigs, Rigs
from .session import Bye, ErrorMessage, Hello, Status, Welcome

Sender = Literal["client", "worker"]

FromClient = (
    Hello
    | PutFrame
    | DropFrame
    | SetScene
    | Preview
    | View
    | GetPalette
    | GetOverlaps
    | GetRigs
    | GetNormals
    | Render
    | Cancel
    | Bye
)
FromWorker = (
    Welcome
    | NeedFrame
    | Image
    | Palette
    | Overlaps
    | Rigs
    | Normals
    | Progress
    | FrameDone
    | Done
    | Status
    | ErrorMessage
    | Bye
)


def type_of(kind: type[Message]) -> str:
    """The type of a message on the wire."""
    return str(msgspec.inspect.type_info(kind).tag)  # type: ignore[attr-defined]


BY_SENDER: dict[Sender, dict[str, type[Message]]] = {
    "client": {type_of(kind): kind for kind in get_args(FromClient)},
    "worker": {type_of(kind): kind for kind in get_args(FromWorker)},
}
MESSAGES: dict[str, type[Message]] = {**BY_SENDER["client"], **BY_SENDER["worker"]}
