"""Work that one thread does for all others, one piece after another."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor, wait
from contextvars import copy_context
from typing import TypeVar

from core import Budget
from core.kernels import Halted

Value = TypeVar("Value")
# Time between two looks at the budget of who waits for a value [s].
LOOK_SECONDS = 0.05


class Turns:
    """A thread for work that cannot be stopped. Calling it gives the value of a function, in turn.

    The function must not call the same thread itself.
    raises: Halted once the budget is stopped; what has begun goes on for nobody
    """

    def __init__(self, name: str) -> None:
        self._worker = ThreadPoolExecutor(1, name)

    def __call__(self, work: Callable[[], Value], budget: Budget | None = None) -> Value:
        value = self._worker.submit(copy_context().run, work)
        while budget is not None:
            if budget.stopped:
                value.cancel()
                raise Halted(budget)
            if wait([value], LOOK_SECONDS).done:
                break
        return value.result()

    def after(self, work: Callable[[], object]) -> None:
        """Do this work in turn, while nobody waits for it."""
        self._worker.submit(work)
