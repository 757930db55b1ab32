"""Latency of live relighting, through the real socket."""

from __future__ import annotations

import math
import os
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from numpy.typing import NDArray

from ..composite.byte_layers import cut_picture, premultiplied
from ..drawing import load_picture
from ..protocol import Crop, Done, Image, Render, Status, View
from ..scene import AreaLight, Floor, Material, Scene
from ..service.client import Client, Worker
from .floor import cycles_alone
from .memory import processor_seconds

HERTZ = 60
SECONDS = 10
PAINTED_PX = 500
CHANGES = 60
MOMENTS, STEPS_BETWEEN = 12, 15
"""Moments of a drag at which what is shown is judged, and changes from one to the next."""
IDLE_SECONDS = 5

Figures = dict[str, float]
Picture = NDArray[np.uint8]


@dataclass
class _Bench:
    client: Client
    picture: Picture
    scene: Scene

    @property
    def whole(self) -> tuple[float, float, float, float]:
        return 0.0, 0.0, float(self.picture.shape[1]), float(self.picture.shape[0])

    @property
    def size(self) -> tuple[int, int]:
        height, width = self.picture.shape[:2]
        scale = PAINTED_PX / max(height, width)
        return round(width * scale), round(height * scale)

    def show(self, scene: Scene) -> Picture:
        """Set a scene and wait until its picture has converged."""
        revision = self.client.set_scene(scene)
        return self.client.picture(120, lambda i: i.converged and i.revision == revision)[1]


def bench_relight(picture: Picture, scene: Scene) -> Figures:
    """Latencies in ms (p50 and p95, from sending a message to receiving its pixels), pictures per
    second, seconds to the first lit picture, and the worker's processor time at rest.

    Args:
        picture: (H, W, 4) uint8, painted by the client at 500 px. scene: its materials and
            lights; the first light is dragged.
    """
    plain = replace(scene, lights=scene.lights[:1], floor=None)
    floor = replace(plain, floor=scene.floor or Floor(0.95 * picture.shape[0]))
    pair = replace(plain, lights=(scene.lights * 2)[:2])
    eight = replace(plain, lights=(scene.lights * 8)[:8])
    figures: Figures = {"load_average": os.getloadavg()[0]}
    with _fresh_worker() as (worker, client, ready):
        bench = _Bench(client, picture, plain)
        figures["s_start_to_ready"] = ready
        figures |= _new_drawing(bench)
        figures |= _idle(bench, worker.process.pid)
        dragged = {"one_light": plain, "floor": floor, "two_lights": pair, "eight_lights": eight}
        for name, staged in dragged.items():
            bench.show(staged)
            figures |= {f"{name}_{k}": v for k, v in _drag(bench, staged).items()}
        bench.show(plain)
        figures |= _under_the_hand(bench, plain)
        figures |= _rest(bench, plain)
        for name, staged in (("", plain), ("_floor", floor)):
            bench.show(staged)
            figures |= {f"{k}{name}": v for k, v in _recombine(bench, staged).items()}
        status, _ = client.wait_for(Status)
        figures["mib_at_the_end"] = status.memory_bytes / 2**20
        figures["changes"] = client.revision
        figures["load_average_after"] = os.getloadavg()[0]
    return figures | cycles_alone(picture, plain)


@contextmanager
def _fresh_worker() -> Iterator[tuple[Worker, Client, float]]:
    """A worker with an empty cache, a client of it, and the seconds until it was ready."""
    with TemporaryDirectory() as folder:
        begin = time.perf_counter()
        with (
            Worker(Path(folder), environment={"XDG_CACHE_HOME": folder}) as worker,
            worker.connect() as client,
        ):
            client.hello()
            client.wait_for(Status, 60, lambda status: status.preview == "idle")
            yield worker, client, time.perf_counter() - begin


def _new_drawing(bench: _Bench) -> Figures:
    """Time for a new drawing until its first lit picture; then for another until its normals."""
    client = bench.client
    client.set_scene(bench.scene)
    begin = time.perf_counter()
    client.announce(1, bench.picture)
    client.look(1, bench.size, bench.whole)
    client.picture(60)
    first = time.perf_counter() - begin
    client.picture(120, lambda image: image.converged)
    converged = time.perf_counter() - begin
    stroke = bench.picture.copy()
    stroke[stroke.shape[0] // 2, stroke.shape[1] // 3 : stroke.shape[1] // 2] = 0, 0, 0, 255
    begin = time.perf_counter()
    client.announce(1, stroke)
    width, height = bench.size
    x, y, w, h = bench.whole
    crop = Crop(x=x, y=y, width=w, height=h)
    request = client.next_request()
    client.send(
        View(request=request, frame=1, show="normals", crop=crop, width=width, height=height)
    )
    client.picture(120, lambda image: image.converged and image.request == request)
    normals = time.perf_counter() - begin
    client.announce(1, bench.picture)
    client.look(1, bench.size, bench.whole)
    client.picture(120, lambda image: image.converged)
    return {
        "s_first_lit": first,
        "s_normals": normals,
        "s_new_drawing_converged": converged,
    }


def _idle(bench: _Bench, pid: int) -> Figures:
    """Processor time of a worker at rest."""
    bench.client.wait_for(Status)
    status, _ = bench.client.wait_for(Status, where=lambda status: status.preview == "idle")
    before = processor_seconds(pid)
    until = time.monotonic() + IDLE_SECONDS
    while (left := until - time.monotonic()) > 0:
        bench.client.receive(left)
    spent = processor_seconds(pid) - before
    return {
        "percent_idle_cpu": 100 * spent / IDLE_SECONDS,
        "mib_at_first": status.memory_bytes / 2**20,
    }


def _circle(scene: Scene, turn: float) -> Scene:
    """The first light on a circle over the canvas."""
    width, height = scene.canvas.width, scene.canvas.height
    x = width * (0.5 + 0.4 * math.cos(turn))
    y = height * (0.4 + 0.3 * math.sin(turn))
    light: AreaLight = replace(scene.lights[0], x=x, y=y)
    return replace(scene, lights=(light, *scene.lights[1:]))


def _drag(bench: _Bench, scene: Scene) -> Figures:
    """Latency of each picture shown while the light goes round at 60 Hz."""
    client, sent, latencies = bench.client, {}, []
    begin = time.perf_counter()
    for step in range(HERTZ * SECONDS):
        moved = _circle(scene, step / HERTZ)
        sent[client.set_scene(moved)] = time.perf_counter()
        due = begin + (step + 1) / HERTZ
        while (left := due - time.perf_counter()) > 0:
            received = client.receive(left)
            image = received and received.message
            if isinstance(image, Image) and image.revision in sent:
                latencies.append(time.perf_counter() - sent[image.revision])
    return _spread(latencies) | {"pictures_per_s": len(latencies) / SECONDS}


def _under_the_hand(bench: _Bench, scene: Scene) -> Figures:
    """How far what is shown is from the converged picture of where the light is at that moment."""
    client, shown = bench.client, bench.show(scene)
    moments: list[tuple[Scene, Picture]] = []
    begin = time.perf_counter()
    for step in range(MOMENTS * STEPS_BETWEEN):
        moved = _circle(scene, step / HERTZ)
        client.set_scene(moved)
        due = begin + (step + 1) / HERTZ
        while (left := due - time.perf_counter()) > 0:
            received = client.receive(left)
            if received is not None and isinstance(received.message, Image):
                shown = received.planes["picture"]
        if step % STEPS_BETWEEN == STEPS_BETWEEN - 1:
            moments.append((moved, shown.copy()))
    errors = [_rmse(picture, bench.show(moved)) for moved, picture in moments]
    return {"rmse_under_the_hand": float(np.mean(errors)), "rmse_worst": max(errors)}


def _rest(bench: _Bench, scene: Scene) -> Figures:
    """How near the final picture the last position comes, and when."""
    client, last = bench.client, _circle(scene, 2.0)
    for step in range(HERTZ):
        client.set_scene(_circle(scene, 1.0 + step / HERTZ))
        client.receive(1 / HERTZ)
    revision, begin = client.set_scene(last), time.perf_counter()
    seen: list[tuple[float, Image, Picture]] = []
    while not seen or not seen[-1][1].converged:
        image, planes = client.wait_for(Image, 60)
        if image.revision == revision:
            seen.append((time.perf_counter() - begin, image, planes["picture"]))
    final = _final(bench)
    errors = [(at, _rmse(picture, final)) for at, _, picture in seen]
    near = [at for at, error in errors if error < 0.02]
    return {
        "s_rest_to_rmse_0.02": near[0] if near else math.inf,
        "s_rest_to_converged": errors[-1][0],
        "rmse_first": errors[0][1],
        "rmse_at_2_s": [error for at, error in errors if at <= 2][-1],
        "rmse_converged": errors[-1][1],
    }


def _final(bench: _Bench) -> Picture:
    """The same scene as a final frame, at the size that the client paints."""
    with TemporaryDirectory() as folder:
        request = bench.client.next_request()
        output = str(Path(folder) / "final.%04d.png")
        bench.client.send(Render(request=request, frames="1", output=output, quality="final"))
        bench.client.wait_for(Done, 300)
        final = load_picture(Path(folder) / "final.0001.png")
    return cut_picture(premultiplied(final), bench.whole, bench.size)


def _rmse(a: Picture, b: Picture) -> float:
    """sRGB in 0..1, over the pixels that either covers."""
    covered = (a[..., 3] > 0) | (b[..., 3] > 0)
    apart = (a[..., :3].astype(np.float32) - b[..., :3])[covered] / 255
    return float(np.sqrt(np.square(apart).mean()))


def _recombine(bench: _Bench, scene: Scene) -> Figures:
    """Latency of changes that need no render."""
    colours = sorted(scene.materials) or ["#000000"]
    light = scene.lights[0]

    def gloss(step: int) -> Scene:
        shiny = {
            colour: replace(scene.material(colour), gloss=0.2 + 0.01 * step) for colour in colours
        }
        return replace(scene, materials=shiny, default_material=Material())

    changes: dict[str, Callable[[int], Scene]] = {
        "colour": lambda n: replace(
            scene, lights=(replace(light, colour=f"#ff{n + 99:02x}80"), *scene.lights[1:])
        ),
        "power": lambda n: replace(
            scene, lights=(replace(light, power=1 + 0.05 * n), *scene.lights[1:])
        ),
        "ambient": lambda n: replace(
            scene, ambient=replace(scene.ambient, strength=0.2 + 0.01 * n)
        ),
        "gloss": gloss,
    }
    figures: Figures = {}
    for name, change in changes.items():
        latencies = []
        for step in range(CHANGES):
            begin = time.perf_counter()
            bench.client.set_scene(change(step))
            bench.client.picture(10, lambda image: image.revision == bench.client.revision)
            latencies.append(time.perf_counter() - begin)
            time.sleep(0.03)
        figures |= {f"{name}_{k}": v for k, v in _spread(latencies).items()}
    return figures


def _spread(seconds: list[float]) -> Figures:
    p50, p95 = np.percentile(np.array(seconds or [math.inf]) * 1000, (50, 95))
    return {"ms_p50": float(p50), "ms_p95": float(p95)}
