"""Pictures of all frames that a command writes beside them: a contact sheet, a moving picture and a
sprite sheet."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..errors import LampblackError
from .outputs import check_suffix, keep_inputs

if TYPE_CHECKING:
    from ..finals.resolve import ResolvedJob
    from ..shot import ShotFrame

ContactSheet = Annotated[
    Path | None,
    typer.Option(
        "--contact-sheet",
        metavar="PNG",
        help="Write a picture of up to 12 frames: drawings above, lit below.",
    ),
]
Preview = Annotated[
    Path | None,
    typer.Option(
        "--preview",
        metavar="FILE",
        help="Write a moving picture to look at: .webm or .mp4 (with ffmpeg), .gif or .webp.",
    ),
]
Fps = Annotated[
    float | None,
    typer.Option(
        "--fps",
        metavar="N",
        min=0.1,
        max=240,
        help="Frames per second of --preview. Default: the project's, or 12.",
    ),
]
SpriteSheet = Annotated[
    Path | None,
    typer.Option(
        "--sprite-sheet",
        metavar="PNG",
        help="Write all frames into one sheet, in the cells of --sheet, or about square.",
    ),
]


@dataclass(frozen=True)
class Overviews:
    """The files that were asked for."""

    contact_sheet: Path | None = None
    preview: Path | None = None
    fps: float | None = None
    sprite_sheet: Path | None = None
    columns: int = 0

    def check(self, job: ResolvedJob) -> None:
        """Refuse what cannot be written, before any work.

        Raises:
            LampblackError: a suffix is wrong, an input would be lost, or the frames are no PNG.
        """
        from ..finals.moving_picture import SUFFIXES, check_program

        asked = [
            (self.contact_sheet, "A contact sheet", "--contact-sheet", (".png",)),
            (self.preview, "A moving picture", "--preview", SUFFIXES),
            (self.sprite_sheet, "A sprite sheet", "--sprite-sheet", (".png",)),
        ]
        for path, what, option, suffixes in asked:
            if path is None:
                continue
            check_suffix(path, *suffixes)
            keep_inputs(path, job.sources)
            if job.targets.kind != "png":
                raise LampblackError(
                    f"{what} shows PNG frames only.", f"Leave out {option}, or write PNG frames."
                )
            if any(path.absolute() == job.targets.path(f).absolute() for f in job.frames):
                raise LampblackError(
                    f"{option} would replace a frame, {path}.", "Give it another name."
                )
        if self.preview is not None:
            check_program(self.preview)

    def save(self, job: ResolvedJob, done: Sequence[ShotFrame]) -> None:
        """Write them of the frames ``done``. Without any, nothing is written.

        Raises:
            OutputError: a file cannot be written.
        """
        from ..drawing import load_picture
        from ..finals.contact_sheet import save_contact_sheet
        from ..finals.moving_picture import USUAL_FPS, save_moving_picture
        from ..finals.sheet import save_sheet

        if self.contact_sheet is not None:
            save_contact_sheet(self.contact_sheet, job, done)
        written = set(done)
        if not written:
            return
        if self.preview is not None:
            fps = self.fps or getattr(job.shot, "fps", None) or USUAL_FPS
            frames = [frame for frame in job.frames if frame in written]
            pictures = (load_picture(job.targets.path(frame)) for frame in frames)
            save_moving_picture(self.preview, pictures, fps)
        if self.sprite_sheet is not None:
            lit = [
                load_picture(job.targets.path(frame)) if frame in written else None
                for frame in job.frames
            ]
            save_sheet(self.sprite_sheet, lit, self.columns)
