"""Light gathered in pieces is the light that is traced at once."""

from __future__ import annotations

import numpy as np
import pytest

from lampblack.errors import RenderError
from lampblack.render.client import RenderChild
from lampblack.render.request import Surface
from lampblack.render.wire import Accumulate
from lampblack.scene import AreaLight, Canvas, Floor
from support.surfaces import ball

SURFACE: Surface = ball(64, 64, (32, 28), 20, gloss=0.4)


def accumulation(subject: str, first: int, count: int, *, resolve: bool) -> Accumulate:
    return Accumulate(
        canvas=Canvas(64, 64),
        view=(0, 0, 64, 64),
        size=(48, 48),
        light=AreaLight(10, 8, 40, 12),
        floor=Floor(52) if subject == "floor" else None,
        subject=subject,  # type: ignore[arg-type]
        spp=6,
        first=first,
        count=count,
        resolve=resolve,
    )


@pytest.mark.parametrize("subject", ["character", "floor"])
def test_pieces_add_up_to_the_whole(child: RenderChild, subject: str) -> None:
    whole = child.accumulate(SURFACE, accumulation(subject, 0, 6, resolve=True))
    assert child.accumulate(SURFACE, accumulation(subject, 0, 1, resolve=False)) == ()
    early = child.accumulate(SURFACE, accumulation(subject, 1, 2, resolve=True))
    child.accumulate(SURFACE, accumulation(subject, 3, 3, resolve=False))
    pieces = child.accumulate(SURFACE, accumulation(subject, 6, 0, resolve=True))
    for one, other in zip(whole, pieces, strict=True):
        assert one.shape == (48, 48, 3)
        assert np.abs(one - other).max() < 1e-3
    assert np.abs(early[0] - whole[0]).max() > 1e-3


def test_an_accumulation_that_is_not_the_current_one_is_refused(child: RenderChild) -> None:
    child.accumulate(SURFACE, accumulation("character", 0, 1, resolve=False))
    with pytest.raises(RenderError):
        child.accumulate(SURFACE, accumulation("character", 3, 1, resolve=True))
    with pytest.raises(RenderError):
        child.accumulate(SURFACE, accumulation("floor", 1, 1, resolve=True))
    assert len(child.accumulate(SURFACE, accumulation("character", 0, 1, resolve=True))) == 2
