"""The pages that say what was tried name tests that there are."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

TESTS = Path(__file__).parents[1]
RESEARCH = TESTS.parent / "docs" / "research"


@pytest.mark.parametrize(("page", "fewest"), [("attacks", 50), ("inputs", 50), ("systems", 30)])
def test_every_row_names_a_test(page: str, fewest: int) -> None:
    text = (RESEARCH / f"{page}.md").read_text()
    rows = [row for row in text.splitlines() if re.match(r"\| [A-Z]?\d+ \|", row)]
    assert len(rows) >= fewest
    for row in rows:
        named = re.findall(r"`([\w/]+)::(\w+)`", row.split("|")[-2])
        assert named, row
        for file, test in named:
            (source,) = [path for path in TESTS.glob(f"{file}.*") if path.suffix in (".py", ".cpp")]
            wanted = f"def test_{test}(" if source.suffix == ".py" else f"void {test}("
            assert wanted in source.read_text(), f"{file}::{test}"
