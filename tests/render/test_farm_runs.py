"""Jobs and clusters in earnest: every frame made, losses survived."""

from __future__ import annotations

import json
import os
import shutil
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from lampblack.drawing import load_picture, save_picture
from lampblack.scene import default_scene, encode_scene
from support.command_line import Run, files
from support.drawings import draw_ball
from support.projects import document, image, layer, png, walk, write_project

BIN = Path(sys.executable).parent


@pytest.mark.skipif(not (BIN / "openjd").exists(), reason="openjd-cli is not installed")
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


@pytest.mark.skipif(not (BIN / "openjd").exists(), reason="openjd-cli is not installed")
def test_openjd_maps_the_paths_of_a_job(run: Run, tmp_path: Path) -> None:
    """Machines of a farm have the shot in another folder than the artist."""
    artist, farm = tmp_path / "artist", tmp_path / "mounted" / "shot 7"
    (artist / "drawn").mkdir(parents=True)
    for number in (1, 2):
        save_picture(artist / "drawn" / f"w.{number:04d}.png", draw_ball(64 - 8 * number))
    (artist / "light.json").write_bytes(encode_scene(default_scene(64, 64)))
    target = tmp_path / "job.yaml"
    words = ("--scene", artist / "light.json", "--to", artist / "lit" / "w.%04d.png")
    assert run("job", artist / "drawn" / "w.%04d.png", "-o", target, *words).code == 0
    farm.parent.mkdir()
    artist.rename(farm)
    rule = {
        "source_path_format": "POSIX",
        "source_path": str(artist),
        "destination_path": str(farm),
    }
    rules = tmp_path / "rules.json"
    rules.write_text(json.dumps({"version": "pathmapping-1.0", "path_mapping_rules": [rule]}))
    done = subprocess.run(
        [BIN / "openjd", "run", target, "--step", "Light", "-p", f"Lampblack={BIN}/lampblack",
         "--path-mapping-rules", f"file://{rules}"],
        capture_output=True, text=True, timeout=240, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stdout[-2000:] + done.stderr[-2000:]
    assert files(farm / "lit") == {"w.0001.png", "w.0002.png"}
    assert load_picture(farm / "lit" / "w.0001.png").any()
    assert not artist.exists()


@pytest.fixture
def certificate(tmp_path: Path) -> tuple[Path, Path]:
    """Our own authority: certificate and key."""
    if shutil.which("openssl") is None:
        pytest.skip("openssl is not installed")
    return certificate_of(tmp_path)


def certificate_of(folder: Path) -> tuple[Path, Path]:
    pem, key = folder / "ca.pem", folder / "ca.key"
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


def test_strangers_are_kept_out_of_a_cluster(
    tmp_path: Path,
    cluster: tuple[str, list[subprocess.Popen[bytes]]],
    certificate: tuple[Path, Path],
    monkeypatch: pytest.MonkeyPatch,
    run: Run,
) -> None:
    monkeypatch.setattr("lampblack.farm.cluster.CONNECT_SECONDS", 3)
    address, _ = cluster
    ours, own_key = certificate
    (tmp_path / "stranger").mkdir()
    theirs, key = certificate_of(tmp_path / "stranger")
    project = walk(tmp_path, [1])
    own = ("--tls-cert", ours, "--tls-key", own_key)
    for wrong in (
        ("--tls-ca", ours, "--tls-cert", theirs, "--tls-key", key),  # not known to the cluster
        ("--tls-ca", theirs, *own),  # a scheduler that only says it is ours
        ("--tls-ca", ours, "--tls-cert", ours, "--tls-key", key),  # a key of another certificate
        ("--tls-ca", ours),
        ("--tls-ca", tmp_path / "none.pem", *own),
    ):
        refused = run("render", project, "-o", tmp_path / "lit", "--cluster", address, *wrong)
        assert refused.code == 1
        assert "There is no cluster" in refused.err
        assert not list(tmp_path.glob("lit/*.png"))
