"""Documentation: every relative link leads to a place, every picture says what it shows."""

from __future__ import annotations

import re
import runpy
from pathlib import Path

import pytest

from support.paths import ROOT

PAGES = sorted({*ROOT.glob("*.md"), *ROOT.glob("docs/**/*.md"), *ROOT.glob("protocol/*.md")})
pages = pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)


def _prose(page: Path) -> str:
    """The text without its code, which may have brackets of its own."""
    text = page.read_text(encoding="utf-8")
    return re.sub(r"```.*?```|^    .*?$|`[^`\n]*`", "", text, flags=re.DOTALL | re.MULTILINE)


def _anchors(page: Path) -> set[str]:
    """The anchors of a page's headings, as GitHub and the site name them."""
    headings = re.findall(r"^#+ (.+)$", page.read_text(encoding="utf-8"), flags=re.MULTILINE)
    plain = (re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", heading).lower() for heading in headings)
    return {re.sub(r"[^\w\- ]", "", heading).strip().replace(" ", "-") for heading in plain}


@pages
def test_every_link_leads_to_a_place(page: Path) -> None:
    dead = []
    for link in re.findall(r"\]\(([^)\s]+)[^)]*\)", _prose(page)):
        if "://" in link:
            continue
        file, _, anchor = link.partition("#")
        target = page.parent / file if file else page
        if not target.exists() or (anchor and anchor not in _anchors(target)):
            dead.append(link)
    assert dead == []


@pages
def test_every_picture_says_what_it_shows(page: Path) -> None:
    assert re.findall(r"!\[\s*\]\([^)]*\)|<img(?![^>]*\balt=\"[^\"]+\")[^>]*>", _prose(page)) == []


def test_every_picture_is_shown_somewhere() -> None:
    shown = {
        (page.parent / link).resolve()
        for page in PAGES
        for link in re.findall(r"!\[[^]]*\]\(([^)\s]+)\)", page.read_text(encoding="utf-8"))
    }
    assert {*(ROOT / "docs" / "images").iterdir()} - shown == set()


def test_it_is_known_how_every_picture_is_made() -> None:
    pictures = runpy.run_path(str(ROOT / "scripts" / "pictures"))
    made = [name for recipe in pictures["RECIPES"] for name in recipe.names]
    assert sorted(made) == sorted(path.name for path in (ROOT / "docs" / "images").iterdir())
