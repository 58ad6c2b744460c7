"""Performances: what they refuse, and when they begin and end."""

import pytest

from core import Dance, Dragon, EndReason, OutsideRun, Part, Performance, Spiral
from core.performance import STANDING
from tests.support.refused import refused
from tests.support.shared_dances import lane

DRAGON = Dragon(3)
STREET = Dance(DRAGON, lane((0.0, 0.0), (40.0, 0.0)))
WINDING = Dance(DRAGON, Spiral(1.1, 4.0))
LONG = [Dance(Dragon(5000 + more), lane((0.0, 0.0), (9000.0, 0.0))) for more in range(2)]
TWO = Performance([Part(STREET, 5.0, "east"), Part(STREET, -2.0, "west")])


@pytest.mark.parametrize(
    "field, call",
    [
        ("parts", lambda: Performance([])),
        ("parts", lambda: Performance([Part(STREET)] * 201)),
        ("parts", lambda: Performance([Part(LONG[1]), *[Part(LONG[0])] * 199])),
        ("parts.1.name", lambda: Performance([Part(STREET, name="east")] * 2)),
        ("colour", lambda: Part(STREET, colour="red")),
        ("colour", lambda: Part(STREET, colour=7)),
        ("delay", lambda: Part(STREET, 1.001e6)),
        ("stop", lambda: TWO.span(5.0, 5.0)),
        ("parts.0", lambda: Performance([STREET])),
        ("dance", lambda: Part(DRAGON)),
        ("venue", lambda: Performance([Part(STREET)], venue=3)),
        # It begins when another one folds.
        ("parts.0.delay", lambda: Performance([Part(WINDING, WINDING.end.time), Part(WINDING)])),
    ],
)
def test_wrong_parts_are_named(field, call):
    with refused(field):
        call()


def test_a_start_at_the_end_of_a_performance_is_refused():
    with refused("start", OutsideRun):
        TWO.span(TWO.end.time)


def test_a_performance_ends_at_the_first_fold_or_with_the_last_path():
    assert STREET.end.reason is EndReason.END
    assert (TWO.end.reason, TWO.end.time, TWO.end.dragon) == (EndReason.END, STREET.end.time + 5.0, None)
    assert TWO.begin == STREET.begin - 2.0
    end = Performance([Part(STREET), Part(WINDING, 3.0), Part(WINDING, 1.0)]).end
    fold = WINDING.end
    assert (end.reason, end.time, end.dragon, end.bench) == (EndReason.FOLD, fold.time + 1.0, 2, fold.bench)


def test_a_performance_may_have_as_many_parts_and_benches_as_its_limits_say():
    assert Performance([Part(LONG[0], 1e6)] * 200).begin == LONG[0].begin + 1e6


def test_a_dragon_that_stands_has_a_moment_of_its_dance_for_any_span():
    part, (begin, end) = TWO.parts[0], (STREET.begin, STREET.end.time)
    assert part.own_span(begin + 6.0, end + 4.0) == pytest.approx((begin + 1.0, end - 1.0))
    assert part.own_span(begin - 9.0, begin) == (begin, begin + STANDING)
    assert part.own_span(end + 6.0, end + 9.0) == (end - STANDING, end)
