"""Reference pages: what is committed is what the commands and the types generate."""

from __future__ import annotations

import runpy

from support.paths import ROOT


def test_what_is_committed_is_what_the_commands_and_types_generate() -> None:
    """``make schema`` writes them."""
    pages = runpy.run_path(str(ROOT / "scripts" / "reference.py"))["reference"]()
    folder = ROOT / "docs" / "reference"
    assert {name: (folder / name).read_text(encoding="utf-8") for name in pages} == pages
