"""A real Pencil2D with the plugin, in a virtual display of its own, driven as an artist would.

Mouse and keys go through the X server (xdotool); where things stand is told by the probe plugin of
``tests/plugin/probe``; pictures are screenshots.
"""

from __future__ import annotations

import json
import os
import shutil
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import closing, contextmanager, suppress
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from support.paths import BUILD

PLUGINS = BUILD / "plugins"
WINDOW = (1430, 960)
PROGRAMS = ("pencil2d", "Xvfb", "openbox", "xdotool", "import")


def missing() -> str:
    """What the machine lacks to run these tests; empty if nothing."""
    lacking = [name for name in PROGRAMS if shutil.which(name) is None]
    plugins = PLUGINS / "generic"
    built = (
        plugins / "liblampblack.so",
        plugins / "liblampblackprobe.so",
        BUILD / "lampblack-window",
    )
    lacking += [str(path) for path in built if not path.exists()]
    return ", ".join(lacking)


def patience() -> float:
    """By what LAMPBLACK_PATIENCE multiplies every time limit, on a machine that is busy."""
    return float(os.environ.get("LAMPBLACK_PATIENCE", "1"))


def wait_until(happened: Callable[[], Any], what: str, seconds: float = 60.0) -> Any:
    """Return the first true answer; fail after ``seconds``, naming what was waited for."""
    seconds *= patience()
    deadline = time.monotonic() + seconds
    while time.monotonic() < deadline:
        answer = happened()
        if answer:
            return answer
        time.sleep(0.05)
    raise AssertionError(f"waited {seconds:.0f} s in vain for {what}")


class Display:
    """A virtual X display with a window manager."""

    def __init__(self, folder: Path, size: tuple[int, int] = (2900, 1960)) -> None:
        self._log = (folder / "display.log").open("ab")
        read, write = os.pipe()
        self._server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(write), "-screen", "0", f"{size[0]}x{size[1]}x24",
             "-nolisten", "tcp", "-noreset"],
            pass_fds=[write], stdout=self._log, stderr=self._log,
        )  # fmt: skip
        os.close(write)
        with os.fdopen(read) as number:
            self.name = ":" + number.readline().strip()
        self.environment = {**os.environ, "DISPLAY": self.name}
        self._manager = subprocess.Popen(
            ["openbox"], env=self.environment, stdout=self._log, stderr=self._log
        )

    def close(self) -> None:
        for process in (self._manager, self._server):
            process.terminate()
            process.wait(10)
        self._log.close()

    def do(self, *arguments: object) -> str:
        """``xdotool ARGUMENTS``"""
        ran = subprocess.run(
            ["xdotool", *map(str, arguments)],
            env=self.environment, check=True, capture_output=True, text=True, timeout=30,
        )  # fmt: skip
        return ran.stdout

    def screenshot(self, left: int, top: int, width: int, height: int) -> NDArray[np.uint8]:
        """(H, W, 3) uint8, sRGB: that part of the screen."""
        part = ["-crop", f"{width}x{height}+{left}+{top}", "-depth", "8", "rgb:-"]
        ran = subprocess.run(
            ["import", "-silent", "-window", "root", *part],
            env=self.environment, check=True, capture_output=True, timeout=30,
        )  # fmt: skip
        return np.frombuffer(ran.stdout, np.uint8).reshape(height, width, 3)


class Program:
    """A running program with a canvas that the lamp lights. Coordinates are the screen's."""

    canvas = ""
    """Class of the canvas widget."""

    def __init__(
        self,
        display: Display,
        folder: Path,
        command: list[str],
        *,
        plugins: str = "lampblackprobe",
        python: str = sys.executable,
        scale: float = 1.0,
    ) -> None:
        home, temporary = folder / "home", folder / "tmp"
        for each in (home, temporary):
            each.mkdir(parents=True, exist_ok=True)
        self.display, self._scale, self._killed = display, scale, False
        self._name = Path(command[0]).name
        self._socket_name = str(folder / "probe")
        with suppress(FileNotFoundError):
            Path(self._socket_name).unlink()
        environment = {
            **os.environ,
            "DISPLAY": display.name,
            "HOME": str(home),
            "TMPDIR": str(temporary),
            "XDG_RUNTIME_DIR": str(temporary),
            "XDG_CONFIG_HOME": str(home / ".config"),
            "LC_ALL": "C.UTF-8",
            "QT_PLUGIN_PATH": str(PLUGINS),
            "QT_QPA_GENERIC_PLUGINS": plugins,
            "QT_SCALE_FACTOR": str(scale),
            "LAMPBLACK_PROBE": self._socket_name,
            "LAMPBLACK_PYTHON": python,
            "OMP_NUM_THREADS": os.environ.get("OMP_NUM_THREADS", "2"),
        }
        temporary.chmod(0o700)
        self.log = folder / f"{self._name}.log"
        self._output = self.log.open("ab")
        self.process = subprocess.Popen(
            command, env=environment, stdout=self._output, stderr=self._output, cwd=folder
        )
        self._probe = self._connect()
        wait_until(lambda: self.of_class(self.canvas), "the canvas")

    def take_window(self, title: str) -> None:
        """Find the main window, and put it where screenshots are made."""
        self.window = wait_until(lambda: self._main_window(title), f"the window of {title}")
        self.display.do(
            "windowsize", "--sync", self.window, *(round(n * self._scale) for n in WINDOW)
        )
        self.display.do("windowmove", "--sync", self.window, 2, 20)
        self.display.do("windowactivate", "--sync", self.window)

    def kill(self) -> None:
        """End it as a crash would."""
        self.process.kill()
        self.process.wait(10)
        self._killed = True

    def close(self) -> None:
        """End it without a question, if it is still there, and see that it had not died."""
        died = None if self._killed else self.process.poll()
        self._lines.close()
        self._probe.close()
        if died is None:
            self.process.kill()
            self.process.wait(10)
        self._output.close()
        assert not died, f"{self._name} ended with {died}:\n{self.log.read_text()[-3000:]}"

    def find(self, name: str) -> dict[str, Any]:
        """What the probe says of the object called ``name``; empty if there is none."""
        return self._ask({"do": "find", "name": name})

    def value(self, name: str, property_name: str) -> Any:
        return self.find(name).get("properties", {}).get(property_name)

    def of_class(self, name: str) -> dict[str, Any]:
        return self._ask({"do": "class", "name": name})

    def names(self, prefix: str) -> dict[str, bool]:
        return self._ask({"do": "names", "name": prefix})

    def entries(self, menu: str) -> dict[str, tuple[int, int, int, int]]:
        """Left, top, width, height of each entry of an open menu."""
        return {
            text: tuple(place) for text, place in self._ask({"do": "entries", "name": menu}).items()
        }

    def trigger(self, action: str) -> None:
        assert self._ask({"do": "trigger", "name": action})["done"], action

    def set(self, name: str, property_name: str, value: Any) -> None:
        asked = {"do": "set", "name": name, "property": property_name, "value": value}
        assert self._ask(asked)["done"], (name, property_name)

    def stalls(self) -> dict[str, Any]:
        """Histogram of the event loop's turns since the last call."""
        return self._ask({"do": "stalls"})

    def watch(self, colours: list[str]) -> list[tuple[float, float]]:
        """Watch the canvas for pixels of exactly these colours from now on; none: no longer.

        Returns:
            of the watch before: the milliseconds since its start and the share of the canvas's
            pixels, whenever that changed.
        """
        asked = {"do": "watch", "name": self.canvas, "colours": colours}
        return [(at, share) for at, share in self._ask(asked)["taken"]]

    def latency(self, name: str) -> list[float]:
        """Milliseconds from mouse moves to lit pixels since the last call."""
        return list(self._ask({"do": "latency", "name": name})["milliseconds"])

    def rect(self, name: str) -> tuple[int, int, int, int]:
        """Left, top, width, height of a visible widget, by object name or class."""
        said = self.find(name) or self.of_class(name)
        assert said.get("seen"), f"{name} is not in sight"
        left, top, width, height = (round(n * self._scale) for n in said["rect"])
        return left, top, width, height

    def screenshot(self) -> NDArray[np.uint8]:
        """(H, W, 3) uint8, sRGB: the screen as far as the window reaches."""
        width, height = (round(n * self._scale) + 30 for n in WINDOW)
        return self.display.screenshot(0, 0, width, height)

    def canvas_picture(self) -> NDArray[np.uint8]:
        return self.display.screenshot(*self.rect(self.canvas))

    def click(self, name: str, button: int = 1) -> None:
        """Click in the middle of a widget, once it stands still: docks are laid out late."""
        left, top, width, height = self.resting_rect(name)
        self.click_at(left + width // 2, top + height // 2, button)

    def resting_rect(self, name: str) -> tuple[int, int, int, int]:
        """As ``rect``, once the widget stands still."""

        def at_rest() -> tuple[int, int, int, int] | None:
            before = self.rect(name)
            time.sleep(0.2)
            return before if self.rect(name) == before else None

        place: tuple[int, int, int, int] = wait_until(at_rest, name, 10)
        return place

    def click_at(self, x: float, y: float, button: int = 1) -> None:
        self.display.do("mousemove", "--sync", round(x), round(y), "click", button)

    def drag(
        self, path: list[tuple[float, float]], button: int = 1, pause: float = 0.01
    ) -> Iterator[int]:
        """Press at the first point, move along, release at the last; yields at every move."""
        (x, y), *rest = path
        self.display.do("mousemove", "--sync", round(x), round(y), "mousedown", button)
        for index, (x, y) in enumerate(rest):
            self.display.do("mousemove", round(x), round(y), "sleep", pause)
            yield index
        self.display.do("mouseup", button)

    def key(self, *keys: str) -> None:
        self.display.do("key", *keys)

    def _main_window(self, title: str) -> str:
        # A window that comes or goes meanwhile makes the search fail: look again.
        with suppress(subprocess.CalledProcessError):
            ours = ("--all", "--pid", self.process.pid, "--onlyvisible", "--name", title)
            return self.display.do("search", *ours).split()[0]
        return ""

    def _connect(self) -> socket.socket:
        probe = socket.socket(socket.AF_UNIX)
        probe.settimeout(30)

        def reached() -> bool:
            assert self.process.poll() is None, self.log.read_text()[-3000:]
            with suppress(OSError):
                probe.connect(self._socket_name)
                return True
            return False

        wait_until(reached, "the probe in the program")
        self._lines = probe.makefile("rb")
        return probe

    def _ask(self, question: dict[str, Any]) -> dict[str, Any]:
        self._probe.sendall(json.dumps(question).encode() + b"\n")
        answer: dict[str, Any] = json.loads(self._lines.readline())
        assert "error" not in answer, answer
        return answer


class Pencil2D(Program):
    """A running Pencil2D."""

    canvas = "ScribbleArea"

    def __init__(
        self,
        display: Display,
        folder: Path,
        project: Path | None,
        *,
        plugin: bool = True,
        program: str = "pencil2d",
        python: str = sys.executable,
        scale: float = 1.0,
    ) -> None:
        super().__init__(
            display,
            folder,
            [program, *([str(project)] if project else [])],
            plugins="lampblack,lampblackprobe" if plugin else "lampblackprobe",
            python=python,
            scale=scale,
        )
        if plugin:  # until a test asks for it, another tool sees the plain drawing
            wait_until(lambda: self.find("lampblack.keep_light"), "the plugin")
            self.set("lampblack.keep_light", "checked", False)
        self.take_window(project.name if project else "Pencil2D")

    def open(self, project: Path) -> None:
        """Put the lamp away and open another project, as a file manager would ask for it."""
        self.trigger("actionSave")
        wait_until(
            lambda: not self.of_class("MainWindow2")["properties"]["windowModified"], "saving"
        )
        self.display.do("windowactivate", "--sync", self.window)
        self.click("pencilButton")
        self.ask_to_open(project)
        wait_until(lambda: self.value("lampblack", "project") == str(project), "the project")
        self.trigger("actionReset_View")  # Pencil2D 0.7 keeps the view of the project before

    def ask_to_open(self, project: Path) -> None:
        """As a file manager would; the lamp stays in use."""
        assert self._ask({"do": "open", "path": str(project)})["done"]


@contextmanager
def pencil2d(
    display: Display, folder: Path, project: Path | None, **options: Any
) -> Iterator[Pencil2D]:
    """A running Pencil2D for the length of a block."""
    with closing(Pencil2D(display, folder, project, **options)) as program:
        yield program


class SharedPencil2D:
    """One Pencil2D for many tests: started for the first, closed after a test that failed."""

    def __init__(self, display: Display, folder: Path) -> None:
        self._display, self._folder = display, folder
        self._program: Pencil2D | None = None
        self._started = 0

    def open(self, project: Path) -> Pencil2D:
        """The running Pencil2D with that project, the lamp not in use."""
        if self._program is None:
            # A folder of its own: Pencil2D offers to recover what a killed one left.
            folder = self._folder / str(self._started)
            self._started += 1
            self._program = Pencil2D(self._display, folder, project)
        else:
            self._program.open(project)
        return self._program

    def close(self) -> None:
        """End it; the next ``open`` starts another."""
        program, self._program = self._program, None
        if program is not None:
            program.close()
