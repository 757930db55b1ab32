"""``lampblack render``: drawings or a project in, lit frames out."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

import typer

from ..errors import LampblackError, RenderError
from ..finals.settings import RenderSettings
from .console import EXIT_FAILED, EXIT_UNLIT, print_error, progress_bar, say
from .options import OPTIONS, with_settings
from .overviews import ContactSheet, Fps, Overviews, Preview, SpriteSheet

if TYPE_CHECKING:
    from ..finals.render_shot import Outcome
    from ..finals.resolve import ResolvedJob
    from ..shot import ShotFrame


@with_settings(*(name for name in OPTIONS if name not in ("input", "frame")))
def render(
    settings: RenderSettings,
    contact_sheet: ContactSheet = None,
    preview: Preview = None,
    fps: Fps = None,
    sprite_sheet: SpriteSheet = None,
    allow_blank: Annotated[
        bool, typer.Option("--allow-blank", help="Exit with 0 even if blank frames stayed unlit.")
    ] = False,
    cluster: Annotated[
        str | None,
        typer.Option(
            "--cluster",
            metavar="ADDRESS",
            help="Render on a dask cluster: its scheduler's address, tls://host:8786.",
        ),
    ] = None,
    tls_ca: Annotated[
        str | None,
        typer.Option(
            "--tls-ca", metavar="PEM", help="Certificate of the authority that the cluster trusts."
        ),
    ] = None,
    tls_cert: Annotated[
        str | None,
        typer.Option("--tls-cert", metavar="PEM", help="This machine's certificate."),
    ] = None,
    tls_key: Annotated[
        str | None,
        typer.Option("--tls-key", metavar="PEM", help="Private key of --tls-cert."),
    ] = None,
) -> None:
    """Light drawings, or the frames of a project.

    A frame whose file is up to date is not rendered again: after an interruption, run the same
    command to continue. Exit code 1: a frame failed; the others are finished. Exit code 3: a blank
    frame was passed through unlit.

    Example: lampblack render walk/ -o lit/ --light 250,150,400 --quality final
    """
    from ..cache import surface_cache
    from ..farm.cluster import Certificates, light_on_cluster
    from ..finals.render_shot import RenderListener, render_shot
    from ..finals.resolve import resolve_job
    from ..finals.sheet import cells_of
    from ..pipeline import Pipeline
    from ..render.client import CARD_LOST

    job = resolve_job(settings)
    columns = 0 if settings.sheet is None else cells_of(settings.sheet)[0]
    overviews = Overviews(contact_sheet, preview, fps, sprite_sheet, columns)
    overviews.check(job)
    with progress_bar() as bar:
        task = bar.add_task("Lighting", total=len(job.frames))

        class Report(RenderListener):
            def on_renderer_lost(self, frame: ShotFrame, error: RenderError) -> None:
                again = error.remedy if error.remedy == CARD_LOST else "It is started again."
                say(f"{frame.name}: {error.what} {again}")
                say(f"  details: {error.details.strip().rpartition(chr(10))[2][:200]}", "dim")

            def on_frame(
                self, frame: ShotFrame, error: LampblackError | None, *, kept: bool
            ) -> None:
                bar.advance(task)
                if error is not None:
                    print_error(error, f"{frame.name}: ")

        if cluster is not None:
            certificates = Certificates(tls_ca, tls_cert, tls_key)
            outcome = light_on_cluster(settings, job, cluster, certificates, Report())
        else:
            with Pipeline(surface_cache(), job.options, device=job.device) as pipeline:
                outcome = render_shot(job, pipeline, listener=Report())
    overviews.save(job, outcome.done)
    _summarise(job, outcome)
    if outcome.failed:
        raise typer.Exit(EXIT_FAILED)
    if outcome.unlit and not allow_blank:
        raise typer.Exit(EXIT_UNLIT)


def _summarise(job: ResolvedJob, outcome: Outcome) -> None:
    kept = f", {len(outcome.kept)} of them from before" if outcome.kept else ""
    say(
        f"{len(outcome.done)} of {len(job.frames)} frames are in "
        f"{job.targets.folder.absolute()}{kept}."
    )
    if len(outcome.devices) > 1:
        counts = ", ".join(f"{number} on {device}" for device, number in outcome.devices.items())
        say(f"Frames of several devices: {counts}. To use only one: --device cpu, or another.")
    if outcome.failed:
        names = ", ".join(frame.name for frame, _ in outcome.failed)
        say(f"Failed: {names}", "bold red")
