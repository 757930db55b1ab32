"""Light gathered in pieces is the light that is traced at once."""

from __future__ import annotations

import numpy as np
import pytest

from lampblack.errors import RenderError
from lampblack.render import Expose, RenderChild, Surface
from lampblack.scene import AreaLight, Canvas, Floor
from support.surfaces import ball

SURFACE: Surface = ball(64, 64, (32, 28), 20, gloss=0.4)


def exposure(subject: str, first: int, count: int, *, develop: bool) -> Expose:
    return Expose(
        canvas=Canvas(64, 64),
        view=(0, 0, 64, 64),
        size=(48, 48),
        light=AreaLight(10, 8, 40, 12),
        floor=Floor(52) if subject == "floor" else None,
        subject=subject,  # type: ignore[arg-type]
        spp=6,
        first=first,
        count=count,
        develop=develop,
    )


@pytest.mark.parametrize("subject", ["character", "floor"])
def test_pieces_add_up_to_the_whole(child: RenderChild, subject: str) -> None:
    whole = child.expose(SURFACE, exposure(subject, 0, 6, develop=True))
    assert child.expose(SURFACE, exposure(subject, 0, 1, develop=False)) == ()
    early = child.expose(SURFACE, exposure(subject, 1, 2, develop=True))
    child.expose(SURFACE, exposure(subject, 3, 3, develop=False))
    pieces = child.expose(SURFACE, exposure(subject, 6, 0, develop=True))
    for one, other in zip(whole, pieces, strict=True):
        assert one.shape == (48, 48, 3)
        assert np.abs(one - other).max() < 1e-3
    assert np.abs(early[0] - whole[0]).max() > 1e-3


def test_an_exposure_that_is_not_at_hand_is_refused(child: RenderChild) -> None:
    child.expose(SURFACE, exposure("character", 0, 1, develop=False))
    with pytest.raises(RenderError):
        child.expose(SURFACE, exposure("character", 3, 1, develop=True))
    with pytest.raises(RenderError):
        child.expose(SURFACE, exposure("floor", 1, 1, develop=True))
    assert len(child.expose(SURFACE, exposure("character", 0, 1, develop=True))) == 2
