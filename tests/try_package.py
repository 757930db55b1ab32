"""The .deb as a user has it, from ``dpkg -i`` until nothing of it is left:

    python tests/try_package.py dist/pencil2d-lampblack_*.deb [lampblack-wheels]     (as root)

The lamp is chosen at a first start, its panel installs the renderer (from a folder of wheels, or
from the package index), a light is dragged in Pencil2D and in ``lampblack-window``, and renderer
and package are removed.
Screenshots go to ``build/screenshots``.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import tempfile
from contextlib import closing
from pathlib import Path

from lampblack.drawing import save_picture
from support.drawings import draw_ball
from support.lamp import Canvas, brightness_of_sides, drag_light, keep, project_in, settled
from support.own_window import OwnWindow
from support.registration import luminance
from support.window import Display, Pencil2D, missing, pencil2d, wait_until

PACKAGE = "pencil2d-lampblack"
OWN_WINDOW = Path("/usr/bin/lampblack-window")
CARD = "lampblack.panel.install"
SYSTEM = ("/etc", "/opt", "/usr", "/var")
ITS_OWN = (
    "/usr/lib/python3",
    "/var/cache/",
    "/var/lib/apt/",
    "/var/lib/dpkg/",
    "/var/lib/lampblack-build/",
    "/var/log/",
)
"""Where the package manager, Python and this test write for themselves."""


def system_files() -> set[str]:
    found = {
        os.path.join(folder, name)  # noqa: PTH118  # a hundred thousand of them
        for start in SYSTEM
        for folder, _, names in os.walk(start)
        for name in names
    }
    return {path for path in found if not path.startswith(ITS_OWN)}


def install_renderer(window: Pencil2D, wheels: Path | None) -> None:
    """By the panel's card, as the first start shows it."""
    wait_until(lambda: window.find(CARD).get("seen"), "the offer to install")
    keep(window, "package offer")
    if wheels is None:
        window.click(f"{CARD}.install")
    else:
        window.click(f"{CARD}.folder")
        wait_until(lambda: window.of_class("QFileDialog").get("seen"), "the folder dialog")
        window.set("fileNameEdit", "text", str(wheels))
        window.key("Return")
    wait_until(lambda: window.find(f"{CARD}.bar").get("seen"), "the installation")
    keep(window, "package installing")

    def ended() -> bool:
        return not window.find(f"{CARD}.cancel").get("seen")

    wait_until(ended, "the end of the installation", 1800)
    left = window.find(CARD).get("seen")
    assert not left, [window.value(f"{CARD}.{name}", "text") for name in ("what", "how")]


def light(window: Pencil2D) -> None:
    settled(window)
    assert window.value("lampblack.overlay", "showsPicture")
    canvas = Canvas(window)
    drag_light(window, canvas, (40, 300))
    left_before, right_before = brightness_of_sides(canvas)
    drag_light(window, canvas, (600, 300))
    left_after, right_after = brightness_of_sides(canvas)
    keep(window, "package lit")
    assert right_after > right_before + 0.03
    assert left_after < left_before - 0.03


def light_in_own_window(window: OwnWindow) -> None:
    def right() -> float:
        return float(luminance(window.crop(160, 105, 20, 30)).mean())

    window.drag_light(20, 110)
    before = right()
    window.drag_light(220, 110)
    keep(window, "package own window")
    assert right() > before + 0.03


def try_package(package: Path, wheels: Path | None, folder: Path) -> None:
    told = ["dpkg-deb", "--field", package, "Depends"]
    depends = subprocess.run(told, check=True, capture_output=True, text=True).stdout
    satisfy = ["apt-get", "satisfy", "--yes", "--no-install-recommends", depends.strip()]
    subprocess.run(satisfy, check=True)
    before = system_files()
    subprocess.run(["dpkg", "-i", package], check=True)
    display = Display(folder)
    try:
        options = {"plugin": False, "program": PACKAGE, "python": ""}  # it brings its own plugin
        with pencil2d(display, folder / "run", project_in(folder), **options) as window:
            wait_until(lambda: window.find("lampblackButton").get("seen"), "the lamp")
            window.click("lampblackButton")
            install_renderer(window, wheels)
            light(window)
        ball = folder / "ball.png"
        save_picture(ball, draw_ball(240))
        run = folder / "run"
        with closing(OwnWindow(display, run, ball, program=OWN_WINDOW, python="")) as own:
            light_in_own_window(own)
    finally:
        display.close()
    home = folder / "run" / "home"
    installed = sum(f.lstat().st_size for f in (home / ".local/share/lampblack").rglob("*"))
    sys.stdout.write(f"renderer: {installed / 1e9:.2f} GB\n")
    own = {**os.environ, "HOME": str(home)}
    subprocess.run([PACKAGE, "--remove-renderer"], env=own, check=True)
    subprocess.run(["dpkg", "-r", PACKAGE], check=True)
    left = sorted(system_files() - before)
    left += [str(path) for path in home.rglob("*lampblack*")]
    assert not left, f"left behind: {left}"
    sys.stdout.write("installed, lit, removed: nothing is left\n")


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("package", type=Path)
    parser.add_argument("wheels", type=Path, nargs="?")
    given = parser.parse_args()
    if missing():
        sys.stderr.write(f"missing: {missing()}\n")
        return 1
    wheels = given.wheels.absolute() if given.wheels else None
    with tempfile.TemporaryDirectory() as folder:
        try_package(given.package.absolute(), wheels, Path(folder))
    return 0


if __name__ == "__main__":
    sys.exit(main())
