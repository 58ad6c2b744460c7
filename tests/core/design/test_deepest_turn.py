"""The shortest turn: just deeper something touches or a bench cannot follow, at it and above nothing does."""

from __future__ import annotations

import math
from functools import cache
from typing import Any

import numpy as np
import pytest
import shapely

import core.design.deepest_turn
from core import (
    Dance,
    DeepestTurn,
    Dragon,
    InvalidValue,
    Outcome,
    TooMuchWork,
    Turn,
    TurnLimit,
    bench_poses,
    deepest_turn,
    first_contact,
    least_clearance,
    trajectory,
)
from core.shapes.rectangles import corners
from tests.support.depth import some

ENTRY_ERROR = 1e-9  # [m]
STEP = 0.1  # [s], between the instants that shapely sees
FINE_STEP = 2e-3  # [s], the same around the instant of least clearance
NEAR = 0.9  # [m], farther pairs are not measured
DEEPER = 1e-5  # [m], an entry clearly on the other side of the border

# A long head reaches the bend first; as short a head as the body lets benches touch first.
EVEN = {"benches": 25, "head_length": 2.2}
CONTACT: dict[str, tuple[dict[str, Any], dict[str, Any]]] = {
    "margin": ({"benches": 30}, {"pitch": 1.7, "ratio": 1.0, "margin": 0.2}),
    "tight pitch": ({"benches": 30}, {"pitch": 1.25, "ratio": 0.7}),
    "wide benches": ({**EVEN, "width": 0.45}, {"pitch": 1.4, "ratio": 1.0}),
    "small dragon": (
        {"benches": 25, "head_length": 1.5, "body_length": 1.5, "width": 0.4, "overhang": 0.2},
        {"pitch": 1.1, "ratio": 1.3},
    ),
}
BEND: dict[str, tuple[dict[str, Any], dict[str, Any]]] = {
    "contest": ({"benches": 30}, {"pitch": 1.7}),
    "equal arcs": ({"benches": 30}, {"pitch": 1.7, "ratio": 1.0}),
    "even": (EVEN, {"pitch": 1.2}),
}


@cache
def answer(name: str) -> DeepestTurn:
    sizes, request = (CONTACT | BEND)[name]
    return deepest_turn(Dragon(**sizes), **request)


def slow_clearance(dragon: Dragon, result: DeepestTurn, entry: float, start: float, stop: float, step: float) -> float:
    """Least distance of benches that share no handle on the turn with that entry, by shapely; at most NEAR."""
    danced = Turn(result.turn.pitch, result.turn.turning_radius, result.turn.ratio, entry_radius=entry)
    sizes = np.stack([dragon.lengths, dragon.widths], axis=-1)
    least = NEAR
    poses = bench_poses(trajectory(Dance(dragon, danced), np.arange(start, stop, step)).position)
    for benches in shapely.polygons(corners(poses, np.broadcast_to(sizes, (*poses.shape[:2], 2)))):
        a, b = shapely.STRtree(benches).query(benches, predicate="dwithin", distance=least)
        apart = b > a + 1
        least = min(least, shapely.distance(benches[a[apart]], benches[b[apart]]).min(initial=least))
    return float(least)


def whole(dragon: Dragon, result: DeepestTurn) -> tuple[float, float]:
    """From before any bench is in the turn until all are past it [s]."""
    length = float(dragon.chords.sum()) + 15.0
    return -15.0, result.turn.length + length


@pytest.mark.parametrize("name", some(list(CONTACT), 2))
def test_just_deeper_two_benches_come_within_the_margin_and_above_none_do(name: str) -> None:
    sizes, request = CONTACT[name]
    dragon, margin, result = Dragon(**sizes), request.get("margin", 0.0), answer(name)
    infeasible, feasible = result.entry_bracket
    assert result.limited_by is TurnLimit.CONTACT
    assert 0.0 < feasible - infeasible <= ENTRY_ERROR
    assert result.turn.entry_radius == feasible
    assert result.benches is not None
    assert result.time is not None
    around = (result.time - 0.3, result.time + 0.3, FINE_STEP)
    assert slow_clearance(dragon, result, infeasible - DEEPER, *around) <= margin
    assert slow_clearance(dragon, result, feasible + DEEPER, *around) > margin
    for entry in some((feasible, 0.5 * (feasible + result.turn.turning_radius), result.turn.turning_radius), 2):
        assert slow_clearance(dragon, result, entry, *whole(dragon, result), STEP) > margin


@pytest.mark.parametrize("name", BEND)
def test_just_deeper_a_bench_cannot_follow_and_above_all_do_without_contact(name: str) -> None:
    sizes, request = BEND[name]
    dragon, result = Dragon(**sizes), answer(name)
    infeasible, feasible = result.entry_bracket
    assert (result.limited_by, result.benches, result.time) == (TurnLimit.BEND, None, None)
    assert 0.0 < feasible - infeasible <= ENTRY_ERROR
    with pytest.raises(InvalidValue, match="must not bend tighter"):
        slow_clearance(dragon, result, infeasible - ENTRY_ERROR, 0.0, STEP, STEP)
    assert slow_clearance(dragon, result, feasible, *whole(dragon, result), STEP) > 0.0
    # the sum of both radii is sqrt(entry^2 + growth^2), and the smaller one just fits the longest chord
    smaller = 0.5 * float(dragon.chords.max()) / core.kernels.ROUTE_SINE_LIMIT
    total = smaller * (1.0 + request.get("ratio", 2.0)) / min(1.0, request.get("ratio", 2.0))
    assert feasible == pytest.approx(
        math.sqrt(total**2 - (request["pitch"] / (2.0 * math.pi)) ** 2), abs=2 * ENTRY_ERROR
    )


@pytest.mark.parametrize("name", [*CONTACT, *BEND])
def test_the_part_that_is_followed_has_the_contacts_of_the_whole_dance(name: str) -> None:
    sizes, request = (CONTACT | BEND)[name]
    dragon, margin = Dragon(**{**sizes, "benches": 150}), request.get("margin", 0.0)
    result = answer(name)
    for entry in (result.turn.entry_radius, result.turn.turning_radius):
        danced = Turn(
            result.turn.pitch, result.turn.turning_radius, result.turn.ratio, start_turns=30, entry_radius=entry
        )
        way, front = core.design.deepest_turn.way_followed(dragon, danced, margin)
        assert front.benches < dragon.benches
        span = 1.6 * float(dragon.chords.sum())
        assert way < span
        in_all = first_contact(Dance(dragon, danced), margin=margin, start=-span, stop=danced.length + span)
        assert in_all.outcome is Outcome.CLEAR


def test_the_answer_does_not_depend_on_how_long_the_dragon_or_the_coil_is() -> None:
    (sizes, request), known = CONTACT["margin"], answer("margin")
    for dragon, start_turns in ((Dragon(**sizes), 80.0), (Dragon(benches=1_000), 3.0)):
        other = deepest_turn(dragon, **request, start_turns=start_turns)
        assert other.turn.entry_radius == pytest.approx(known.turn.entry_radius, abs=ENTRY_ERROR)
        assert other.benches == known.benches


def test_a_dragon_given_bench_by_bench_has_the_answer_of_the_uniform_one() -> None:
    uniform = Dragon(**CONTACT["margin"][0])
    widths = uniform.widths.copy()
    widths[-1] -= 1e-9
    listed = Dragon.of(uniform.lengths, widths, uniform.overhangs)
    assert listed.uniform_from > uniform.uniform_from
    a, b = answer("margin"), deepest_turn(listed, **CONTACT["margin"][1])
    assert a.turn.entry_radius == pytest.approx(b.turn.entry_radius, abs=ENTRY_ERROR)
    assert (a.limited_by, a.benches) == (b.limited_by, b.benches)


def test_nothing_limits_a_tiny_dragon_down_to_the_centre() -> None:
    result = deepest_turn(Dragon(5, 0.1, 0.1, 0.01, 0.01), 1.7)
    step = core.design.deepest_turn.ENTRY_STEP * 4.5
    assert (result.limited_by, result.entry_bracket) == (TurnLimit.CENTRE, (0.0, step))
    assert result.scan_step == step


def test_one_bench_is_limited_by_the_bend_alone() -> None:
    result = deepest_turn(Dragon(benches=1), 1.7, margin=1.0)
    assert result.limited_by is TurnLimit.BEND


@pytest.mark.parametrize(
    ("sizes", "query", "words"),
    [
        (
            {},
            {"turning_radius": 4.0},
            r"got 4 m: a turn that begins on the circle bends to a radius of 1\.336 m, too tight .* \(2\.86 m\)$",
        ),
        ({}, {"pitch": 0.8}, r"benches 0 and 15 touch 13\.286258 s after the entry"),
        ({}, {"pitch": 0.5, "start_turns": 30, "turning_radius": 4.2}, r"bends to a radius"),
        ({}, {"margin": 0.4}, r"come within 0\.4 m .* s after the entry"),
        ({"width": 1.8}, {"start_turns": 30}, r"touch .* s before the entry at 1 m/s"),
    ],
    ids=["bend", "contact", "bend first", "margin", "on the coil"],
)
def test_a_turn_that_cannot_be_danced_even_at_the_circle_is_refused(sizes: Any, query: Any, words: str) -> None:
    with pytest.raises(InvalidValue, match=words) as e:
        deepest_turn(Dragon(**sizes), **{"pitch": 1.7, **query})
    assert e.value.field == "turning_radius"


@pytest.mark.parametrize("margin", [-0.1, math.nan, "1"])
def test_an_invalid_margin_is_refused(margin: Any) -> None:
    with pytest.raises(InvalidValue) as e:
        deepest_turn(Dragon(), 1.7, margin=margin)
    assert e.value.field == "margin"


def test_the_turn_of_a_short_head_is_searched_only_until_nothing_can_follow() -> None:
    """The search of the whole dance, 590 m at each entry, was given up near the bend, which was taken for a contact."""
    result = deepest_turn(Dragon(head_length=1.001), 1.7, ratio=1.0)
    assert result.limited_by is TurnLimit.BEND


def test_work_that_ends_before_the_turn_is_found_is_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    for work in (1e4, 4e4):  # on the first entry, and on one further in
        monkeypatch.setattr(core.design.deepest_turn, "TURN_WORK", work)
        with pytest.raises(TooMuchWork, match=rf"turning_radius must .*, got 4.5 m: .* within {work:g} steps of work"):
            deepest_turn(Dragon(), 1.7)


def test_work_that_ends_while_the_turn_is_bisected_leaves_a_wider_bracket(monkeypatch: pytest.MonkeyPatch) -> None:
    (sizes, request), whole = CONTACT["margin"], answer("margin")
    monkeypatch.setattr(core.design.deepest_turn, "TURN_WORK", 4e5)
    least = deepest_turn(Dragon(**sizes), **request)
    assert least.entry_bracket[0] <= whole.entry_bracket[0]
    assert whole.entry_bracket[1] <= least.entry_bracket[1]
    assert least.evaluations < whole.evaluations


@pytest.mark.parametrize("number", [3, 8])  # of steps from the circle to the entry
def test_a_margin_that_an_entry_only_just_keeps_is_limited_by_the_pair_that_meets_deeper(
    number: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Rounding hides whether the pair meets at that entry, so the lower end of the bracket is a deeper one."""
    dragon, entry = Dragon(40), 4.5
    for _ in range(number):
        entry -= 0.01 * 4.5

    def dance(entry_radius: float) -> Dance:
        return Dance(dragon, Turn(1.7, 4.5, 1.0, start_turns=16.0, entry_radius=entry_radius))

    least = least_clearance(dance(entry))
    assert least is not None
    result = deepest_turn(dragon, 1.7, ratio=1.0, margin=least.distance)
    infeasible, feasible = result.entry_bracket
    assert infeasible < entry <= feasible < infeasible + 20 * ENTRY_ERROR
    assert (result.limited_by, result.benches) == (TurnLimit.CONTACT, least.benches)
    assert first_contact(dance(infeasible), margin=least.distance).benches == least.benches
    assert first_contact(dance(feasible), margin=least.distance).outcome is Outcome.CLEAR
    monkeypatch.setattr(core.design.deepest_turn, "LOOKED_BELOW", 0.0)
    hidden = deepest_turn(dragon, 1.7, ratio=1.0, margin=least.distance)
    assert (hidden.limited_by, hidden.benches, hidden.time) == (TurnLimit.UNDECIDED, None, None)
    assert hidden.entry_bracket == (entry, feasible)
