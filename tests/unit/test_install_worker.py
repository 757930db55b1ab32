"""The installer of the worker, from a folder with two wheels that are quickly made."""

from __future__ import annotations

import base64
import hashlib
import importlib.util
import json
import os
import signal
import subprocess
import sys
import time
import zipfile
from collections.abc import Sequence
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

from support.paths import ROOT

SCRIPT = ROOT / "packaging" / "install_worker.py"
HERE = "{}.{}".format(*sys.version_info[:2])
SICK = """
import needed, pathlib, sys
if "doctor" in sys.argv:
    pathlib.Path(__file__).with_name("tried").touch()
    sys.exit("There is no light.")
"""
BLENDER, UNUSED = "bpy/5.2/scripts/a.py", "bpy/5.2/python/lib/python3.13/site-packages/pxr/a.py"


def wheel(folder: Path, name: str, version: str, code: str, *more: str) -> Path:
    """A wheel of one package that runs ``code`` as a program, with ``more`` empty files."""
    path = folder / f"{name}-{version}-py3-none-any.whl"
    info = f"{name}-{version}.dist-info"
    files = {
        f"{name}/__init__.py": "",
        f"{name}/__main__.py": code,
        f"{info}/METADATA": f"Metadata-Version: 2.1\nName: {name}\nVersion: {version}\n",
        f"{info}/WHEEL": "Wheel-Version: 1.0\nRoot-Is-Purelib: true\nTag: py3-none-any\n",
        **dict.fromkeys(more, ""),
    }
    record = f"{info}/RECORD,,\n"
    for file, text in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(text.encode()).digest()).rstrip(b"=")
        record += f"{file},sha256={digest.decode()},{len(text)}\n"
    with zipfile.ZipFile(path, "w") as archive:
        for file, text in (files | {f"{info}/RECORD": record}).items():
            archive.writestr(file, text)
    return path


def source(folder: Path, version: str = "9.0") -> tuple[Path, Path]:
    """A folder to install from, and one with the wheel that the worker needs."""
    shipped, wheels = folder / f"share {version}", folder / "lampblack-wheels"
    shipped.mkdir()
    wheels.mkdir(exist_ok=True)
    wheel(shipped, "lampblack", version, SICK)
    needed = wheel(wheels, "needed", "1.0", "", BLENDER, UNUSED)
    digest = hashlib.sha256(needed.read_bytes()).hexdigest()
    sizes = "# bytes to download: 500\n# bytes installed: 1000\n"
    lock = f"{sizes}needed==1.0 \\\n  --hash=sha256:{digest}\n"
    (shipped / f"worker-python{HERE}.txt").write_text(lock)
    return shipped, wheels


def command(what: str, shipped: Path, target: Path, *words: object) -> list[str]:
    return [
        *(sys.executable, "-I", str(SCRIPT), what, "--from", str(shipped), "--to", str(target)),
        *map(str, words),
    ]


def call(
    what: str, shipped: Path, target: Path, *words: object, **environment: str
) -> tuple[int, list[dict[str, Any]]]:
    clean = {name: value for name, value in os.environ.items() if not name.startswith("PIP_")}
    done = subprocess.run(
        command(what, shipped, target, *words),
        capture_output=True,
        text=True,
        env=clean | {"PIP_CONFIG_FILE": os.devnull} | environment,
    )
    assert "Traceback" not in done.stderr
    return done.returncode, [json.loads(line) for line in done.stdout.splitlines()]


def said(told: Sequence[dict[str, Any]], say: str) -> dict[str, Any]:
    return next(line for line in reversed(told) if line["say"] == say)


def state(shipped: Path, target: Path) -> str:
    return str(said(call("plan", shipped, target)[1], "plan")["state"])


def test_the_plan_tells_what_is_downloaded_and_what_stays_on_disk(tmp_path: Path) -> None:
    shipped, _ = source(tmp_path)
    plan = said(call("plan", shipped, tmp_path / "home")[1], "plan")
    assert (plan["download"], plan["disk"]) == (500, 1000)


def test_it_installs_updates_and_removes_in_a_folder_with_a_strange_name(tmp_path: Path) -> None:
    shipped, wheels = source(tmp_path)
    target = tmp_path / "Möwe & Söhne's home" / "lampblack"
    assert state(shipped, target) == "absent"
    code, told = call("install", shipped, target, "--wheels", wheels)
    assert (code, told[-1]["say"]) == (0, "done"), told
    assert state(shipped, target) == "installed"
    python = target / "worker" / "bin" / "python"
    assert subprocess.run([python, "-I", "-m", "lampblack"]).returncode == 0
    assert sorted(path.name for path in target.iterdir()) == ["worker"]
    (packages,) = (target / "worker").glob("lib/python*/site-packages")
    assert (packages / BLENDER).exists()
    assert (packages / "lampblack" / "tried").exists()  # what is wrong is told at the first light
    assert not (packages / Path(UNUSED).parents[3]).exists()

    newer, _ = source(tmp_path, "9.1")
    assert state(newer, target) == "other"
    (wheels / "needed-1.0-py3-none-any.whl").rename(tmp_path / "away.whl")
    code, told = call("install", newer, target, "--wheels", wheels)
    assert code == 1
    assert said(told, "error")["what"] == "The folder of wheels lacks a package."
    assert "needed==1.0" in said(told, "error")["details"]
    assert state(shipped, target) == "installed"  # the old one still works
    (tmp_path / "away.whl").rename(wheels / "needed-1.0-py3-none-any.whl")
    assert call("install", newer, target, "--wheels", wheels)[0] == 0
    assert state(newer, target) == "installed"

    (target / "worker" / "complete.json").unlink()
    assert state(newer, target) == "half"
    cache = tmp_path / "cache"
    (cache / "lampblack").mkdir(parents=True)
    assert call("remove", newer, target, XDG_CACHE_HOME=str(cache))[0] == 0
    assert not target.exists()
    assert not list(cache.iterdir())


def test_a_package_that_is_another_one_is_refused(tmp_path: Path) -> None:
    shipped, wheels = source(tmp_path)
    wheel(wheels, "needed", "1.0", "print('other')")
    code, told = call("install", shipped, tmp_path / "home", "--wheels", wheels)
    assert code == 1
    assert said(told, "error")["what"].startswith("A package is not the one that was tested")
    assert state(shipped, tmp_path / "home") == "half"


def test_without_a_network_it_says_so_and_goes_on_later(tmp_path: Path) -> None:
    shipped, wheels = source(tmp_path)
    nowhere = {"PIP_INDEX_URL": "http://127.0.0.1:9/simple", "PIP_RETRIES": "0"}
    code, told = call("install", shipped, tmp_path / "home", **nowhere)
    assert code == 1
    assert said(told, "error")["what"] == "The package index cannot be reached."
    assert call("install", shipped, tmp_path / "home", "--wheels", wheels)[0] == 0


@pytest.mark.parametrize("way", ["signal", "parent"])
def test_it_is_cancelled_at_once_and_leaves_the_next_a_free_way(tmp_path: Path, way: str) -> None:
    shipped, wheels = source(tmp_path)
    words = command("install", shipped, tmp_path / "home", "--wheels", wheels, "--with-parent")
    with subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as installer:
        assert installer.stdout is not None
        assert installer.stdin is not None
        installer.stdout.readline()
        time.sleep(0.3)
        if way == "signal":
            installer.send_signal(signal.SIGTERM)
        else:
            installer.stdin.close()
        assert installer.wait(10) == 130
    assert state(shipped, tmp_path / "home") in ("half", "absent")


@pytest.fixture(scope="module")
def installer() -> ModuleType:
    spec = importlib.util.spec_from_file_location("install_worker", SCRIPT)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules["install_worker"] = module
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize(
    ("words", "what"),
    [
        ("OSError: [Errno 28] No space left on device", "The disk is full."),
        ("ProxyError('Cannot connect to proxy.', OSError('407'))", "The proxy refused."),
        ("Temporary failure in name resolution", "The package index cannot be reached."),
        ("[Errno 13] Permission denied: '/srv'", "The folder cannot be written to."),
        ("something else", "The renderer could not be installed."),
    ],
)
def test_each_fault_has_its_words(installer: ModuleType, words: str, what: str) -> None:
    error = installer._explained(f"ERROR: {words}", "pip download")
    assert error.what == what
    assert error.remedy
    assert words in error.details


def test_too_little_room_is_told_before_anything_is_done(
    installer: ModuleType, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    shipped, _ = source(tmp_path)
    usage = installer.shutil.disk_usage(tmp_path)._replace(free=10_000)
    monkeypatch.setattr(installer.shutil, "disk_usage", lambda folder: usage)
    with pytest.raises(installer.Stopped, match="too little room"):
        installer.install(installer.Source(shipped), installer.Target(tmp_path / "home"))
    assert not list((tmp_path / "home").iterdir())


def test_another_python_is_told_by_name(installer: ModuleType, tmp_path: Path) -> None:
    shipped, _ = source(tmp_path)
    (shipped / f"worker-python{HERE}.txt").rename(shipped / "worker-python3.13.9.txt")
    with pytest.raises(installer.Stopped, match=f"Python is {HERE}; the renderer needs 3.13"):
        installer.plan(installer.Source(shipped), installer.Target(tmp_path / "home"))


@pytest.mark.parametrize("lock", sorted((ROOT / "packaging").glob("worker-python*.txt")))
def test_the_worker_installs_what_was_tested(lock: Path) -> None:
    python = lock.stem.removeprefix("worker-")
    tested = (ROOT / "requirements" / f"{python}.txt").read_text()
    packages = [line for line in lock.read_text().splitlines() if "==" in line]
    assert packages
    assert [line for line in packages if f"\n{line.split()[0]} " not in f"\n{tested}"] == []
    assert not any(line.startswith(("torch", "nvidia")) for line in packages)
