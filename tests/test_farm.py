"""Shots spread over tasks and machines: every frame made, each drawing once, losses survived."""

from __future__ import annotations

import os
import shutil
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import msgspec
import numpy as np
import pytest
import yaml
from openjd.model import decode_job_template

from conftest import Run, draw_ball, files
from lampblack.drawing import load_picture, parse_frames, save_picture
from lampblack.drawing.sequence import frame_list
from lampblack.errors import LampblackError
from lampblack.farm.cluster import check_address, light_group
from lampblack.farm.tasks import MAX_TASKS, cut_into_tasks
from lampblack.finals.settings import RenderSettings
from lampblack.shot import ShotFrame
from projects import document, image, layer, png, write_project

BIN = Path(sys.executable).parent


def walk(folder: Path, cycle: list[int]) -> Path:
    """A project of balls, one key a frame, that repeats drawings as ``cycle`` says."""
    keys = [image(n, f"{name}.png", -40, -40) for n, name in enumerate(cycle, start=1)]
    pictures = {f"{n}.png": png(draw_ball(80, (10 * n, 90, 60))) for n in set(cycle)}
    xml = document([layer(2, "ball", keys)], size=(96, 96))
    return write_project(folder / "walk.pclx", xml, pictures)


def test_tasks_hold_each_drawing_whole() -> None:
    frames = [ShotFrame(n, f"{n}.png", f"drawing {n % 5}") for n in range(1, 24)]
    tasks = cut_into_tasks(frames, 6)
    assert sorted(number for task in tasks for number in task) == list(range(1, 24))
    for drawing in range(5):
        holders = [task for task in tasks if any(number % 5 == drawing for number in task)]
        assert len(holders) == 1
    assert all(len(task) >= 6 for task in tasks[:-1])
    many = [ShotFrame(n, f"{n}.png", str(n)) for n in range(5000)]
    assert len(cut_into_tasks(many, 1)) <= MAX_TASKS
    with pytest.raises(LampblackError, match="no number"):
        cut_into_tasks([ShotFrame(None, "a.png", "")], 1)


@pytest.mark.parametrize("numbers", [[1], [1, 2, 3], [1, 3, 4, 9], list(range(0, 99, 2))])
def test_frame_lists_are_read_back(numbers: list[int]) -> None:
    assert parse_frames(frame_list(numbers)) == numbers


def test_a_job_names_each_drawing_in_one_task(run: Run, tmp_path: Path) -> None:
    project, target = walk(tmp_path, [1, 2, 1, 2, 3, 3, 1]), tmp_path / "job.yaml"
    words = ("--to", tmp_path / "lit.%04d.exr", "--quality", "final", "--frames-per-task", 1)
    assert run("job", project, "-o", target, *words).code == 0
    template = yaml.safe_load(target.read_text())
    decode_job_template(template=template)
    (step,) = template["steps"]
    (frames,) = step["parameterSpace"]["taskParameterDefinitions"]
    assert frames["range"] == ["1,3,7", "2,4", "5-6"]
    defaults = {p["name"]: p.get("default") for p in template["parameterDefinitions"]}
    assert defaults["Input"] == "walk.pclx"
    assert defaults["Output"] == "lit.%04d.exr"
    (tmp_path / "elsewhere").mkdir()
    told = run("job", project, "-o", tmp_path / "elsewhere" / "job.yaml", *words)
    assert f"-p Input={project} -p Output={tmp_path}/lit.%04d.exr" in told.err
    assert "--quality=final" in step["script"]["actions"]["onRun"]["args"]


def test_jobs_that_cannot_be_are_told(run: Run, tmp_path: Path, ball_png: Path) -> None:
    project, target = walk(tmp_path, [1]), tmp_path / "job.yaml"
    assert run("job", project, "-o", tmp_path / "job.txt").code == 1
    assert run("job", tmp_path / "none.pclx", "-o", target).code == 1
    assert run("job", ball_png, "-o", target).code == 1  # no number
    assert run("job", project, "-o", target, "--frames", "5").code == 1
    assert not target.exists()


@pytest.mark.cycles
def test_openjd_runs_the_job(run: Run, tmp_path: Path) -> None:
    project, target, out = walk(tmp_path, [1, 2, 1, 9]), tmp_path / "job.yaml", tmp_path / "lit"
    blank = png(np.zeros((8, 8, 4), np.uint8))
    xml = document(
        [layer(2, "b", [image(1, "1.png", -40, -40), image(3, "blank.png"),
                        image(4, "1.png", -40, -40)])],
        size=(96, 96),
    )  # fmt: skip
    project.unlink()
    write_project(project, xml, {"1.png": png(draw_ball(80)), "blank.png": blank})
    assert run("job", project, "-o", target, "--frames-per-task", 1).code == 0
    done = subprocess.run(
        [BIN / "openjd", "run", target, "--step", "Light", "-p", f"Lampblack={BIN}/lampblack"],
        capture_output=True, text=True, timeout=240, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stdout[-2000:] + done.stderr[-2000:]
    assert files(out) == {f"walk.{n:04d}.png" for n in range(1, 5)}
    pictures = [load_picture(out / f"walk.000{n}.png") for n in range(1, 5)]
    assert np.array_equal(pictures[0], pictures[3])
    assert not pictures[2].any()


@pytest.mark.parametrize(
    "address", ["tcp://scheduler:8786", "tcp://10.0.0.7:1", "scheduler:8786", "ws://a:1", ""]
)
def test_clusters_without_tls_are_refused(address: str) -> None:
    with pytest.raises(LampblackError, match="TLS"):
        check_address(address)


@pytest.mark.parametrize("address", ["tls://scheduler:8786", "tcp://127.0.0.1:1", "tcp://[::1]:1"])
def test_clusters_over_tls_or_on_this_machine_are_not(address: str) -> None:
    check_address(address)


@pytest.fixture
def certificate(tmp_path: Path) -> tuple[Path, Path]:
    """Our own authority: certificate and key."""
    if shutil.which("openssl") is None:
        pytest.skip("openssl is not installed")
    pem, key = tmp_path / "ca.pem", tmp_path / "ca.key"
    subprocess.run(
        ["openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-days", "2",
         "-subj", "/CN=lampblack", "-keyout", key, "-out", pem],
        check=True, capture_output=True,
    )  # fmt: skip
    return pem, key


@pytest.fixture
def cluster(
    tmp_path: Path, certificate: tuple[Path, Path]
) -> Iterator[tuple[str, list[subprocess.Popen[bytes]]]]:
    """A scheduler's address, and two workers, each a process of one thread."""
    pem, key = certificate
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        address = f"tls://127.0.0.1:{free.getsockname()[1]}"
    tls = ["--tls-ca-file", pem, "--tls-cert", pem, "--tls-key", key]
    dask, log = [sys.executable, "-m", "dask"], (tmp_path / "cluster.log").open("wb")
    quiet = {"stdout": log, "stderr": log, "env": {**os.environ, "OMP_NUM_THREADS": "1"}}
    commands = [[*dask, "scheduler", "--host", address, "--no-dashboard", *tls]]
    worker = [*dask, "worker", address, "--nthreads", "1", "--no-nanny", "--no-dashboard"]
    commands += [[*worker, "--local-directory", tmp_path / f"worker{n}", *tls] for n in (1, 2)]
    processes = [subprocess.Popen(command, **quiet) for command in commands]  # type: ignore[call-overload]
    yield address, processes[1:]
    for process in processes:
        process.kill()
        process.wait()
    log.close()


@pytest.mark.cycles
def test_a_worker_that_dies_loses_no_frame(
    tmp_path: Path,
    cluster: tuple[str, list[subprocess.Popen[bytes]]],
    certificate: tuple[Path, Path],
) -> None:
    address, workers = cluster
    project, out = walk(tmp_path, [n % 12 for n in range(24)]), tmp_path / "lit"
    pem, key = certificate
    command = [
        sys.executable, "-m", "lampblack", "render", project, "-o", out, "--cluster", address,
        "--tls-ca", pem, "--tls-cert", pem, "--tls-key", key,
    ]  # fmt: skip
    process = subprocess.Popen(command, stderr=subprocess.PIPE)
    deadline = time.monotonic() + 200
    while len(list(out.glob("walk.*.png"))) < 3 and time.monotonic() < deadline:
        assert process.poll() is None, (process.stderr or sys.stderr).read()
        time.sleep(0.05)
    os.kill(workers[0].pid, signal.SIGKILL)
    _, told = process.communicate(timeout=240)
    assert process.returncode == 0, told
    assert files(out) == {f"walk.{n:04d}.png" for n in range(1, 25)}
    pictures = [load_picture(out / f"walk.{n:04d}.png") for n in range(1, 25)]
    assert all(np.array_equal(pictures[n], pictures[n + 12]) for n in range(12))


def test_a_worker_notices_drawings_that_change_between_two_runs(
    tmp_path: Path, unrendered: list[str]
) -> None:
    save_picture(tmp_path / "a.0001.png", draw_ball(64))
    settings = RenderSettings(inputs=(str(tmp_path / "a.0001.png"),), output=str(tmp_path / "lit"))
    settings_json = msgspec.json.encode(settings)
    assert light_group(settings_json, "first", ["a.0001.png"]) == [("a.0001.png", "done", [])]
    assert light_group(settings_json, "first", ["a.0001.png"]) == [("a.0001.png", "kept", [])]
    save_picture(tmp_path / "a.0001.png", draw_ball(64, (60, 120, 220)))
    assert light_group(settings_json, "second", ["a.0001.png"]) == [("a.0001.png", "done", [])]
    (tmp_path / "a.0001.png").write_text("no picture")
    ((_, became, words),) = light_group(settings_json, "third", ["a.0001.png"])
    assert became == "failed"
    assert "not a PNG" in words[0]


def test_a_cluster_that_is_not_there_is_told(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("lampblack.farm.cluster.CONNECT_SECONDS", 0.5)
    save_picture(tmp_path / "a.0001.png", draw_ball(64))
    words = ("--cluster", "tcp://127.0.0.1:9")
    told = run("render", tmp_path / "a.0001.png", "-o", tmp_path / "lit", *words)
    assert told.code == 1
    assert "no cluster" in told.err
