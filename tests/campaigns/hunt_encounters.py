"""First encounters and least clearances in random performances against a slow search that shares no code with them.

`python -m tests.campaigns.hunt_encounters SEED SECONDS`. Two to five small dragons wind into spirals, some into the
same one, go through arcs and along lines that cross, with speeds, passages, pauses and delays of their own. Half of the
margins are chosen so that benches only graze, and so meet slowly.
"""

from functools import partial

import numpy as np

from core import (
    Arc,
    Coil,
    Dance,
    Line,
    Outcome,
    Part,
    Performance,
    Route,
    Spiral,
    encounter_check,
    first_encounter,
    least_clearance,
)
from core.contact.gaps import PROOF_WIDTHS
from tests.campaigns import hunting
from tests.campaigns.hunt_contacts import GAP, SlowLook, random_dragon, random_margin, random_passages
from tests.campaigns.hunt_contacts import meeting_fault as encounter_fault
from tests.support.slow_performance import SlowPerformance
from tests.support.slow_search import RUN

# Width of a bracket as promised where benches do not meet slowly [s].
NARROW = 1e-9
# Accuracy of the least of a slow look, which refines its lowest samples [m].
LEAST = 1e-7
# Performances that are drawn until no two dragons overlap at the beginning [1].
TRIALS = 6
# Longest time that is looked at [s].
LONGEST = 60.0


def random_route(rng, dragon, reach):
    """A line through the middle, an arc about it, or a coil, long enough for the dragon."""
    chord = float(dragon.chords.max())
    length = float(dragon.chords.sum())
    middle = rng.uniform(-0.3, 0.3, 2) * reach
    heading = rng.uniform(-np.pi, np.pi)
    kind = rng.choice(["line", "arc", "coil"])
    along = np.array([np.cos(heading), np.sin(heading)])
    if kind == "line":
        return Route([Line(tuple(middle - (reach + length) * along), tuple(middle + reach * along))], start=length)
    if kind == "arc":
        radius = rng.uniform(1.2 * chord, max(reach, 1.5 * chord))
        sweep = (length / radius * 1.6 + rng.uniform(1.0, 5.0)) * float(rng.choice([-1.0, 1.0]))
        return Route([Arc(tuple(middle), radius, heading, sweep)])
    pitch = rng.uniform(0.8, 2.0) * chord
    inner = rng.uniform(1.0, 2.0)
    return Route([Coil(pitch, inner + rng.uniform(2.0, 4.0), inner, tuple(middle), heading)])


def random_performance(rng):
    """Two to five dragons, of which some share one spiral."""
    count = int(rng.integers(2, 6))
    reach = rng.uniform(5.0, 16.0)
    shared = rng.uniform() < 0.4
    pitch = rng.uniform(0.8, 2.0) * count * 0.6
    clockwise = rng.uniform() < 0.5
    centre = tuple(rng.uniform(-5.0, 5.0, 2))
    turn = rng.uniform(2.0, 6.0)
    spin = rng.uniform(-3.0, 3.0)
    parts = []
    for k in range(count):
        dragon = random_dragon(rng, int(rng.integers(1, 10)))
        if shared and rng.uniform() < 0.8:
            rotation = spin + 2.0 * np.pi * k / count + float(rng.choice([0.0, 0.0, rng.uniform(-0.3, 0.3)]))
            path = Spiral(pitch, turn, centre, rotation, clockwise)
        elif rng.uniform() < 0.3:
            place = tuple(rng.uniform(-reach, reach, 2))
            path = Spiral(rng.uniform(0.5, 2.0), rng.uniform(2.0, 6.0), place, spin * k, rng.uniform() < 0.5)
        else:
            path = random_route(rng, dragon, reach)
        speed = 1.0 if shared else rng.uniform(0.5, 1.6)
        delay = float(rng.choice([0.0, 0.0, rng.uniform(-5.0, 15.0)]))
        parts.append(Part(Dance(dragon, path, speed, random_passages(rng)), delay))
    return Performance(parts)


def random_case(seed, case):
    """performance, margin, start, stop, and the slow look at it; raises: BenchDragonError for what is refused"""
    rng = hunting.generator(seed, case)
    performance = random_performance(rng)
    for _ in range(TRIALS):
        if SlowPerformance(performance.parts).clearance([performance.begin])[0][0] > 0.0:
            break
        performance = random_performance(rng)
    begin = performance.begin
    end = performance.end.time
    if performance.end.dragon is not None:
        end = begin + RUN * (end - begin)
    start = begin + (end - begin) * float(rng.choice([0.0, rng.uniform(0.0, 0.8)]))
    look = SlowLook(SlowPerformance(performance.parts), start, min(end, start + LONGEST))
    return performance, random_margin(rng, look), start, look.until, look


def judged(performance, margin, start, stop, look):
    """The kind of a first encounter, and its fault in words."""
    met = first_encounter(performance, margin=margin, start=start, stop=stop)
    wrong = encounter_fault(met, margin, look) or least_fault(performance, start, stop, look)
    kind = met.outcome.value
    if met.outcome is Outcome.CONTACT:
        low, high = met.time_bracket
        kind += ", wide" if high - low > 1.01 * NARROW else ""
        # engines see a graze only if it is deeper than their tolerances
        if not wrong and high - low < 1.01 * NARROW and not encounter_check(met).agree:
            kind += ", engines differ"
    return kind, wrong and f"{wrong} in {performance.parts!r}, margin {margin!r}, {start} to {stop}"


def least_fault(performance, start, stop, look):
    """What is wrong with the least clearance."""
    low, there = look.least()
    least = least_clearance(performance, start=start, stop=stop)
    gap = look.at(least.time)
    if low <= LEAST:
        is_fine = least.distance <= 0.0 and gap <= GAP
    else:
        # Up to a fold the bound is wider.
        width = PROOF_WIDTHS[1] * 1.01 if performance.end.dragon is None else np.inf
        proven = least.at_least <= low + GAP and 0.0 < least.distance - least.at_least <= width
        is_fine = proven and least.distance <= low + LEAST and abs(gap - least.distance) <= GAP
    return "" if is_fine else f"{least!r}, but the gap is {low} at {there} s"


fault = partial(hunting.unless_refused, judged, random_case)
hunt = partial(hunting.hunt, fault)

if __name__ == "__main__":
    hunting.main(hunt, "encounters")
