"""Early ends of a loop."""

from __future__ import annotations

from core import Dragon, Spiral, kernels
from core.budget import Budget
from core.contact.search import Search


def test_a_loop_has_to_end_when_its_work_is_done_or_when_it_is_stopped() -> None:
    halt = kernels.Halt(3.0)
    assert [bool(halt.spend(1.0)) for _ in range(4)] == [False, False, True, True]
    assert halt.left == -1.0
    halt.left = 9.0
    assert not halt.spend(1.0)
    halt.stopped = True
    assert halt.spend(1.0)


def test_a_scene_has_the_halt_of_its_search_whatever_path_that_takes() -> None:
    budget = Budget(5.0)
    search = Search(Dragon(5), Spiral(), 0.0, budget=budget)
    search.resize(4)
    search.use(Spiral(0.7), 0.1)
    search.scene.halt.left -= 2.0
    assert budget.left == 3.0
