"""The simulated farm: cases whose answer is known."""

from __future__ import annotations

from dataclasses import replace

import pytest

from lampblack_research.farm.simulation import Farm, equal_tasks, shrinking_tasks, simulate

EVEN = Farm(machines=10, start=5, drawing=10, variation=0, speeds=0, losses=0, dispatch=0)


def test_equal_machines_finish_together() -> None:
    run = simulate(EVEN, equal_tasks(40, 4))
    assert run.seconds == pytest.approx(5 + 4 * 10)
    assert run.utilisation == pytest.approx(40 / 45)
    assert run.straggling == pytest.approx(0)
    assert run.tasks == 10


def test_one_task_too_many_doubles_the_time() -> None:
    run = simulate(EVEN, equal_tasks(44, 4))
    assert run.seconds == pytest.approx(2 * 45)
    assert run.straggling == pytest.approx(0.5)


def test_tasks_wait_for_a_slow_scheduler() -> None:
    run = simulate(replace(EVEN, dispatch=1), equal_tasks(10, 1))
    assert run.seconds == pytest.approx(10 * 1 + 15)


def test_a_lost_machine_costs_time_and_no_drawing() -> None:
    """Light of lost tasks is kept: with ever so many losses all 400 drawings are lit once."""
    run = simulate(replace(EVEN, losses=30), equal_tasks(400, 8), seed=3)
    assert run.tasks > 60
    assert run.utilisation * run.seconds * 10 == pytest.approx(400 * 10)
    assert run.seconds > simulate(EVEN, equal_tasks(400, 8)).seconds


def test_tasks_hold_all_drawings() -> None:
    assert sum(equal_tasks(101, 8)) == sum(shrinking_tasks(101, 4, 2)) == 101
    shrinking = shrinking_tasks(1000, 4, 2)
    assert shrinking == sorted(shrinking, reverse=True)
    assert shrinking[0] == 125


def test_shrinking_tasks_leave_fewer_machines_idle_at_the_end() -> None:
    farm = Farm(machines=100, start=10, drawing=12)
    equal = simulate(farm, equal_tasks(3000, 15))
    shrinking = simulate(farm, shrinking_tasks(3000, 100, 2))
    assert shrinking.utilisation > equal.utilisation
    assert shrinking.straggling < equal.straggling
