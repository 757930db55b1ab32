"""Moving pictures of a shot."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from lampblack.errors import LampblackError
from lampblack.finals.moving_picture import save_moving_picture
from support.command_line import Run
from support.projects import walk

needs_ffmpeg = pytest.mark.skipif(shutil.which("ffmpeg") is None, reason="ffmpeg is not installed")

COLOURS = ((220, 40, 30), (30, 160, 60), (40, 60, 210))


def flat(colour: tuple[int, int, int], size: tuple[int, int] = (65, 41)) -> np.ndarray:
    picture = np.zeros((size[1], size[0], 4), np.uint8)
    picture[4:-4, 4:-4] = *colour, 255
    return picture


def frames_of(path: Path) -> list[np.ndarray]:
    with Image.open(path) as image:
        found = []
        for index in range(getattr(image, "n_frames", 1)):
            image.seek(index)
            found.append(np.asarray(image.convert("RGBA")))
        return found


@pytest.mark.parametrize("suffix", ["gif", "webp"])
def test_pictures_follow_one_another(tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"walk.{suffix}"
    save_moving_picture(path, map(flat, COLOURS), 8)
    found = frames_of(path)
    assert len(found) == 3
    for picture, colour in zip(found, COLOURS, strict=True):
        assert np.abs(picture[20, 30, :3].astype(int) - colour).max() <= 4
    assert tuple(found[0][0, 0]) == (255, 255, 255, 255)
    with Image.open(path) as image:
        image.load()
        assert image.info["duration"] in (120, 125)


@needs_ffmpeg
@pytest.mark.parametrize("suffix", ["mp4", "webm"])
def test_videos_play_at_the_asked_speed(tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"-walk %d.{suffix}"
    save_moving_picture(path, map(flat, COLOURS * 4), 8)
    folder = tmp_path / "frames"
    folder.mkdir()
    command = ["ffmpeg", "-v", "error", "-i", f"file:{path}", "-vsync", "0", folder / "%02d.png"]
    subprocess.run(command, check=True)
    found = sorted(folder.iterdir())
    assert len(found) == 12
    second = np.asarray(Image.open(found[1]).convert("RGB")).astype(int)
    assert second.shape == (42, 66, 3)
    assert np.abs(second[20, 30] - COLOURS[1]).max() <= 12
    probe = ["ffprobe", "-v", "error", "-show_entries", "stream=r_frame_rate", "-of", "csv=p=0"]
    told = subprocess.run([*probe, f"file:{path}"], check=True, capture_output=True, text=True)
    assert told.stdout.strip() == "8/1"
    assert [each.name for each in tmp_path.iterdir() if ".part" in each.name] == []


def test_other_sizes_are_shown_at_the_size_of_the_first(tmp_path: Path) -> None:
    pictures = [flat(COLOURS[0], (4000, 400)), flat(COLOURS[1], (50, 50))]
    save_moving_picture(tmp_path / "a.gif", pictures, 12)
    assert {picture.shape for picture in frames_of(tmp_path / "a.gif")} == {(192, 1920, 4)}


def test_a_preview_is_written_beside_the_frames(
    run: Run, tmp_path: Path, unrendered: list[str]
) -> None:
    path = tmp_path / "walk.gif"
    project = walk(tmp_path, [1, 2, 3])
    done = run("render", project, "-o", tmp_path / "lit", "--preview", path)
    assert done.code == 0, done.err
    assert len(frames_of(path)) == 3
    with Image.open(path) as image:
        assert image.info["duration"] in (80, 83), "the project has 12 frames a second"


def test_what_cannot_be_written_is_told_before_any_work(
    run: Run, tmp_path: Path, unrendered: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    project, out = walk(tmp_path, [1]), ("-o", tmp_path / "lit")
    assert ".webm, .mp4, .gif, .webp" in run("render", project, *out, "--preview", "a.avi").err
    monkeypatch.setenv("PATH", str(tmp_path))
    told = run("render", project, *out, "--preview", tmp_path / "a.mp4")
    assert "apt-get install ffmpeg" in told.err
    assert not unrendered
    with pytest.raises(LampblackError, match="no frame"):
        save_moving_picture(tmp_path / "a.gif", [], 12)
