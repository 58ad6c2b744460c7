"""Budgets: early ends of a loop, and what a process hands to another."""

import pickle

import pytest

from core import Dragon, Spiral
from core.kernels import Budget, Halted
from tests.support.searches import search_on


def test_a_loop_has_to_end_when_its_work_is_done_or_when_it_is_stopped():
    budget = Budget(3.0)
    assert [budget.uses_up(1.0) for _ in range(4)] == [False, False, True, True]
    assert budget.left == -1.0
    budget.left = 9.0
    assert not budget.uses_up(1.0)
    budget.stop()
    assert budget.uses_up(1.0)


@pytest.mark.parametrize("work", ["1", True, -1.0, float("nan")])
def test_what_is_no_amount_of_work_is_refused(work):
    with pytest.raises(ValueError, match="work must be"):
        Budget(work)


def test_a_brief_budget_refuses_long_work_alone():
    Budget(brief=True).afford(1.0)
    Budget().take_time()
    with pytest.raises(Halted):
        Budget(brief=True).take_time()


def test_a_budget_keeps_its_state_in_another_process():
    budget = Budget(3.0, brief=True)
    budget.spend(1.0)
    part = Budget().within(5.0)
    budget.part = part
    budget.stop("before dinner")
    same = pickle.loads(pickle.dumps(budget))
    state = (same.left, same.work, same.stopped, same.brief, same.limited, same.then, same.part.stopped)
    assert state == (2.0, 3.0, True, True, True, "before dinner", True)
    assert type(same.stopped) is bool


def test_a_scene_has_the_halt_of_its_search_whatever_path_that_takes():
    budget = Budget(5.0)
    search = search_on(Dragon(5), Spiral(), budget=budget)
    search.resize(4)
    search.use(Spiral(0.7), 0.1)
    search.scene.budget.left -= 2.0
    assert budget.left == 3.0
