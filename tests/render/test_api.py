"""``lampblack.light``: the entry from Python, as the README shows it."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import numpy as np

from lampblack.drawing import load_picture, save_picture
from lampblack.scene import default_scene, encode_scene
from support.command_line import Run
from support.drawings import draw_ball
from support.paths import ROOT


def test_the_readme_lights_a_picture_as_the_command_line_does(run: Run, tmp_path: Path) -> None:
    save_picture(tmp_path / "hero.png", draw_ball(96))
    (tmp_path / "hero.json").write_bytes(encode_scene(default_scene(96, 96)))
    (code,) = re.findall(r"(?:^    .*\n|^\n)*^    import lampblack\n(?:^    .*\n|^\n)*",
                         (ROOT / "README.md").read_text(), re.MULTILINE)  # fmt: skip
    program = "\n".join(line.removeprefix("    ") for line in code.splitlines())
    subprocess.run([sys.executable, "-c", program], cwd=tmp_path, check=True, timeout=120)
    lit = load_picture(tmp_path / "hero.lit.png")
    assert lit.shape == (96, 96, 4)
    assert np.abs(lit.astype(int) - draw_ball(96)).max() > 20

    scene = tmp_path / "hero.json"
    assert run("render", tmp_path / "hero.png", "-o", tmp_path / "lit", "--scene", scene).code == 0
    assert np.array_equal(lit, load_picture(tmp_path / "lit" / "hero.png"))
