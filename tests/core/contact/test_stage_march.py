"""Steps in time: where they break, where they end, and how crossings are found."""

import math

import pytest

from core.contact.stage import Stage
from core.contact.stage_march import EncounterMarch, beyond, least_after, to_fold
from core.kernels import Ended
from core.sampling import crossing
from tests.support.shared_dances import EAST, NORTH, on_lanes, side_by_side

# Width of a crossing in these tests [s].
WIDTH = 1e-12


@pytest.mark.parametrize("zero", [0.1, 0.5, 0.999])
def test_a_crossing_is_never_early_and_late_by_less_than_its_width(zero):
    looks = []

    def value(time):
        looks.append(time)
        return math.exp(zero) - math.exp(time)

    assert zero <= crossing(value, 0.0, 1.0, WIDTH) <= zero + 2.0 * WIDTH
    assert len(looks) < 40
    assert crossing(value, 1.0, 2.0, WIDTH) == 1.0  # not above zero where it begins


def test_a_certain_encounter_is_found_behind_an_undecided_touch():
    stage = Stage(on_lanes(EAST, NORTH), (15.0, 60.0), 0.0)
    met = EncounterMarch(stage).run(15.0, 60.0)
    later = beyond(stage, met._replace(ended=Ended.STUCK, proven=met.proven - 5e-4), 60.0)
    assert later.touching > met.proven


def test_the_rest_before_a_fold_is_clear_only_where_the_gap_exceeds_the_motion_left():
    performance = side_by_side()
    end = performance.end.time
    stage = Stage(performance, (0.0, end), 0.0)
    folding = stage.folding(end)
    assert folding == [0, 1]
    met = to_fold(stage, EncounterMarch(stage), 0.0, end, folding)
    assert met.ended == Ended.REACHED
    assert met.proven == end
    stage.enter(end - 1e-4, end)
    gap, _ = stage.nearest()
    # Benches move by a millimetre and more in the last tenth of a millisecond.
    for spare, clear in ((1e-6, False), (0.2, True), (gap, True)):
        near = Stage(performance, (0.0, end), gap - spare)
        assert (least_after(near, end - 1e-4, end, folding) > near.margin) is clear
