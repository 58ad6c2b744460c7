"""Proposals: dances that fit, judged by dense samples; reasons where none does; objectives, limits and bad input."""

import math

import pytest

from core import Area, Budget, Dragon, FailureKind, Figure, Gate, Objective, ReasonKind, TooMuchWork, Venue, propose
from core.proposal.propose import BENCHES_MOST
from tests.campaigns.hunt_proposals import fault
from tests.support.depth import further, some, thorough
from tests.support.random_squares import Case, box, closed, refuted
from tests.support.refused import refused

# What an organiser has: 30 m x 40 m with two trees and a stage, and 40 benches of 2 m.
SQUARE = box("square", 0, 0, 40, 30)
PLACE = Venue(SQUARE, (box("linden", 10, 10, 1, 1), box("chestnut", 30, 20, 1, 1), box("stage", 14, 25, 12, 5)))
WEST = Gate((0.0, 15.0), 0.0)
EAST = Gate((40.0, 15.0), math.pi)
SMALL = Venue(box("yard", 0, 0, 24, 20))
LIMITS = {"stray": 0.05, "margin": 0.0}


@pytest.mark.parametrize("gates, asked", [((), ["ring", "spiral"]), *thorough(((WEST, EAST), None))])
def test_every_figure_of_a_square_with_trees_and_a_stage_is_danced_as_it_says(gates, asked):
    case = Case(PLACE, Dragon(40, 3.41, 2.0), gates, LIMITS)
    result = case.proposals(count=len(asked or Figure), figures=asked)
    figures = {one.figure for one in result.proposals}
    assert figures >= {Figure.RING, Figure.SPIRAL}
    assert (Figure.PARADE in figures) == bool(gates)
    tolerances = [one.tolerance for one in result.proposals]
    assert tolerances == sorted(tolerances, reverse=True)
    for one in result.proposals:
        assert refuted(case, one) == ""
        assert one.tolerance >= 0.05
        assert one.duration == pytest.approx(one.length / one.dance.head_speed)
        assert one.gates == ((0, 1) if one.gates and one.gates[0] == 0 else (1, 0) if gates else ())


@pytest.mark.parametrize("seed", further(some(range(200), 5)[::-2] + some(range(200), 5)[1::2], 1))
def test_proposals_for_random_squares_hold_and_reasons_are_right(seed):
    kind, wrong = fault(seed)
    assert wrong == ""
    assert kind not in ("too much work", "0 proposals")


@pytest.mark.thorough
def test_a_dance_for_people_who_never_stray_is_proposed_where_it_allows_the_stray():
    # No ring leaves the room for the stray that the first search keeps from the beginning.
    ring = ((20.45, 0.0), (8.912, 11.113), (-8.512, 14.891), (-22.415, 2.558), (20.45, 0.0))
    case = Case(Venue(Area("kite", (ring,))), Dragon(38, 3.23, 2.0), (), {**LIMITS, "stray": 0.1})
    (one,) = case.proposals().proposals
    assert one.figure is Figure.RING
    assert one.tolerance >= 0.1
    assert refuted(case, one) == ""


def test_one_figure_gives_several_different_dances_and_the_same_question_the_same_ones():
    first, again = (propose(SMALL, Dragon(6), figures=["ring"], count=3) for _ in range(2))
    dances = [one.dance for one in first.proposals]
    assert dances == [one.dance for one in again.proposals]
    assert len({tuple(dance.path.position(dance.path.begin).round(1)) for dance in dances}) == 3


def test_a_speed_limit_slows_the_head():
    case = Case(SMALL, Dragon(12), (), {**LIMITS, "speed_limit": 0.9})
    (one,) = case.proposals(figures=["ring"], count=1).proposals
    assert one.dance.head_speed <= 0.9
    assert refuted(case, one) == ""


def test_more_turns_and_longer_dances_are_wished_for():
    tolerant, turning, long = (
        propose(SMALL, Dragon(6), figures=["ring", "spiral"], objective=name, count=1).proposals[0]
        for name in (Objective.TOLERANCE, Objective.TURNS, Objective.DURATION)
    )
    assert turning.turns > tolerant.turns
    assert long.duration > tolerant.duration
    assert tolerant.tolerance >= max(turning.tolerance, long.tolerance)


def test_rings_and_eights_go_around_as_often_as_is_asked_or_as_long_as_it_may_last():
    case = Case(SMALL, Dragon(8), (), LIMITS)
    dragon = Dragon(8)
    once, often = (
        propose(SMALL, dragon, figures=["ring"], count=1, **wish).proposals[0]
        for wish in ({"laps": 1}, {"laps": 5, "head_speed": 1.2})
    )
    assert once.dance.head_speed == 1.0
    assert often.dance.head_speed == 1.2
    assert often.turns - once.turns == pytest.approx(4.0)
    around = (often.length - once.length) / 4
    ring, eight = sorted(
        case.proposals(figures=["ring", "eight"], count=2, duration_limit=200.0).proposals, key=lambda one: one.turns
    )[::-1]
    assert [refuted(case, one) for one in (ring, eight)] == ["", ""]
    assert 200.0 - around < ring.duration <= 200.0
    assert 100.0 < eight.duration <= 200.0
    reason = propose(SMALL, dragon, duration_limit=9.0).reason
    assert reason.kind == ReasonKind.DURATION
    assert reason.have == 9.0
    (shortest,) = propose(SMALL, dragon, figures=[reason.figure], count=1, duration_limit=reason.need + 0.01).proposals
    assert 9.0 < shortest.duration <= reason.need + 0.01


@pytest.mark.parametrize("uses, way", [(("in", "out"), (0, 1)), (("out", "both"), (1, 0))])
def test_a_dance_enters_by_a_way_in_and_leaves_by_a_way_out(uses, way):
    gates = [Gate(gate.point, gate.heading, use) for gate, use in zip((WEST, EAST), uses, strict=True)]
    result = propose(PLACE, Dragon(12), gates=gates, figures=["ring", "parade"], count=2)
    assert [one.gates for one in result.proposals] == [way, way]


def test_the_most_benches_are_below_the_bound_of_the_areas_and_no_dance_has_one_more():
    result = propose(SMALL, Dragon(10), figures=["ring"], objective="benches", count=1)
    best = result.proposals[0]
    most = best.dance.dragon.benches
    assert 10 < most <= result.most_benches
    more = propose(SMALL, Dragon(2 * most), figures=["ring"])
    assert more.proposals == ()
    assert more.reason is not None
    assert refuted(Case(SMALL, best.dance.dragon, (), LIMITS), best) == ""


@pytest.mark.parametrize("last", [0.3, 4.0], ids=["thin", "wide"])
@pytest.mark.parametrize("side", [0.5, 3.0, 5.0])
def test_the_bound_of_the_areas_is_that_of_every_other_bench_of_a_dragon_whose_last_bench_differs(last, side):
    yard = Venue(box("yard", 0, 0, side, side))
    dragon = Dragon.of([3.4, *[2.0] * 9], [1.0] * 9 + [last], [0.275] * 10)
    result = propose(yard, dragon, figures=["ring"], count=1, objective="benches")
    areas = [3.4, *[2.0] * 8, *[2.0 * last] * 200]
    fits = [max(sum(areas[:n:2]), sum(areas[1:n:2])) <= side * side for n in range(200)]
    assert result.most_benches == fits.index(False) - 1


@pytest.mark.parametrize(
    "venue, dragon, more, expected",
    [
        (Venue(box("lane", 0, 0, 30, 3.0)), Dragon(8), {}, {"kind": "width", "have": 3.01, "need": 3.91}),
        # The mouth of the street is no part of the square.
        (
            Venue(box("lane", 0, 0, 30, 3.0)),
            Dragon(8),
            {"figures": ["ring"], "gates": [Gate((15, 0), 0.5 * math.pi)]},
            {"kind": "width", "have": 3.01, "need": 3.91},
        ),
        (SMALL, Dragon(BENCHES_MOST), {}, {"kind": "area", "tried": 0, "have": 480.0, "need": 660.4}),
        (SMALL, Dragon(120), {"figures": ["ring"]}, {"kind": "benches", "need": 120}),
    ],
    ids=["narrow yard", "narrow yard with a gate", "too large", "too long"],
)
def test_where_nothing_fits_the_reason_has_what_there_is_and_what_is_needed(venue, dragon, more, expected):
    result = propose(venue, dragon, **more)
    reason = result.reason
    assert result.proposals == ()
    assert result.message == reason.message
    for name, value in expected.items():
        assert getattr(reason, name) == (value if name == "kind" else pytest.approx(value, abs=0.06))
    assert reason.have < reason.need
    if reason.kind is ReasonKind.BENCHES:
        assert propose(venue, Dragon(int(reason.have)), count=1, **more).proposals


def test_one_bench_dances_too():
    case = Case(SMALL, Dragon(1), (), LIMITS)
    assert [refuted(case, one) for one in case.proposals().proposals] == ["", "", ""]


@pytest.mark.parametrize(
    "field, more",
    [
        ("figures", {"figures": []}),
        ("count", {"count": 1.5}),
        ("laps", {"laps": 2, "figures": ["ring", "spiral"]}),
        ("dragon.benches", {"dragon": Dragon(100_000)}),
    ],
)
def test_bad_input_is_refused(field, more):
    with refused(field):
        propose(SMALL, **{"dragon": Dragon(12), **more})


def test_what_was_found_before_the_work_ended_is_proposed():
    def within(budget):
        return propose(SMALL, Dragon(10), figures=["ring", "serpentine"], budget=budget)

    whole = Budget(1e12)
    every = within(whole)
    part = within(Budget(0.5 * (1e12 - whole.left)))  # the first is certified after less than that
    assert 1 <= len(part.proposals) <= len(every.proposals)
    assert part.tried < every.tried
    with pytest.raises(TooMuchWork):
        within(Budget(1e3))


@pytest.mark.parametrize("side, benches", [(3.95, 1), (4.0, 2), (5.0, 4), (6.0, 1)])
def test_a_short_dragon_dances_in_a_square_in_which_its_tightest_circle_just_fits(side, benches):
    case = Case(Venue(box("yard", 0, 0, side, side)), Dragon(benches), (), LIMITS)
    result = case.proposals()
    assert [refuted(case, one) for one in result.proposals] == [""] * max(len(result.proposals), 1), result.message


def bend(width, other):
    """Two channels into one side of a room, of which each is the only way to a gate."""
    ring = [(0, 0), (30, 0), (30, width), (20, width), (20, 10.8 - other), (30, 10.8 - other), (30, 10.8), (0, 10.8)]
    return ring, ((30, 0.5 * width), math.pi), ((30, 10.8 - 0.5 * other), math.pi)


def rooms(width):
    """Two rooms with a channel between and one to each gate, on three lines."""
    across = (0, 8, 8, 20, 20, 30, 30, 44, 44, 52)
    low = (8, 8, 0, 0, 1, 1, 0, 0, 8, 8)
    high = (8, 8, 12, 12, 1)
    up = [y + width * (y in (1, 8)) for y in (*high, *high[::-1])]
    ring = [*zip(across, low, strict=True), *zip(across[::-1], up, strict=True)]
    return ring, ((0, 8 + 0.5 * width), 0.0), ((52, 8 + 0.5 * width), math.pi)


def lane(width, other):
    """A lane with a right angle."""
    ring = [(0, 0), (10 + other, 0), (10 + other, 12), (10, 12), (10, width), (0, width)]
    return ring, ((0, 0.5 * width), 0.0), ((10 + 0.5 * other, 12), -0.5 * math.pi)


YARD = [(0, 0), (24, 0), (24, 20), (0, 20)]
STREETS = [(0, 3), (17, 3), (17, 20), (13, 20), (13, 7), (0, 7)]
LOW_WEST = ((0, 10.1), 0.0)
LOW_EAST = ((24, 10.1), math.pi)
# Corners of a square [m], the gates of a walk, the angle by which all is turned [rad], and what stands in it.
WALKS = {
    "straight through a channel": (YARD, LOW_WEST, LOW_EAST, 0.0, (6, 0, 12, 9.8), (6, 10.4, 12, 9.6)),
    "straight through 5 m": ([(0, 0), (5, 0), (5, 9), (0, 9)], ((0, 4.5), 0.0), ((5, 4.5), math.pi), 0.0),
    "a channel beside a gate": (YARD, ((0, 14), 0.0), LOW_EAST, 0.0, (8, 0, 8, 9.8), (8, 10.4, 8, 9.6)),
    "beside both": (YARD, ((0, 10), 0.0), ((24, 10), math.pi), 0.0, (8, 0, 8, 12.05), (8, 12.95, 8, 7.05)),
    "a narrow one beside both": (YARD, LOW_WEST, LOW_EAST, 0.0, (8, 0, 8, 6.03), (8, 6.63, 8, 13.37)),
    "two streets": (STREETS, ((0, 5), 0.0), ((15, 20), -0.5 * math.pi), 0.0),
    "a bend of 0.8 m": (*bend(0.8, 0.8), 0.0),
    "a bend of 0.6 m": (*bend(0.6, 0.6), 0.3),
    "a turned bend of 0.9 m": (*bend(0.9, 0.9), 2.5),
    "a bend of 0.7 m and 1.3 m": (*bend(0.7, 1.3), 1.1),
    "rooms in a row": (*rooms(0.7), 0.4),
    "a lane of 1.4 m and 1.8 m": (*lane(1.4, 1.8), 0.7),
    "a jog in a lane": (
        [(0, 0), (10, 0), (12, 2), (22, 2), (22, 3.6), (12, 3.6), (10, 1.6), (0, 1.6)],
        ((0, 0.8), 0.0),
        ((22, 2.8), math.pi),
        2.0,
    ),
}


def turned(point, angle):
    x, y = point
    return x * math.cos(angle) - y * math.sin(angle), x * math.sin(angle) + y * math.cos(angle)


def walk(ring, begin, end, angle, *blocks, benches=4):
    """A walk from gate to gate."""
    square = Area("square", (closed([turned(point, angle) for point in ring]),))
    venue = Venue(square, tuple(box(f"block {k}", *block) for k, block in enumerate(blocks)))
    gates = tuple(Gate(turned(at, angle), heading + angle) for at, heading in (begin, end))
    return Case(venue, Dragon(benches), gates, LIMITS)


@pytest.mark.parametrize("name", WALKS)
def test_a_walk_turns_where_there_is_room_and_is_straight_in_channels(name):
    case = walk(*WALKS[name])
    result = case.proposals(figures=["parade"], count=1)
    assert [refuted(case, one) for one in result.proposals] == [""], result.message


@pytest.mark.thorough
def test_figures_are_danced_in_a_room_behind_two_narrow_channels():
    case = walk(*WALKS["a bend of 0.8 m"])
    result = case.proposals()
    assert {one.figure for one in result.proposals} > {Figure.PARADE}
    assert [refuted(case, one) for one in result.proposals] == [""] * 3


@pytest.mark.thorough
def test_where_not_even_one_bench_fits_the_reason_is_what_fails_in_its_nearest_dance():
    blocks = (8, 0, 2, 6.03), (8, 6.63, 2, 13.37), (12.5, 0, 3, 15), (12.5, 15.6, 3, 4)
    reason = walk(YARD, LOW_WEST, LOW_EAST, 0.0, *blocks, benches=4).proposals(figures=["parade"]).reason
    assert (reason.kind, reason.have, reason.need, reason.figure) == (ReasonKind.FAILS, 1, 4, Figure.PARADE)
    assert reason.failure.kind == FailureKind.VENUE
    assert reason.failure.area == "block 2"
    assert reason.message.endswith(f"not even with one bench; the nearest, a parade: {reason.failure.message}")


def test_a_way_is_refused_by_a_bound_that_no_dance_can_do_without():
    blocks = (6, 0, 12, 9.91), (6, 10.29, 12, 9.71)
    reason = walk(YARD, LOW_WEST, LOW_EAST, 0.0, *blocks, benches=2).proposals(figures=["parade"]).reason
    assert reason.kind == ReasonKind.WAY
    assert reason.who == (0, 1)
    assert 0.38 <= reason.have < 0.39
    assert reason.need == pytest.approx(0.3 + 2.0 * 0.05)
