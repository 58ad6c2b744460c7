"""The stage: speeds, breaks, and where rings prove that all is clear."""

from __future__ import annotations

import math

import pytest

from core import Dance, Dragon, Line, Part, Passage, Performance, Route, Spiral
from core.performance.stage import Stage

STREET = Route([Line((-30.0, 0.0), (30.0, 0.0))])


def test_steps_break_where_a_speed_changes() -> None:
    slow = Dance(Dragon(3), STREET, 1.0, [Passage(0.5, until_time=20.0), Passage(0.0, until_time=25.0)])
    performance = Performance([Part(slow, 4.0), Part(Dance(Dragon(3), Spiral(1.0, 5.0, (90.0, 0.0)), 1.5))])
    stage = Stage(performance, (0.0, 45.0), 0.0)
    first = stage.players[0].begin
    assert stage.breaks(0.0, 45.0) == [0.0, 4.0, first, 24.0, 29.0, 45.0]  # at 4 s the first passage begins
    assert [stage.players[0].speed(*span) for span in ((0.0, first), (first, 24.0), (24.0, 29.0), (29.0, 45.0))] == [
        0.0,
        0.5,
        0.0,
        1.0,
    ]
    # Before its delay is over the dragon stands at its beginning.
    assert stage.players[0].travel(0.0) == slow.clock.travel(slow.begin)


@pytest.mark.parametrize("pitch", [1.1, 2.0])
def test_in_one_spiral_all_is_clear_until_a_head_is_at_the_radius(pitch: float) -> None:
    parts = [Part(Dance(Dragon(80), Spiral(pitch, 10.0, rotation=turn))) for turn in (0.0, math.pi)]
    stage = Stage(Performance(parts), (0.0, 45.0), 0.0)
    radius = stage.rings[0, 1]
    until = stage.clear_until()
    for part in parts:
        assert part.dance.path.head(part.dance.clock.travel(until)).radius >= radius
    later = Stage(Performance(parts), (0.0, parts[0].end), 0.0).clear_until()
    reached = parts[0].dance.path.head(parts[0].dance.clock.travel(later)).radius
    assert reached == pytest.approx(radius, rel=1e-9)


@pytest.mark.parametrize(
    "second",
    [
        Spiral(1.1, 10.0, clockwise=False),
        Spiral(1.1, 10.0, (0.1, 0.0), math.pi),
        Spiral(1.2, 10.0, rotation=math.pi),
        Spiral(1.1, 10.0, rotation=0.5),
    ],
    ids=["the other way", "another centre", "another pitch", "too near"],
)
def test_rings_prove_nothing_elsewhere(second: Spiral) -> None:
    performance = Performance([Part(Dance(Dragon(80), path)) for path in (Spiral(1.1, 10.0), second)])
    stage = Stage(performance, (0.0, 50.0), 0.0)
    assert stage.rings == {}
    assert stage.clear_until() == 0.0


def test_rows_lead_back_to_dragons_and_benches() -> None:
    performance = Performance([Part(Dance(Dragon(3), STREET)), Part(Dance(Dragon(2), STREET), 90.0)])
    stage = Stage(performance, (10.0, 20.0), 0.0)
    assert stage.pair(2, 5) == ((0, 1), (2, 1))
