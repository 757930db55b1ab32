"""Install, update or remove the worker in the user's data folder, for the plugin's panel.

    python3 install_worker.py plan|install|remove --from SOURCE --to FOLDER [--wheels FOLDER]

It needs the standard library only. On stdout it tells what happens, by ``say``, one JSON a line:

    plan      state (absent, half, other, installed), version, folder, download, disk (bytes)
    progress  what, done, total (bytes; total 0: not known)
    error     what, remedy, details
    done

SIGTERM, or the end of stdin with ``--with-parent``, cancels. What was downloaded is kept, and the
next ``install`` goes on from there. The worker that is there is replaced only by a whole one.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import threading
import venv
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NoReturn

MARKER = "complete.json"
"""In the environment, written last."""
SPARE_BYTES = 200 << 20
LEFT_OUT = "lib/python3*/site-packages/bpy/*/python/lib"
"""Blender's Python modules for USD and others, 80 MB that the worker never loads."""
PIP = "pip>=24.1"
"""The first that tells its progress."""


class Stopped(Exception):
    """The work cannot go on: what happened, what to do, and details to copy."""

    def __init__(self, what: str, remedy: str, details: str = "") -> None:
        super().__init__(what)
        self.what, self.remedy, self.details = what, remedy, details


def tell(say: str, **fields: Any) -> None:
    """Tell the panel."""
    sys.stdout.write(json.dumps({"say": say, **fields}) + "\n")
    sys.stdout.flush()


@dataclass(frozen=True)
class Source:
    """What is installed: the worker's wheel, and the locked packages for this Python."""

    folder: Path
    wheels: Path | None = None

    @property
    def wheel(self) -> Path:
        """The worker's wheel."""
        found = sorted(self.folder.glob("lampblack-*.whl"))
        if not found:
            raise Stopped(f"{self.folder} has no worker.", "Install Lampblack's package again.")
        return found[-1]

    @property
    def version(self) -> str:
        """The worker's version."""
        return self.wheel.name.split("-")[1]

    @property
    def lock(self) -> Path:
        """The locked packages."""
        name = "worker-python{}.{}.txt"
        path = self.folder / name.format(*sys.version_info[:2])
        if not path.is_file():
            have = sorted(re.findall(r"3\.\d+", " ".join(f.name for f in self.folder.iterdir())))
            here = "{}.{}".format(*sys.version_info[:2])
            raise Stopped(
                f"This system's Python is {here}; the renderer needs {' or '.join(have)}.",
                "Use Debian 12 or 13, or install one of these and try again.",
            )
        return path

    def packages(self) -> list[str]:
        """The lines of the lock, one package each with its hashes."""
        text = self.lock.read_text(encoding="utf-8").replace("\\\n", " ")
        return [line for line in text.splitlines() if line and not line.startswith("#")]

    def stated(self, what: str) -> int:
        """Bytes to ``download``, or ``installed``, as the lock says."""
        found = re.search(rf"^# bytes {what}: (\d+)$", self.lock.read_text(encoding="utf-8"), re.M)
        return int(found[1]) if found else 0


@dataclass(frozen=True)
class Target:
    """Where it is installed."""

    folder: Path

    @property
    def worker(self) -> Path:
        """The environment that the plugin uses."""
        return self.folder / "worker"

    @property
    def part(self) -> Path:
        """An environment that is being made."""
        return self.folder / "worker.part"

    @property
    def downloads(self) -> Path:
        """Wheels that were downloaded."""
        return self.folder / "downloads"

    def version(self) -> str:
        """The version of a whole environment; empty if there is none."""
        with contextlib.suppress(OSError, ValueError, KeyError, TypeError):
            marker = json.loads((self.worker / MARKER).read_text(encoding="utf-8"))
            if (self.worker / "bin" / "python").exists():
                return str(marker["version"])
        return ""

    def state(self, wanted: str) -> str:
        """``absent``, ``half`` done, of an ``other`` version, or ``installed``."""
        version = self.version()
        if version:
            return "installed" if version == wanted else "other"
        return "half" if self.worker.exists() or self.part.exists() else "absent"


def plan(source: Source, target: Target) -> None:
    """Tell what ``install`` would do."""
    source.packages()
    kept = sum(file.stat().st_size for file in _files(target.downloads))
    download = 0 if source.wheels else max(source.stated("to download") - kept, 0)
    tell(
        "plan",
        state=target.state(source.version),
        version=source.version,
        folder=str(target.folder),
        download=download,
        disk=source.stated("installed"),
    )


def install(source: Source, target: Target) -> None:
    """Make the environment, or finish it.

    Raises:
        Stopped: it cannot be made.
    """
    packages = source.packages()
    with _working(target.folder):
        _check_room(source, target)
        shutil.rmtree(target.part, ignore_errors=True)
        python = _make_environment(target.part)
        if source.wheels is None:
            _pip(python, ["install", "--upgrade", PIP])
            _download(python, source, packages, target.downloads)
        tell("progress", what="Installing", done=0, total=0)
        names = target.part / "packages.txt"
        names.write_text("\n".join(packages), encoding="utf-8")
        wheels = str(source.wheels or target.downloads)
        offline = ["install", "--no-index", "--no-deps", "--find-links", wheels]
        _pip(python, [*offline, "--require-hashes", "-r", str(names)])
        _pip(python, [*offline, str(source.wheel)])
        for folder in target.part.glob(LEFT_OUT):
            shutil.rmtree(folder)
        tell("progress", what="Checking", done=0, total=0)
        _run([str(python), "-I", "-m", "lampblack", "--version"])
        tell("progress", what="Trying a first picture", done=0, total=0)
        # It compiles what the artist would wait for at the first click. What is wrong is told then.
        with contextlib.suppress(Stopped):
            _run([str(python), "-I", "-m", "lampblack", "doctor"])
        marker = {"version": source.version, "python": sys.version.split()[0]}
        (target.part / MARKER).write_text(json.dumps(marker), encoding="utf-8")
        old = target.folder / "worker.old"
        shutil.rmtree(old, ignore_errors=True)
        if target.worker.exists():
            target.worker.rename(old)
        target.part.rename(target.worker)
        for done_with in (old, target.downloads):
            shutil.rmtree(done_with, ignore_errors=True)


def remove(target: Target) -> None:
    """Remove the environment and the worker's cache. Looks and rigs of the artist stay."""
    cache = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "lampblack"
    with _working(target.folder):
        for folder in (target.worker, target.part, target.downloads, cache):
            shutil.rmtree(folder, ignore_errors=True)
    with contextlib.suppress(OSError):
        target.folder.rmdir()


@contextlib.contextmanager
def _working(folder: Path) -> Iterator[None]:
    """A context that only one process is in, and that tells what the system refuses."""
    try:
        import fcntl

        folder.mkdir(parents=True, exist_ok=True)
        path = folder / "install.lock"
        with path.open("w") as lock:
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                raise Stopped(
                    "Another window is installing the renderer.", "Wait until it is done."
                ) from None
            try:
                yield
            finally:
                path.unlink()
    except OSError as error:
        raise _explained(error.strerror or "", str(error)) from error


def _files(folder: Path) -> list[Path]:
    return [path for path in folder.iterdir() if path.is_file()] if folder.is_dir() else []


def _check_room(source: Source, target: Target) -> None:
    download = 0 if source.wheels else source.stated("to download")
    needed = source.stated("installed") + download + SPARE_BYTES
    kept = sum(file.stat().st_size for file in _files(target.downloads))
    if shutil.disk_usage(target.folder).free + kept < needed:
        raise Stopped(
            f"{target.folder} has too little room.",
            f"Free {needed / 1e9:.1f} GB on that disk, then try again.",
        )


def _make_environment(folder: Path) -> Path:
    tell("progress", what="Preparing Python", done=0, total=0)
    try:
        venv.create(folder, with_pip=True)
    except subprocess.CalledProcessError as error:
        raise Stopped(
            "This system's Python cannot make environments.",
            "On Debian: apt-get install python3-venv. Then try again.",
            str(error.output or error),
        ) from error
    return folder / "bin" / "python"


def _download(python: Path, source: Source, packages: list[str], folder: Path) -> None:
    """Download each package that is not there. pip checks its hash."""
    folder.mkdir(exist_ok=True)
    total = source.stated("to download")
    for package in packages:
        name = package.split()[0]
        before = sum(file.stat().st_size for file in _files(folder))
        one = python.parents[1] / "package.txt"
        one.write_text(package, encoding="utf-8")

        def follow(line: str, name: str = name, before: int = before) -> None:
            found = re.match(r"Progress (\d+) of (\d+)", line)
            if found:
                tell("progress", what=name, done=before + int(found[1]), total=total)

        tell("progress", what=name, done=before, total=total)
        wanted = ["download", "--no-deps", "--only-binary", ":all:", "--require-hashes"]
        show = ["--progress-bar", "raw", "--no-cache-dir"]
        _pip(python, [*wanted, *show, "-r", str(one), "-d", str(folder)], follow)
        one.unlink()


def _pip(python: Path, words: list[str], follow: Any = None) -> None:
    _run(
        [str(python), "-I", "-m", "pip", "--disable-pip-version-check", "--no-input", *words],
        follow,
    )


_child: list[subprocess.Popen[str]] = []


def _run(command: list[str], follow: Any = None) -> None:
    """Run a program; its lines go to ``follow``.

    Raises:
        Stopped: it failed.
    """
    environment = {k: v for k, v in os.environ.items() if not k.startswith("PYTHON")}
    environment["LC_ALL"] = "C.UTF-8"
    with subprocess.Popen(
        command,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        stdin=subprocess.DEVNULL,
        text=True,
        errors="replace",
        env=environment,
        start_new_session=True,
    ) as child:
        _child[:] = [child]
        assert child.stdout is not None
        lines: list[str] = []
        for line in child.stdout:
            lines = [*lines[-40:], line.rstrip()]
            if follow:
                follow(line)
    _child.clear()
    if child.returncode:
        raise _explained("\n".join(lines), " ".join(command[3:]))


CASES = {
    r"No space left|Disk quota exceeded": (
        "The disk is full.",
        "Make room, then install again: it goes on from here.",
    ),
    r"Permission denied|Read-only file system": (
        "The folder cannot be written to.",
        "Give yourself the right to write there, then try again.",
    ),
    r"THESE PACKAGES DO NOT MATCH THE HASHES": (
        "A package is not the one that was tested, or is damaged.",
        "Install again. If that does not help, do not use that package, and report it.",
    ),
    r"--no-index.*(from versions|No matching distribution)": (
        "The folder of wheels lacks a package.",
        "Copy all wheels into it. The details name the one that is missing.",
    ),
    r"ProxyError|\b407\b": (
        "The proxy refused.",
        "Set https_proxy to your proxy's address, with name and password, and start again.",
    ),
    r"NewConnectionError|NameResolution|Temporary failure|Timeout|Network is unreachable|"
    r"Connection ?(reset|refused|aborted|broken)|SSLError|\(from versions: none\)": (
        "The package index cannot be reached.",
        "Connect to the internet, then install again: it goes on from here. "
        "Without internet, choose a folder with the wheels.",
    ),
}
"""What words of pip or of the system mean for a person, and what to do."""


def _explained(text: str, details: str) -> Stopped:
    """What ``text``, of pip or of the system, means for a person."""
    details = f"{details}\n{text}"[-3000:]
    for pattern, (what, remedy) in CASES.items():
        if re.search(pattern, details, re.IGNORECASE | re.DOTALL):
            return Stopped(what, remedy, details)
    return Stopped("The renderer could not be installed.", "Try again.", details)


def _cancel(*_: object) -> NoReturn:
    for child in _child:
        with contextlib.suppress(OSError):
            os.killpg(child.pid, signal.SIGKILL)
    os._exit(130)


def _end_with_parent() -> None:
    with contextlib.suppress(OSError, ValueError):
        while sys.stdin.buffer.raw.read(1024):  # type: ignore[attr-defined]
            pass
    _cancel()


def main() -> int:
    """Do what the command line says."""
    parser = argparse.ArgumentParser()
    parser.add_argument("what", choices=["plan", "install", "remove"])
    parser.add_argument("--from", dest="source", type=Path, required=True)
    parser.add_argument("--to", dest="target", type=Path, required=True)
    parser.add_argument("--wheels", type=Path)
    parser.add_argument("--with-parent", action="store_true")
    given = parser.parse_args()
    signal.signal(signal.SIGTERM, _cancel)
    if given.with_parent:
        threading.Thread(target=_end_with_parent, daemon=True).start()
    source, target = Source(given.source, given.wheels), Target(given.target.absolute())
    try:
        if given.what == "remove":
            remove(target)
        elif given.what == "plan":
            plan(source, target)
        else:
            install(source, target)
    except Stopped as error:
        tell("error", what=error.what, remedy=error.remedy, details=error.details)
        return 1
    tell("done")
    return 0


if __name__ == "__main__":
    sys.exit(main())
