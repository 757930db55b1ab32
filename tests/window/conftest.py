"""A display for all tests of the window, and one Pencil2D for those not about its start or end."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from support.lamp import project_in
from support.window import Display, Pencil2D, SharedPencil2D


@pytest.fixture(scope="session")
def display(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Display]:
    shown = Display(tmp_path_factory.mktemp("display"))
    yield shown
    shown.close()


@pytest.fixture(scope="session")
def session_pencil2d(
    display: Display, tmp_path_factory: pytest.TempPathFactory
) -> Iterator[SharedPencil2D]:
    shared = SharedPencil2D(display, tmp_path_factory.mktemp("pencil2d"))
    yield shared
    shared.close()


@pytest.fixture
def shared(
    session_pencil2d: SharedPencil2D, request: pytest.FixtureRequest
) -> Iterator[SharedPencil2D]:
    """For a test that is not about starting or closing Pencil2D."""
    failed = request.session.testsfailed
    yield session_pencil2d
    if request.session.testsfailed > failed:
        session_pencil2d.close()


@pytest.fixture
def window(shared: SharedPencil2D, tmp_path: Path) -> Pencil2D:
    """The example, in the shared Pencil2D."""
    return shared.open(project_in(tmp_path))
