"""A display for all tests of the window, and the example opened in it."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from support.lamp import project_in
from support.window import Display, Pencil2D, pencil2d


@pytest.fixture(scope="session")
def display(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Display]:
    shown = Display(tmp_path_factory.mktemp("display"))
    yield shown
    shown.close()


@pytest.fixture
def window(display: Display, tmp_path: Path) -> Iterator[Pencil2D]:
    with pencil2d(display, tmp_path, project_in(tmp_path)) as program:
        yield program
