"""The five answers in numbers, each with its bracket and its evidence."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from app.contest.solved import Solved, Turned
from core import EndReason, MinimumPitch, Outcome, ShortestTurn
from core.language import Listed, say


@dataclass(frozen=True)
class Result:
    """One number of an answer.

    question: 1 to 5; bracket: interval that is proven to hold the exact value, if there is one; how: the evidence
    """

    question: int
    name: str
    value: float
    unit: str
    bracket: tuple[float | None, float | None] | None
    how: str


def answers(solved: Solved, question: int | None = None) -> list[Result]:
    """The numbers of the answers, in the order of the questions. question: the only one, None for all five"""
    numbers: dict[int, Callable[[], list[Result]]] = {
        1: lambda: _inwards(solved),
        2: lambda: _contact(solved),
        3: lambda: [_pitch(solved.pitch)],
    }
    if turned := solved.turned:
        limit = solved.request.speed_limit
        numbers[4] = lambda: [*_turn(turned), *_times(turned, limit)]
        numbers[5] = lambda: [_speed(turned, limit)]
    return [result for number, of in numbers.items() if question in (None, number) for result in of()]


def _inwards(solved: Solved) -> list[Result]:
    motion, stop = solved.inwards, solved.stop
    how = say(
        "every handle from the chord equation, every speed from the rigid links: good to 1e-11 m and 1e-11 m/s",
    )
    rear, at = say("rear handle of the tail"), say(" at {stop:g} s", stop=stop)
    places = [
        Result(1, say("{name}, {axis}{at}", name=name, axis=axis, at=at), float(place), "m", None, how)
        for name, k in ((say("front handle of the head"), 0), (rear, -1))
        for axis, place in zip("xy", motion.position[-1, k], strict=True)
    ]
    return [
        *places,
        Result(1, say("{name}, speed{at}", name=rear, at=at), float(motion.speed[-1, -1]), "m/s", None, how),
    ]


def _contact(solved: Solved) -> list[Result]:
    contact = solved.contact
    if contact.time is None or contact.benches is None or contact.head is None:
        name = say("no contact until")
        return [Result(2, name, solved.met_at, "s", contact.time_bracket, _why_ended(solved))]
    a, b = contact.benches
    pair = say("benches {a} and {b}", a=a, b=b)
    steps = contact.certificate.steps
    how = say(
        "{pair} touch; {steps} proven steps show that nothing touched earlier",
        pair=pair,
        steps=steps,
    )
    place = say("the head at that time")
    return [
        Result(2, say("time of first contact"), contact.time, "s", contact.time_bracket, how),
        Result(2, say("distance of the head from the centre"), contact.head.radius, "m", None, place),
    ]


def _why_ended(solved: Solved) -> str:
    end = solved.contact.end
    if end is None or solved.contact.outcome is Outcome.UNDECIDED:
        return say("the search ended there")
    if end.reason is EndReason.FOLD:
        return say(
            "the run ends there: bench {end.bench} folds and cannot follow any further",
            end=end,
        )
    return say("the head is at the centre")


def _pitch(minimum: MinimumPitch) -> Result:
    pair = minimum.benches or ()
    whose = say(" of benches {a} and {b}", a=pair[0], b=pair[1]) if pair else ""
    words = {
        "graze": say("a graze{whose} on the way", whose=whose),
        "circle": say("contact{whose} on the circle", whose=whose),
        "start": say("contact{whose} at the start", whose=whose),
        "fold": say("a bench that can no longer follow"),
    }
    every = minimum.proven_up_to is None and minimum.scan_step is None
    proven = say("every larger pitch is proven feasible")
    sampled = say("larger pitches are partly sampled, not proven")
    limit = say("limited by {limit}", limit=words[minimum.limited_by.value])
    how = say("{first}; {second}", first=limit, second=proven if every else sampled)
    return Result(3, say("minimum pitch"), minimum.pitch, "m", minimum.pitch_bracket, how)


def _turn(turned: Turned) -> list[Result]:
    shortest, even, length = turned.shortest, turned.even, turned.path.length
    why = say(
        "closed form. The sum of the radii is S = sqrt(R^2 + (p / 2 pi)^2) at every ratio, and both "
        "arcs have the same angle a, so the length S a does not depend on the ratio",
    )
    inner, shorter = say("length of the shortest turn"), say("shorter by")
    equal = say("shortest turn with equal arcs (ratio 1)")
    rows = [
        (say("length of the turn"), length, None, why),
        (inner, shortest.turn.length, shortest.length_bracket, _why_shortest(shortest)),
        (shorter, length - shortest.turn.length, None, say("the difference")),
    ]
    if even and even.turn.length < shortest.turn.length:
        rows.append((equal, even.turn.length, even.length_bracket, _why_shortest(even)))
    return [Result(4, name, value, "m", bracket, how) for name, value, bracket, how in rows]


def _why_shortest(shortest: ShortestTurn) -> str:
    limits = {
        "least_radius": say(
            "the least radius of a bend, half of the longest chord and 0.1 % more for the proof",
        ),
        "contact": say("benches would touch"),
        "circle": say("its circle"),
        "centre": say("nothing, down to the centre"),
        "undecided": say("rounding hides whether benches would touch"),
    }
    entry, leaving = (f"{radius:.6f} m" for radius in (shortest.turn.entry_radius, shortest.turn.exit_radius))
    limit = limits[shortest.limited_by.value]
    return say(
        "entry at a radius of {entry}, exit at {leaving}; limit: {limit}",
        entry=entry,
        leaving=leaving,
        limit=limit,
    )


def _times(turned: Turned, limit: float) -> list[Result]:
    """How long the head takes through the turns if no handle exceeds the limit."""
    turns = (
        say("the turn of question 4"),
        say("the shortest turn"),
        say("the quickest turn (of a scan)"),
    )
    results = []
    for name, time in zip(turns, turned.times, strict=False):
        entry, leaving = time.turn.entry_radius, time.turn.exit_radius
        how = say(
            "{time.length:.6f} m at {time.head_speed:.6f} m/s, the highest head speed at which no "
            "handle exceeds {limit:g} m/s; entry at a radius of {entry:.6f} m, exit at {leaving:.6f} m",
            time=time,
            limit=limit,
            entry=entry,
            leaving=leaving,
        )
        results.append(Result(4, say("time through {name}", name=name), time.time, "s", None, how))
    return results


def _speed(turned: Turned, limit: float) -> Result:
    fastest = turned.fastest
    handles = Listed(fastest.handles)
    how = say(
        "handles {handles} reach {limit:g} m/s at {fastest.time:.6f} s, {fastest.speed_ratio:.6f} "
        "times the head's speed",
        handles=handles,
        limit=limit,
        fastest=fastest,
    )
    return Result(5, say("maximum head speed"), fastest.head_speed, "m/s", fastest.head_speed_bracket, how)
