"""Rendering on a dask cluster, whose workers keep network and renderer loaded. If a worker is lost,
others take over its work.

A scheduler executes everything that it receives, so whoever can connect to it controls its
machines. Between machines, connections must use TLS, with certificates on both sides.
"""

from __future__ import annotations

import functools
import ipaddress
import secrets
import threading
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Literal
from urllib.parse import urlsplit

import msgspec

from ..cache import surface_cache
from ..choices import DeviceChoice, PipelineOptions
from ..errors import LampblackError, OutputError
from ..finals.render_shot import Outcome, RenderListener, render_shot
from ..finals.resolve import ResolvedJob, resolve_job
from ..finals.settings import RenderSettings
from ..finals.targets import Targets
from ..finals.tasks import stamps
from ..pipeline import Pipeline
from ..shot import ShotFrame, by_drawing
from .tasks import on_one_device

CONNECT_SECONDS = 30


@dataclass(frozen=True)
class Certificates:
    """TLS files; if all are None, dask's own configuration is used."""

    ca: str | None = None
    certificate: str | None = None
    key: str | None = None


def light_on_cluster(
    settings: RenderSettings,
    job: ResolvedJob,
    address: str,
    certificates: Certificates,
    listener: RenderListener,
) -> Outcome:
    """Render the frames of ``settings`` on the cluster whose scheduler is at ``address``.

    The workers need the same files under the same names. Frames of one drawing are in one task.

    Raises:
        LampblackError: there is no cluster, the connection is not over TLS, or dask is not
            installed.
    """
    try:
        from distributed import Client, Security, as_completed
    except ImportError as error:
        raise LampblackError(
            "Clusters need a part of Lampblack that is not installed.",
            "Install it: pip install 'lampblack[cluster]'.",
        ) from error
    check_address(address)
    settings_json = msgspec.json.encode(on_one_device(settings).absolute())
    run = secrets.token_hex(8)
    outcome = Outcome()
    try:
        client = Client(  # type: ignore[no-untyped-call]
            address, security=_security(Security, certificates), timeout=CONNECT_SECONDS
        )
    except (OSError, ValueError, TypeError) as error:
        raise LampblackError(
            f"There is no cluster at {address}.",
            "Check the address and the certificates, and that its scheduler runs.",
            str(error),
        ) from error
    with client, Pipeline(surface_cache(), job.options) as unused:
        stamp = stamps(job, unused)
        groups = by_drawing(job.frames)
        futures: dict[Any, list[ShotFrame]] = {
            client.submit(
                light_group, settings_json, run, [f.name for f in group], pure=False
            ): group
            for group in groups
        }
        for future in as_completed(futures):  # type: ignore[no-untyped-call]
            _take_in(outcome, futures[future], future, listener, job.targets, stamp)
    return outcome


def check_address(address: str) -> None:
    """Refuse a scheduler that others on the network could impersonate.

    Raises:
        LampblackError: the address is on another machine, and not over TLS.
    """
    parts = urlsplit(address)
    try:
        loopback = ipaddress.ip_address(parts.hostname or "").is_loopback
    except ValueError:
        loopback = parts.hostname == "localhost"
    if parts.scheme != "tls" and not (parts.scheme == "tcp" and loopback):
        raise LampblackError(
            f"{address} is not reached over TLS.",
            "Name it like tls://scheduler:8786; without TLS, anybody can run code on the cluster.",
        )


def light_group(
    settings_json: bytes, run: str, names: Sequence[str]
) -> list[tuple[str, str, list[str]]]:
    """Runs on a worker: render the named frames. Returns (name, result, error text) of each.

    ``run`` identifies one call of ``light_on_cluster``; between two calls, drawings may change.

    Raises:
        RenderError: this machine cannot use the device that the job names.
    """
    with _ONE_AT_A_TIME:
        job = _resolved(settings_json, run)
        pipeline = _warm_pipeline(job.options, job.device)
        wanted = [frame for frame in job.frames if frame.name in set(names)]
        outcome = render_shot(job, pipeline, wanted)
    failed = {frame.name: error for frame, error in outcome.failed}
    kept = {frame.name for frame in outcome.kept}
    unlit = {frame.name for frame in outcome.unlit}
    report = []
    for frame in wanted:
        error = failed.get(frame.name)
        if error is not None:
            kind = "full" if isinstance(error, OutputError) else "failed"
            report.append((frame.name, kind, [error.what, error.remedy, error.details]))
        else:
            became = "kept" if frame.name in kept else "unlit" if frame.name in unlit else "done"
            report.append((frame.name, became, []))
    return report


Became = Literal["done", "kept", "unlit", "failed", "full"]
"""What became of a frame; ``full``: nothing can be written any more."""

_ONE_AT_A_TIME = threading.Lock()


_pipelines: list[tuple[DeviceChoice, Pipeline]] = []


@functools.lru_cache(maxsize=1)
def _resolved(settings_json: bytes, run: str) -> ResolvedJob:
    return resolve_job(msgspec.json.decode(settings_json, type=RenderSettings))


def _warm_pipeline(options: PipelineOptions, device: DeviceChoice) -> Pipeline:
    """The worker's pipeline, kept between tasks; its renderer ends with the worker."""
    if _pipelines and (_pipelines[0][0], _pipelines[0][1].surfaces.options) != (device, options):
        _pipelines.pop()[1].close()
    if not _pipelines:
        _pipelines.append((device, Pipeline(surface_cache(), options, device=device)))
    return _pipelines[0][1]


def _take_in(
    outcome: Outcome,
    group: list[ShotFrame],
    future: Any,
    listener: RenderListener,
    targets: Targets,
    stamp: Callable[[ShotFrame], str],
) -> None:
    """Take in what a machine says of ``group``. A frame is believed when its files are there and
    have its stamp, by whatever device."""
    by_name = {frame.name: frame for frame in group}
    try:
        report = msgspec.convert(future.result(), list[tuple[str, Became, list[str]]])
        if sorted(name for name, _, _ in report) != sorted(by_name):
            raise ValueError("it speaks of other frames")
        for name, became, words in report:
            frame = by_name[name]
            if became not in ("failed", "full") and not targets.holds(frame, stamp(frame), "auto"):
                raise ValueError(f"the file of {name} is missing, not whole, or another")
            if bool(words) != (became in ("failed", "full")):
                raise ValueError("it contradicts itself")
    except Exception as error:  # whatever went wrong over there
        lost = LampblackError(
            "The cluster could not light this frame.",
            "Run it again; what was finished is kept.",
            repr(error)[:400],
        )
        report = [(frame.name, "failed", [lost.what, lost.remedy, lost.details]) for frame in group]
    for name, became, words in report:
        frame = by_name[name]
        if words:
            kind = OutputError if became == "full" else LampblackError
            failure = kind(*words[:3])
            outcome.failed.append((frame, failure))
            listener.on_frame(frame, failure, kept=False)
            continue
        outcome.done.append(frame)
        if became == "kept":
            outcome.kept.append(frame)
        elif became == "unlit":
            outcome.unlit.append(frame)
        listener.on_frame(frame, None, kept=became == "kept")


def _security(kind: Any, certificates: Certificates) -> Any:
    named = {
        "tls_ca_file": certificates.ca,
        "tls_client_cert": certificates.certificate,
        "tls_client_key": certificates.key,
    }
    given = {name: value for name, value in named.items() if value is not None}
    return kind(require_encryption=True, **given) if given else kind()
