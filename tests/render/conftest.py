"""One renderer and one worker for all tests that do not end them."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from lampblack.render.client import RenderChild
from lampblack.service.client import Worker


@pytest.fixture(scope="session")
def child() -> Iterator[RenderChild]:
    with RenderChild() as child:
        yield child


@pytest.fixture(scope="session")
def worker(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Worker]:
    folder = tmp_path_factory.mktemp("worker")
    with Worker(folder, environment={"XDG_CACHE_HOME": str(folder / "cache")}) as worker:
        yield worker
