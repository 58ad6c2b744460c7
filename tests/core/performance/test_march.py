"""Steps in time: where they break, where they end, and how crossings are found."""

from __future__ import annotations

import math

import pytest

from core import Arc, Dance, Dragon, Line, Part, Performance, Route, Spiral
from core.kernels import Ended
from core.performance.march import EncounterMarch, beyond, crossing, least_after, to_fold
from core.performance.stage import Stage

# Width of a crossing in these tests [s].
WIDTH = 1e-12


@pytest.mark.parametrize("zero", [0.1, 0.5, 0.999])
def test_a_crossing_is_never_early_and_late_by_less_than_its_width(zero: float) -> None:
    looks = []

    def value(time: float) -> float:
        looks.append(time)
        return math.exp(zero) - math.exp(time)

    high = crossing(value, 0.0, 1.0, WIDTH)
    assert zero <= high <= zero + 2.0 * WIDTH
    assert len(looks) < 40
    assert crossing(value, 1.0, 2.0, WIDTH) == 1.0  # not above zero where it begins


def crossed() -> Performance:
    street, other = Route([Line((-40.0, 0.0), (40.0, 0.0))]), Route([Line((0.0, -40.0), (0.0, 40.0))])
    return Performance([Part(Dance(Dragon(5), street)), Part(Dance(Dragon(4), other, 1.2), 3.0)])


def test_a_margin_just_above_the_least_gap_is_met_and_just_below_is_proven() -> None:
    circles = [Route([Arc((0.0, 0.0), radius, start, 11.0)]) for radius, start in ((14.0, 0.0), (14.6, -1.2))]
    performance = Performance([Part(Dance(Dragon(4), circles[0])), Part(Dance(Dragon(4), circles[1], 1.4), -1.0)])
    span = (10.0, 100.0)
    proven = EncounterMarch(Stage(performance, span, 0.0)).run(*span)
    assert proven.ended is Ended.REACHED
    assert proven.graze is not None
    bottom = proven.graze.gap
    assert EncounterMarch(Stage(performance, span, bottom - 1e-6)).run(*span).ended is Ended.REACHED
    met = EncounterMarch(Stage(performance, span, bottom + 1e-6)).run(*span)
    assert met.ended is Ended.TOUCHED
    assert met.touching is not None
    assert met.touching <= proven.graze.time + 1e-6


def test_a_certain_encounter_is_found_behind_an_undecided_touch() -> None:
    performance = crossed()
    stage = Stage(performance, (15.0, 60.0), 0.0)
    met = EncounterMarch(stage).run(15.0, 60.0)
    assert met.touching is not None
    later = beyond(stage, met._replace(ended=Ended.STUCK, proven=met.proven - 5e-4), 60.0)
    assert later is not None
    assert later.touching is not None
    assert later.touching > met.proven


def test_the_rest_before_a_fold_is_clear_only_where_the_gap_exceeds_the_motion_left() -> None:
    performance = Performance([Part(Dance(Dragon(3), Spiral(1.2, 2.0, (x, 0.0)))) for x in (0.0, 9.0)])
    end = performance.end.time
    stage = Stage(performance, (0.0, end), 0.0)
    folding = stage.folding(end)
    assert folding == [0, 1]
    assert least_after(stage, end - 1e-4, end, folding) > stage.margin
    met = to_fold(stage, EncounterMarch(stage), 0.0, end, folding)
    assert (met.ended, met.proven) == (Ended.REACHED, end)
    stage.enter(end - 1e-4, end)
    gap, *_ = stage.nearest()
    # Benches move by a millimetre and more in the last tenth of a millisecond.
    for spare, clear in ((1e-6, False), (0.2, True)):
        near = Stage(performance, (0.0, end), gap - spare)
        assert (least_after(near, end - 1e-4, end, folding) > near.margin) is clear
