"""First contacts, least clearances and verdicts of random dances against a slow search that shares no code with them.

`python -m tests.campaigns.hunt_contacts SEED SECONDS`. Dances are on spirals, on turns and on routes of lines, arcs and
coils, three in eight on routes with clothoids, also from before time 0, with passages and pauses; dragons are uniform
or given bench by bench. Half of the margins are chosen so that benches only graze, and so meet slowly.
"""

from functools import partial

import numpy as np

from core import (
    Coil,
    Dance,
    Dragon,
    Judgement,
    Outcome,
    Passage,
    Route,
    Spiral,
    Turn,
    check,
    first_contact,
    least_clearance,
)
from tests.campaigns import hunting
from tests.support.random_routes import Pen
from tests.support.slow_performance import travelled
from tests.support.slow_route import SlowRoute
from tests.support.slow_search import RUN, STEP, Samples, SlowDance

# Accuracy of slow clearances [m], and of times at 1 m/s [s].
GAP = 1e-9
TIME = 1e-9
# Width of a bracket as promised at 1 m/s [s], and where a second pair or rounding may hide more.
NARROW = 1e-9
# Largest number of coarse samples of a slow search: longer dances are cut.
SAMPLES = 2_000
# A touch this much above 0 or a margin counts as none, because two benches only graze [m].
SURE = 1e-8


def random_dragon(rng, benches=None):
    """3 to 16 benches, or so many, uniform or bench by bench."""
    benches, chord = benches or int(rng.integers(3, 17)), 10.0 ** rng.uniform(-0.3, 0.4)
    width = chord * 10.0 ** rng.uniform(-1.0, -0.1)
    overhang = chord * rng.choice([0.0, 0.1, 0.25, 0.4])
    if rng.uniform() < 0.3:
        chords = chord * 10.0 ** rng.uniform(-0.15, 0.15, benches)
        overhangs = np.full(benches, overhang) * rng.uniform(0.5, 1.0, benches)
        return Dragon.of(chords + 2.0 * overhangs, width * rng.uniform(0.7, 1.3, benches), overhangs)
    head = chord * 10.0 ** rng.uniform(-0.2, 0.4)
    return Dragon(benches, head + 2.0 * overhang, chord + 2.0 * overhang, width, overhang)


def random_path(rng, dragon):
    """A spiral, a turn, or a route of lines, arcs and coils that bends back towards itself."""
    chord = float(dragon.chords.max())
    width = float(dragon.widths.max())
    kind = rng.choice(["spiral", "turn", "route", "coil"])
    pitch = rng.uniform(0.8, 2.0) * width + rng.uniform(0.0, 0.6) * chord
    if kind == "spiral":
        return Spiral(pitch, rng.uniform(1.5, 9.0))
    if kind == "turn":
        radius = rng.uniform(1.1, 3.0) * chord
        return Turn(pitch, radius, rng.uniform(0.6, 2.5), start_turns=radius / pitch + rng.uniform(1.0, 5.0))
    if kind == "coil":
        inner = 1.2 * chord / pitch
        return Route([Coil(pitch, inner + rng.uniform(2.0, 5.0), inner)])
    radius = rng.uniform(0.55, 1.5) * chord
    sweep = rng.uniform(2.0, 3.1) * rng.choice([-1, 1])
    way = float(sum(dragon.chords) + rng.uniform(1.0, 6.0) * chord)
    pen = Pen(complex(-way))
    pen.line(way)
    pen.arc(radius, float(sweep))
    pen.line(way)
    return Route(pen.pieces, start=way)


def blended_route(rng, dragon):
    """A line, one or two bends of clothoids and arcs, with ramps of any length or none, and a line."""
    chord = float(dragon.chords.max())
    way = float(sum(dragon.chords) + rng.uniform(1.0, 6.0) * chord)
    pen = Pen(complex(-way))
    side = float(rng.choice([-1.0, 1.0]))
    pen.line(way)
    for _ in range(int(rng.choice([1, 1, 2]))):
        bend = side / (rng.uniform(0.55, 1.5) * chord)
        sweep = rng.uniform(1.5, 3.4)
        ramps = rng.uniform(0.0, 0.9, 2) * (rng.uniform(size=2) < 0.8)  # parts of the sweep, half of which is left
        turned = [(0.0, bend, 0.5 * ramps[0] * sweep), (bend, bend, (1.0 - 0.5 * ramps.sum()) * sweep)]
        for first, last, angle in [*turned, (bend, 0.0, 0.5 * ramps[1] * sweep)]:
            if (length := 2.0 * angle / abs(first + last)) > 1e-2:
                pen.clothoid(first, last, length)
        side = -side
    pen.line(way)
    return Route(pen.pieces, start=way)


def random_passages(rng):
    """No passages, or some with pauses, from time 0 on."""
    if rng.uniform() < 0.6:
        return ()
    passages = []
    time = 0.0
    for _ in range(int(rng.integers(1, 4))):
        time += rng.uniform(0.5, 6.0)
        passages.append(Passage(0.0 if rng.uniform() < 0.4 else rng.uniform(0.3, 2.0), until_time=time))
    return tuple(passages)


def random_margin(rng, look, dragon=None):
    """A part of a width, or half of the time one near the least gap: benches that just graze meet slowly [m]."""
    low, _ = look.least()
    margin = float(rng.choice([0.0, 0.0, 0.05, 0.2]) * (dragon.widths.max() if dragon else 1.0))
    if rng.uniform() < 0.5 and 0.0 < low < 1e3:
        margin = max(low + rng.choice([-1.0, 1.0]) * 10.0 ** rng.uniform(-11.0, -2.0), 0.0)
    return margin


class SlowLook(Samples):
    """The slow clearance of a dance between two travels, in samples that are closer around the lowest of them."""

    def __init__(self, slow, begin, until):
        self.begin = begin
        self.until = min(until, begin + SAMPLES * STEP * slow.chords.min())
        part = np.linspace(0.0, 1.0, 3 + int((self.until - begin) / (STEP * slow.chords.min())))
        # handles move as the square root of the way to a fold
        ahead = until - self.until < 1.0 and not isinstance(slow, SlowRoute)
        travels = begin + (self.until - begin) * (1.0 - (1.0 - part) ** 2 if ahead else part)
        super().__init__(lambda times: slow.clearance(times)[0], travels)


def random_case(seed, case, any_path=None, slow_route=SlowRoute):
    """dance, margin, stop, and the slow look at it; raises: BenchDragonError for what core refuses"""
    rng = hunting.generator(seed, case)
    dragon = random_dragon(rng)
    path = (any_path or (blended_route if case % 8 in (0, 5, 7) else random_path))(rng, dragon)
    dance = Dance(dragon, path, 1.0, random_passages(rng))
    is_spiral = isinstance(path, Spiral)
    start = dance.begin - (rng.uniform(0.0, 8.0) if is_spiral and rng.uniform() < 0.3 else 0.0)
    stop = None if rng.uniform() < 0.6 else float(start + (dance.end.time - start) * rng.uniform(0.3, 1.0))
    slow = SlowDance.of(dragon, path) if is_spiral else slow_route.of(dragon, path)
    ends = slow.end() if stop is None else travelled(dance, stop)
    look = SlowLook(
        slow, travelled(dance, start), RUN * min(ends, dance.end.time) if stop is None and is_spiral else ends
    )
    if look.until < ends - 1.0:  # only so much is looked at
        stop = float(dance.clock.time(look.until))
    return dance, random_margin(rng, look, dragon), start, stop, look


def judged(dance, margin, start, stop, look, accuracy=GAP):
    """The kind of the answers about a dance, and their fault in words. accuracy: of slow clearances [m]"""
    span = {"start": start, "stop": stop}
    contact = first_contact(dance, margin=margin, **span)
    path = "spiral" if dance.path.spiral is not None else f"{len(dance.path.pieces)} pieces"
    kind = f"{path}, {contact.outcome.value}{', wide' if is_wide(dance, contact) else ''}"
    known = certain = contact.overlapping is not None
    if known:
        kind += ", overlap known"
    wrong = contact_fault(dance, contact, margin, look, accuracy)
    least = least_clearance(dance, **span)
    wrong = wrong or least_fault(dance, least, look, contact if margin == 0.0 else None, accuracy)
    verdict = check(dance, margin=margin, **span).verdict
    certain = certain or contact.outcome in (Outcome.CONTACT, Outcome.CONTACT_AT_START)
    if certain and verdict is not Judgement.FAILS:
        wrong = wrong or f"{contact!r}, but check says {verdict.value}"
    if verdict is Judgement.PASSES and look.least()[0] < margin - accuracy:
        wrong = wrong or f"check passes, but the gap is {look.least()}"
    return kind, wrong and f"{wrong} in {dance!r}, margin {margin!r}, {span}"


def is_wide(dance, result):
    """True for the bracket of a contact that is wider than promised."""
    if result.outcome is not Outcome.CONTACT:
        return False
    clear, touching = result.time_bracket
    return touching - clear > NARROW / min(1.0, dance.clock.slowest) * 1.01


def contact_fault(dance, result, margin, look, accuracy=GAP):
    """What is wrong with a first contact."""
    return meeting_fault(result, margin, look, accuracy, accuracy, lambda time: travelled(dance, time))


def meeting_fault(result, margin, look, accuracy=GAP, reached=GAP, place=float):
    """What is wrong with the first contact of any kind.

    accuracy, reached: of slow gaps [m], and where they have reached the margin; place: in the look of a time
    """
    if result.outcome is Outcome.CONTACT_AT_START:
        gap = look.at(look.times[0])
        return f"{result!r}, but the gap is {gap}" if gap > margin + accuracy else ""
    clear = look.times[-1] if result.outcome is Outcome.CLEAR else place(result.time_bracket[0])
    least, there = look.least(clear)
    if least < margin - accuracy:
        return f"proven clear up to {clear}, but the gap is {least} at {there}"
    if result.outcome is Outcome.CONTACT or result.overlapping is not None:
        gap = look.at(place(result.time_bracket[1]))
        if gap > margin + reached:
            return f"certain contact at {result.time_bracket[1]} s, but the gap is {gap}"
    return ""


def least_fault(dance, least, look, contact, accuracy):
    """What is wrong with a least clearance. contact: the first one without a margin, if it was asked for"""
    if least is None:
        return ""
    seen = look.until if least.distance > 0.0 else travelled(dance, least.time) - TIME
    low, there = look.least(seen)
    if least.at_least is not None and low < least.at_least - accuracy:
        return f"{least!r}, but the gap is {low} at {there} m"
    if least.distance > 0.0 and low < least.distance - 1.1e-3:
        return f"{least!r}, but the gap is {low} at {there} m"
    gap = look.at(travelled(dance, least.time))
    sure = max(SURE, 10.0 * accuracy)
    if abs(max(gap, min(least.distance, 0.0)) - least.distance) > sure and not (least.distance == 0.0 and gap < sure):
        return f"{least!r}, but the gap there is {gap}"
    if (
        contact is not None
        and contact.outcome is Outcome.UNDECIDED
        and least.distance == 0.0
        and least.at_least is not None
    ):
        return f"undecided from {contact.time_bracket[0]} s on, but {least!r}"
    return ""


fault = partial(hunting.unless_refused, judged, random_case)
hunt = partial(hunting.hunt, fault)

if __name__ == "__main__":
    hunting.main(hunt, "dances")
