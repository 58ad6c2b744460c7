"""Performances: what they refuse, and when they begin and end."""

import pytest

from core import Dance, Dragon, EndReason, Part, Performance, Spiral, first_encounter
from tests.support.refused import refused
from tests.support.shared_dances import lane

DRAGON = Dragon(3)
STREET = Dance(DRAGON, lane((0.0, 0.0), (40.0, 0.0)))
WINDING = Dance(DRAGON, Spiral(1.1, 4.0))


@pytest.mark.parametrize(
    ("field", "call"),
    [
        ("parts", lambda: Performance([])),
        ("parts", lambda: Performance([Part(STREET)] * 1000)),
        ("parts.0", lambda: Performance([STREET])),
        ("dance", lambda: Part(DRAGON)),
        ("venue", lambda: Performance([Part(STREET)], venue=3)),
        # It begins when another one has folded.
        ("parts.0.delay", lambda: Performance([Part(STREET, WINDING.end.time), Part(WINDING)])),
    ],
)
def test_wrong_parts_are_named(field, call):
    with refused(field):
        call()


def test_a_performance_ends_at_the_first_fold_or_with_the_last_path():
    assert STREET.end.reason is EndReason.END
    two = Performance([Part(STREET, 5.0), Part(STREET, -2.0)])
    assert (two.end.reason, two.end.time, two.end.dragon) == (EndReason.END, STREET.end.time + 5.0, None)
    assert two.begin == STREET.begin - 2.0
    end = Performance([Part(STREET), Part(WINDING, 3.0), Part(WINDING, 1.0)]).end
    fold = WINDING.end
    assert (end.reason, end.time, end.dragon, end.bench) == (EndReason.FOLD, fold.time + 1.0, 2, fold.bench)


def test_dances_that_share_no_time_meet_where_one_stands():
    # The first one stays at the end of its street, where the second one comes later.
    later = Dance(DRAGON, lane((-60.0, 0.0), (40.0, 0.0)))
    delay = STREET.end.time - later.begin + 10.0
    met = first_encounter(Performance([Part(STREET), Part(later, delay)]))
    tail = 40.0 - float(DRAGON.chords.sum()) - float(DRAGON.overhangs[2])
    assert (met.dragons, met.benches) == ((0, 1), (2, 0))
    # 60 m from the beginning of the second street to x = 0
    assert met.time == pytest.approx(delay + 60.0 + tail - float(DRAGON.overhangs[0]), abs=1e-9)
