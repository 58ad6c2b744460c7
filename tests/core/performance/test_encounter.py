"""First encounters: the reference, invariances, grazes, and their ends."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from core import (
    Arc,
    Budget,
    Dance,
    Dragon,
    EndReason,
    FirstEncounter,
    InvalidValue,
    Line,
    Outcome,
    Part,
    Passage,
    Performance,
    Route,
    Spiral,
    TooMuchWork,
    encounter_check,
    first_encounter,
)
from tests.support.reference_encounters import CASES, performance_of

# Width of a bracket as promised where benches do not meet slowly [s].
NARROW = 1.01e-9
# Differences of times after a motion of the whole scene, or of the clock [s].
SAME_TIME = 1e-9
# Differences of the point of an encounter after such a motion [m].
SAME_PLACE = 1e-8


def reference(name: str, **options: Any) -> FirstEncounter:
    case = CASES[name]
    performance = performance_of(case)
    return first_encounter(performance, start=case["start"], stop=min(case["stop"], performance.end.time), **options)


@pytest.mark.parametrize("name", CASES)
def test_the_reference_is_met(name: str) -> None:
    case, met = CASES[name], reference(name)
    assert met.outcome.value == case["outcome"]
    if met.outcome is Outcome.CLEAR:
        near = met.certificate.least_clearance
        assert near is None or near.clearance >= case["least"] - 2e-6
        return
    assert met.time == pytest.approx(case["time"], rel=0, abs=case["time_error"])
    assert met.dragons is not None
    assert (list(met.dragons), list(met.benches or ())) == (case["dragons"], case["benches"])
    if met.outcome is Outcome.CONTACT:
        low, high = met.time_bracket or (0.0, math.inf)
        assert high - low <= (1.01e-8 if "grazed" in name else NARROW)
        assert low <= met.time <= high
    check = encounter_check(met)
    assert check is not None
    assert check.agree
    assert sum(map(len, check.judged)) == sum(one["dragon"]["benches"] for one in case["dances"])


@pytest.mark.parametrize(
    ("name", "symmetric"), [("two dragons in one spiral, opposite", True), ("random 0", False)], ids=["one", "random"]
)
def test_a_rotation_a_shift_and_a_mirror_of_all_change_nothing(name: str, symmetric: bool) -> None:
    known, case = reference(name), CASES[name]
    angle, shift = 0.7, np.array([31.0, -7.5])
    turn = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    for mirror in (1.0, -1.0):
        dances = []
        for one in case["dances"]:
            path = dict(one["path"])
            if path["kind"] == "spiral":
                centre = turn @ (np.array(path.get("centre", (0.0, 0.0))) * [1.0, mirror]) + shift
                path |= {"centre": tuple(centre), "rotation": mirror * path.get("rotation", 0.0) + angle}
                path["clockwise"] = path.get("clockwise", True) == (mirror > 0.0)
            else:
                path["points"] = [tuple(turn @ (np.array(point) * [1.0, mirror]) + shift) for point in path["points"]]
            dances.append({**one, "path": path})
        performance = performance_of({**case, "dances": dances})
        met = first_encounter(performance, start=case["start"], stop=min(case["stop"], performance.end.time))
        assert met.outcome is known.outcome
        assert met.time == pytest.approx(known.time, rel=0, abs=SAME_TIME)
        if symmetric:  # in one spiral the same meeting happens twice, half a turn apart
            assert met.benches in (known.benches, (known.benches or ())[::-1])
            continue
        assert (met.dragons, met.benches) == (known.dragons, known.benches)
        moved = turn @ (np.array(known.point) * [1.0, mirror]) + shift
        np.testing.assert_allclose(met.point, moved, rtol=0, atol=SAME_PLACE)


def test_a_shift_of_the_clock_changes_nothing() -> None:
    case = CASES["random 0"]
    known = reference("random 0")
    parts = [replace(part, delay=part.delay + 1000.0) for part in performance_of(case).parts]
    met = first_encounter(Performance(parts), start=case["start"] + 1000.0, stop=known.time + 1010.0)
    assert met.time == pytest.approx(known.time + 1000.0, rel=0, abs=SAME_TIME)
    assert (met.dragons, met.benches) == (known.dragons, known.benches)


def test_the_order_of_the_dragons_only_changes_their_numbers() -> None:
    known = reference("two dragons in one spiral, opposite")
    parts = performance_of(CASES["two dragons in one spiral, opposite"]).parts
    met = first_encounter(Performance(parts[::-1]), start=1e-6)
    assert met.time == pytest.approx(known.time, rel=0, abs=SAME_TIME)


def test_a_pause_is_a_delay() -> None:
    street = Route([Line((-80.0, 0.0), (80.0, 0.0))])
    crossing = Route([Line((0.0, -80.0), (0.0, 80.0))])
    waits = Dance(Dragon(20), crossing, passages=[Passage(1.0, until_time=50.0), Passage(0.0, until_time=53.5)])
    first = Part(Dance(Dragon(30), street))
    paused = first_encounter(Performance([first, Part(waits)]), start=54.0)
    delayed = first_encounter(Performance([first, Part(Dance(Dragon(20), crossing), 3.5)]), start=54.0)
    assert paused.time == pytest.approx(delayed.time, rel=0, abs=SAME_TIME)
    assert (paused.dragons, paused.benches) == (delayed.dragons, delayed.benches)
    # In closed form: the head of the second one comes to the side of the first dragon.
    assert paused.time == pytest.approx(3.5 + 80.0 - 0.15 - 0.275, rel=0, abs=1e-9)


@pytest.mark.parametrize("offset", [-1e-6, 1e-6])
def test_a_graze_is_decided_a_micrometre_from_the_touch(offset: float) -> None:
    # Two circles: the outer dragon overtakes. The corners of the inner one reach out to a radius in closed form, and
    # the inner side of an outer bench is nearest to the centre at its middle.
    inner, outer = Dragon(3, 2.0, 2.0, 0.3, 0.2), Dragon(1, 2.0, 2.0, 0.3, 0.2)
    radius, half = 14.0, 0.8
    reach = math.hypot(math.sqrt(radius**2 - half**2) + 0.15, 1.0)
    far = math.hypot(reach + 0.15 + offset, half)
    parts = [
        Part(Dance(inner, Route([Arc((0.0, 0.0), radius, 0.0, 9.0)]))),
        Part(Dance(outer, Route([Arc((0.0, 0.0), far, -0.6, 11.0)]), 1.4)),
    ]
    met = first_encounter(Performance(parts))
    assert met.outcome is (Outcome.CONTACT if offset < 0.0 else Outcome.CLEAR)
    if offset > 0.0:
        near = met.certificate.least_clearance
        assert near is not None
        assert near.clearance == pytest.approx(1e-6, rel=0, abs=1e-10)


def test_a_margin_is_met_earlier_and_a_stray_counts_as_ground() -> None:
    street, crossing = Route([Line((-80.0, 0.0), (80.0, 0.0))]), Route([Line((0.0, -80.0), (0.0, 80.0))])
    performance = Performance([Part(Dance(Dragon(30), street)), Part(Dance(Dragon(20), crossing), 3.5)])
    touch = first_encounter(performance, start=54.0)
    near = first_encounter(performance, start=54.0, margin=0.25)
    assert touch.time is not None
    assert near.time == pytest.approx(touch.time - 0.25, rel=0, abs=SAME_TIME)
    assert (near.gap, touch.gap) == (0.25, 0.0)
    stray = first_encounter(performance, start=54.0, stray=0.02)
    # One bench moves sideways by the stray and the other one forwards by it; a corner of a turning end reaches further.
    assert 0.04 < touch.time - stray.time < 0.05
    assert stray.gap == pytest.approx(touch.time - stray.time, rel=0, abs=SAME_TIME)
    check = encounter_check(stray)
    assert check is not None
    assert check.agree


def test_benches_that_overlap_at_the_start_are_named() -> None:
    met = reference("random 7")
    assert met.outcome is Outcome.CONTACT_AT_START
    assert met.time == CASES["random 7"]["start"]
    assert met.time_bracket is None
    assert met.gap == pytest.approx(CASES["random 7"]["least"], rel=0, abs=1e-6)
    assert repr(met) == "<FirstEncounter: bench 35 of dragon 0 and bench 0 of dragon 1 touch at 2.420001 s>"


def test_a_lone_dragon_meets_no_other() -> None:
    dance = Dance(Dragon(20), Spiral(0.4, 5.0))  # it touches itself on the way
    met = first_encounter(Performance([Part(dance)]))
    assert (met.outcome, met.time) == (Outcome.CLEAR, None)
    assert met.end is not None
    assert met.end.reason is EndReason.FOLD
    assert met.certificate.method.endswith("There is only one dragon, so there is no pair to judge.")


def test_dragons_apart_are_clear_up_to_a_fold() -> None:
    parts = [Part(Dance(Dragon(12), Spiral(1.2, 3.0, (x, 0.0))), delay) for x, delay in ((0.0, 0.0), (11.0, 3.0))]
    performance = Performance(parts)
    met = first_encounter(performance)
    assert met.outcome is Outcome.CLEAR
    assert met.end == performance.end
    assert met.certificate.clear_until == performance.end.time
    assert repr(met).endswith(f"until {performance.end.time:.9g} s, where bench 0 of dragon 0 folds>")


def test_two_dragons_that_fold_together_near_each_other_are_judged_to_the_end() -> None:
    # Half a turn apart in a wide spiral: their heads keep a metre apart at the fold.
    parts = [Part(Dance(Dragon(8), Spiral(5.0, 2.0, rotation=turn))) for turn in (0.0, math.pi)]
    met = first_encounter(Performance(parts))
    assert met.outcome in (Outcome.CLEAR, Outcome.CONTACT)
    just_before = first_encounter(Performance(parts), stop=Performance(parts).end.time - 1e-3)
    if met.outcome is Outcome.CLEAR:
        assert just_before.outcome is Outcome.CLEAR


def test_a_stop_ends_the_search() -> None:
    met = reference("two dragons in one spiral, opposite")
    assert met.time is not None
    before = first_encounter(met.performance, stop=met.time - 1.0)
    assert before.outcome is Outcome.CLEAR
    assert before.end is not None
    assert (before.end.reason, before.end.time) == (EndReason.STOP, met.time - 1.0)


def test_a_spent_and_a_stopped_budget_are_told() -> None:
    performance = performance_of(CASES["two dragons in one spiral, opposite"])
    with pytest.raises(TooMuchWork, match="parts must be fewer, or the time asked about shorter"):
        first_encounter(performance, start=1.0, budget=Budget(100.0))
    stopped = Budget()
    stopped.stop()
    with pytest.raises(TooMuchWork) as ended:
        first_encounter(performance, start=1.0, budget=stopped)
    assert ended.value.stopped


@pytest.mark.parametrize(("name", "value"), [("margin", -0.1), ("margin", "wide"), ("stray", 5.0), ("stray", None)])
def test_wrong_options_are_refused(name: str, value: Any) -> None:
    performance = performance_of(CASES["two dragons in one spiral, opposite"])
    with pytest.raises(InvalidValue) as refused:
        first_encounter(performance, **{name: value})
    assert refused.value.field == name


def test_only_a_performance_can_be_asked_about() -> None:
    with pytest.raises(InvalidValue, match="performance must be a Performance, got a Dance"):
        first_encounter(Dance(Dragon(3), Spiral()))  # type: ignore[arg-type]
