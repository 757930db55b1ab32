"""Photoshop's files: composited as psd-tools and the programs that wrote them composite them."""

from __future__ import annotations

import struct
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image
from psd_tools import PSDImage
from psd_tools.composite import blend as theirs
from psd_tools.constants import BlendMode, Tag

from lampblack.errors import LampblackWarning, ProjectError
from lampblack.project import is_project, read_project
from lampblack.project.blend import blended
from lampblack.project.psd import BLENDS
from lampblack.project.shot import ProjectShot
from lampblack.project.stack import Roles
from support.layered import apart, blob
from support.memory import little_memory
from support.paths import ROOT

SIZE = 96, 72
RED, GREEN, BLUE = (200, 60, 40), (40, 170, 60), (50, 80, 210)
SMOOTH = [
    BlendMode.NORMAL, BlendMode.MULTIPLY, BlendMode.SCREEN, BlendMode.OVERLAY, BlendMode.DARKEN,
    BlendMode.LIGHTEN, BlendMode.SOFT_LIGHT, BlendMode.HARD_LIGHT, BlendMode.DIFFERENCE,
    BlendMode.EXCLUSION, BlendMode.LINEAR_DODGE, BlendMode.LINEAR_BURN, BlendMode.COLOR,
]  # fmt: skip
"""Modes that do not make rounding errors larger."""


def new(depth: Any = 8, mode: str = "RGBA") -> PSDImage:
    return PSDImage.new(mode, SIZE, depth=depth)


def put(
    parent: Any, name: str, picture: np.ndarray, at: tuple[int, int] = (0, 0), **how: Any
) -> Any:
    layer = parent.create_pixel_layer(
        Image.fromarray(picture), name=name, left=at[0], top=at[1], **how
    )
    return layer


def masked(layer: Any, grey: np.ndarray, at: tuple[int, int], outside: int = 0) -> Any:
    mask = layer.create_mask(Image.fromarray(grey), left=at[0], top=at[1])
    mask.data.background_color = outside
    return mask


def saved(folder: Path, psd: PSDImage, name: str = "hero.psd") -> Path:
    path = folder / name
    psd.save(path)
    return path


def shot_of(path: Path, roles: Roles | None = None) -> ProjectShot:
    return ProjectShot(*read_project(path), roles or {})


def unlit(path: Path, roles: Roles | None = None) -> np.ndarray:
    shot = shot_of(path, roles)
    return shot.finish(shot.frames[0], shot.cel(shot.frames[0]).pixels)


def their_composite(path: Path) -> np.ndarray:
    image = PSDImage.open(path).composite(ignore_preview=True)
    assert image is not None
    return np.asarray(image.convert("RGBA"))


def ramp(side: int = 24) -> np.ndarray:
    return np.tile(np.linspace(0, 255, side).astype(np.uint8), (side, 1))


@pytest.mark.parametrize("name", ["krita.psd", "gimp.psd"])
def test_a_file_looks_as_in_the_program_that_wrote_it(name: str) -> None:
    path = ROOT / "tests/data/layers" / name
    stored = PSDImage.open(path).topil(apply_icc=False)
    assert stored is not None
    assert apart(unlit(path), np.asarray(stored.convert("RGBA"))).max() <= 2
    names = [layer.name for layer in read_project(path)[0].layers]
    drawn = ["body", "shade", "arm"] if name == "krita.psd" else ["figure", "shade", "glow"]
    assert names[:4] == ["paper", *drawn]


@pytest.mark.parametrize("seed", range(8))
def test_trees_of_layers_are_composited_as_by_psd_tools(tmp_path: Path, seed: int) -> None:
    rng = np.random.default_rng(seed)
    psd = new()

    def fill(parent: Any, depth: int) -> None:
        for index in range(3):
            if depth < 2 and rng.random() < 0.4:
                how = rng.choice([0, 1, 2])
                mode = (BlendMode.PASS_THROUGH, BlendMode.NORMAL, BlendMode.MULTIPLY)[how]
                group = parent.create_group(
                    name=f"group {depth}{index}", blend_mode=mode,
                    opacity=int(rng.choice([255, 150])),
                )  # fmt: skip
                fill(group, depth + 1)
                continue
            soft = 4 if index else 0
            layer = put(
                parent,
                f"layer {depth}{index}",
                blob(tuple(rng.integers(30, 226, 3)), tuple(rng.integers(16, 60, 2)), soft),
                tuple(int(n) for n in rng.integers(-8, 50, 2)),
                opacity=int(rng.choice([255, 120])),
                blend_mode=SMOOTH[rng.integers(len(SMOOTH))],
            )
            # A soft edge is blended with what is clipped to it as in Krita, not as by psd-tools,
            # which lets the clipped colour show through.
            layer.clipping = index == 1 and depth > 0 and not parent[0].is_group()
            if rng.random() < 0.4:
                masked(layer, ramp(), (int(rng.integers(0, 30)), 8), int(rng.choice([0, 255])))

    put(psd, "paper", np.full((72, 96, 4), (230, 220, 200, 255), np.uint8))
    fill(psd, 0)
    path = saved(tmp_path, psd)
    assert apart(unlit(path), their_composite(path)).max() <= 2


@pytest.mark.parametrize("mode", [mode for mode in BLENDS if mode != BlendMode.PASS_THROUGH])
def test_colours_are_blended_as_in_photoshop(mode: BlendMode) -> None:
    rng = np.random.default_rng(1)
    below, above = (rng.integers(0, 256, (64, 64, 3)).astype(np.float32) / 255 for _ in "ab")
    below[0], above[1], below[2], above[3] = 0, 0, 1, 1
    opaque = np.ones((64, 64, 1), np.float32)
    found = blended(np.dstack([below, opaque]), np.dstack([above, opaque]), BLENDS[mode], 1)
    expected = theirs.get_blend_func(mode)(below.copy(), above.copy())
    assert np.abs(found[..., :3] - np.clip(expected, 0, 1)).max() < 1e-3


def test_what_is_clipped_shows_on_its_base_and_goes_through_its_blend_mode(tmp_path: Path) -> None:
    psd = new()
    put(psd, "paper", np.full((72, 96, 4), (200, 200, 200, 255), np.uint8))
    put(psd, "arm", np.full((20, 20, 4), (*RED, 255), np.uint8), (60, 10))
    base = np.full((30, 30, 4), (*GREEN, 255), np.uint8)
    put(psd, "body", base, (10, 10), blend_mode=BlendMode.MULTIPLY, opacity=128)
    shade = put(psd, "shade", np.full((30, 90, 4), (*BLUE, 255), np.uint8), (0, 25))
    shade.clipping = True
    path = saved(tmp_path, psd)
    picture = unlit(path).astype(int)
    assert picture[30, 5].tolist() == picture[30, 70].tolist() == [200, 200, 200, 255]
    shown = 200 * (1 + 128 / 255 * (np.array(BLUE) / 255 - 1))
    assert np.abs(picture[30, 20, :3] - shown).max() <= 1
    assert apart(picture, their_composite(path)).max() <= 2


def test_a_group_that_passes_mixes_by_its_opacity(tmp_path: Path) -> None:
    psd = new()
    put(psd, "paper", np.full((72, 96, 4), (200, 200, 200, 255), np.uint8))
    group = psd.create_group(name="shading", opacity=128)
    put(
        group, "shade", np.full((72, 50, 4), (128, 128, 128, 255), np.uint8),
        blend_mode=BlendMode.MULTIPLY,
    )  # fmt: skip
    picture = unlit(saved(tmp_path, psd)).astype(int)
    assert abs(picture[5, 5, 0] - 200 * (1 - 128 / 255 * 127 / 255)) <= 1
    assert picture[5, 60, 0] == 200


@pytest.mark.parametrize(("outside", "beyond"), [(0, 0), (255, 255)])
def test_masks_hide_and_go_on_beyond_their_edges(tmp_path: Path, outside: int, beyond: int) -> None:
    psd = new()
    layer = put(psd, "body", np.full((72, 96, 4), (*RED, 255), np.uint8))
    mask = masked(layer, ramp(), (20, 10), outside)
    path = saved(tmp_path, psd)
    alpha = unlit(path)[..., 3]
    assert np.array_equal(alpha[10:34, 20:44], ramp())
    assert (alpha[40:] == beyond).all()
    assert apart(unlit(path), their_composite(path)).max() <= 1
    mask.disabled = True
    assert (unlit(saved(tmp_path, psd))[..., 3] == 255).all()


def test_layers_keep_their_roles_their_order_and_their_names(tmp_path: Path) -> None:
    psd = new()
    put(psd, "paper", np.full((72, 96, 4), 255, np.uint8))
    put(psd, "body", blob(RED, soft=0), (10, 10))
    shade = put(psd, "shade", blob(BLUE), (25, 20), blend_mode=BlendMode.MULTIPLY)
    shade.clipping = True
    put(psd, "arm", blob(GREEN, (30, 12)), (40, 22))
    line = blob((0, 0, 0), (8, 50), 20)
    put(psd, "ink lines", line, (20, 10))
    group = psd.create_group(name="away")
    put(group, "never", blob(GREEN))
    group.visible = False
    roles: Roles = {"body": "character", "arm": "character", "ink lines": "line"}
    path = saved(tmp_path, psd)
    shot = shot_of(path, roles)
    cel = shot.cel(shot.frames[0])
    assert [(layer.name, layer.line) for layer in cel.layers] == [
        ("body", False), ("arm", False), ("ink lines", True),
    ]  # fmt: skip
    body = cel.layers[0].placed(SIZE)
    assert tuple(body[30, 40, :3]) != tuple(blob(RED)[20, 30, :3]), "its shade belongs to it"
    assert not cel.pixels[60:, 80:].any(), "the paper is not lit"
    assert cel.ink is not None
    assert apart(unlit(path, roles), their_composite(path)).max() <= 2


def test_unlit_layers_above_are_blended_with_what_is_lit(tmp_path: Path) -> None:
    psd = new()
    put(psd, "paper", np.full((72, 96, 4), (230, 220, 200, 255), np.uint8))
    put(psd, "body", blob(RED, (60, 50)), (10, 10))
    put(psd, "shade", blob(BLUE, (50, 40)), (30, 20), blend_mode=BlendMode.MULTIPLY, opacity=200)
    group = psd.create_group(name="weather", opacity=128)
    put(group, "fog", blob(GREEN, (70, 30)), (5, 40), blend_mode=BlendMode.SCREEN)
    path = saved(tmp_path, psd)
    assert apart(unlit(path, {"body": "character"}), their_composite(path)).max() <= 2


def test_other_depths_and_grey_are_read(tmp_path: Path) -> None:
    for depth, mode in ((16, "RGBA"), (8, "LA"), (16, "LA")):
        psd = new(depth, mode)
        put(psd, "body", blob(RED, (60, 50)), (10, 10))
        path = saved(tmp_path, psd)
        assert apart(unlit(path), their_composite(path)).max() <= 2, (depth, mode)


@pytest.mark.parametrize(("depth", "mode"), [(8, "CMYK"), (32, "RGBA")])
def test_other_colours_are_lit_as_one_picture_and_told(
    tmp_path: Path, depth: int, mode: str
) -> None:
    psd = new(depth, mode)
    put(psd, "body", blob(RED, (60, 50)), (10, 10))
    path = saved(tmp_path, psd)
    with pytest.warns(LampblackWarning, match="its layers are lit as one picture"):
        shot = shot_of(path)
    assert shot.cel(shot.frames[0]).layers == ()


def test_a_file_without_layers_is_one_picture(tmp_path: Path) -> None:
    drawn = np.full((72, 96, 3), 255, np.uint8)
    drawn[10:40, 10:60] = RED
    path = tmp_path / "flat.psd"
    PSDImage.frompil(Image.fromarray(drawn)).save(path)
    assert np.array_equal(unlit(path)[..., :3], drawn)


def test_what_has_no_pixels_is_left_out_and_told(tmp_path: Path) -> None:
    psd = new()
    put(psd, "body", blob(RED, (60, 50)), (10, 10))
    inverted = put(psd, "Invert", np.zeros((1, 1, 4), np.uint8))
    inverted.tagged_blocks.set_data(Tag.INVERT)
    path = saved(tmp_path, psd)
    with pytest.warns(LampblackWarning, match="'Invert' have no pixels"):
        picture = unlit(path)
    assert apart(picture[10:60, 10:70], blob(RED, (60, 50))).max() <= 1


def test_the_same_file_has_the_same_drawing(tmp_path: Path) -> None:
    psd = new()
    layer = put(psd, "body", blob(RED))
    first = shot_of(saved(tmp_path, psd)).frames[0].drawing
    assert shot_of(saved(tmp_path, psd)).frames[0].drawing == first
    masked(layer, ramp(), (0, 0))
    assert shot_of(saved(tmp_path, psd)).frames[0].drawing != first


def test_suffixes_are_known_in_any_case() -> None:
    assert is_project("HERO.PSD")
    assert is_project("hero.psb")


def test_damage_is_told(tmp_path: Path) -> None:
    psd = new()
    put(psd, "body", blob(RED, (60, 50)))
    whole = saved(tmp_path, psd).read_bytes()
    path = tmp_path / "broken.psd"
    for content in (b"", b"8BPS", whole[:60], whole[: len(whole) // 4], b"\x89PNG" * 40):
        path.write_bytes(content)
        with pytest.raises(ProjectError, match=r"damaged|no layer|None of"):
            unlit(path)
    with pytest.raises(ProjectError, match="no drawing at"):
        unlit(tmp_path / "none.psd")


def test_any_flipped_byte_is_an_error_for_people_at_most(tmp_path: Path) -> None:
    psd = new()
    put(psd.create_group(name="g"), "body", blob(RED, (20, 10)))
    whole = bytearray(saved(tmp_path, psd).read_bytes())
    path, rng = tmp_path / "flipped.psd", np.random.default_rng(5)
    for place in rng.integers(0, min(len(whole), 700), 150):
        flipped = bytearray(whole)
        flipped[place] ^= 1 << rng.integers(8)
        path.write_bytes(flipped)
        try:
            unlit(path)
        except (ProjectError, LampblackWarning):
            continue


@pytest.mark.parametrize(
    ("start", "words"),
    [
        (b"8BPS\0\1" + bytes(6) + struct.pack(">HIIHH", 3, 29000, 29000, 8, 3), "29000 x 29000"),
        (b"8BPX\0\1" + bytes(6) + struct.pack(">HIIHH", 3, 60, 60, 8, 3), "no file of Photoshop"),
        (b"8BPS\0\7" + bytes(6) + struct.pack(">HIIHH", 3, 60, 60, 8, 3), "no file of Photoshop"),
        (b"8BPS\0\1" + bytes(6) + struct.pack(">HIIHH", 3, 0, 60, 8, 3), "0 pixels"),
    ],
)
def test_little_is_read_of_what_is_refused(tmp_path: Path, start: bytes, words: str) -> None:
    path = tmp_path / "huge.psd"
    with path.open("wb") as file:
        file.write(start)
        file.truncate(900 << 20)
    with little_memory(), pytest.raises(ProjectError, match=words):
        shot_of(path)
    with path.open("r+b") as file:
        file.truncate((1 << 30) + 1)
    with little_memory(), pytest.raises(ProjectError, match="larger than 1024 MiB"):
        shot_of(path)


def sound_start(pixels: int, depth: int = 8) -> bytes:
    """A file with one layer up to its four channels of so many bytes each. Of 16 bits, they are in
    a block."""
    record = struct.pack(">4iH", 0, 0, SIZE[1], SIZE[0], 4)
    record += b"".join(struct.pack(">hI", number, pixels) for number in (0, 1, 2, -1))
    record += b"8BIMnorm" + struct.pack(">BBBxI", 255, 0, 0, 12) + bytes(8) + b"\1a\0\0"
    info = struct.pack(">h", 1) + record
    info = struct.pack(">I", len(info) + 4 * pixels) + info
    if depth == 16:
        info = bytes(8) + b"8BIMLr16" + info
    head = b"8BPS\0\1" + bytes(6) + struct.pack(">HIIHH", 4, SIZE[1], SIZE[0], depth, 3) + bytes(8)
    return head + struct.pack(">I", len(info) + 4 * pixels) + info


@pytest.mark.parametrize("depth", [8, 16])
def test_pixels_stay_in_the_file_until_they_are_shown(tmp_path: Path, depth: int) -> None:
    path, start = tmp_path / "large.psd", sound_start(200 << 20, depth)
    with path.open("wb") as file:
        file.write(start)
        file.truncate(800 << 20)
    with little_memory(), pytest.raises(ProjectError, match="damaged"):
        shot_of(path)
    with path.open("r+b") as file:
        file.truncate(len(start) + (800 << 20) + 2)
    with little_memory():
        shot = shot_of(path)
        assert not shot.cel(shot.frames[0]).pixels.any()  # alpha is 0 everywhere
    shot = shot_of(path)
    path.write_bytes(start + bytes(1 << 20))
    with pytest.raises(ProjectError, match="changed while the shot was rendered"):
        shot.cel(shot.frames[0])


def test_linked_files_are_passed_over(tmp_path: Path) -> None:
    path, length = tmp_path / "linked.psd", 700 << 20
    content = sound_start(3) + bytes(12) + bytes(4) + b"8BIMlnk2" + struct.pack(">I", length)
    content = content[:34] + struct.pack(">I", len(content) - 38 + length) + content[38:]
    with path.open("wb") as file:
        file.write(content)
        file.truncate(len(content) + length + 2)
    with little_memory():
        (layer,) = read_project(path)[0].layers
    assert layer.name == "a"


def test_a_damaged_layer_is_not_black(tmp_path: Path) -> None:
    psd = new()
    layer = put(psd, "body", np.full((30, 30, 4), (*RED, 255), np.uint8))
    for channel in layer._channels:
        channel.data = channel.data[:40]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        path = saved(tmp_path, psd)
        before = list(warnings.filters)
        with pytest.raises(ProjectError, match="damaged"):
            unlit(path)
        assert list(warnings.filters) == before, "what other threads are told stays as it was"
