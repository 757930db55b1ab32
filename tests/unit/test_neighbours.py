"""Steady normals in a shot: the same whichever frames are lit, found only when needed."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from lampblack.cache import ArrayCache
from lampblack.drawing import save_picture
from lampblack.finals.neighbours import NeighbourLoader
from lampblack.finals.resolve import resolve_shot
from lampblack.finals.settings import RenderSettings
from lampblack.pipeline import Pipeline
from support.command_line import Run, files
from support.drawings import draw_ball


def ball(number: int) -> np.ndarray:
    """A ball that rolls on, with a highlight of its own."""
    picture = np.roll(draw_ball(90), 2 * number, axis=1)
    picture[30 + number : 36 + number, 40:50, :3] = 250
    return picture


@pytest.fixture
def shot(tmp_path: Path) -> RenderSettings:
    folder = tmp_path / "walk"
    folder.mkdir()
    for number, drawn in enumerate([0, 0, 1, 2, None, 3], start=1):
        picture = np.zeros((90, 90, 4), np.uint8) if drawn is None else ball(drawn)
        save_picture(folder / f"walk.{number:04d}.png", picture)
    return RenderSettings(inputs=(str(folder),), output=str(tmp_path / "lit"))


def normals_of(settings: RenderSettings, numbers: list[int], cache: Path) -> dict[int, np.ndarray]:
    opened = resolve_shot(settings)
    with Pipeline(ArrayCache(cache)) as pipeline:
        neighbour_loader = NeighbourLoader(opened.shot, pipeline)
        frames = {frame.number: frame for frame in opened.frames}
        return {
            number: pipeline.surfaces.normals(
                neighbour_loader.drawing(frames[number]),
                neighbour_loader.neighbours(frames[number]),
            )
            for number in numbers
        }


def test_any_order_and_any_part_of_a_shot_gives_the_same(
    shot: RenderSettings, tmp_path: Path
) -> None:
    all_of_it = normals_of(shot, [1, 3, 4, 6], tmp_path / "a")
    backwards = normals_of(shot, [6, 4, 1, 3], tmp_path / "b")
    part = normals_of(replace_frames(shot, "3-4"), [4, 3], tmp_path / "c")
    for number, normals in all_of_it.items():
        assert np.array_equal(normals, backwards[number])
    for number, normals in part.items():
        assert np.array_equal(normals, all_of_it[number])


def replace_frames(settings: RenderSettings, frames: str) -> RenderSettings:
    return RenderSettings(inputs=settings.inputs, output=settings.output, frames=frames)


def test_neighbours_are_found_only_when_a_surface_is_made(
    shot: RenderSettings, tmp_path: Path
) -> None:
    opened = resolve_shot(shot)
    with Pipeline(ArrayCache(tmp_path / "cache")) as pipeline:
        neighbour_loader = NeighbourLoader(opened.shot, pipeline)
        frame = opened.frames[2]
        drawing, neighbours = neighbour_loader.drawing(frame), neighbour_loader.neighbours(frame)
        assert neighbours is not None
        assert [len(side) for side in neighbours.keys] == [1, 2]
        # A blank frame is a cut: nothing is taken from it or from beyond it.
        found = neighbours.load()
        assert (len(found.before), len(found.after)) == (1, 1)
        steady = pipeline.prepare(drawing, neighbours).height

        def unneeded() -> object:
            raise AssertionError

        known = replace(neighbours, load=unneeded)
        assert np.array_equal(pipeline.prepare(drawing, known).height, steady)
        assert not np.array_equal(pipeline.prepare(drawing).height, steady)


def test_a_drawing_on_its_own_has_no_neighbours(tmp_path: Path) -> None:
    save_picture(tmp_path / "ball.png", draw_ball(60))
    settings = RenderSettings(inputs=(str(tmp_path / "ball.png"),), output=str(tmp_path / "lit"))
    opened = resolve_shot(settings)
    with Pipeline(ArrayCache(tmp_path / "cache")) as pipeline:
        assert NeighbourLoader(opened.shot, pipeline).neighbours(opened.frames[0]) is None


def test_normals_and_meshes_of_a_shot_are_steadied_unless_told_otherwise(
    shot: RenderSettings, run: Run, tmp_path: Path
) -> None:
    folder = Path(shot.inputs[0])
    told = run("normals", folder, "-o", tmp_path / "s.%04d.npy")
    assert (told.code, "walk.0005.png" in told.err) == (0, True)
    assert run("normals", folder, "-o", tmp_path / "p.%04d.npy", "--no-steady").code == 0
    assert files(tmp_path) >= {f"{kind}.000{n}.npy" for kind in "sp" for n in (1, 2, 3, 4, 6)}
    assert not (tmp_path / "s.0005.npy").exists()
    found = {name: np.load(tmp_path / f"{name}.npy") for name in ("s.0001", "s.0002", "p.0001")}
    assert np.array_equal(found["s.0001"], found["s.0002"])
    assert not np.array_equal(found["s.0001"], found["p.0001"])
    # One frame of a shot is as in the shot; a drawing named alone is as predicted.
    assert run("normals", folder, "--frames", 1, "-o", tmp_path / "one.npy").code == 0
    assert np.array_equal(np.load(tmp_path / "one.npy"), found["s.0001"])
    assert run("normals", folder / "walk.0001.png", "-o", tmp_path / "one.npy").code == 0
    assert np.array_equal(np.load(tmp_path / "one.npy"), found["p.0001"])
    assert run("mesh", folder, "--stride", 4, "-o", tmp_path / "meshes").code == 0
    assert files(tmp_path / "meshes") == {f"walk.000{n}.glb" for n in (1, 2, 3, 4, 6)}
