"""The choice of a device: cards are tried once, and what is wrong is not used."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest

from lampblack.farm.tasks import on_one_device
from lampblack.finals.png import save_png
from lampblack.finals.settings import RenderSettings
from lampblack.finals.targets import Targets, device_stamp
from lampblack.render.device import DRIVERS, Card, Memory, Verdict, choose
from lampblack.render.light_pass_cache import LightPassCache
from lampblack.render.passes import LightPasses, Passes
from lampblack.scene import Scene, default_scene
from lampblack.shot import ShotFrame

OLD, NEW = Card("cuda", "Old", "0"), Card("optix", "New", "1")
RIGHT = Verdict("right", denoises=True)
WRONG = Verdict("wrong", why="a test picture on it came out wrong.")


class Machine:
    """A machine with ``cards``, which are tried with these results."""

    def __init__(self, *cards: Card, **results: Verdict | Exception) -> None:
        self.cards, self.results = cards, results
        self.tried: list[str] = []

    def find(self) -> Sequence[Card]:
        return self.cards

    def judge(self, card: Card) -> Verdict:
        self.tried.append(card.name)
        result = self.results.get(card.name, RIGHT)
        if isinstance(result, BaseException):
            raise result
        return result


def test_the_processor_is_chosen_without_a_look_at_cards(tmp_path: Path) -> None:
    machine = Machine(OLD)
    assert choose("cpu", machine.find, machine.judge, tmp_path / "m.json").card is None
    assert not machine.tried
    assert not list(tmp_path.iterdir())


def test_a_machine_without_cards_uses_the_processor_in_silence(tmp_path: Path) -> None:
    machine = Machine()
    choice = choose("auto", machine.find, machine.judge, tmp_path / "m.json")
    assert (choice.card, choice.notice) == (None, "")
    named = choose("optix", machine.find, machine.judge, tmp_path / "m.json")
    assert named.card is None
    assert "no graphics card for optix" in named.notice


def test_the_best_right_card_is_chosen_and_tried_once(tmp_path: Path) -> None:
    machine = Machine(OLD, NEW)
    for _ in range(2):
        choice = choose("auto", machine.find, machine.judge, tmp_path / "m.json")
        assert (choice.card, choice.denoises, choice.notice) == (NEW, True, "")
    assert machine.tried == ["New"]
    assert choose("cuda", machine.find, machine.judge, tmp_path / "m.json").card == OLD


@pytest.mark.parametrize("result", [WRONG, RuntimeError("asleep")])
def test_a_wrong_card_is_told_once_and_never_used(
    tmp_path: Path, result: Verdict | Exception
) -> None:
    machine = Machine(OLD, New=result, Old=result)
    first, second = (
        choose("auto", machine.find, machine.judge, tmp_path / "m.json") for _ in range(2)
    )
    assert first.card is second.card is None
    assert first.notice.startswith("Old (cuda) is not used: a test picture on it")
    assert first.notice.endswith("The processor is used.")
    assert second.notice == ""
    assert machine.tried == ["Old"]
    named = choose("cuda", machine.find, machine.judge, tmp_path / "m.json")
    assert named.card is None
    assert "Old" in named.notice  # who names it is told each time
    better = Machine(OLD, NEW, Old=result)
    assert choose("auto", better.find, better.judge, tmp_path / "m.json").card == NEW


def test_what_ended_the_process_is_not_tried_again(tmp_path: Path) -> None:
    class Ended(BaseException):
        pass

    path = tmp_path / "m.json"
    machine = Machine(OLD, Old=Ended())  # type: ignore[arg-type]
    with pytest.raises(Ended):
        choose("auto", machine.find, machine.judge, path)
    after = choose("auto", machine.find, machine.judge, path)
    assert "ended the renderer" in after.notice
    assert machine.tried == ["Old"]

    def broken() -> Sequence[Card]:
        raise Ended

    path.unlink()
    with pytest.raises(Ended):
        choose("auto", broken, machine.judge, path)
    assert choose("auto", broken, machine.judge, path).notice.startswith("The search for graphics")
    assert choose("auto", broken, machine.judge, path).notice == ""


def test_a_search_that_fails_is_told_in_one_sentence(tmp_path: Path) -> None:
    def failing() -> Sequence[Card]:
        raise RuntimeError("no driver")

    choice = choose("auto", failing, Machine().judge, tmp_path / "m.json")
    assert choice.notice == "The graphics cards could not be listed: no driver. " + (
        "The processor is used."
    )


def test_another_driver_is_another_trial_and_a_spoiled_memory_none(tmp_path: Path) -> None:
    path = tmp_path / "m.json"
    Memory(path, "before").remember(DRIVERS, WRONG)
    assert Memory(path, "before").verdict(DRIVERS) == WRONG
    assert Memory(path, "after").verdict(DRIVERS) is None
    for spoiled in (b"", b"[1]", b'["before", {"drivers": {"outcome": "fine"}}]'):
        path.write_bytes(spoiled)
        assert Memory(path, "before").verdict(DRIVERS) is None
    folder = Path("/proc")  # where nothing can be kept
    assert choose("auto", Machine(OLD).find, Machine(OLD).judge, folder / "m.json").card == OLD


def test_two_programs_do_not_try_a_card_at_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    fcntl = pytest.importorskip("fcntl")
    monkeypatch.setattr("lampblack.render.device.WAIT_SECONDS", 0.2)
    path, machine = tmp_path / "m.json", Machine(OLD)
    lock = os.open(tmp_path / "m.lock", os.O_RDWR | os.O_CREAT)
    fcntl.flock(lock, fcntl.LOCK_EX)
    choice = choose("auto", machine.find, machine.judge, path)
    os.close(lock)
    assert choice.card is None
    assert "another program" in choice.notice
    assert choose("auto", machine.find, machine.judge, path).card == OLD


def test_files_of_another_device_are_up_to_date_only_for_auto(tmp_path: Path) -> None:
    targets, frame = Targets(str(tmp_path)), ShotFrame(1, "a.png", "a")
    picture = np.zeros((2, 2, 4), np.uint8)
    save_png(targets.path(frame), picture, device_stamp("stamp", "optix"))
    assert targets.holds(frame, "stamp", "auto") == "optix"
    assert targets.holds(frame, "stamp", "optix") == "optix"
    assert targets.holds(frame, "stamp", "cpu") is None
    assert targets.holds(frame, "other", "auto") is None
    save_png(targets.path(frame), picture, device_stamp("stamp", "cpu"))
    assert targets.holds(frame, "stamp", "cpu") == "cpu"
    assert targets.holds(frame, "stamp", "cuda") is None


def test_tasks_of_several_machines_name_one_device() -> None:
    settings = RenderSettings(inputs=("a",), output="b")
    assert "--device=auto" in settings.arguments()
    assert on_one_device(settings).device == "cpu"
    named = RenderSettings(inputs=("a",), output="b", device="optix")
    assert on_one_device(named) == named


def test_one_picture_has_the_light_of_one_device() -> None:
    cache, drawing = LightPassCache(), object()
    scene = default_scene(8, 8)
    moved = Scene(scene.canvas, (scene.lights[0].__class__(1, 2, 3),))
    light = LightPasses(np.zeros((1, 1, 3), np.float32), np.zeros((1, 1, 3), np.float32))
    asked: list[bool] = []

    def on(device: str, scene: Scene) -> Passes:
        def trace(wanted: Scene, ambient: bool, glows: object) -> Passes:
            asked.append(ambient)
            return Passes(tuple(light for _ in wanted.lights), light, device=device)  # type: ignore[arg-type]

        return cache.complete(drawing, scene, trace)

    assert on("cuda", scene).device == "cuda"
    assert on("cuda", moved).device == "cuda"
    assert asked == [True, False]
    assert on("cpu", scene).device == "cpu"  # the card was given up: ambient light is traced again
    assert asked == [True, False, False, True]
