"""Lengths between which an answer to the question for the shortest turn is justifiable, by closed forms alone."""

from __future__ import annotations

import math

import numpy as np

from core import kernels
from core.design.shortest_turn import BOX_WORK, LENGTH_WIDTH, MULTIPLIERS, SHORTEST_WORK
from core.design.turn_bounds import Multipliers, divided, first_boxes, least_entry, lower_lengths, multipliers_at
from core.design.turn_boxes import sizes_of, turns_in
from core.design.turn_moves import least_bend
from core.design.turn_places import polished, starts
from core.dragon import Dragon, told_chords
from core.errors import Quantity, asked_of, too_much
from core.kernels import Budget
from core.paths.turn import Turn


@asked_of("dragon", Dragon)
def turn_length_bounds(
    dragon: Dragon,
    pitch: float,
    turning_radius: float = 4.5,
    ratio: float = 2.0,
    *,
    start_turns: float = 16.0,
    budget: Budget | None = None,
) -> tuple[float, float]:
    """Lengths between which an answer to "the shortest turn of two arcs inside the circle" is justifiable [m].

    pitch, turning_radius [m]; ratio: radius of the first arc over that of the second; start_turns: of the coils
    low: no turn is shorter whose arcs have radii of half the longest chord or more: then the chord is the diameter of
        the bend. shortest_turn() asks for 1 / ROUTE_SINE_LIMIT of that, so its answer is between. Proven by closed
        forms alone, so a turn with contacts may be between too
    high: the turn that begins and ends on the circle, which needs no choice
    budget: default: SHORTEST_WORK
    raises: InvalidValue; TooMuchWork

    >>> [round(length, 4) for length in turn_length_bounds(Dragon(), 1.7)]
    [11.7729, 13.6212]
    """
    whole = Turn(pitch, turning_radius, ratio, start_turns=start_turns)
    growth, radius = whole.pitch / (2.0 * math.pi), whole.turning_radius
    least = least_bend(dragon) * kernels.ROUTE_SINE_LIMIT
    inner = least_entry(growth, radius, least)
    shortest = math.inf
    known: list[Multipliers] = []
    for start in starts(growth, inner, radius, whole.ratio, least):
        place = polished(growth, start, inner, radius, whole.ratio, least)
        if place is not None:
            length = float(sizes_of(growth, *place[:, None])[4, 0])
            if length < shortest:
                shortest, known = length, [multipliers_at(growth, place, least, radius, False), *known][:MULTIPLIERS]
    boxes = first_boxes(growth, inner, radius, whole.ratio)
    work = (budget or Budget()).within(SHORTEST_WORK)
    while boxes.lows.size:
        if work.uses_up(BOX_WORK * boxes.lows.size):
            rule = (
                "must be smaller, or benches fewer: no length was proven {then}; the {benches} chords are {shortest} to"
            )
            size = Quantity(radius, "m")
            raise too_much(work, "turning_radius", rule + " {longest} long", size, **told_chords(dragon))
        turns = turns_in(growth, boxes.centres, boxes.halves)
        bounds = [one.lower(turns, boxes.centres, boxes.halves) for one in known]
        boxes = boxes._replace(lows=np.maximum.reduce([boxes.lows, lower_lengths(turns), *bounds]))
        out = (turns.exit.low > radius) | (turns.exit.high < inner) | (boxes.lows >= shortest - LENGTH_WIDTH)
        out |= (turns.radii[0].high < least) | (turns.radii[1].high < least)
        left = np.flatnonzero(~out)
        slope = np.array([slope.furthest for slope in turns.slopes[2]])
        boxes = divided(boxes.taken(left), slope[:, left])
    return min(shortest - LENGTH_WIDTH, whole.length), whole.length
