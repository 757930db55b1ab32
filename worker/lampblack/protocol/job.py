"""Messages about render jobs: frames written to files, at low priority."""

from __future__ import annotations

from typing import Annotated, Literal

from msgspec import Meta

from ..choices import ApartKind, QualityName
from .fields import Count, FrameNumber, Message, Request

Outcome = Literal["finished", "cancelled", "failed"]
Path = Annotated[str, Meta(max_length=1024, extra_json_schema={"x-unit": "path"})]


class Render(Message, frozen=True, kw_only=True):
    """Render frames into files, with the scene of this moment."""

    request: Request
    frames: Annotated[
        str,
        Meta(
            pattern=r"^[0-9]{1,6}(-[0-9]{1,6}(x[0-9]{1,6})?)?"
            r"(,[0-9]{1,6}(-[0-9]{1,6}(x[0-9]{1,6})?)?)*$(?!\n)",
            max_length=1024,
            description="ranges with optional steps: 1-20x2,25; at most 100,000 frames",
        ),
    ]
    output: Annotated[
        Path,
        Meta(
            pattern=r"^/[^%\x00-\x1f\x7f]*%0[1-9]d\.(png|exr)$(?!\n)",
            description="absolute path with the frame number as %04d: /shots/a_v001.%04d.png",
        ),
    ]
    quality: QualityName = "final"
    keep_finished: Annotated[bool, Meta(description="keep files that are up to date")] = False
    project: Annotated[
        Path,
        Meta(
            pattern=r"^(/[^\x00-\x1f\x7f]*\.pclx)?$(?!\n)",
            description="absolute path of a project: its saved frames are rendered instead of the "
            "announced drawings, through its first camera, with the lit layers only",
            extra_json_schema={"x-unit": "path", "x-since": "1.1"},
        ),
    ] = ""
    apart: Annotated[
        ApartKind,
        Meta(
            description="take each frame apart into layers for compositing: an OpenRaster file "
            "beside it, PNG in a folder for each layer, the same without blend modes for Pencil2D, "
            "or layers of the EXR",
            extra_json_schema={"x-since": "1.3"},
        ),
    ] = "none"


class Progress(Message, frozen=True, kw_only=True):
    """The progress of a job."""

    request: Request
    frame: Annotated[FrameNumber, Meta(description="the frame that is being rendered")]
    share: Annotated[float, Meta(ge=0, le=1, description="share of that frame that is done")]
    frames_done: Count
    frames_total: Count


class FrameDone(Message, frozen=True, kw_only=True):
    """The file of a frame is complete."""

    request: Request
    frame: FrameNumber
    path: Annotated[Path, Meta(min_length=1, description="the file")]
    kept: Annotated[bool, Meta(description="the file existed before the job")] = False


class Done(Message, frozen=True, kw_only=True):
    """The end of a job; no message about it follows."""

    request: Request
    outcome: Outcome
    frames_done: Count
    frames_total: Count
    frames_failed: Annotated[Count, Meta(description="an error was sent for each")] = 0


class Cancel(Message, frozen=True, kw_only=True):
    """End the viewport or a job. A job answers done; unknown and ended requests are ignored."""

    request: Annotated[Request, Meta(description="number of the preview, view or render to stop")]
