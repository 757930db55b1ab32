"""``lampblack doctor`` tries all that lighting needs."""

from __future__ import annotations

import subprocess
import sys


def test_the_doctor_lights_a_drawing_as_a_final_frame_and_live() -> None:
    command = [sys.executable, "-I", "-m", "lampblack", "doctor"]
    run = subprocess.run(command, capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
    assert run.stdout.splitlines()[-2:] == ["Cycles: renders", "live preview: lights"]
