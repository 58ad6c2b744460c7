"""Steps in time: where they break, where they end, and how crossings are found."""

from core.contact.stage import Stage
from core.contact.stage_march import EncounterMarch, beyond
from core.kernels import Ended
from tests.support.shared_dances import EAST, NORTH, on_lanes


def test_a_certain_encounter_is_found_behind_an_undecided_touch():
    stage = Stage(on_lanes(EAST, NORTH), (15.0, 60.0), 0.0)
    met = EncounterMarch(stage).run(15.0, 60.0)
    later = beyond(stage, met._replace(ended=Ended.STUCK, proven=met.proven - 5e-4), 60.0)
    assert later.touching > met.proven
