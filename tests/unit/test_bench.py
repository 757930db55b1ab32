"""Benchmarks: what is compared, and what a shot will cost."""

from __future__ import annotations

import sys
from pathlib import Path

import msgspec
import numpy as np
import pytest

from lampblack.bench.compare import alternate, installed, ratios
from lampblack.errors import LampblackError
from support.command_line import Run


def test_a_busy_machine_does_not_change_the_ratio() -> None:
    """Both versions are slowed alike within a round: the other is always twice as slow."""
    rng = np.random.default_rng(0)
    busy = np.exp(rng.normal(0, 1, 6))
    pairs = [({"seconds": b, "here": 1.0}, {"seconds": 2 * b, "there": 1.0}) for b in busy]
    found = ratios(pairs)
    assert list(found) == ["seconds"]
    assert found["seconds"].ratio == pytest.approx(0.5)
    assert found["seconds"].low == pytest.approx(0.5)
    assert found["seconds"].there == pytest.approx(2 * np.median(busy))


def test_the_interval_holds_the_true_ratio_as_often_as_it_says() -> None:
    rng = np.random.default_rng(1)
    held = 0
    for _ in range(400):
        noise = np.exp(rng.normal(0, 0.2, (5, 2)))
        found = ratios([({"s": 0.8 * a}, {"s": b}) for a, b in noise])["s"]
        held += found.low < 0.8 < found.high
    assert 0.92 < held / 400 < 0.98


def test_figures_that_have_no_ratio_are_left_out() -> None:
    pairs = [({"lost": 0.0, "s": 1.0}, {"lost": 3.0, "s": 1.0})] * 2
    assert list(ratios(pairs)) == ["s"]


def test_both_take_turns_in_being_first() -> None:
    order: list[str] = []

    def measured(name: str) -> dict[str, float]:
        order.append(name)
        return {name: len(order)}

    rounds = list(alternate(lambda: measured("here"), lambda: measured("there"), 3))
    assert order == ["here", "there", "there", "here", "here", "there"]
    assert [set(a) | set(b) for a, b in rounds] == [{"here", "there"}] * 3
    assert all("here" in a for a, _ in rounds)


def _fake(folder: Path, body: str) -> Path:
    """A virtual environment whose ``lampblack`` is a few lines."""
    program = folder / "bin" / "lampblack"
    program.parent.mkdir(parents=True)
    program.write_text(f"#!{sys.executable}\n{body}\n")
    program.chmod(0o755)
    return folder


def test_an_installed_version_is_measured_with_the_same_arguments(tmp_path: Path) -> None:
    echo = "import sys, json; print(json.dumps({' '.join(sys.argv[1:]): 2.0}))"
    assert installed(_fake(tmp_path, echo), ["final", "a b.png"])() == {
        "bench final a b.png --json": 2.0
    }


@pytest.mark.parametrize("body", ["import sys; sys.exit('no such stage')", "print('fast')"])
def test_a_version_that_cannot_be_measured_is_named(tmp_path: Path, body: str) -> None:
    with pytest.raises(LampblackError, match="could not be measured"):
        installed(_fake(tmp_path, body), ["final"])()
    with pytest.raises(LampblackError, match="There is no lampblack"):
        installed(tmp_path / "none", ["final"])


def test_the_command_compares(run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    figures = 'print(\'{{"seconds_direct": {}, "{}": 1}}\')'
    here = _fake(tmp_path / "here", figures.format(3.0, "here"))
    there = _fake(tmp_path / "there", figures.format(4.0, "there"))
    monkeypatch.setattr(sys, "prefix", str(here))
    shown = run("bench", "inflate", "--compare", there, "--rounds", "2")
    assert shown.code == 0
    assert "0.750" in shown.out
    assert "0.750 to 0.750" in shown.out
    found = msgspec.json.decode(run("bench", "inflate", "--compare", there, "--json").out)
    assert list(found) == ["seconds_direct"]
    assert found["seconds_direct"] == {
        "here": 3,
        "there": 4,
        "ratio": 0.75,
        "low": 0.75,
        "high": 0.75,
    }
