"""The cards of proposed dances: what is good and what is tight about each, in words that tell it from the others."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

import core
from app.wire.fields import Answer
from core.language import Language, Phrases, phrase, say, speaking

FIGURES: Phrases = {
    core.Figure.SPIRAL: "Spiral in and out",
    core.Figure.EIGHT: "Figure eight",
    core.Figure.SERPENTINE: "Serpentine",
    core.Figure.RING: "Ring",
    core.Figure.PARADE: "From gate to gate",
}
# Angle between two benches that is worth a word, and one that is sharp [rad]; stray that is little room for people, and
# a near distance [m].
BEND, SHARP, LITTLE, NEAR = math.radians(40.0), math.radians(60.0), 0.1, 0.3
# Benches with one bench between them are always near each other: their numbers differ by this [1].
NEXT_BUT_ONE = 2
# Two values that differ by less are equal.
EQUAL = 1e-3
# From this time on minutes are counted [s]. Points at which a way is looked at [1].
LONG, POINTS = 120, 400


class ProposalCard(Answer):
    """A proposed dance in words.

    title: its figure, and what tells it from the others of that figure
    size: benches, time and way
    good: what is good about it, among all proposals
    tight: what comes near, and what is tight
    is_tight: whether to look out there
    """

    title: str
    size: str
    good: str
    tight: str
    is_tight: bool


@dataclass(frozen=True)
class ProposalCards:
    """Cards of dances that were proposed together.

    found: the dances; square: in which they are danced; gates: names of all gates; stray: that was asked for [m];
    ended: whether these are all of a search, so that what one has most of is said
    """

    found: Sequence[core.Proposal]
    square: core.Area
    gates: Sequence[str]
    stray: float
    ended: bool = True

    def of(self, k: int) -> dict[Language, ProposalCard]:
        """The card of dance k in every language."""
        cards = {}
        for language in Language:
            with speaking(language):
                cards[language] = self._card(k)
        return cards

    def _card(self, k: int) -> ProposalCard:
        one = self.found[k]
        seconds, benches = round(one.duration), one.dance.dragon.benches
        time = say("{seconds} s", seconds=seconds)
        if seconds >= LONG:
            time = say("{minutes} min {seconds} s", minutes=seconds // 60, seconds=seconds % 60)
        size = phrase("{benches} benches, {time}; the head walks {length} m")
        comma = say(", ")
        return ProposalCard(
            title=self._title(k),
            size=say(size, benches=benches, time=time, length=f"{one.length:.0f}"),
            good=comma.join(self._good(one)),
            tight=comma.join(self._tight(one)),
            is_tight=one.tolerance < LITTLE
            or (one.sharpest_bend or 0.0) > SHARP
            or min(_apart(one), one.near.distance) < NEAR,
        )

    def _title(self, k: int) -> str:
        figures = list(map(self._figure, self.found))
        alike = [j for j, figure in enumerate(figures) if figure == figures[k]]
        if len(alike) < 2:
            return figures[k]
        place = alike.index(k)
        marks: list[Callable[[core.Proposal], str]] = [self._wide, self._side, _turns, _length]
        words = ([mark(self.found[j]) for j in alike] for mark in marks)
        apart = next((each for each in words if len(set(each)) == len(each)), None)
        parts = apart[place] if apart else say("no. {number}", number=place + 1)
        return say("{figure}, {parts}", figure=figures[k], parts=parts)

    def _figure(self, one: core.Proposal) -> str:
        words = say(FIGURES[one.figure])
        if not one.gates or one.gates[0] == one.gates[1]:
            return words
        a, b = (self.gates[gate] for gate in one.gates)
        if one.figure is core.Figure.PARADE:
            return say("From {a} to {b}", a=a, b=b)
        return say("{figure}, {parts}", figure=words, parts=say("from {a} to {b}", a=a, b=b))

    def _danced(self, one: core.Proposal) -> tuple[np.ndarray, np.ndarray]:
        """Points of the way within the bounds of the square: streets are no part of a figure."""
        ring, path = np.array(self.square.rings[0]), one.dance.path
        points = path.position(np.linspace(max(path.begin, 0.0), path.end, POINTS))
        inside = ((points >= ring.min(axis=0)) & (points <= ring.max(axis=0))).all(axis=1)
        x, y = points[inside].T
        return x, y

    def _wide(self, one: core.Proposal) -> str:
        wide = phrase("{wide} m wide with its ways to the gates") if one.gates else phrase("{wide} m wide")
        return say(wide, wide=f"{np.ptp(self._danced(one)[0]):.0f}")

    def _side(self, one: core.Proposal) -> str:
        x, y = self._danced(one)
        left = float(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y)) > 0.0
        return say("to the left") if left else say("to the right")

    def _most(self, one: core.Proposal, value: Callable[[core.Proposal], float]) -> bool:
        others = [other for other in self.found if other is not one]
        return self.ended and bool(others) and all(value(other) < value(one) - EQUAL for other in others)

    def _good(self, one: core.Proposal) -> list[str]:
        room = phrase("People may be {stray} cm from their places")
        if self._most(one, lambda other: other.tolerance):
            room = phrase("Most room: people may be {stray} cm from their places")
        words = [say(room, stray=_centimetres(one))]
        if self._most(one, lambda other: other.duration):
            words.append(say("the longest dance"))
        if self._most(one, lambda other: other.turns):
            words.append(say("the most turns: {turns}", turns=f"{one.turns:.1f}"))
        if self._most(one, lambda other: -(other.sharpest_bend or 0.0)):
            words.append(say("the gentlest bends"))
        return words

    def _tight(self, one: core.Proposal) -> list[str]:
        """What comes nearest, then what is tight. Distances count from people in place, as does the safe stray."""
        near, bend = one.near, one.sharpest_bend or 0.0
        template, distance, strayed = (
            phrase("nobody comes nearer than {distance} m to “{name}”"),
            near.in_place,
            near.distance,
        )
        if one.clearance_in_place is not None and _apart(one) < near.distance:
            template = phrase("benches that are not neighbours come as near as {distance} m to each other")
            distance, strayed = one.clearance_in_place, _apart(one)
        elif near.name == self.square.name:
            template = phrase("nobody comes nearer than {distance} m to the border of the square")
        words = [say(template, distance=f"{distance:.2f}", name=near.name)]
        if self.stray:
            least = phrase(" (at least {distance} m while people stray by {stray} cm)")
            words[0] += say(least, distance=f"{strayed:.2f}", stray=f"{round(100.0 * self.stray, 2):g}")
        if bend > BEND:
            words.append(say("bends of up to {angle}°", angle=f"{math.degrees(bend):.0f}"))
        if one.tolerance < LITTLE:
            words.append(say("people may be only {stray} cm from their places", stray=_centimetres(one)))
        return words


def _apart(one: core.Proposal) -> float:
    """The least distance of two benches if they have more than one bench between them, infinite if not [m]."""
    least = one.report.least_clearance
    a, b = (0, 0) if least is None else least.benches
    return math.inf if least is None or b - a <= NEXT_BUT_ONE else least.distance


def _centimetres(one: core.Proposal) -> str:
    """The safe stray as people say it, rounded down."""
    if one.tolerance < LITTLE:
        return f"{math.floor(1000.0 * one.tolerance) / 10.0:g}"
    return str(math.floor(100.0 * one.tolerance))


def _turns(one: core.Proposal) -> str:
    return say("{turns} turns", turns=f"{one.turns:.1f}")


def _length(one: core.Proposal) -> str:
    return say("{length} m", length=f"{one.length:.0f}")
