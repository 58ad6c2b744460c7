"""Limits that typed answers keep: a pitch and a turn have a least value, the speed of the head has a highest.

Input: the name of a number and its value. Output: the limit, and what happens beyond it, in words. State: none.
"""

from __future__ import annotations

from contextlib import suppress

import core
from app.grade.contacts import TURNING_RADIUS
from app.grade.handles import BENCHES
from app.grade.shortcuts import SPEED_LIMIT, fastest, right_answer
from app.grade.words import Note, note
from core import BenchDragonError, Dance, Dragon, Spiral
from core.language import Listed

# Shortest turn whose arcs are no tighter than half of the head's chord [m]: question 4 leaves open the ratio, and where
# the dance enters and leaves the circle. core.turn_length_bounds(core.Dragon(), 1.7, ratio=None) proves in a minute
# that in every shorter turn an arc is tighter than that, or benches overlap; a test recomputes it. core.shortest_turn
# with a free ratio, whose bends are wider by the rounding that a proof needs, proves 8.223983 m.
WIDER_LENGTH = 8.2147138
# The shortest one that keeps to these wider bends, by its ratio, entry and exit [m].
EQUAL_TURN = (1.0, 4.5, 3.93378849)
# The shortest turn known, by its ratio, entry and exit [m]; its length, rounded up [m]. Its first arc has 0.951 m of
# radius, but every bench is proven to follow, and nothing touches. A search found it on 2026-11-30: a shorter one may
# exist. With its ratio and exit, entries up to the circle give all lengths above it (12 of them danced, 2026-11-30).
TIGHTER_TURN = (0.66439183, 3.8721443, 4.5)
TIGHTER_LENGTH = 7.69341
# Side of the limit on which a number keeps it [1].
SAFE_SIDE = {"pitch": 1, "speed": -1, "turn_length": 1}
# Fewest and most decimals of a speed beyond its limit, which show that it is beyond.
DECIMALS = range(3, 10)


def limit_of(name: str) -> float | None:
    """The limit of a number, in its unit; None for the time of first contact, which has none."""
    if name not in SAFE_SIDE:
        return None
    return TIGHTER_LENGTH if name == "turn_length" else right_answer(name)


def beyond(name: str, value: float) -> float:
    """How far a number is beyond its limit, in its unit; 0 or less if it keeps it, or has none."""
    limit = limit_of(name)
    return 0.0 if limit is None else SAFE_SIDE[name] * (limit - value)


def broken(name: str, value: float) -> Note:
    """What happens at a number beyond its limit."""
    if name == "speed":
        return _too_fast(value)
    if name == "pitch":
        return _contact(value)
    return note("breaks_turn_length", least=f"{WIDER_LENGTH:.7f}", tighter=f"{TIGHTER_LENGTH}")


def _too_fast(speed: float) -> Note:
    """The highest speed of any handle, with the handles and the instant."""
    most = fastest()
    reached = speed * most.speed_ratio
    decimals = next((k for k in DECIMALS if round(reached, k) > SPEED_LIMIT), DECIMALS[-1])
    values = {"limit": f"{SPEED_LIMIT:g}", "speed": f"{reached:.{decimals}f}"}
    time = f"{most.time_at_unit_head_speed / speed:.3f}"
    return note("breaks_speed", time=time, handles=Listed(most.handles), **values)


def _contact(pitch: float) -> Note:
    """The first contact on the way to the circle."""
    with suppress(BenchDragonError):
        first = core.first_contact(Dance(Dragon(BENCHES), Spiral(pitch)))
        if first.time is not None and first.benches is not None and first.head is not None:
            a, b = first.benches
            values = {"a": a, "b": b, "radius": f"{first.head.radius:.3f}", "circle": f"{TURNING_RADIUS:g}"}
            return note("breaks_pitch" if first.time > 0.0 else "breaks_pitch_at_start", **values)
    return note("breaks_pitch_everywhere")
