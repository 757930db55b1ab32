"""Graphics cards: a render child with one that is none, and the search of this machine."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

from lampblack.drawing import save_picture
from lampblack.errors import LampblackWarning, RenderError
from lampblack.finals.png import png_stamp
from lampblack.render.client import RenderChild
from lampblack.render.quality import Quality, Sampling
from lampblack.render.request import RenderRequest
from lampblack.render.survey import survey
from lampblack.scene import AreaLight, Canvas
from support import fake_card
from support.command_line import Run
from support.drawings import draw_ball
from support.surfaces import ball

SAMPLING = Sampling(1, 64, 8)
REQUEST = RenderRequest(
    ball(48, 48, (24, 24), 20, gloss=0.5),
    Canvas(48, 48),
    (AreaLight(8, 8, 40),),
    quality=Quality(SAMPLING, SAMPLING, SAMPLING, 1),
)


@pytest.fixture
def paper_card(own_cache: Path, monkeypatch: pytest.MonkeyPatch) -> pytest.MonkeyPatch:
    return monkeypatch


def behave(monkeypatch: pytest.MonkeyPatch, behaviour: str) -> None:
    command = (sys.executable, "-P", str(fake_card.__file__), behaviour)
    monkeypatch.setattr("lampblack.render.client.COMMAND", command)
    monkeypatch.setattr("lampblack.render.survey.COMMAND", command)


def test_a_right_card_is_used_with_its_denoiser(
    paper_card: pytest.MonkeyPatch, child: RenderChild
) -> None:
    expected = child.render(REQUEST)
    assert expected.device == "cpu"
    behave(paper_card, "right")
    with RenderChild(device="auto") as card:
        assert (card.device().device, card.device().name) == ("cuda", "Paper Card")
        found = card.render(REQUEST)
    assert found.device == "cuda"
    # The denoiser's way through a card's memory loses nothing.
    assert np.array_equal(found.lights[0].diffuse, expected.lights[0].diffuse)
    assert np.array_equal(found.lights[0].glossy, expected.lights[0].glossy)
    with RenderChild(device="cpu") as processor:
        assert processor.device().device == "cpu"


@pytest.mark.parametrize(
    ("behaviour", "told"),
    [
        ("black", "a test picture on it came out wrong"),
        ("fails", "a test picture on it failed: the card is asleep"),
        ("search fails", "could not be listed: the driver is older than the card"),
    ],
)
def test_a_wrong_card_is_replaced_by_the_processor(
    paper_card: pytest.MonkeyPatch, behaviour: str, told: str
) -> None:
    behave(paper_card, behaviour)
    with RenderChild(device="auto") as card:
        with pytest.warns(LampblackWarning, match=told):
            assert card.render(REQUEST).device == "cpu"
        assert card.render(REQUEST).device == "cpu"  # and is told once
    with RenderChild(device="auto") as card:
        assert card.render(REQUEST).device == "cpu"
    with RenderChild(device="cuda") as card, pytest.raises(RenderError) as refused:
        card.require_device()
    assert told in refused.value.what


@pytest.mark.parametrize("behaviour", ["search dies", "dies"])
def test_a_driver_that_ends_the_renderer_is_left_alone_from_then_on(
    paper_card: pytest.MonkeyPatch, behaviour: str
) -> None:
    behave(paper_card, behaviour)
    with RenderChild(device="auto") as card:
        with pytest.raises(RenderError):
            card.render(REQUEST)
        assert card.render(REQUEST).device == "cpu"
    with RenderChild(device="auto") as card, pytest.warns(LampblackWarning, match="The processor"):
        assert card.render(REQUEST).device == "cpu"


@pytest.mark.parametrize("behaviour", ["dies later", "fails later"])
def test_a_card_that_dies_in_a_job_costs_no_frame(
    run: Run, paper_card: pytest.MonkeyPatch, tmp_path: Path, behaviour: str
) -> None:
    behave(paper_card, behaviour)
    (tmp_path / "walk").mkdir()
    for number in (1, 2):
        save_picture(tmp_path / "walk" / f"w.{number}.png", draw_ball(40 + number))
    words = ("render", tmp_path / "walk", "-o", tmp_path / "lit")
    done = run(*words, "--device", "cuda")
    assert done.code == 0
    assert done.err.count("From now on the processor is used.") == 1
    assert "Frames of several devices: 1 on cuda, 1 on cpu." in done.err
    stamps = [png_stamp(tmp_path / "lit" / f"w.{number}.png") or "" for number in (1, 2)]
    assert [stamp.endswith(" cuda") for stamp in stamps] == [True, False]
    kept = run(*words)
    assert "2 of 2 frames" in kept.err
    assert "2 of them from before" in kept.err


@pytest.mark.parametrize("command", ["render", "estimate"])
def test_a_named_device_that_is_not_there_is_refused(
    run: Run, tmp_path: Path, command: str
) -> None:
    save_picture(tmp_path / "a.png", draw_ball(40))
    target = ("-o", tmp_path / "lit") if command == "render" else ()
    told = run(command, tmp_path / "a.png", *target, "--device", "metal")
    assert told.code == 1
    assert "no graphics card for metal" in told.err
    assert not told.out
    assert not list((tmp_path / "lit").glob("*.png"))


def test_the_survey_blames_each_crash_on_its_card(paper_card: pytest.MonkeyPatch) -> None:
    behave(paper_card, "no denoiser")
    (found,) = survey()
    assert (found.card, found.verdict.outcome, found.verdict.denoises) == (
        fake_card.CARD, "right", False,
    )  # fmt: skip
    behave(paper_card, "dies")
    (found,) = survey()
    assert found.verdict.outcome == "wrong"
    behave(paper_card, "search dies")
    with pytest.raises(RenderError, match="could not be listed"):
        survey()
