"""The budget of a question: its remaining work, and a flag by which another thread ends it."""

import math
from inspect import Parameter, Signature


class Budget:
    """The remaining work of all searches of one question; another thread may stop them at any time.

    work: largest work [1], see core/kernels/constants.py; 1e7 take 1 to 4 s. None: each question uses the default that
        its docstring names; math.inf: no limit
    brief: True ends a search before work that takes a tenth of a second, such as exact decimals near a graze
    left: remaining work [1]; stopped: True if the budget was stopped
    raises: ValueError for a work that is not a number, or is below zero
    A question whose budget is spent or stopped ends with TooMuchWork. A spent budget does not interrupt a step, but
    refuses the next one. A search notices a stopped budget within milliseconds, or after the chain of handles that it
    lays out (25 ms for 100,000 benches), and ends like one that gave up: its caller looks at the budget too, and uses
    nothing that a stopped loop found. Only the earliest time of a dance on a route (Dance.earliest, 40 chains) is found
    without a look.

    >>> budget = Budget(work=10.0)
    >>> budget.stop()
    >>> budget.left, budget.stopped
    (10.0, True)
    """

    # The compiler leaves none on the class.
    __signature__ = Signature(
        [
            Parameter("work", Parameter.POSITIONAL_OR_KEYWORD, default=None, annotation="float | None"),
            Parameter("brief", Parameter.KEYWORD_ONLY, default=False, annotation="bool"),
        ]
    )

    def __init__(self, work=None, *, brief=False):
        self.brief = brief
        self.limited = work is not None
        try:
            if isinstance(work, (bool, str, bytes)):  # float() takes these too
                raise TypeError
            self.work = self.left = math.inf if work is None else float(work)
        except (TypeError, ValueError) as error:
            raise ValueError(f"work must be a number of steps, got {work!r}") from error
        if not self.work >= 0.0:
            raise ValueError(f"work must be zero or more, got {self.work:g}")
        self.stopped = False
        self.part = None
        self.then = f"within {self.work:g} steps of work, each a bench placed or a pair of benches tried"

    def __repr__(self):
        left = "no limit" if math.isinf(self.work) else f"{max(self.left, 0.0):g} of {self.work:g} steps of work left"
        left = left if self.limited else "the default work of each question"
        return f"<Budget: {left}{', brief' if self.brief else ''}{', stopped' if self.stopped else ''}>"

    def within(self, work):
        """The budget of one question, which is stopped together with this: itself, or this default work [1]."""
        if self.limited:
            return self
        self.part = Budget(work)
        if self.stopped:  # another thread may have stopped it before this part was linked
            self.part.stop(self.then)
        return self.part

    def stop(self, then="before it was stopped"):
        """End the question with this budget, and all later ones that use it. Any thread may call it.

        then: the end of the sentence, such as "before it was stopped"; a Quantity with that text tells its limit
        """
        self.then = then
        self.stopped = True
        if self.part is not None:
            self.part.stop(then)

    def spend(self, work):
        """Subtract finished work [1]."""
        self.left -= work

    def uses_up(self, work):
        """Subtract finished work [1]; True if the loop that did it has to end."""
        self.left -= work
        return self.stopped or self.left <= 0.0

    def take_time(self):
        """Announce long work. raises: Halted if the budget is brief"""
        if self.brief:
            raise Halted(self)

    def look(self):
        """Check the flag. raises: Halted if the budget is stopped"""
        if self.stopped:
            raise Halted(self)

    def afford(self, work=0.0):
        """Subtract work that is about to begin [1].

        raises: Halted if nothing is left, or the budget is stopped
        """
        if self.stopped or self.left <= 0.0:
            raise Halted(self)
        self.left -= work


class Halted(Exception):
    """A budget is spent or stopped. The question turns this into a TooMuchWork that names the cause."""

    __slots__ = ("budget",)

    def __init__(self, budget):
        super().__init__("the budget is spent or stopped")
        self.budget = budget
