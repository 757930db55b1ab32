"""The pages that say what was tried name tests that there are."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

TESTS = Path(__file__).parents[1]
PAGES = [TESTS.parent / "docs" / "research" / f"{name}.md" for name in ("attacks", "inputs")]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_every_row_names_a_test(page: Path) -> None:
    rows = [row for row in page.read_text().splitlines() if re.match(r"\| [A-Z]?\d+ \|", row)]
    assert len(rows) >= 50
    for row in rows:
        named = re.findall(r"`([\w/]+)::(\w+)`", row.split("|")[-2])
        assert named, row
        for file, test in named:
            (source,) = [path for path in TESTS.glob(f"{file}.*") if path.suffix in (".py", ".cpp")]
            wanted = f"def test_{test}(" if source.suffix == ".py" else f"void {test}("
            assert wanted in source.read_text(), f"{file}::{test}"
