"""Messages about render jobs: frames written to files, at low priority."""

from __future__ import annotations

from typing import Annotated, Literal

from msgspec import Meta

from ..choices import QualityName
from .fields import Count, FrameNumber, Message, Request

Outcome = Literal["finished", "cancelled", "failed"]
Path = Annotated[str, Meta(max_length=1024, extra_json_schema={"x-unit": "path"})]


class Render(Message, frozen=True, kw_only=True):
    """Light frames into files, under the scene as it is now, whatever changes later."""

    request: Request
    frames: Annotated[
        str,
        Meta(
            pattern=r"^[0-9]{1,6}(-[0-9]{1,6}(x[0-9]{1,6})?)?"
            r"(,[0-9]{1,6}(-[0-9]{1,6}(x[0-9]{1,6})?)?)*$(?!\n)",
            max_length=1024,
            description="ranges with optional steps, such as 1-20x2,25; at most 100,000 frames",
        ),
    ]
    output: Annotated[
        Path,
        Meta(
            pattern=r"^/[^%\x00-\x1f\x7f]*%0[1-9]d\.png$(?!\n)",
            description="absolute, the frame number as %04d, such as /shots/a_v001.%04d.png",
        ),
    ]
    quality: QualityName = "final"
    keep_finished: Annotated[
        bool, Meta(description="leave frames whose file is there, whole and up to date")
    ] = False


class Progress(Message, frozen=True, kw_only=True):
    """How far a job is."""

    request: Request
    frame: Annotated[FrameNumber, Meta(description="the frame being made")]
    share: Annotated[float, Meta(ge=0, le=1, description="of that frame, done")]
    frames_done: Count
    frames_total: Count


class FrameDone(Message, frozen=True, kw_only=True):
    """A frame's file is there, whole."""

    request: Request
    frame: FrameNumber
    path: Annotated[Path, Meta(min_length=1, description="the file")]
    kept: Annotated[bool, Meta(description="it was there before")] = False


class Done(Message, frozen=True, kw_only=True):
    """The end of a job; nothing of it follows."""

    request: Request
    outcome: Outcome
    frames_done: Count
    frames_total: Count
    frames_failed: Annotated[Count, Meta(description="each was told of by an error")] = 0


class Cancel(Message, frozen=True, kw_only=True):
    """Stop a look or a job. A job answers done; unknown and ended requests are let be."""

    request: Annotated[Request, Meta(description="of the preview, view or render to stop")]
