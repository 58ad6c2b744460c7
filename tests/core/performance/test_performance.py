"""Performances: what they refuse, and when they begin and end."""

from __future__ import annotations

import math
from typing import Any

import pytest

from core import (
    Area,
    Dance,
    Dragon,
    EndReason,
    InvalidValue,
    Line,
    OutsideRun,
    Part,
    Performance,
    Route,
    Spiral,
    Venue,
    first_encounter,
)

DRAGON = Dragon(3)
STREET = Dance(DRAGON, Route([Line((0.0, 0.0), (40.0, 0.0))]))
WINDING = Dance(DRAGON, Spiral(1.1, 4.0))


@pytest.mark.parametrize(
    ("parts", "message"),
    [
        ([], "parts must be at least one, got 0"),
        ([Part(STREET)] * 1000, "parts must be at most 200, got 1000"),
        (3, "parts must be a list of Part objects, got 3"),
        ([STREET], "parts[0] must be a Part, got a Dance"),
        (
            [Part(STREET, name="east"), Part(WINDING), Part(STREET, name="east")],
            "parts[2].name must differ from parts[0].name, got 'east'",
        ),
    ],
    ids=["none", "a thousand", "no list", "a dance", "equal names"],
)
def test_wrong_parts_are_named(parts: Any, message: str) -> None:
    with pytest.raises(InvalidValue) as refused:
        Performance(parts)
    assert refused.value.message == message


def test_a_delay_of_a_lifetime_is_refused() -> None:
    with pytest.raises(InvalidValue) as refused:
        Part(STREET, 1e9)
    assert refused.value.message == "delay must be at most 1e+06 s, got 1000000000 s"


def test_wrong_values_of_a_part_are_refused() -> None:
    with pytest.raises(InvalidValue, match="dance must be a Dance"):
        Part(DRAGON)  # type: ignore[arg-type]
    with pytest.raises(InvalidValue, match="name must be one line of plain text"):
        Part(STREET, name="two\nlines")
    with pytest.raises(InvalidValue, match="venue must be a Venue"):
        Performance([Part(STREET)], venue=3)  # type: ignore[arg-type]


def test_a_part_that_begins_after_another_one_folds_is_refused() -> None:
    fold = WINDING.end.time
    with pytest.raises(InvalidValue) as refused:
        Performance([Part(STREET, fold), Part(WINDING)])
    assert refused.value.field == "parts.0.delay"
    assert "must let parts[0] begin, which is at" in refused.value.message
    assert "before bench 0 of parts[1] folds at" in refused.value.message
    assert Performance([Part(STREET, fold - STREET.begin - 1e-6), Part(WINDING)]).end.dragon == 1


def test_a_performance_ends_at_the_first_fold_or_with_the_last_path() -> None:
    assert STREET.end.reason is EndReason.END
    two = Performance([Part(STREET, 5.0), Part(STREET, -2.0)])
    assert (two.end.reason, two.end.time, two.end.dragon) == (EndReason.END, STREET.end.time + 5.0, None)
    assert two.begin == STREET.begin - 2.0
    winding = Performance([Part(STREET), Part(WINDING, 3.0), Part(WINDING, 1.0)])
    assert (winding.end.reason, winding.end.time) == (EndReason.FOLD, WINDING.end.time + 1.0)
    assert (winding.end.dragon, winding.end.bench) == (2, WINDING.end.bench)


def test_dances_that_share_no_time_meet_where_one_stands() -> None:
    # The first one stays at the end of its street, where the second one comes later.
    later = Dance(DRAGON, Route([Line((-60.0, 0.0), (40.0, 0.0))]))
    delay = STREET.end.time - later.begin + 10.0
    performance = Performance([Part(STREET), Part(later, delay)])
    assert performance.parts[1].begin > performance.parts[0].end
    met = first_encounter(performance)
    tail = 40.0 - float(DRAGON.chords.sum()) - float(DRAGON.overhangs[2])
    assert (met.dragons, met.benches) == ((0, 1), (2, 0))
    # 60 m from the beginning of the second street to x = 0
    assert met.time == pytest.approx(delay + 60.0 + tail - float(DRAGON.overhangs[0]), abs=1e-9)


@pytest.mark.parametrize(
    ("span", "kind", "message"),
    [
        ((-50.0, None), OutsideRun, "start must be at least"),
        ((None, 1e6), OutsideRun, "stop must be at most"),
        ((1e5, None), OutsideRun, "start must be before"),
        ((20.0, 20.0), InvalidValue, "stop must be after start (20 s), got 20 s"),
        ((math.nan, None), InvalidValue, "start must be a finite number"),
    ],
    ids=["before", "after", "start after", "empty", "no number"],
)
def test_times_outside_a_performance_are_refused(span: Any, kind: Any, message: str) -> None:
    performance = Performance([Part(WINDING, name="green"), Part(Dance(DRAGON, Spiral(1.1, 4.0, (30.0, 0.0))))])
    with pytest.raises(kind) as refused:
        performance.span(*span)
    assert message in refused.value.message
    if kind is OutsideRun and message != "start must be at least":
        assert refused.value.message.split("when ")[1].startswith("bench 0 of green folds")


def test_a_performance_tells_its_dragons_and_its_time() -> None:
    square = Area("square", (((-50, -50), (50, -50), (50, 50), (-50, 50), (-50, -50)),))
    performance = Performance([Part(STREET, name="east"), Part(WINDING)], Venue(square))
    assert repr(performance) == (
        f"<Performance: 2 dragons (east, dragon 1), from {performance.begin:.9g} to {performance.end.time:.9g} s>"
    )
