"""Ways to the circle: the statement on a pitch against dense samples of its way."""

import pytest

import core.design.ways
from core import Dragon, Spiral, TooMuchWork, minimum_pitch
from core.design.ways import CONTACT_WIDTH, Ways
from core.kernels import Ended
from tests.core.design.test_minimum_pitch import FOLDING
from tests.support.near import assert_near
from tests.support.refused import refused
from tests.support.slow_search import SlowDance

RADIUS = 3.0
TURNS = 9.0
# The head of FOLDING folds on a circle of 0.85 m at this pitch, by 40 digits [m].
FOLDS_AT = 0.525552677857343
# A pair at a computed place of the head is within this of its gap there [m].
GAP = 1e-9


def test_where_a_way_ends_the_pair_touches_and_with_a_wider_pitch_it_does_not():
    ways = Ways(Dragon(14), RADIUS, TURNS, 0.0, 0.0, None)
    pitch = 0.44
    result = ways.march(pitch, CONTACT_WIDTH)
    assert result.ended is Ended.TOUCHED
    dance = SlowDance.of(Dragon(14), Spiral(pitch, TURNS))
    assert_near(dance.pair_gap(result.touching, result.pair), 0.0, GAP)
    radius = dance.head(result.touching) * dance.growth
    assert ways.still_touches(pitch, radius - 1e-6, *result.pair)
    assert not ways.still_touches(1.1 * pitch, radius, *result.pair)
    later = Ways(Dragon(14), RADIUS, 0.999 * radius / pitch, 0.0, 0.0, None)
    assert not later.still_touches(pitch, radius - 1e-6, *result.pair)  # its way begins further in


@pytest.mark.parametrize("more, ended", [(-1e-6, Ended.BENCH_FOLDED), (1e-6, Ended.REACHED)])
def test_a_way_folds_below_the_pitch_at_which_the_head_folds_on_the_circle(more, ended):
    ways = Ways(FOLDING, 0.85, 5.0, 0.0, 0.0, None)
    assert ways.march(FOLDS_AT + more).ended is ended
    assert ways.is_clear(FOLDS_AT + more) is (more > 0.0)


@pytest.mark.parametrize(
    "dragon, field",
    [
        (Dragon(head_length=1.0), "dragon.head_length"),
        (Dragon.of([2.2, 2.1, 2.0] * 20, [0.3] * 60, [0.2] * 60), "dragon.lengths.2"),
    ],
    ids=["a short head", "bench by bench"],
)
def test_the_shortest_bench_is_named_where_the_work_ends(dragon, field, monkeypatch):
    monkeypatch.setattr(core.design.ways, "PITCH_WORK", 1e2)
    with refused(field, TooMuchWork):
        minimum_pitch(dragon)
