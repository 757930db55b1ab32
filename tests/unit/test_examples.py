"""The example pictures: of the stated sizes, flat, transparent, and matched by their scenes."""

from __future__ import annotations

import importlib
import sys
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

from lampblack.scene import decode_scene
from support.paths import ROOT

EXAMPLES = ROOT / "examples"
STILL = EXAMPLES / "character.png"
FRAMES = sorted((EXAMPLES / "animation").glob("lamplighter.*.png"))
PICTURES = [STILL, *FRAMES]
INK = (0x2A, 0x1A, 0x22)


def read(path: Path) -> NDArray[np.uint8]:
    with Image.open(path) as picture:
        assert picture.mode == "RGBA"
        return np.asarray(picture)


def flat_colours(pixels: NDArray[np.uint8], least: int) -> set[str]:
    """Colours that at least ``least`` opaque pixels wear exactly."""
    opaque = pixels[pixels[..., 3] == 255][:, :3]
    values, counts = np.unique(opaque, axis=0, return_counts=True)
    return {"#" + bytes(v.tolist()).hex() for v in values[counts >= least]}


def test_still_fills_its_canvas() -> None:
    pixels = read(STILL)
    assert pixels.shape == (1000, 1000, 4)
    assert np.count_nonzero(pixels[..., 3] > 127) > 400_000


def test_frames_are_numbered_from_one_and_one_size() -> None:
    assert [path.name for path in FRAMES] == [f"lamplighter.{n:04d}.png" for n in range(1, 9)]
    assert {read(path).shape for path in FRAMES} == {(720, 640, 4)}


def test_only_the_hold_repeats() -> None:
    files = [path.read_bytes() for path in FRAMES]
    assert files[0] == files[1]
    assert len(set(files)) == len(files) - 1


@pytest.mark.parametrize("path", PICTURES, ids=lambda path: path.stem)
def test_background_is_transparent_and_margin_free(path: Path) -> None:
    alpha = read(path)[..., 3]
    margin = np.ones_like(alpha, dtype=bool)
    margin[4:-4, 4:-4] = False
    assert not alpha[margin].any()
    assert path.stat().st_size < 200_000


@pytest.mark.parametrize("path", PICTURES, ids=lambda path: path.stem)
def test_edge_wears_the_straight_colour_of_the_ink(path: Path) -> None:
    pixels = read(path)
    edge = (pixels[..., 3] > 0) & (pixels[..., 3] < 255)
    assert np.count_nonzero(edge) > 2000
    assert np.abs(pixels[edge][:, :3].astype(int) - INK).max() <= 1


@pytest.mark.parametrize("path", PICTURES, ids=lambda path: path.stem)
def test_most_of_the_figure_is_exactly_flat(path: Path) -> None:
    pixels = read(path)
    colours, counts = np.unique(pixels[pixels[..., 3] == 255], axis=0, return_counts=True)
    assert np.sort(counts)[::-1][:14].sum() > 0.88 * counts.sum()
    assert len(colours) < 6000


@pytest.mark.parametrize(
    ("scene_name", "pictures"),
    [("character.scene.json", [STILL]), ("animation.scene.json", FRAMES)],
)
def test_scene_fits_its_pictures(scene_name: str, pictures: list[Path]) -> None:
    scene = decode_scene((EXAMPLES / scene_name).read_bytes())
    assert scene.extra == {}
    assert any(light.z > 0 for light in scene.lights)
    assert any(light.z < 0 for light in scene.lights)
    drawn: set[str] = set()
    for path in pictures:
        pixels = read(path)
        assert (scene.canvas.width, scene.canvas.height) == (pixels.shape[1], pixels.shape[0])
        drawn |= flat_colours(pixels, least=100)
    assert set(scene.materials) <= drawn
    kinds = {(material.diffuse, material.glossy) for material in scene.materials.values()}
    assert {(True, False), (True, True), (False, True)} <= kinds

    # The floor is hinged where the standing character's soles end.
    standing = read(pictures[0])[..., 3]
    assert scene.floor is not None
    lowest = int(np.flatnonzero((standing > 127).any(axis=1))[-1])
    assert abs(lowest - scene.floor.y) < 8


def test_script_draws_the_pictures_that_are_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(str(EXAMPLES))
    draw = importlib.import_module("draw")
    try:
        drawn = np.asarray(draw.draw_frame(draw.HOP[4])).astype(int)
    finally:
        for name in ("draw", "lamplighter", "attire", "pose", "strokes"):
            sys.modules.pop(name, None)
    kept = read(FRAMES[4]).astype(int)
    # Another build of numpy may round a handful of samples another way.
    assert np.mean(np.abs(drawn - kept).max(axis=2) > 16) < 1e-4
