"""What is around the code says the same as the code: versions, licences, checks."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path
from xml.etree import ElementTree

import pytest
import yaml

from lampblack import __version__
from support.paths import ROOT

METAINFO = ROOT / "packaging" / "org.lampblack.Pencil2D.metainfo.xml"


def test_a_citation_names_this_version() -> None:
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    assert citation["version"] == __version__
    releases = ElementTree.parse(METAINFO).findall("releases/release")
    assert (releases[0].get("version"), releases[0].get("date")) == (
        __version__,
        citation["date-released"],
    )


@pytest.mark.skipif(not shutil.which("appstreamcli"), reason="appstream is not installed")
def test_the_entry_in_software_catalogues_is_valid() -> None:
    subprocess.run(["appstreamcli", "validate", "--no-net", METAINFO], check=True)


def test_every_locked_package_has_its_licence_told() -> None:
    page = (ROOT / "docs" / "licences.md").read_text(encoding="utf-8")
    told = set(re.findall(r"`([a-z0-9-]+)`", page.partition("## What the network")[0]))
    locks = "\n".join(lock.read_text() for lock in (ROOT / "requirements").glob("python*.txt"))
    assert set(re.findall(r"^([a-z0-9-]+)==", locks, re.MULTILINE)) - told == set()


def test_the_workflow_does_what_ci_does() -> None:
    text = (ROOT / ".github" / "workflows" / "test.yml").read_text(encoding="utf-8")
    assert yaml.safe_load(text)["jobs"]["test"]["steps"][-1] == {"run": ".ci/run"}


@pytest.mark.parametrize("form", sorted((ROOT / ".github" / "ISSUE_TEMPLATE").iterdir()))
def test_an_issue_form_has_what_github_asks_for(form: Path) -> None:
    fields = yaml.safe_load(form.read_text(encoding="utf-8"))
    assert {"name", "description", "body"} <= set(fields)
    for field in fields["body"]:
        assert field["type"] in ("markdown", "textarea", "input", "dropdown", "checkboxes")
        assert field["attributes"].get("label") or field["type"] == "markdown"
