"""Places of handles along the path, and times at which they pass a place."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from core.dance import Dance
from core.kernels import Budget
from core.kernels.constants import CHAIN_COLUMNS, CHORD, LAG, SIZE_COLUMNS
from core.questions import question_about
from core.values import Floats

# Travel of the head between two rows of a table of places [m], largest number of rows, and of finer tables at a time.
STEP, ROWS_MAX, FINER_MOST = 0.25, 2_000, 100


@question_about("dance", Dance)
def handle_places(dance: Dance, times: ArrayLike, *, budget: Budget | None = None) -> Floats:
    """Arc length s of every handle along the path.

    times: (T,) [s]; returns (T, n + 1) [m]
    raises: OutsideRun (times); TooMuchWork

    >>> from core import Dragon, Spiral
    >>> handle_places(Dance(Dragon(2), Spiral()), [0.0]).round(3)
    array([[ 0.   , -2.873, -4.525]])
    """
    instants = dance.times(np.asarray(times, dtype=np.float64)).reshape(-1)
    return _behind(dance, np.array([dance.clock.travel(time) for time in instants.tolist()]), budget or Budget())


@question_about("dance", Dance, "the places of the handles were not found")
def _behind(dance: Dance, travels: Floats, budget: Budget) -> Floats:
    """Arc lengths (T, n + 1) of all handles for travels (T,) of the head [m]. raises: TooMuchWork"""
    path, last = dance.path, dance.dragon.benches
    sizes, chain = np.zeros((last + 1, SIZE_COLUMNS)), np.zeros((last + 1, CHAIN_COLUMNS))
    sizes[:last, CHORD] = dance.dragon.chords
    rows = []
    for lag in path.lags(travels, dance.end.theta or 0.0).tolist():
        budget.afford(float(last))
        path.follow(lag, last, sizes, chain)
        rows.append(path.along(chain[:, LAG]))
    return np.array(rows)


class Passing:
    """Times at which handles first pass places on the path, between two instants [s].

    The place of a handle depends only on the head's travel. It is interpolated linearly between the rows of a table,
    STEP apart, with an error below a centimetre. On a way of more than ROWS_MAX rows they are further apart, and a
    finer table is made between the two rows between which a handle is there.
    raises: TooMuchWork
    """

    def __init__(self, dance: Dance, start: float, stop: float, *, budget: Budget | None = None) -> None:
        self.clock = dance.clock
        first, last = self.clock.travel(start), self.clock.travel(stop)
        self.travels = np.linspace(first, last, min(ROWS_MAX, int((last - first) / STEP) + 2))
        self.start, self.dance, self.budget = start, dance, budget or Budget()
        self.s = _behind(dance, self.travels, self.budget)
        self.steps = math.ceil((last - first) / (len(self.travels) - 1) / STEP)
        self.finer = dict[int, tuple[Floats, Floats]]()

    def when(self, handle: int, s: float) -> float | None:
        """The first time at which a handle is at s [s]; None if it is not there between the two instants.

        raises: TooMuchWork
        """
        row = self.s[:, handle]
        passed = np.flatnonzero(row >= s)
        if not passed.size or (passed[0] == 0 and row[0] > s):
            return None
        k = int(passed[0])
        if k == 0:
            return self.start
        travels, places = self._between(k)
        row = places[:, handle]
        # The last row again, which may differ in its last bit, if no row has reached s.
        later = np.flatnonzero(row[1:] >= s)
        k = 1 + int(later[0]) if later.size else len(row) - 1
        share = (s - row[k - 1]) / (row[k] - row[k - 1])
        return self.clock.time(float(travels[k - 1] + share * (travels[k] - travels[k - 1])))

    def _between(self, k: int) -> tuple[Floats, Floats]:
        """Travels and places from row k - 1 to row k, at most STEP apart."""
        if self.steps <= 1:
            return self.travels[k - 1 : k + 1], self.s[k - 1 : k + 1]
        if k not in self.finer:
            if len(self.finer) == FINER_MOST:
                self.finer.clear()
            travels = np.linspace(self.travels[k - 1], self.travels[k], self.steps + 1)
            self.finer[k] = travels, _behind(self.dance, travels, self.budget)
        return self.finer[k]
