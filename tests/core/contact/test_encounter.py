"""First encounters: the reference, invariances, grazes, and their ends."""

import math
from dataclasses import replace

import numpy as np
import pytest

from core import (
    Arc,
    Dance,
    Dragon,
    Line,
    Outcome,
    Part,
    Passage,
    Performance,
    Route,
    Waypoints,
    encounter_check,
    first_encounter,
)
from tests.support.near import assert_near
from tests.support.reference_encounters import CASES, performance_of
from tests.support.shared_dances import in_one_spiral, on_lanes

# Width of a bracket as promised where benches do not meet slowly [s].
NARROW = 1.01e-9
# Difference of times after a motion of the clock [s].
SAME_TIME = 1e-9
STREETS = on_lanes(((-80.0, 0.0), (80.0, 0.0)), ((0.0, -80.0), (0.0, 80.0)), benches=30).parts


def first_of(case):
    performance = performance_of(case)
    return first_encounter(performance, start=case["start"], stop=min(case["stop"], performance.end.time))


@pytest.mark.parametrize("name", CASES)
def test_the_reference_is_met(name):
    case = CASES[name]
    met = first_of(CASES[name])
    assert met.outcome.value == case["outcome"]
    if met.outcome is Outcome.CLEAR:
        near = met.certificate.least_clearance
        assert near is None or near.clearance >= case["least"] - 2e-6
        return
    assert_near(met.time, case["time"], case["time_error"])
    assert list(met.dragons) == case["dragons"]
    assert list(met.benches) == case["benches"]
    if met.outcome is Outcome.CONTACT_AT_START:
        assert_near(met.gap, case["least"], 1e-6)
    else:
        low, high = met.time_bracket
        assert low <= met.time <= high <= low + (1.01e-8 if "grazed" in name else NARROW)
    check = encounter_check(met)
    assert check.agree
    assert sum(map(len, check.judged)) == sum(one["dragon"]["benches"] for one in case["dances"])


@pytest.mark.parametrize("speed, away, width", [(0.001, 0.0, 4.1e-9), (0.0025, 0.0, NARROW), (0.0065, 300.0, NARROW)])
def test_benches_that_meet_slowly_have_a_bracket_as_narrow_as_rounding_lets_it_be(speed, away, width):
    angle = 0.0457
    middle = np.array([22.6 + away, 0.0])
    way = 20.0 * np.array([math.cos(angle), math.sin(angle)])
    lanes = ((away, 0.0), (40.0 + away, 0.0)), (tuple(middle - way), tuple(middle + way))
    slow = (
        [Passage(1.0, until_s=17.34), Passage(speed, until_s=19.34)],
        [Passage(1.0, until_s=19.0), Passage(speed, until_s=21.0)],
    )
    first, second = (
        Dance(Dragon(3), Route([Waypoints(points)]), passages=own) for points, own in zip(lanes, slow, strict=True)
    )
    low, high = first_encounter(Performance([Part(first), Part(second, 2.535)])).time_bracket
    assert high - low < width


@pytest.mark.parametrize("offset", [-1e-6, 1e-6])
def test_a_graze_is_decided_a_micrometre_from_the_touch(offset):
    # Two circles: the outer dragon overtakes. The corners of the inner one reach out to a radius in closed form, and
    # the inner side of an outer bench is nearest to the centre at its middle.
    radius = 14.0
    half = 0.8
    sizes = (2.0, 2.0, 0.3, 0.2)
    reach = math.hypot(math.sqrt(radius**2 - half**2) + 0.15, 1.0)
    far = math.hypot(reach + 0.15 + offset, half)
    inner = Dance(Dragon(3, *sizes), Route([Arc((0.0, 0.0), radius, 0.0, 9.0)]))
    outer = Dance(Dragon(1, *sizes), Route([Arc((0.0, 0.0), far, -0.6, 11.0)]), 1.4)
    met = first_encounter(Performance([Part(inner), Part(outer)]))
    assert met.outcome is (Outcome.CONTACT if offset < 0.0 else Outcome.CLEAR)
    if offset > 0.0:
        assert_near(met.certificate.least_clearance.clearance, 1e-6, 1e-10)


def test_a_margin_is_met_earlier_and_a_stray_counts_as_ground():
    performance = Performance([STREETS[0], replace(STREETS[1], delay=3.5)])
    queries = {}, {"margin": 0.25}, {"stray": 0.02}
    touch, near, stray = (first_encounter(performance, start=54.0, **query) for query in queries)
    assert_near(near.time, touch.time - 0.25, SAME_TIME)
    assert near.gap == 0.25
    assert touch.gap == 0.0
    # One bench moves sideways by the stray and the other one forwards by it; a corner of a turning end reaches further.
    assert 0.04 < touch.time - stray.time < 0.05
    assert_near(stray.gap, touch.time - stray.time, SAME_TIME)
    assert encounter_check(stray).agree


def test_a_dragon_that_begins_a_rounding_later_than_another_one_is_judged_like_it():
    starts = (14.411, math.nextafter(14.411, 15.0))
    lanes = [Route([Line((-40.0, y), (40.0, y))], start) for y, start in zip((0.0, 3.0), starts, strict=True)]
    met = first_encounter(Performance([Part(Dance(Dragon(8), lane)) for lane in lanes]))
    assert met.outcome is Outcome.CLEAR


def test_two_dragons_that_meet_less_than_half_a_second_before_they_fold_are_judged_rightly():
    together = in_one_spiral(8, 5.0, 2.0)
    met = first_encounter(together)
    assert together.end.time - 0.5 < met.time < together.end.time
    assert encounter_check(met).agree
