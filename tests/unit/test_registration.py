"""What tests of the window measure pictures with."""

from __future__ import annotations

import numpy as np
import pytest
from PIL import Image

from support.paths import ROOT
from support.registration import offset


def test_offsets_are_seen() -> None:
    """What the test above measures with."""
    picture = np.asarray(Image.open(ROOT / "docs" / "images" / "lamplighter.png").convert("RGB"))
    left = picture[:400, :400]
    assert offset(left, picture[2:402, 3:403]) == pytest.approx((-3, -2), abs=0.1)
    half = (picture[:400, :400].astype(int) + picture[:400, 1:401]) // 2
    assert offset(left, half.astype(np.uint8)) == pytest.approx((-0.5, 0), abs=0.1)
