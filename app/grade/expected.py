"""The right content of the contest's workbooks, and the motion of any dance in their columns."""

from __future__ import annotations

from collections.abc import Callable
from enum import StrEnum
from functools import cache

import numpy as np

from app.grade.handles import BENCHES, HANDLES
from app.grade.layout import COMPONENTS, OVER_TIME, TableKind
from core import Dance, Dragon, Spiral, Turn, first_contact
from core import trajectory as trajectory_of
from core.values import Floats

# x, y [m] and speed [m/s] of every handle (T, H, 3) at times (T,) [s].
Motion = Callable[[Floats], Floats]
PITCH = 1.7  # [m], of the spiral that question 4 turns on
# Time of result4 before and after the beginning of the turn, and length of result1 [s].
TURN_SPAN, SPIRAL_SPAN = 100, 300


class Workbook(StrEnum):
    """A workbook of the contest."""

    RESULT1 = "result1"
    RESULT2 = "result2"
    RESULT4 = "result4"


# Kinds of sheets of each workbook.
KINDS = {
    Workbook.RESULT1: OVER_TIME,
    Workbook.RESULT2: (TableKind.CONTACT,),
    Workbook.RESULT4: OVER_TIME,
}


@cache
def right_turn() -> Turn:
    """The turn of the contest, the only path of its dances besides a spiral."""
    return Turn(PITCH)


@cache
def dance_of(workbook: Workbook) -> Dance:
    return Dance(Dragon(BENCHES), right_turn() if workbook is Workbook.RESULT4 else Spiral())


@cache
def contact_time() -> float:
    """The time of first contact [s]."""
    time = first_contact(dance_of(Workbook.RESULT2)).time
    assert time is not None
    return time


def times_of(workbook: Workbook) -> Floats:
    """The instants of a workbook [s]."""
    if workbook is Workbook.RESULT2:
        return np.array([contact_time()])
    first, last = (-TURN_SPAN, TURN_SPAN) if workbook is Workbook.RESULT4 else (0, SPIRAL_SPAN)
    return np.arange(first, last + 1, dtype=np.float64)


def cells_of(workbook: Workbook, kind: TableKind) -> int:
    """Number of cells with numbers in a sheet."""
    return times_of(workbook).size * HANDLES * len(COMPONENTS[kind])


def motion(position: Floats, speed: Floats) -> Floats:
    """(T, H, 3) from positions (T, H, 2) and speeds (T, H)."""
    return np.concatenate([position, speed[..., None]], axis=-1)


def of_dance(dance: Dance) -> Motion:
    """The right motion of a dance."""

    def moved(times: Floats) -> Floats:
        right = trajectory_of(dance, np.minimum(times, dance.end.time))
        return motion(right.position, right.speed)

    return moved
