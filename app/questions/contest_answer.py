"""The question contest_answer: one of the contest's five questions, answered as a student hands it in, with reasons."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from typing import Literal

import numpy as np
from pydantic import Field

import core
from app.contest import pictures
from app.contest.pictures import Picture
from app.contest.solved import ContestRequest
from app.grade.limits import EQUAL_TURN, TIGHTER_TURN, WIDER_LENGTH
from app.grade.shortcuts import UNITS
from app.wire.answers import SENTENCES
from app.wire.fields import Answer, Whole, Wire
from app.wire.question import Question, Terms
from app.wire.readings import contact_words, handles_words, pitch_words, turn_words
from core import Dance, Dragon, InvalidValue, Outcome
from core.language import phrase, say
from core.quantities import format_bound, format_number

# The problem as the contest gives it.
PROBLEM = ContestRequest()
# Estimated time of each answer, and of one with the shortest turns [s], measured 2026-11-30.
COSTS, FURTHER = {1: 0.01, 2: 0.01, 3: 0.1, 4: 0.01, 5: 0.02}, 1.0
# The question about the turn.
TURN = 4
# Rows and columns of the map of turns, and the ratios at its ends [1].
ENTRIES, COLUMNS, RATIOS = 9, 9, (0.5, 2.5)
# What makes one turn differ from another.
SHAPE = ("ratio", "entry_radius", "exit_radius")


class ContestAnswerQuery(Wire):
    """One of the five questions."""

    question: Whole = Field(1, ge=1, le=5, description="Number of the question")
    further: bool = Field(
        False, description="Whether the answer has what takes seconds too: for question 4 the shortest turns"
    )


class Offer(Answer):
    """A dance that an answer tells of, to be looked at.

    words: what the offer does, on a button
    path: its path
    numbers: what differs from the contest's numbers: fields of a dance; time, the instant to look at [s]; and handle,
        the one to look at
    """

    words: str
    path: Literal["spiral", "turn"]
    numbers: dict[str, float]


class TurnLengths(Answer):
    """Lengths of turns that leave opposite to where they enter, by ratio and entry.

    words: what the map shows
    axes: names of the columns and of the rows, with their units
    ratios: radius of the first arc over that of the second: the columns [1]
    entry_radii: distances of the entry from the centre: the rows [m]
    lengths: a row for each entry; null where the benches cannot dance it [m]
    """

    words: str
    axes: list[str]
    ratios: list[float]
    entry_radii: list[float]
    lengths: list[list[float | None]]


class ContestAnswer(Answer):
    """The answer to one of the contest's questions.

    question: number of the question
    asks: the question in a sentence
    text: the answer with the digits that the contest asks for, and its unit
    more: what the answer has with `further`, as a question; null if no more
    picture: a picture of the answer, as lines
    turns: of question 4 with `further`, lengths of other turns
    offers: dances that the answer tells of
    workbook: name of the workbook that the contest asks for; null if it asks for none
    number: name of the number that POST /grade judges for this question; null if it is all in the workbook
    unit: unit of that number
    example: that number as a student may write it; null without one
    """

    question: int
    asks: str
    text: str
    sentences: list[str] = SENTENCES
    more: str | None = None
    picture: Picture
    turns: TurnLengths | None = None
    offers: list[Offer]
    workbook: str | None
    number: str | None
    unit: str | None = None
    example: str | None


def contest_answer(request: ContestAnswerQuery, terms: Terms) -> ContestAnswer:
    """One of the contest's five questions (CUMCM 2024 A), with its reasons, a picture and what is handed in."""
    turn = _shorter if request.further else _turn
    answers: list[Callable[[Dragon, Terms], ContestAnswer]] = [_motion, _contact, _pitch, turn, _speed]
    return answers[request.question - 1](PROBLEM.to_dragon(terms.settings.checked_benches_max), terms)


def _spiral(dragon: Dragon) -> Dance:
    return Dance(dragon, PROBLEM.to_path(), PROBLEM.head_speed)


def _motion(dragon: Dragon, terms: Terms) -> ContestAnswer:
    time = PROBLEM.stop
    motion = core.trajectory(_spiral(dragon), [time], budget=terms.budget)
    (x, y), (tail_x, tail_y), rear = motion.position[-1, 0], motion.position[-1, -1], float(motion.speed[-1, -1])
    words = [
        say(
            "There is the head at {time:g} s. The rear of the tail is then at ({x:.6f}, {y:.6f}) m and moves at "
            "{speed:.6f} m/s.",
            time=time,
            x=tail_x,
            y=tail_y,
            speed=rear,
        ),
        say(
            "Each handle is the first place on the spiral behind the one before it at the distance of the two holes, "
            "and a rigid bench passes the speed on: the speeds of its two ends along the bench are equal."
        ),
    ]
    return ContestAnswer(
        question=1,
        asks=say("Where is every handle, and how fast, in every second up to {time:g} s?", time=time),
        text=f"({x:.6f}, {y:.6f}) m",
        sentences=words,
        picture=pictures.of_motion(motion, time),
        offers=[Offer(words=say("Show the dance at {time:g} s", time=time), path="spiral", numbers={"time": time})],
        workbook="result1.xlsx",
        number=None,
        example=None,
    )


def _contact(dragon: Dragon, terms: Terms) -> ContestAnswer:
    dance = _spiral(dragon)
    contact = core.first_contact(dance, budget=terms.budget)
    graze = contact.certificate.least_clearance
    assert contact.time is not None
    assert graze is not None
    at_contact = core.trajectory(dance, [contact.time], budget=terms.budget).position[-1]
    words = [
        *contact_words(contact),
        say(
            "Nothing touched earlier, which {steps} steps prove, each as long as it is sure to be clear. Steps of "
            "equal length may miss it: at {time:.2f} s two benches pass with {gap:.3f} mm between them.",
            steps=contact.certificate.steps,
            time=graze.time,
            gap=1000.0 * graze.clearance,
        ),
    ]
    return ContestAnswer(
        question=2,
        asks=say("When do two benches first touch, so that the dance must end?"),
        text=f"{contact.time:.6f} s",
        sentences=words,
        picture=pictures.of_contact(contact, at_contact, dragon),
        offers=[Offer(words=say("Show the contact"), path="spiral", numbers={"time": contact.time})],
        workbook="result2.xlsx",
        number="collision_time",
        unit=UNITS["collision_time"],
        example="412.473838",
    )


def _pitch(dragon: Dragon, terms: Terms) -> ContestAnswer:
    minimum = PROBLEM.least_pitch(dragon, terms.budget)
    words = [
        *pitch_words(minimum, dragon, PROBLEM.turning_diameter, 0.0, 0.0),
        say(
            "So it is not enough to look at the dance with the head on the circle, and halving cannot search for the "
            "radius at which the head stops: as the pitch grows that radius falls in jumps, over the circle."
        ),
    ]
    pitch = format_bound(minimum.pitch, 6, up=True)
    return ContestAnswer(
        question=3,
        asks=say(
            "What is the smallest pitch at which the head reaches the circle of {diameter} m?",
            diameter=format_number(PROBLEM.turning_diameter),
        ),
        text=f"{pitch} m",
        sentences=words,
        picture=pictures.of_pitch(minimum, PROBLEM.turning_radius, dragon, terms.budget),
        offers=[Offer(words=say("Use this pitch"), path="spiral", numbers={"pitch": minimum.pitch_bracket[1]})],
        workbook=None,
        number="pitch",
        unit=UNITS["pitch"],
        example="0.450338",
    )


def _turn(dragon: Dragon, terms: Terms) -> ContestAnswer:
    turn = PROBLEM.to_turn()
    words = [
        say(
            "With its ends on the circle no ratio changes this length: both arcs turn by {angle:.6f} rad, and their "
            "radii add up to {sum:.6f} m at every ratio, so the length is the product.",
            angle=turn.angles[0],
            sum=sum(turn.radii),
        ),
        say(
            "A turn is shorter if it may begin or end inside the circle, until a bend is too tight for the longest "
            "bench: it surely follows where the radius is at least half of the distance of its two handles, "
            "{least:.3f} m.",
            least=0.5 * float(dragon.chords.max()),
        ),
    ]
    return ContestAnswer(
        question=4,
        asks=say("How long is the turn of two arcs in the circle, and can it be shorter?"),
        text=f"{turn.length:.6f} m",
        sentences=words,
        more=say("How much shorter?"),
        picture=pictures.of_turn(turn),
        offers=[_turn_offer(say("Dance this turn"), turn)],
        workbook="result4.xlsx",
        number="turn_length",
        unit=UNITS["turn_length"],
        example="13.621245",
    )


def _turn_offer(words: str, turn: core.Turn) -> Offer:
    return Offer(words=words, path="turn", numbers={name: getattr(turn, name) for name in SHAPE} | {"time": 0.0})


def _shorter(dragon: Dragon, terms: Terms) -> ContestAnswer:
    """Question 4 with the shortest turns of its ratio and of equal arcs."""
    answer, circle = _turn(dragon, terms), (PROBLEM.turn_pitch, PROBLEM.turning_radius)
    same = core.shortest_turn(dragon, *circle, PROBLEM.ratio, budget=terms.budget)
    equal, tight = (
        core.Turn(*circle, ratio, entry_radius=entry, exit_radius=leaving)
        for ratio, entry, leaving in (EQUAL_TURN, TIGHTER_TURN)
    )
    least = 0.5 * float(dragon.chords.max())
    bends = {"wide": equal.radii[0], "least": least, "shortest": WIDER_LENGTH}
    for turn, template in (
        (same.turn, phrase("The shortest one with the same ratio, {ratio:g}, is {length:.6f} m long.")),
        (
            equal,
            phrase(
                "With equal arcs it is {length:.6f} m long, and it is proven that no turn of any ratio is 1e-6 m "
                "shorter whose bends have radii of at least {wide:.4f} m. Where {least:.3f} m, half of that distance, "
                "are enough, none is shorter than {shortest:.4f} m."
            ),
        ),
        (
            tight,
            phrase(
                "An arc may even be tighter, as long as every bench can follow: with a ratio of {ratio:.6f} and a "
                "first arc of {radius:.3f} m, {length:.6f} m are danced and nothing touches. A shorter one may exist."
            ),
        ),
    ):
        answer.sentences += [
            say(template, ratio=turn.ratio, length=turn.length, radius=turn.radii[0], **bends),
            turn_words(turn),
        ]
        answer.offers.append(_turn_offer(say("Dance the turn of {length:.2f} m", length=turn.length), turn))
    answer.more, answer.turns = None, _lengths(dragon, terms)
    return answer


def _lengths(dragon: Dragon, terms: Terms) -> TurnLengths:
    """The map of the lengths, each of a turn that is proven to be danced without a contact."""
    radius = PROBLEM.turning_radius
    entries, ratios = np.linspace(0.65 * radius, radius, ENTRIES).round(3), np.linspace(*RATIOS, COLUMNS).round(3)
    danced: dict[tuple[int, int], Dance] = {}
    for cell in np.ndindex(ENTRIES, COLUMNS):
        entry, ratio = float(entries[cell[0]]), float(ratios[cell[1]])
        with suppress(InvalidValue):  # an arc is too tight
            turn = core.Turn(PROBLEM.turn_pitch, radius, ratio, entry_radius=entry, exit_radius=entry)
            danced[cell] = Dance(dragon, turn)
    lengths: list[list[float | None]] = [[None] * COLUMNS for _ in entries]
    contacts = core.first_contacts(list(danced.values()), budget=terms.budget)
    for ((row, column), dance), contact in zip(danced.items(), contacts, strict=True):
        if contact.outcome is Outcome.CLEAR and isinstance(dance.path, core.Turn):
            lengths[row][column] = dance.path.length
    words = say(
        "Length of the turn by its ratio and its entry; the darker the longer, grey: too tight. Touch one to dance "
        "it, or use the arrow keys and Enter."
    )
    axes = [say("ratio of the arcs [1]"), say("entry, from the centre [m]")]
    return TurnLengths(words=words, axes=axes, ratios=ratios.tolist(), entry_radii=entries.tolist(), lengths=lengths)


def _speed(dragon: Dragon, terms: Terms) -> ContestAnswer:
    turn, limit = PROBLEM.to_turn(), PROBLEM.speed_limit
    fastest = core.maximum_head_speed(Dance(dragon, turn), limit, budget=terms.budget)
    peak, first = fastest.time_at_unit_head_speed, fastest.handles[0]
    motion = core.trajectory(Dance(dragon, turn), [peak], budget=terms.budget)
    x, y = motion.position[-1, first]
    words = [
        say(
            "The fastest are {handles}, at the same instant, with {ratio:.4f} times the speed of the head, which is "
            "then {way:.2f} m past the beginning of the turn.",
            handles=handles_words(fastest.handles),
            ratio=fastest.speed_ratio,
            way=peak,
        ),
        say(
            "The head has then left the second arc for the wide coil. Its bench, {chord:.2f} m from hole to hole, "
            "stands almost across that arc of radius {radius:.2f} m, where handle 1 still is: little of a speed there "
            "points along the bench, so handle 1 must be {second:.4f} times as fast.",
            chord=dragon.chords[0],
            radius=turn.radii[1],
            second=motion.speed[-1, 1],
        ),
        say(
            "The joint of the two arcs, between handles {ahead} and {first}, adds the rest: handle {first} is at "
            "({x:.2f}, {y:.2f}) m, still on the first arc.",
            first=first,
            ahead=first - 1,
            x=x,
            y=y,
        ),
        say(
            "So {limit:g} m/s of theirs allow the head {limit:g} / {ratio:.6f} = {speed:.6f} m/s.",
            limit=limit,
            ratio=fastest.speed_ratio,
            speed=fastest.head_speed,
        ),
    ]
    low, _ = fastest.head_speed_bracket
    speed = fastest.head_speed if low is None else low
    return ContestAnswer(
        question=5,
        asks=say("How fast may the head be, so that no handle exceeds {limit:g} m/s?", limit=limit),
        text=f"{format_bound(speed, 6)} m/s",
        sentences=words,
        picture=pictures.of_speed(fastest, dragon, turn, terms.budget),
        offers=[
            Offer(
                words=say("Dance at this speed"),
                path="turn",
                numbers={"head_speed": speed, "time": fastest.time, "handle": float(first)},
            )
        ],
        workbook=None,
        number="speed",
        unit=UNITS["speed"],
        example="1.246266",
    )


def _cost(request: ContestAnswerQuery) -> float:
    return FURTHER if request.further and request.question == TURN else COSTS[request.question]


QUESTION = Question(contest_answer, ContestAnswer, flat=ContestAnswerQuery, cost=_cost)
