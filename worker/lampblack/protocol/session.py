"""Messages that open, keep and close a session, and those that say what went wrong."""

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
    """The first message of a client; sent again, it starts its session afresh."""

    minor: Minor
    client: Annotated[Name, Meta(description="name of the program, for people")]
    client_version: Annotated[Name, Meta(description="for people")]
    capabilities: Capabilities = ()


class Welcome(Message, frozen=True, kw_only=True):
    """The answer to hello. Both sides then speak the lower of the two minors."""

    minor: Minor
    session: Annotated[
        str,
        Meta(
            pattern="^[0-9a-f]{32}$",
            max_length=32,
            description="another one than before: the worker holds nothing of this client",
        ),
    ]
    worker_version: Annotated[Name, Meta(description="of the package, for people")]
    capabilities: Capabilities = ()
    status_ms: Annotated[
        int,
        Meta(ge=100, le=10_000, description="between two ticks", extra_json_schema=MILLISECONDS),
    ] = 1000


class Status(Message, frozen=True, kw_only=True):
    """The worker's tick: three missed ones mean that it is gone."""

    uptime_ms: Annotated[
        Count, Meta(description="since the worker started", extra_json_schema=MILLISECONDS)
    ]
    revision: Annotated[Count, Meta(description="of the scene it holds; 0 before the first")]
    preview: Annotated[ChildState, Meta(description="the renderer of previews")]
    job: Annotated[ChildState, Meta(description="the renderer of jobs")]
    jobs_waiting: Annotated[Count, Meta(description="render jobs not yet begun")] = 0
    frames_held: Annotated[Count, Meta(description="frames whose drawing it holds")] = 0
    frames_lit: Annotated[
        Count, Meta(description="of these, frames lit at low quality under this scene")
    ] = 0
    memory_bytes: Annotated[
        Count, Meta(description="resident, its children included", extra_json_schema=BYTES)
    ] = 0


class Bye(Message, frozen=True, kw_only=True):
    """The sender leaves; nothing of it follows, and what it asked for is let go."""

    reason: Annotated[Sentence, Meta(description="for people")] = ""


class ErrorMessage(Message, frozen=True, kw_only=True, tag="error"):
    """Something went wrong; unless it is fatal, the session goes on."""

    code: Annotated[
        str,
        Meta(
            pattern=r"^[a-z][a-z0-9_]*$(?!\n)",
            max_length=40,
            description="stable, see ERRORS.md; an unknown one is shown like any other",
        ),
    ]
    what: Annotated[Sentence, Meta(description="what happened, a sentence for people")]
    remedy: Annotated[Sentence, Meta(description="what to do, a sentence for people")] = ""
    details: Annotated[str, Meta(max_length=4000, description="worth copying into a report")] = ""
    fatal: Annotated[bool, Meta(description="the session is over")] = False
    about: Annotated[
        str, Meta(max_length=40, description="type of the message it answers, if it answers one")
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
    """The message that tells of an error; words left out are the catalogue's.

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
    """The message that refuses one that could not be decoded."""
    return error_message(
        error.code, details=error.details, about=error.about, request=error.request
    )
