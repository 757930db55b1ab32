"""A shot is rendered and a light is dragged while everything that can die dies.

One minute of it is a slow test; ``make test-chaos`` endures an hour. At the end every frame is
there once and whole, memory is flat and nothing is left.
"""

from __future__ import annotations

import os
import random
import resource
import signal
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import replace
from pathlib import Path

import pytest

from lampblack.drawing import load_picture, save_picture
from lampblack.errors import LampblackError
from lampblack.protocol import ProtocolError, Status
from lampblack.scene import default_scene
from lampblack.service.client import Client, Worker
from support.drawings import draw_ball
from support.jumping_clock import JumpingClock
from support.processes import processes_below, processes_with
from support.window import patience, wait_until

MINUTES = float(os.environ.get("LAMPBLACK_CHAOS_MINUTES", "1"))
SIZE, FRAMES = 96, 40
WHOLE = (0.0, 0.0, float(SIZE), float(SIZE))
RENDERER = b"lampblack.render.child"
YEAR = 365 * 86400
UNDISTURBED_SECONDS = 600
"""Within which nothing but the shot is rendered."""


class Shot:
    """A command line that renders a shot again and again, whatever happens to it."""

    def __init__(self, folder: Path, environment: dict[str, str]) -> None:
        self.inputs, self.output = folder / "in", folder / "lit"
        self.inputs.mkdir()
        self._environment = environment
        for number in range(1, FRAMES + 1):
            save_picture(self.inputs / f"a.{number:04d}.png", draw_ball(SIZE - number, canvas=SIZE))
        self.process: subprocess.Popen[bytes] | None = None

    def start(self, output: Path | None = None) -> subprocess.Popen[bytes]:
        return subprocess.Popen(
            [sys.executable, "-I", "-m", "lampblack", "render", self.inputs,
             "-o", output or self.output, "--quality", "low"],
            env=self._environment, stderr=subprocess.DEVNULL,
        )  # fmt: skip

    def keep_going(self) -> None:
        """Start it again if it has ended; begin anew if it has finished."""
        if self.process is None or self.process.poll() is not None:
            if self.process is not None and self.process.returncode == 0:
                for path in sorted(self.output.iterdir())[::2]:
                    path.unlink()
            self.process = self.start()


class Artist:
    """A client that drags a light, and comes back if the worker or it itself is lost."""

    def __init__(self, folder: Path, environment: dict[str, str]) -> None:
        self._folder, self._environment = folder, environment
        self.worker: Worker | None = None
        self.client: Client | None = None
        self.pictures, self.memory = 0, [0]

    def drag(self, seconds: float) -> None:
        until = time.monotonic() + seconds
        while time.monotonic() < until:
            try:
                client = self._connected()
                scene = default_scene(SIZE, SIZE)
                light = replace(scene.lights[0], x=float(client.revision % SIZE))
                client.set_scene(replace(scene, lights=(light,)))
                received = client.receive(1 / 30)
            except (LampblackError, ProtocolError, AssertionError, TimeoutError):
                self.vanish()
                continue
            if received is not None:
                self.pictures += "picture" in received.planes
                if isinstance(received.message, Status):
                    self.memory.append(received.message.memory_bytes)
            if time.monotonic() - self._heard > 20:
                self.vanish()
            elif received is not None:
                self._heard = time.monotonic()

    def vanish(self) -> None:
        """Without a word of farewell, as a program that crashed."""
        if self.client is not None:
            self.client.__exit__(None, None, None)
        self.client = None

    def _connected(self) -> Client:
        if self.worker is None or self.worker.process.poll() is not None:
            self.vanish()
            self.worker = Worker(self._folder, environment=self._environment)
        if self.client is None:
            self.client = self.worker.connect()
            self.client.hello()
            self.client.announce(1, draw_ball(SIZE))
            self.client.look(1, (SIZE, SIZE), WHOLE)
            self._heard = time.monotonic()
        return self.client


@contextmanager
def playing(shot: Shot, artist: Artist) -> Iterator[None]:
    try:
        yield
    finally:
        artist.vanish()
        for process in (shot.process, artist.worker.process if artist.worker else None):
            if process is not None and process.poll() is None:
                process.send_signal(signal.SIGCONT)
                process.terminate()
                process.wait(120)


@pytest.mark.slow
@pytest.mark.timeout(60 * MINUTES + 1500 * patience())
def test_everything_dies_and_nothing_is_lost(
    tmp_path: Path, record_property: Callable[[str, object], None]
) -> None:
    chance, done = random.Random(5), Counter[str]()
    temporary = tmp_path / "tmp"
    temporary.mkdir()
    clock = JumpingClock(tmp_path)
    environment = {
        **os.environ,
        "XDG_CACHE_HOME": str(tmp_path / "cache"),
        "TMPDIR": str(temporary),
        "XDG_RUNTIME_DIR": str(temporary),
        **clock.environment,
    }
    shot, artist = Shot(tmp_path, environment), Artist(tmp_path, environment)

    def hit(which: int | None, number: int, only: bytes = b"") -> None:
        if which is None:
            return
        struck = [pid for pid, words in processes_below(which).items() if only in words]
        with suppress(ProcessLookupError):
            os.kill(chance.choice(struck) if struck and only else which, number)

    def shot_pid() -> int | None:
        return shot.process.pid if shot.process and shot.process.poll() is None else None

    def worker_pid() -> int | None:
        worker = artist.worker
        return worker.process.pid if worker and worker.process.poll() is None else None

    def spoil_cache() -> None:
        entries = sorted((tmp_path / "cache").rglob("*.safetensors"))
        if entries:
            path = chance.choice(entries)
            data = bytearray(path.read_bytes() or b"?")
            data[chance.randrange(len(data))] ^= 0x55
            path.write_bytes(data[: chance.randrange(1, len(data) + 1)])

    def spoil_frame() -> None:
        finished = sorted(shot.output.glob("*.png"))
        if finished:
            path = chance.choice(finished)
            path.write_bytes(path.read_bytes()[: chance.randrange(200)])

    def fill_disk(bytes_left: int = -1) -> None:
        """No file gets longer than ``bytes_left``; without a number, as long as it likes."""
        for pid in (shot_pid(), worker_pid()):
            with suppress(ProcessLookupError):
                if pid is not None:
                    resource.prlimit(pid, resource.RLIMIT_FSIZE, (bytes_left, -1))

    deeds: dict[str, Callable[[], None]] = {
        "renderer of the shot killed": lambda: hit(shot_pid(), signal.SIGKILL, RENDERER),
        "renderer of the shot stopped": lambda: hit(shot_pid(), signal.SIGSTOP, RENDERER),
        "renderer of the worker killed": lambda: hit(worker_pid(), signal.SIGKILL, RENDERER),
        "renderer of the worker stopped": lambda: hit(worker_pid(), signal.SIGSTOP, RENDERER),
        "shot interrupted": lambda: hit(shot_pid(), signal.SIGINT),
        "shot ended": lambda: hit(shot_pid(), signal.SIGTERM),
        "shot killed": lambda: hit(shot_pid(), signal.SIGKILL),
        "worker killed": lambda: hit(worker_pid(), signal.SIGKILL),
        "artist vanished": artist.vanish,
        "cache entry spoilt": spoil_cache,
        "finished frame cut short": spoil_frame,
        "disk full": lambda: fill_disk(chance.randrange(4000)),
        "disk has room again": fill_disk,
        "clock jumped": lambda: clock.jump(chance.choice((-YEAR, -3600, 0, 90, YEAR))),
    }
    assert shot.start(tmp_path / "undisturbed").wait(UNDISTURBED_SECONDS * patience()) == 0
    with playing(shot, artist):
        until = time.monotonic() + 60 * MINUTES
        while time.monotonic() < until:
            shot.keep_going()
            artist.drag(chance.uniform(1, 6))
            deed = chance.choice(list(deeds))
            deeds[deed]()
            done[deed] += 1
        fill_disk()
        artist.drag(15)
        before, until = artist.pictures, time.monotonic() + 180 * patience()
        while artist.pictures == before and time.monotonic() < until:
            artist.drag(1)
        assert artist.pictures > before, "the preview lives"
    half = len(artist.memory) // 2
    if half > 60:
        assert max(artist.memory[half:]) < max(artist.memory[:half]) + (256 << 20)

    assert shot.start().wait(UNDISTURBED_SECONDS * patience()) == 0
    names = sorted(path.name for path in (tmp_path / "undisturbed").iterdir())
    assert len(names) == FRAMES
    assert sorted(path.name for path in shot.output.iterdir()) == names, "nothing half-written"
    for name in names:
        expected = load_picture(tmp_path / "undisturbed" / name)
        assert (load_picture(shot.output / name) == expected).all(), name
    wait_until(lambda: not processes_with(temporary), "the end of all that was started", 3)
    assert not list(temporary.iterdir()), "the last run removed what the killed ones left"
    record_property("deeds", dict(done))
    record_property("pictures", artist.pictures)
    record_property("most_memory", max(artist.memory))
