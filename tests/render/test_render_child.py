"""The render process: killed, stopped, hung or hindered, it is told, replaced, and never left."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

import numpy as np
import pytest

from lampblack.errors import LampblackWarning, RenderError
from lampblack.render import client, watched_pipe
from lampblack.render.client import RenderChild
from lampblack.render.quality import Quality, Sampling
from lampblack.render.request import RenderRequest
from lampblack.scene import AreaLight, Canvas
from support.processes import gone
from support.surfaces import ball
from support.window import patience


def request(spp: int) -> RenderRequest:
    sampling = Sampling(1, 512, spp)
    quality = Quality(sampling, sampling, Sampling(0.5, 512, 16), 1, "high")
    return RenderRequest(
        ball(96, 96, (48, 48), 40), Canvas(96, 96), (AreaLight(10, 10, 60),), quality=quality
    )


def test_killed_child_is_told_and_replaced() -> None:
    with RenderChild() as child:
        quick, slow = request(1), request(100_000)
        first = child.render(quick)
        pid = child.pid
        assert pid is not None
        timer = threading.Timer(0.7, os.kill, (pid, signal.SIGKILL))
        timer.start()
        with pytest.raises(RenderError, match="stopped unexpectedly") as caught:
            child.render(slow)
        assert caught.value.remedy
        again = child.render(quick)
        assert child.pid != pid
        assert abs(again.lights[0].diffuse - first.lights[0].diffuse).max() < 1e-4


def test_interrupt_leaves_no_orphan() -> None:
    with RenderChild() as child:
        pid = child.pid
        assert pid is not None
        timer = threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        with pytest.raises(KeyboardInterrupt):
            child.render(request(100_000))
        assert gone([pid], 3)


@pytest.mark.parametrize("stopped", [False, True])
def test_child_ends_with_a_parent_that_was_killed(stopped: bool) -> None:
    """Not with the thread that needed it first."""
    code = """
import threading, time
from lampblack.render.client import RenderChild
from lampblack.render.passes import LightPasses, Passes
child = RenderChild()
starter = threading.Thread(target=child.start)
starter.start()
starter.join()
print(child.pid, flush=True)
time.sleep(120)
"""
    with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE) as parent:
        assert parent.stdout is not None
        pid = int(parent.stdout.readline())
        while "/bpy/" not in Path(f"/proc/{pid}/maps").read_text():
            time.sleep(0.05)
        if stopped:
            os.kill(pid, signal.SIGSTOP)
        parent.kill()
    assert gone([pid], 3)


def test_a_child_that_is_stopped_is_replaced_and_leaves_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    quick = request(4)
    with RenderChild() as own:
        before = own.render(quick).ambient.diffuse
        stopped = own.pid
        assert stopped is not None
        os.kill(stopped, signal.SIGSTOP)
        with pytest.raises(RenderError) as told:
            own.render(quick)
        assert "it was stopped" in told.value.details
        assert gone([stopped], 3)
        assert np.array_equal(own.render(quick).ambient.diffuse, before)
        assert len(list(tmp_path.iterdir())) == 1
    assert not list(tmp_path.iterdir())


HUNG = """
import ctypes, pathlib
from lampblack.render import child
child.private_stdout()
from lampblack.render import trace
render_passes, hung = trace.render_passes, pathlib.Path({hung!r})
def hang_once(scene):
    if not hung.exists():
        hung.touch()
        ctypes.PyDLL(None).pause()  # with the interpreter's lock held
    return render_passes(scene)
trace.render_passes = hang_once
child.main()
"""
"""A render process whose driver does not return, once."""


def test_a_child_that_hangs_is_told_and_replaced(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    since = tmp_path / "hung"
    program = HUNG.format(hung=str(since))
    monkeypatch.setattr(client, "COMMAND", (sys.executable, "-I", "-c", program))
    quick = request(4)
    with RenderChild() as own:
        own.device()  # it has loaded
        hung = own.pid
        assert hung is not None
        with pytest.raises(RenderError) as told:
            own.render(quick)
        assert time.time() - since.stat().st_mtime < 10 * patience()
        assert "it did no work" in told.value.details
        assert told.value.remedy
        assert gone([hung], 3)
        again = own.render(quick)
    assert again.lights[0].diffuse.max() > 0.1


@contextmanager
def hindered(pid: int) -> Iterator[threading.Event]:
    """It gets to work for a hundredth of a second in half a second, as on a machine that swaps,
    until the event that this yields is set."""
    free = threading.Event()

    def hinder() -> None:
        with suppress(ProcessLookupError):
            while not free.wait(0.01):
                os.kill(pid, signal.SIGSTOP)
                free.wait(0.5)
                os.kill(pid, signal.SIGCONT)

    thread = threading.Thread(target=hinder)
    thread.start()
    try:
        yield free
    finally:
        free.set()
        thread.join()


def test_a_child_that_hardly_gets_to_work_is_told_and_waited_for(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(watched_pipe, "SLOW_SHARE", 0.1)
    slow = request(64)
    with RenderChild() as own:
        before, pid, warn = own.render(slow), own.pid, own.on_slow
        assert pid is not None
        with hindered(pid) as free:

            def relent() -> None:
                warn()
                free.set()

            own.on_slow = relent
            with pytest.warns(LampblackWarning, match="hardly gets to work"):
                found = own.render(slow)
        assert own.pid == pid
    assert np.array_equal(found.lights[0].diffuse, before.lights[0].diffuse)
