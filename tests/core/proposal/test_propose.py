"""Proposals: dances that fit, judged by dense samples; reasons where none does; objectives, limits and bad input."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import core
from core import Area, Budget, Dragon, Figure, Gate, InvalidValue, Objective, ReasonKind, TooMuchWork, Venue, propose
from core.proposal.propose import BENCHES_MOST
from tests.support.depth import some
from tests.support.random_squares import Case, box, random_case, refuted, wrong_reason

# What an organiser has: 30 m x 40 m with two trees and a stage, and 40 benches of 2 m.
SQUARE = box("square", 0, 0, 40, 30)
PLACE = Venue(SQUARE, (box("linden", 10, 10, 1, 1), box("chestnut", 30, 20, 1, 1), box("stage", 14, 25, 12, 5)))
FORTY = Dragon(40, 3.41, 2.0)
WEST, EAST = Gate((0.0, 15.0), 0.0), Gate((40.0, 15.0), math.pi)
SMALL = Venue(box("yard", 0, 0, 24, 20))


def limits(**more: Any) -> dict[str, Any]:
    return {"stray": 0.05, "margin": 0.0, **more}


@pytest.mark.parametrize("gates", [(), (WEST, EAST)], ids=["without gates", "with gates"])
def test_every_figure_of_a_square_with_trees_and_a_stage_is_danced_as_it_says(gates: tuple[Gate, ...]) -> None:
    case = Case(PLACE, FORTY, gates, limits())
    result = case.proposals(count=5)
    assert {one.figure for one in result.proposals} >= {Figure.RING, Figure.SPIRAL}
    assert (Figure.PARADE in {one.figure for one in result.proposals}) == bool(gates)
    assert result.reason is None
    assert (
        result.message == f"The best {len(result.proposals)} of {result.tried} tried, {result.checked} of them checked."
    )
    tolerances = [one.tolerance for one in result.proposals]
    assert tolerances == sorted(tolerances, reverse=True)
    for one in result.proposals:
        assert refuted(case, one) == ""
        assert one.tolerance >= 0.05
        assert one.duration == pytest.approx(one.length / one.dance.head_speed)
        assert one.near.distance > 0.05
        assert one.clearance is not None
        assert one.clearance > 0.1
        assert one.gates == ((0, 1) if one.gates and one.gates[0] == 0 else (1, 0) if gates else ())


@pytest.mark.parametrize("seed", some(range(200), 5))
def test_proposals_for_random_squares_hold_and_reasons_are_right(seed: int) -> None:
    case = random_case(seed)
    result = case.answer()
    if isinstance(result, InvalidValue):  # a street has no room beside another one, or beside a corner
        assert result.field.startswith("gates.")
        return
    assert [refuted(case, one) for one in result.proposals] == [""] * len(result.proposals)
    assert (result.reason is None) == bool(result.proposals)
    if result.reason is not None:
        assert wrong_reason(case, result) == ""


def test_a_dance_for_people_who_never_stray_is_proposed_where_it_allows_the_stray() -> None:
    # No ring leaves the room for the stray that the first search keeps from the beginning.
    ring = ((20.45, 0.0), (8.912, 11.113), (-8.512, 14.891), (-22.415, 2.558), (20.45, 0.0))
    case = Case(Venue(Area("kite", (ring,))), Dragon(38, 3.23, 2.0), (), limits(stray=0.1))
    result = case.answer()
    assert isinstance(result, core.Proposals)
    assert [one.figure for one in result.proposals] == [Figure.RING]
    assert result.proposals[0].tolerance >= case.limits["stray"]
    assert refuted(case, result.proposals[0]) == ""


@pytest.mark.parametrize("margin", [0.0, 0.02])
def test_the_largest_stray_of_a_reason_has_a_dance(margin: float) -> None:
    dragon = Dragon(12)
    reason = propose(SMALL, dragon, stray=0.8, margin=margin).reason
    assert reason is not None
    assert reason.kind is ReasonKind.STRAY
    assert reason.have is not None
    best = propose(SMALL, dragon, stray=0.999 * reason.have, margin=margin, count=1).proposals[0]
    assert best.report.passed
    assert propose(SMALL, dragon, stray=1.1 * reason.have, margin=margin).reason is not None


def test_the_same_question_has_the_same_answer() -> None:
    first, again = (propose(SMALL, Dragon(10), figures=["ring", "spiral"], count=2) for _ in range(2))
    assert [one.dance for one in first.proposals] == [one.dance for one in again.proposals]
    assert first.tried == again.tried


def test_one_figure_gives_several_different_dances() -> None:
    result = propose(PLACE, Dragon(12), figures=["ring"], count=3)
    places = {tuple(np.round(one.dance.path.position(one.dance.path.begin), 1)) for one in result.proposals}
    assert len(places) == 3


def test_a_speed_limit_slows_the_head() -> None:
    case = Case(SMALL, Dragon(12), (), limits(speed_limit=0.9))
    for one in case.proposals(figures=["serpentine", "ring"]).proposals:
        assert one.dance.head_speed <= 0.9
        assert refuted(case, one) == ""


def test_more_turns_and_longer_dances_are_wished_for() -> None:
    kinds = {
        name: propose(PLACE, Dragon(12), figures=["ring", "spiral"], objective=name, count=1)
        for name in Objective
        if name is not Objective.BENCHES
    }
    best = {name: result.proposals[0] for name, result in kinds.items()}
    assert best[Objective.TURNS].turns > best[Objective.TOLERANCE].turns
    assert best[Objective.DURATION].duration > best[Objective.TOLERANCE].duration
    assert best[Objective.TOLERANCE].tolerance == max(one.tolerance for one in best.values())


def test_the_most_benches_are_below_the_bound_of_the_areas_and_no_dance_has_one_more() -> None:
    result = propose(SMALL, Dragon(10), figures=["ring"], objective="benches", count=1)
    best = result.proposals[0]
    most = best.dance.dragon.benches
    assert 10 < most <= (result.most_benches or 0)
    more = propose(SMALL, Dragon(2 * most), figures=["ring"])
    assert more.proposals == ()
    assert more.reason is not None
    assert refuted(Case(SMALL, best.dance.dragon, (), limits()), best) == ""


@pytest.mark.parametrize("last", [0.3, 1.0, 4.0], ids=["thin", "like the others", "wide"])
@pytest.mark.parametrize("side", [0.5, 3.0, 5.0])
def test_the_bound_of_the_areas_is_that_of_every_other_bench_of_a_dragon_whose_last_bench_differs(
    last: float, side: float
) -> None:
    yard = Venue(box("yard", 0, 0, side, side))
    dragon = Dragon.of([3.4, *[2.0] * 8, 2.0], [1.0] * 9 + [last], [0.275] * 10)
    result = propose(yard, dragon, figures=["ring"], count=1, objective="benches")
    areas = [2.0 if k else 3.4 for k in range(9)] + [2.0 * last] * 200
    fits = [max(sum(areas[:n:2]), sum(areas[1:n:2])) <= side * side for n in range(200)]
    assert result.most_benches == fits.index(False) - 1


def reason_of(venue: Venue, dragon: Dragon, **more: Any) -> core.Reason:
    result = propose(venue, dragon, **more)
    assert result.proposals == ()
    assert result.reason is not None
    assert result.message == result.reason.message
    return result.reason


def test_a_yard_that_is_too_narrow_is_told_with_both_widths() -> None:
    reason = reason_of(Venue(box("lane", 0, 0, 30, 3.0)), Dragon(8))
    assert reason.kind is ReasonKind.WIDTH
    assert reason.message == "The widest free circle is at most 3.02 m across; a turn of the head bench needs 3.91 m."


def test_trees_everywhere_leave_no_room() -> None:
    trees = [box(f"tree {i} {j}", 2.0 * i + 0.5, 2.0 * j + 0.5, 0.4, 0.4) for i in range(19) for j in range(14)]
    assert reason_of(Venue(SQUARE, tuple(trees)), FORTY).kind is ReasonKind.WIDTH


def test_too_many_benches_for_the_area_are_proven_to_be() -> None:
    reason = reason_of(SMALL, Dragon(BENCHES_MOST))
    assert (reason.kind, reason.tried) == (ReasonKind.AREA, 0)
    assert reason.message == "The benches cover at least 660.4 m2 at any moment; the square has 480.0 m2."


def test_a_dragon_that_is_too_long_is_told_how_many_benches_fit() -> None:
    reason = reason_of(SMALL, Dragon(120), figures=["ring"])
    assert reason.kind is ReasonKind.BENCHES
    assert reason.need == 120
    assert propose(SMALL, Dragon(int(reason.have or 0)), figures=["ring"], count=1).proposals


def test_a_passage_that_is_too_narrow_is_told_with_both_widths() -> None:
    walls = (box("wall", 19.5, 0, 1, 14.9), box("other wall", 19.5, 15.1, 1, 14.9))
    reason = reason_of(Venue(SQUARE, walls), Dragon(6), gates=[WEST, EAST], figures=["parade"])
    assert (reason.kind, reason.who) == (ReasonKind.WAY, (0, 1))
    assert reason.have is not None
    assert reason.have < (reason.need or 0.0)


@pytest.mark.parametrize("benches", [1, 2])
def test_one_bench_or_two_dance_too(benches: int) -> None:
    case = Case(SMALL, Dragon(benches), (), limits())
    result = case.proposals()
    assert len(result.proposals) == 3
    assert [refuted(case, one) for one in result.proposals] == ["", "", ""]


@pytest.mark.parametrize(
    ("more", "words"),
    [
        ({"figures": ["polka"]}, r"figures\[0\] must be one of spiral, eight, serpentine, ring, parade, got 'polka'"),
        ({"figures": []}, "figures must name at least one figure"),
        ({"figures": ["parade"]}, "figures must have two gates for a parade, which leads from one to the other, got 0"),
        ({"objective": "beauty"}, "objective must be one of tolerance, benches, turns, duration, got 'beauty'"),
        ({"count": 0}, "count must be positive, got 0"),
        ({"count": 1.5}, r"count must be a whole number, got 1\.5"),
        ({"stray": 5.0}, r"stray must be at most half the chord of bench 1 \(0\.825 m\), got 5 m"),
        ({"margin": -1.0}, "margin must be zero or more, got -1 m"),
        ({"speed_limit": 0.0}, "speed_limit must be "),
        ({"dragon": Dragon(100_000)}, r"dragon\.benches must be at most 2000, got 100000"),
        ({"gates": [Gate((5, 6), 0.0)]}, r"gates\[0\]\.point must be on the border of the square"),
    ],
)
def test_bad_input_is_one_sentence(more: dict[str, Any], words: str) -> None:
    with pytest.raises(InvalidValue, match=words):
        propose(SMALL, **{"dragon": Dragon(12), **more})


def test_an_unknown_limit_is_no_argument() -> None:
    with pytest.raises(TypeError, match="unexpected keyword argument 'strays'"):
        propose(SMALL, Dragon(3), strays=0.1)  # type: ignore[call-arg]


def test_what_was_found_before_the_work_ended_is_proposed() -> None:
    whole = Budget(1e12)
    every = propose(SMALL, Dragon(10), budget=whole)
    part = propose(SMALL, Dragon(10), budget=Budget(0.4 * (1e12 - whole.left)))
    assert 1 <= len(part.proposals) <= len(every.proposals)
    assert part.tried < every.tried
    with pytest.raises(TooMuchWork, match="no dance was found"):
        propose(SMALL, Dragon(10), budget=Budget(1e3))
