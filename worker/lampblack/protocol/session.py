"""Messages that open, keep and close a session, and that report errors."""

from __future__ import annotations

from typing import Annotated, Literal

from msgspec import Meta

from .errors import CATALOGUE, ErrorCode, ProtocolError
from .fields import (
    BYTES,
    MILLISECONDS,
    Capabilities,
    Count,
    FrameNumber,
    Message,
    Name,
    Request,
    Sentence,
)

Minor = Annotated[int, Meta(ge=0, le=999, description="minor version of the protocol")]
ChildState = Literal["off", "starting", "idle", "working", "restarting"]


class Hello(Message, frozen=True, kw_only=True):
    """The first message of a client. Another one starts a new session."""

    minor: Minor
    client: Annotated[Name, Meta(description="name of the program, for people")]
    client_version: Annotated[Name, Meta(description="version of the program, for people")]
    capabilities: Capabilities = ()


class Welcome(Message, frozen=True, kw_only=True):
    """The answer to hello. Both sides then use the lower of the two minor versions."""

    minor: Minor
    session: Annotated[
        str,
        Meta(
            pattern="^[0-9a-f]{32}$",
            max_length=32,
            description="if it differs from before, the worker holds nothing of this client",
        ),
    ]
    worker_version: Annotated[Name, Meta(description="version of the package, for people")]
    capabilities: Capabilities = ()
    status_ms: Annotated[
        int,
        Meta(
            ge=100,
            le=10_000,
            description="time between two status messages",
            extra_json_schema=MILLISECONDS,
        ),
    ] = 1000


class Status(Message, frozen=True, kw_only=True):
    """Sent regularly: if a client misses ten, the worker has ended."""

    uptime_ms: Annotated[
        Count, Meta(description="time since the worker started", extra_json_schema=MILLISECONDS)
    ]
    revision: Annotated[
        Count, Meta(description="revision of the scene it holds; 0 before the first")
    ]
    preview: Annotated[ChildState, Meta(description="state of the renderer of previews")]
    job: Annotated[ChildState, Meta(description="state of the renderer of jobs")]
    jobs_waiting: Annotated[Count, Meta(description="render jobs that have not begun")] = 0
    frames_held: Annotated[Count, Meta(description="frames whose drawing it holds")] = 0
    frames_lit: Annotated[
        Count, Meta(description="of these, frames lit at low quality with this scene")
    ] = 0
    memory_bytes: Annotated[
        Count,
        Meta(description="resident memory, including child processes", extra_json_schema=BYTES),
    ] = 0
    card: Annotated[
        str,
        Meta(
            max_length=64,
            description="name of the graphics card that traces previews; empty: the processor does",
            extra_json_schema={"x-since": "1.3"},
        ),
    ] = ""


class Bye(Message, frozen=True, kw_only=True):
    """The sender leaves. It sends nothing more, and its requests are dropped."""

    reason: Annotated[Sentence, Meta(description="reason, for people")] = ""


class ErrorMessage(Message, frozen=True, kw_only=True, tag="error"):
    """An error. The session continues unless it is fatal."""

    code: Annotated[
        str,
        Meta(
            pattern=r"^[a-z][a-z0-9_]*$(?!\n)",
            max_length=40,
            description="stable code, see ERRORS.md; an unknown one is shown like any other",
        ),
    ]
    what: Annotated[Sentence, Meta(description="what happened, one sentence for people")]
    remedy: Annotated[Sentence, Meta(description="what to do, one sentence for people")] = ""
    details: Annotated[str, Meta(max_length=4000, description="text to copy into a report")] = ""
    fatal: Annotated[bool, Meta(description="the session is over")] = False
    about: Annotated[
        str, Meta(max_length=40, description="type of the message that it answers, if any")
    ] = ""
    request: Annotated[Request | None, Meta(description="the request it concerns")] = None
    frame: Annotated[FrameNumber | None, Meta(description="the frame it concerns")] = None


def error_message(
    code: ErrorCode,
    *,
    what: str = "",
    remedy: str = "",
    details: str = "",
    about: str = "",
    request: int | None = None,
    frame: int | None = None,
) -> ErrorMessage:
    """The message that reports an error; omitted texts are taken from the catalogue.

    Text is cut to what the message may hold.
    """
    entry = CATALOGUE[code]
    return ErrorMessage(
        code=code.value,
        what=(what or entry.meaning)[:500],
        remedy=(remedy or entry.remedy)[:500],
        details=details[:4000],
        fatal=entry.fatal,
        about=about[:40],
        request=request,
        frame=frame,
    )


def answer_to(error: ProtocolError) -> ErrorMessage:
    """The answer to a message that could not be decoded."""
    return error_message(
        error.code, details=error.details, about=error.about, request=error.request
    )
