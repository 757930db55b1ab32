"""The locked versions: complete, and free of this or that machine."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

import pytest
from packaging.requirements import Requirement

ROOT = Path(__file__).parents[2]
APART = {lock.stem: lock for lock in (ROOT / "requirements").glob("*-torch.txt")}
LOCKS = [lock for lock in (ROOT / "requirements").glob("python*.txt") if lock not in APART.values()]
DOCS = ROOT / "requirements" / "docs.txt"
ENTRY = r"[a-z0-9-]+==\S+(\s+--hash=sha256:[0-9a-f]{64})+\s*"


def _versions(*files: Path) -> dict[str, str]:
    text = "\n".join(file.read_text() for file in files)
    return dict(re.findall(r"^([a-z0-9-]+)==(\S+)", text, re.MULTILINE))


@pytest.mark.parametrize("lock", LOCKS, ids=lambda lock: lock.stem)
def test_lock_meets_every_requirement(lock: Path) -> None:
    versions = _versions(lock, APART[f"{lock.stem}-torch"])
    python = {"python_version": lock.stem.removeprefix("python")}
    read = tomllib.loads((ROOT / "pyproject.toml").read_text())
    wanted = read["build-system"]["requires"] + read["project"]["dependencies"]
    for extra in read["project"]["optional-dependencies"].values():
        wanted += extra
    for line in wanted:
        requirement = Requirement(line)
        here = requirement.marker is None or requirement.marker.evaluate(python)
        if requirement.name != "lampblack" and here:
            version = versions.get(requirement.name.lower().replace("_", "-"), "0")
            assert version in requirement.specifier, f"{line}: run make lock"


@pytest.mark.parametrize("lock", LOCKS, ids=lambda lock: lock.stem)
def test_lock_names_hashes_and_no_machine(lock: Path) -> None:
    for entry in lock.read_text().replace("\\\n", "").splitlines():
        assert re.fullmatch(ENTRY, entry), entry
    for entry in APART[f"{lock.stem}-torch"].read_text().splitlines():
        assert re.fullmatch(r"[a-z0-9-]+==[0-9.]+", entry), entry


def test_the_lock_of_the_site_meets_its_group() -> None:
    versions = _versions(DOCS)
    groups = tomllib.loads((ROOT / "pyproject.toml").read_text())["dependency-groups"]
    for requirement in map(Requirement, groups["docs"]):
        assert versions[requirement.name] in requirement.specifier, f"{requirement}: make lock"
    for entry in DOCS.read_text().replace("\\\n", "").splitlines():
        assert re.fullmatch(ENTRY, entry), entry
