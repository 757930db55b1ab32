"""Layers become bodies: which of them, what each holds, and that the whole stays as it was."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from lampblack.drawing import Body, Drawing, DrawingPlanes, decompose_cel, decompose_drawing
from lampblack.drawing.grouping import LayerKind, place_layers
from lampblack.drawing.joints import joint_of
from lampblack.scene import LayerBody
from lampblack.shot import Cel, CelLayer, cropped_layer
from support.drawings import draw_capsule, layered_cel

Picture = NDArray[np.uint8]
SIZE = 240, 220
BODY = draw_capsule(SIZE, (115, 115), (115, 115), 75, (200, 110, 60))
ARM = draw_capsule(SIZE, (70, 110), (215, 100), 16)
INNER = draw_capsule(SIZE, (85, 110), (145, 110), 16)
TOP = BODY.shape[0]


def layer_kinds(
    layers: Sequence[CelLayer], size: tuple[int, int], choices: Sequence[LayerBody] = ()
) -> tuple[LayerKind, ...]:
    return tuple(placed.kind for placed in place_layers(layers, size, choices))


def shade(cover: float) -> Picture:
    """A shadow on a side of the body, inside its outline."""
    dark = draw_capsule(SIZE, (115, 115), (115, 115), 70, (90, 40, 30), line=0)
    dark[:, :120] = 0
    dark[..., 3] = np.round(dark[..., 3] * cover)
    return dark


OVER_THE_BODY = {
    "an arm that sticks out": (ARM, "own"),
    "an arm within": (INNER, "own"),
    "an arm without ink that sticks out": (
        draw_capsule(SIZE, (70, 110), (215, 100), 16, line=0),
        "own",
    ),
    "a patch": (draw_capsule(SIZE, (85, 110), (145, 110), 16, line=0), "below"),
    "an eye": (draw_capsule(SIZE, (100, 80), (100, 80), 9, (255, 255, 255)), "below"),
    "a line": (draw_capsule(SIZE, (70, 110), (150, 110), 16, paint=False), "below"),
    "a shadow": (shade(1.0), "below"),
    "a glaze that sticks out": (np.roll(shade(0.5), 60, axis=1), "below"),
    "the same shape again": (draw_capsule(SIZE, (115, 115), (115, 115), 76, (9, 99, 200)), "below"),
    "a tile beside it": (draw_capsule(SIZE, (206, 100), (206, 130), 18, line=0), "below"),
    "a head": (draw_capsule(SIZE, (115, 50), (115, 50), 44), "below"),
    "something elsewhere": (draw_capsule(SIZE, (216, 196), (216, 196), 18), "own"),
}


@pytest.mark.parametrize("name", OVER_THE_BODY)
def test_layers_are_told_apart_by_how_they_overlap(name: str) -> None:
    picture, kind = OVER_THE_BODY[name]
    for factor in (1, 3):  # the same at every size
        planes = [np.kron(p, np.ones((factor, factor, 1), np.uint8)) for p in (BODY, picture)]
        cel = layered_cel(body=planes[0], other=planes[1])
        size = cel.pixels.shape[1], cel.pixels.shape[0]
        assert layer_kinds(cel.layers, size) == ("own", kind)


@pytest.mark.parametrize("kind", ["own", "below", "flat"])
def test_the_artists_choice_wins(kind: LayerKind) -> None:
    for picture, _ in OVER_THE_BODY.values():
        cel = layered_cel(body=BODY, other=picture)
        chosen = [LayerBody("other", kind), LayerBody("nobody", "own")]
        assert layer_kinds(cel.layers, SIZE, chosen) == ("own", kind)


def test_there_is_always_a_body() -> None:
    cel = layered_cel(body=BODY, arm=ARM)
    for kind in ("below", "flat"):
        chosen = [LayerBody(name, kind) for name in ("body", "arm")]  # type: ignore[arg-type]
        assert "own" in layer_kinds(cel.layers, SIZE, chosen)
        assert decompose_cel(cel, chosen).mask.any()


def test_the_whole_is_as_without_layers() -> None:
    cel = layered_cel(body=BODY, arm=ARM)
    plain, drawing = decompose_drawing(cel.pixels), decompose_cel(cel)
    assert [body.name for body in drawing.bodies] == ["body", "arm"]
    assert alike(plain, drawing)
    for alone in (replace(cel, layers=()), replace(cel, layers=cel.layers[:1])):
        assert decompose_cel(alone).bodies == ()
    joined = decompose_cel(cel, [LayerBody("arm", "below")])
    painted_on = decompose_cel(cel, [LayerBody("arm", "flat")])
    assert [body.name for body in joined.bodies + painted_on.bodies] == ["body"]
    assert alike(plain, joined)
    assert alike(plain, painted_on)


def alike(one: Drawing, other: Drawing) -> bool:
    planes = [name for name, value in vars(one).items() if isinstance(value, np.ndarray)]
    return all(np.array_equal(getattr(one, name), getattr(other, name)) for name in planes)


def placed(body: Body) -> NDArray[np.bool_]:
    mask = np.zeros(SIZE[::-1], bool)
    rows, columns = body.drawing.mask.shape
    whole = body.drawing.mask | body.rim
    mask[body.top : body.top + rows, body.left : body.left + columns] = whole
    return mask


def test_a_body_has_the_paint_that_others_cover() -> None:
    cel = layered_cel(body=BODY, arm=ARM)
    drawing = decompose_cel(cel)
    body, arm = drawing.bodies
    assert np.array_equal(placed(body), BODY[..., 3] >= 128)
    assert np.array_equal(placed(arm), ARM[..., 3] >= 128)
    row, column = 105 - body.top, 140 - body.left
    assert np.rint(255 * body.drawing.albedo[row, column]).tolist() == [200, 110, 60]
    assert body.drawing.ink[row, column] == 0


def test_bodies_cover_all_of_the_whole() -> None:
    soft = ARM.copy()
    soft[..., 3] = np.where(soft[..., 3] < 255, soft[..., 3] * 0.4, 255)
    faint = BODY.copy()
    faint[..., 3] = np.where(BODY[..., 3] < 255, BODY[..., 3] * 0.9, 255)
    halves = np.zeros_like(BODY)
    halves[20:30, 100:110] = 90, 90, 90, 120  # two faint spots that are one when painted
    cel = layered_cel(body=np.maximum(faint, halves), arm=np.maximum(soft, halves))
    drawing = decompose_cel(cel)
    assert drawing.mask[25, 105]
    covered = np.logical_or.reduce([placed(body) for body in drawing.bodies])
    assert np.array_equal(covered, drawing.mask)
    for body in drawing.bodies:
        assert ((body.drawing.labels >= 0) == body.drawing.mask).all()


def test_a_layer_that_moves_stays_the_same_body() -> None:
    moved = np.roll(ARM, (-20, -9), axis=(0, 1))
    _, before = decompose_cel(layered_cel(body=BODY, arm=ARM)).bodies
    _, after = decompose_cel(layered_cel(body=BODY, arm=moved)).bodies
    assert alike(before.drawing, after.drawing)
    assert (after.left - before.left, after.top - before.top) == (-9, -20)


def test_a_line_goes_to_the_body_that_it_surrounds() -> None:
    """Colours on layers of their own, and one layer with all of the line."""
    body = draw_capsule(SIZE, (115, 115), (115, 115), 75, (200, 110, 60), line=0)
    arm = draw_capsule(SIZE, (70, 110), (215, 100), 16, line=0)
    line = draw_capsule(SIZE, (115, 115), (115, 115), 75, paint=False)
    line[ARM[..., 3] > 0] = 0
    drawn = draw_capsule(SIZE, (70, 110), (215, 100), 16, paint=False)
    line = np.where(drawn[..., 3:] > 0, drawn, line)
    drawing = decompose_cel(layered_cel(body=body, arm=arm, line=line))
    under, over = drawing.bodies
    inked = np.zeros(SIZE[::-1], np.float32)
    rows, columns = over.drawing.ink.shape
    inked[over.top : over.top + rows, over.left : over.left + columns] = over.drawing.ink
    assert inked[(drawn[..., 3] == 255)].mean() > 0.9
    # None of the arm's line is drawn on the body under it.
    inner = drawn[..., 3] == 255
    inner &= np.hypot(*(np.mgrid[: SIZE[1], : SIZE[0]] + 0.5 - 115)) < 65
    rows, columns = np.nonzero(inner)
    assert under.drawing.ink[rows - under.top, columns - under.left].max() < 0.1


def test_an_open_outline_is_a_joint() -> None:
    arm = draw_capsule(SIZE, (70, 110), (200, 110), 16, open_before=80)
    joint = joint_of(decompose_drawing(arm))
    assert joint[110, 57] > 0.9
    assert joint[110, 110:].max() == 0
    for closed in (ARM, draw_capsule(SIZE, (70, 110), (200, 110), 16, line=0)):
        assert joint_of(decompose_drawing(closed)).max() == 0


def test_layers_in_planes_are_reduced_with_them() -> None:
    cel = layered_cel(body=BODY, arm=ARM)
    planes = DrawingPlanes(cel.pixels, layers=cel.layers)
    small = planes.reduced(2)
    assert [body.name for body in small.decompose().bodies] == ["body", "arm"]
    for layer, reduced in zip(cel.layers, small.layers, strict=True):
        assert reduced.left == layer.left // 2
        assert reduced.top == layer.top // 2
    assert small.nbytes < planes.nbytes / 3
    assert planes.nbytes > cel.pixels.nbytes


def test_an_empty_layer_is_none() -> None:
    assert cropped_layer("empty", np.zeros_like(BODY)) is None
    layer = cropped_layer("arm", ARM)
    assert layer is not None
    assert np.array_equal(layer.placed(SIZE)[ARM[..., 3] > 0], ARM[ARM[..., 3] > 0])
    specks = np.zeros_like(BODY)
    specks[3, 3] = 255
    cel: Cel = layered_cel(body=BODY, dust=specks, arm=ARM)
    assert [body.name for body in decompose_cel(cel).bodies] == ["body", "arm"]
