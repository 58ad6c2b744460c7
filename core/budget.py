"""The budget of a question: its largest work, and a flag by which another thread stops it."""

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

# Work between two checks of a budget [1], see core/kernels/constants.py, in batches divided for them: 2 to 10 ms.
BATCH_WORK = 100_000


class Budget:
    """The remaining work of all searches of one question; another thread may stop them at any time.

    work: largest work [1], see core/kernels/constants.py; 1e7 take 1 to 4 s. None: each question uses the default that
        its docstring names; math.inf: no limit
    brief: True ends a search before work that takes a tenth of a second, such as exact decimals near a graze
    halt: the remaining work and the flag, in the form that the compiled loops read
    A question whose budget is spent or stopped ends with TooMuchWork. A spent budget does not interrupt a step, but
    refuses the next one. Every loop notices a stopped budget within milliseconds.

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
        """Remaining work [1]."""
        return self.halt.left

    @property
    def stopped(self) -> bool:
        """True if the budget was stopped."""
        return bool(self.halt.stopped)

    def stop(self, then: str = "before it was stopped") -> None:
        """End the question with this budget, and all later ones that use it. Any thread may call it.

        then: the end of the error's sentence, such as "before it was stopped"
        """
        self.then = then
        self.halt.stopped = True
        if self.part:
            self.part.stop(then)

    def spend(self, work: float) -> None:
        """Subtract finished work [1]."""
        self.halt.left -= work

    def take_time(self) -> None:
        """Announce long work. raises: Halted if the budget is brief"""
        if self.brief:
            raise Halted(self)

    def look(self) -> None:
        """Check the flag. raises: Halted if the budget is stopped"""
        if self.halt.stopped:
            raise Halted(self)

    def afford(self, work: float = 0.0) -> None:
        """Subtract work that is about to begin [1].

        raises: Halted if nothing is left, or the budget is stopped
        """
        if self.halt.stopped or self.halt.left <= 0.0:
            raise Halted(self)
        self.halt.left -= work

    def too_much(self, field: str, rule: str, got: float, unit: str) -> TooMuchWork:
        """The error of a question that ended early. The rule ends with a clause on the missing answer and {then}."""
        error = TooMuchWork.of(field, rule.format(then=self.then), got, unit)
        error.stopped = self.stopped
        return error


def within(budget: Budget | None, work: float) -> Budget:
    """The budget of a question: the given one with its own limit, else with this default work.

    budget: the argument of the question; the result is stopped together with it
    """
    if budget is None:
        return Budget(work)
    if budget.limited:
        return budget
    budget.part = Budget(work)
    if budget.stopped:  # another thread may have stopped it before this part was linked
        budget.part.stop(budget.then)
    return budget.part


class Halted(Exception):
    """A budget is spent or stopped. The question turns this into a TooMuchWork that names the cause."""

    def __init__(self, budget: Budget) -> None:
        super().__init__("the budget is spent or stopped")
        self.budget = budget


def bounded(found: str) -> Callable[[Callable[P, R]], Callable[P, R]]:
    """Decorator that ends a question about a dance, a dragon or benches with TooMuchWork when its budget ends.

    found: clause on the missing answer, which {then} completes
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
