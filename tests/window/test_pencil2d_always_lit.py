"""The canvas is never the plain drawing once it is lit, whatever the artist does.

The window's own pixels are looked at every 20 ms and after each paint, during the whole action.
Plain is a canvas where as many pixels as in the drawing have exactly the drawing's flat colours.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from support.lamp import keep, light_up, settled
from support.window import Pencil2D, wait_until

FUR = "#4f8fb3"
WHILE_PLAIN = 0.4
"""Of the flat pixels of a plain drawing: more of them mean that it is not lit."""


def plain_share(window: Pencil2D) -> float:
    """The share of the canvas that has exactly the flat colours while the lamp is not in use."""
    window.watch([FUR])
    seen = wait_until(lambda: window.watch([FUR]), "a look at the canvas")
    window.watch([])
    share = seen[-1][1]
    assert share > 0.02, "the figure is in sight"
    return float(share)


@contextmanager
def staying_lit(window: Pencil2D, plain: float) -> Iterator[None]:
    """No look at the canvas finds it plain."""
    window.watch([FUR])
    yield
    looks = window.watch([])
    assert looks
    flat = [
        (round(at), round(share / plain, 2)) for at, share in looks if share > WHILE_PLAIN * plain
    ]
    assert not flat, f"plain at (ms, share) {flat[:20]} of {len(looks)} looks"


def is_ready(window: Pencil2D) -> bool:
    return bool(window.value("lampblack.panel.worker", "text") == "Ready")


@pytest.fixture
def plain(window: Pencil2D) -> float:
    """The share of flat pixels in the plain drawing; then the canvas is lit."""
    share = plain_share(window)
    light_up(window)
    return share


def test_selecting_and_deselecting(window: Pencil2D, plain: float) -> None:
    with staying_lit(window, plain):
        window.trigger("actionSelect_All")
        window.trigger("actionDeselect_All")
        wait_until(lambda: not is_ready(window), "the drawing to be read again", 10)
        wait_until(lambda: is_ready(window), "the light", 30)
        settled(window)
    keep(window, "deselected")


def test_saving_under_another_name(window: Pencil2D, plain: float, tmp_path: Path) -> None:
    with staying_lit(window, plain):
        window.trigger("actionSave_as")
        dialog = wait_until(lambda: window.of_class("QFileDialog"), "the file dialog")
        assert dialog["seen"]
        window.display.do("type", "--delay", "5", str(tmp_path / "other.pclx"))
        window.key("Return")
        wait_until((tmp_path / "other.pclx").exists, "the file")
        wait_until(lambda: not window.of_class("QFileDialog"), "the end of the dialog")
        wait_until(lambda: is_ready(window), "the light", 30)
        settled(window)
    keep(window, "saved as")
