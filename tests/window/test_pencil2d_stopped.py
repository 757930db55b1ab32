"""Pencil2D and its worker, stopped and killed: nothing is lost, and nothing stays behind."""

from __future__ import annotations

import os
import shutil
import signal
import time
from pathlib import Path

import pytest

from support.lamp import Canvas, drag_light, keep, light_up, project_in, settled, sidecar
from support.processes import gone, processes_below, workers_of
from support.window import Display, Pencil2D, pencil2d

HEARTBEAT_SECONDS = 7
"""After so long without an answer the worker takes the connection for lost."""
ORPHAN_SECONDS = 3
"""So long may what Pencil2D started outlive it, on a busy machine too."""


def test_a_stopped_pencil2d_goes_on_where_it_was(window: Pencil2D) -> None:
    canvas = Canvas(window)
    light_up(window)
    drag_light(window, canvas, (500, 300))
    before = window.value("lampblack", "lightPlaces")
    (worker,) = workers_of(window.process.pid)
    os.kill(window.process.pid, signal.SIGSTOP)
    time.sleep(HEARTBEAT_SECONDS)
    assert workers_of(window.process.pid) == [worker], "it waits for its program"
    os.kill(window.process.pid, signal.SIGCONT)
    settled(window)
    assert window.value("lampblack", "lightPlaces") == before
    shown = window.value("lampblack", "shownRevision")
    drag_light(window, canvas, (120, 300))
    assert window.value("lampblack", "shownRevision") > shown
    keep(window, "after a stop")


@pytest.mark.parametrize("stopped", [False, True])
def test_a_killed_pencil2d_leaves_nothing_for_long(
    display: Display, tmp_path: Path, stopped: bool
) -> None:
    project, folder = project_in(tmp_path), tmp_path / "window"

    def left() -> set[str]:
        """Lampblack's folders, by the process that made them."""
        return {path.name.split("-")[1] for path in (folder / "tmp").glob("lampblack-*")}

    with pencil2d(display, folder, project) as window:
        light_up(window)
        killed = window.process.pid
        ours = [pid for pid, words in processes_below(killed).items() if b"lampblack" in words]
        assert len(ours) >= 2, "a worker and its renderer"
        if stopped:
            for pid in ours:
                os.kill(pid, signal.SIGSTOP)
        window.kill()
        assert gone(ours, ORPHAN_SECONDS)
    assert left() <= {str(killed)}
    assert not list((folder / "tmp").glob("lampblack-*/*")), "only the folder itself is left"
    shutil.rmtree(folder / "tmp" / "Pencil2D", ignore_errors=True)  # its own, to be recovered
    with pencil2d(display, folder, project) as window:
        light_up(window)
        assert left() == {str(window.process.pid)}
    assert not sidecar(project).exists(), "nothing was saved that nobody saved"
