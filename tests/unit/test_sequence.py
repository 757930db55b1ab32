"""Frames found, ordered and chosen."""

from __future__ import annotations

from pathlib import Path

import pytest

from lampblack.drawing import Frame, find_frames, parse_frames, select_frames
from lampblack.drawing.numbering import is_pattern, numbered_names
from lampblack.errors import DrawingError, LampblackWarning


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    for name in ("a.10.png", "a.2.png", "a.0001.PNG", "b0003.png", "notes.txt", ".a.0004.png"):
        (tmp_path / name).touch()
    (tmp_path / "a.0007.png").mkdir()
    return tmp_path


def numbers(frames: list[Frame]) -> list[int | None]:
    return [frame.number for frame in frames]


def test_folder_in_order_of_number(folder: Path) -> None:
    assert numbers(find_frames([folder])) == [1, 2, 3, 10]


def test_files_keep_their_order_and_count_once(folder: Path) -> None:
    named: list[str | Path] = [folder / "a.10.png", str(folder / "b0003.png"), folder / "a.10.png"]
    assert find_frames(named) == [Frame(10, folder / "a.10.png"), Frame(3, folder / "b0003.png")]


def test_pattern_matches_padding_and_longer_numbers(folder: Path) -> None:
    assert numbers(find_frames([folder / "b%04d.png"])) == [3]
    assert numbers(find_frames([folder / "a.%02d.png"])) == [10]
    assert numbers(find_frames([folder / "a.%d.png"])) == [2, 10]


def test_name_without_digits(tmp_path: Path) -> None:
    (tmp_path / "hero.png").touch()
    assert find_frames([tmp_path / "hero.png"]) == [Frame(None, tmp_path / "hero.png")]


def test_gaps_are_fine_and_two_sequences_are_told(tmp_path: Path) -> None:
    for name in ("a.9.png", "a.200.png"):
        (tmp_path / name).touch()
    assert numbers(find_frames([tmp_path])) == [9, 200]
    (tmp_path / "B.9.png").touch()
    with pytest.warns(LampblackWarning, match="2 sequences \\('a', 'b'\\)"):
        assert numbers(find_frames([tmp_path])) == [9, 9, 200]


def test_one_number_in_two_formats_or_paddings_is_no_second_sequence(tmp_path: Path) -> None:
    for name in ("Walk.0001.png", "walk.0002.PNG", "walk_0002.png"):
        (tmp_path / name).touch()
    assert numbers(find_frames([tmp_path])) == [1, 2, 2]


@pytest.mark.parametrize(
    ("pattern", "found"),
    [
        ("walk..png", [-2, 1, 10]),
        ("WALK..png", [-2, 1, 10]),
        ("walk.####.png", [-2, 1, 10]),
        ("walk.%d.png", [-2, 1, 10]),
        ("take#2.%04d.png", [7]),
        ("walk.v..2..png", [5]),
    ],
)
def test_patterns_of_opentoonz_and_others(tmp_path: Path, pattern: str, found: list[int]) -> None:
    names = ("walk.0001.png", "walk.0010.png", "walk.-002.png", "walk.png", "walk.x.0003.png")
    for name in (*names, "take#2.0007.png", "walk.v..2.0005.png"):
        (tmp_path / name).touch()
    if pattern.isupper() or pattern.startswith("WALK"):
        with pytest.warns(LampblackWarning, match="other capitals"):
            assert numbers(find_frames([tmp_path / pattern])) == found
    else:
        assert numbers(find_frames([tmp_path / pattern])) == found


@pytest.mark.parametrize(
    ("pattern", "number", "name"),
    [
        ("walk..png", 7, "walk.0007.png"),
        ("walk.%d.png", 7, "walk.7.png"),
        ("walk_###.exr", -7, "walk_-07.exr"),
        ("walk.%04d.png", -7, "walk.-007.png"),
        ("walk.%012d.png", 7, "walk.000000007.png"),
    ],
)
def test_names_are_written_as_they_are_read(pattern: str, number: int, name: str) -> None:
    (place,) = numbered_names(pattern)
    assert place.name(number) == name
    match = place.matching().fullmatch(name)
    assert match is not None
    assert int(match[1]) == number


@pytest.mark.parametrize("name", ["..", ".", "lit..v2", "walk.png", ".png", "..png"])
def test_other_names_are_no_patterns(name: str) -> None:
    assert not is_pattern(name)


@pytest.mark.parametrize(
    ("name", "number"),
    [
        ("walk.-0001.png", -1),
        ("walk_-12.png", -12),
        ("-3.png", -3),
        ("walk-0001.png", 1),
        ("walk1-2.png", 2),
        ("walk--2.png", 2),
        ("1-walk.png", 1),
        ("-1_walk.png", -1),
        ("12. run2.png", 2),
        ("3d.png", None),
        ("WALK.0007.JPG", 7),
        ("walk.0008.tiff", 8),
        ("walk.1234567890.png", None),
    ],
)
def test_the_number_in_a_name(tmp_path: Path, name: str, number: int | None) -> None:
    (tmp_path / name).touch()
    assert numbers(find_frames([tmp_path])) == [number]


def test_frames_before_the_first_come_first(tmp_path: Path) -> None:
    for number in (2, -3, 0, -1):
        (tmp_path / f"a.{number:05d}.png").touch()
    for pattern in ("", "a.%05d.png", "a.#####.png", "a.%d.png", "a..png"):
        assert numbers(find_frames([tmp_path / pattern])) == [-3, -1, 0, 2]


def test_names_are_in_the_order_of_their_numbers(tmp_path: Path) -> None:
    """Numbers first, wherever they are."""
    for name in ("2-walk.png", "10-walk.png", "a10b.png", "a2b.png", "1-walk.png"):
        (tmp_path / name).touch()
    found = [frame.path.name for frame in find_frames([tmp_path])]
    assert found == ["1-walk.png", "2-walk.png", "10-walk.png", "a2b.png", "a10b.png"]


def test_lost_links_are_told(folder: Path) -> None:
    (folder / "a.0011.png").symlink_to(folder / "gone.png")
    with pytest.warns(LampblackWarning, match=r"a\.0011\.png"):
        assert numbers(find_frames([folder])) == [1, 2, 3, 10]


@pytest.mark.parametrize("name", ["missing", "missing.png", "none.%04d.png", "no/x.%d.png"])
def test_missing(folder: Path, name: str) -> None:
    with pytest.raises(DrawingError):
        find_frames([folder / name])


def test_empty(tmp_path: Path) -> None:
    with pytest.raises(DrawingError, match="holds no pictures"):
        find_frames([tmp_path])
    with pytest.raises(DrawingError, match="No drawing"):
        find_frames([])


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("7", [7]),
        ("1-20x2,25", [*range(1, 21, 2), 25]),
        ("3, 1-2", [1, 2, 3]),
        ("5-5", [5]),
        ("1-4,2-3", [1, 2, 3, 4]),
        ("0001-0003", [1, 2, 3]),
        ("-3", [-3]),
        ("-3-1x2", [-3, -1, 1]),
        ("-3--1", [-3, -2, -1]),
    ],
)
def test_frame_lists(text: str, expected: list[int]) -> None:
    assert parse_frames(text) == expected


@pytest.mark.parametrize(
    "text",
    [
        "",
        ",",
        "a",
        "1-",
        "-",
        "1x2",
        "5-1",
        "1-9x0",
        "1--3",
        "--3",
        "1.5",
        "1-999999999",
        "9" * 5000,
    ],
)
def test_bad_frame_lists(text: str) -> None:
    with pytest.raises(DrawingError):
        parse_frames(text)


def test_select() -> None:
    frames = [Frame(n, Path(f"a.{n}.png")) for n in (1, 2, 5)]
    assert numbers(select_frames(frames, parse_frames("1-5x4"))) == [1, 5]
    with pytest.warns(LampblackWarning, match="3, 4, 6"):
        assert numbers(select_frames(frames, parse_frames("2-9"))) == [2, 5]
    with pytest.raises(DrawingError, match="from 1 to 5"):
        select_frames(frames, [3])
