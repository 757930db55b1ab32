"""A downloaded project may carry code: none is run, though commands are started in its folder."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
import trimesh

from lampblack.render.client import RenderChild
from lampblack.service.client import Worker

LAMPBLACK = Path(sys.executable).with_name("lampblack")
MODULES = ("lampblack", "numpy", "msgspec", "bpy", "multiprocessing", "pickle")


class Trap:
    """The current folder: modules under the names of others', which write down that they ran."""

    def __init__(self, folder: Path) -> None:
        self.log = folder / "ran.txt"
        for name in MODULES:
            (folder / f"{name}.py").write_text(f"open({str(self.log)!r}, 'a').write('{name} ')")

    def sprung(self) -> str:
        return self.log.read_text() if self.log.exists() else ""


@pytest.fixture
def trap(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Trap:
    folder = tmp_path / "downloaded"
    folder.mkdir()
    monkeypatch.chdir(folder)
    return Trap(folder)


def test_the_trap_works(trap: Trap) -> None:
    subprocess.run([sys.executable, "-m", "lampblack"], check=True)
    assert trap.sprung() == "lampblack "


def test_the_worker_runs_none(trap: Trap, tmp_path: Path) -> None:
    with Worker(tmp_path) as worker, worker.connect() as client:
        client.hello()
        assert _folder_of(worker.process.pid) != Path.cwd()
    assert trap.sprung() == ""


def test_the_renderer_is_started_elsewhere(trap: Trap) -> None:
    with RenderChild() as child:
        assert child.pid is not None
        assert _folder_of(child.pid) != Path.cwd()


def test_the_command_runs_none_and_finds_files_by_relative_names(
    trap: Trap, ball_png: Path
) -> None:
    ball_png.rename("ball.png")
    command = [LAMPBLACK, "render", "ball.png", "-o", "lit", "--quality", "low"]
    subprocess.run(command, check=True)
    assert Path("lit/ball.png").exists()
    assert trap.sprung() == ""


def test_processes_that_share_the_work_run_none(trap: Trap) -> None:
    models = Path("models")
    models.mkdir()
    trimesh.creation.icosphere().export(models / "ball.ply")
    command = [LAMPBLACK, "dataset", "build", "--models", models, "-o", "data", "--views", "2"]
    subprocess.run([*command, "--resolution", "64", "--freestyle", "0"], check=True)
    assert len(list(Path("data").rglob("*.npz"))) == 2
    assert trap.sprung() == ""


def test_compiled_code_is_not_taken_from_the_current_folder(trap: Trap) -> None:
    Path(".numba_config.yaml").write_text("cache_dir: kernels\ncache_locator_classes: evil.Evil\n")
    use = "import lampblack.composite.byte_kernel"
    subprocess.run([sys.executable, "-I", "-c", use], check=True)
    assert not Path("kernels").exists()


def _folder_of(pid: int) -> Path:
    """The current folder of a process."""
    return Path(f"/proc/{pid}/cwd").readlink()
