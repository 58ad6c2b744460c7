"""What one question may do, and how another thread ends it."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import wraps
from inspect import signature
from typing import ParamSpec, TypeVar

from core import kernels
from core.errors import TooMuchWork

P = ParamSpec("P")
R = TypeVar("R")

# Work between two looks at a budget where a batch is cut for them, see core/kernels/constants.py [1]: 2 to 10 ms.
BATCH_WORK = 100_000


class Budget:
    """What all searches of one question may still do together; another thread may stop them at any time.

    work: how much, see core/kernels/constants.py [1]; 1e7 take 1 to 4 s. None: each question takes its own default,
        which its docstring names; math.inf: none takes any
    brief: end before work that takes a tenth of a second, as that of decimals near a graze
    halt: what is left of it, and the flag, as the compiled loops read them
    A question whose budget is spent or stopped ends with TooMuchWork. A spent budget interrupts no step: whoever asks
    for more then is refused. A stopped one is seen by every loop within milliseconds.

    >>> budget = Budget(work=10.0)
    >>> budget.stop()
    >>> budget.left, budget.stopped
    (10.0, True)
    """

    __slots__ = ("brief", "halt", "limited", "part", "then", "work")

    def __init__(self, work: float | None = None, *, brief: bool = False) -> None:
        self.brief, self.limited = brief, work is not None
        self.work = math.inf if work is None else float(work)
        self.halt = kernels.Halt(self.work)
        self.part: Budget | None = None
        self.then = f"within {self.work:g} steps of work, each a bench placed or a pair of benches tried"

    @property
    def left(self) -> float:
        """Work that may still be done [1]."""
        return self.halt.left

    @property
    def stopped(self) -> bool:
        """Has anybody stopped it?"""
        return bool(self.halt.stopped)

    def stop(self, then: str = "before it was stopped") -> None:
        """End the question that has this budget, and all that are asked with it from now on. Any thread may call it.

        then: until when the answer was not found, for the error
        """
        self.then = then
        self.halt.stopped = True
        if self.part:
            self.part.stop(then)

    def spend(self, work: float) -> None:
        """Take work that was done from what is left [1]."""
        self.halt.left -= work

    def take_time(self) -> None:
        """raises: Halted where the question must not take long; the work that is about to begin does."""
        if self.brief:
            raise Halted(self)

    def look(self) -> None:
        """raises: Halted where the budget is stopped."""
        if self.halt.stopped:
            raise Halted(self)

    def afford(self, work: float = 0.0) -> None:
        """Take work that is about to be done from what is left [1].

        raises: Halted where nothing is left, or the budget is stopped
        """
        if self.halt.stopped or self.halt.left <= 0.0:
            raise Halted(self)
        self.halt.left -= work

    def too_much(self, field: str, rule: str, got: float, unit: str) -> TooMuchWork:
        """The error of a question that ended early; the rule ends with what was not found, and {then} says when."""
        error = TooMuchWork.of(field, rule.format(then=self.then), got, unit)
        error.stopped = self.stopped
        return error


def within(budget: Budget | None, work: float) -> Budget:
    """The budget of a question that takes this much work unless its budget says how much.

    budget: as the question was given it; the result is stopped with it
    """
    if budget is None:
        return Budget(work)
    if budget.limited:
        return budget
    budget.part = Budget(work)
    if budget.stopped:  # perhaps by another thread, before it could see this part
        budget.part.stop(budget.then)
    return budget.part


class Halted(Exception):
    """A budget is spent or stopped: what a question makes a TooMuchWork of that says what was too much of it."""

    def __init__(self, budget: Budget) -> None:
        super().__init__("the budget is spent or stopped")
        self.budget = budget


def bounded(found: str) -> Callable[[Callable[P, R]], Callable[P, R]]:
    """Makes a question about a dance, a dragon or benches end with TooMuchWork where its budget does.

    found: what it was to find, and that this was not found: a clause that {then} ends
    """

    def bound(question: Callable[P, R]) -> Callable[P, R]:
        @wraps(question)
        def asked(*args: P.args, **kwargs: P.kwargs) -> R:
            try:
                return question(*args, **kwargs)
            except Halted as halted:
                budget, given = halted.budget, signature(question).bind(*args, **kwargs).arguments
            dance = given.get("dance")
            if dragon := given.get("dragon") or (dance and dance.dragon):
                rule = "must be fewer" + (", or the time asked about shorter" if dance else "")
                raise budget.too_much("dragon.benches", f"{rule}: {found} {{then}}", dragon.benches, "")
            raise budget.too_much("benches", f"must be fewer: {found} {{then}}", len(given["poses"]), "")

        return asked

    return bound
