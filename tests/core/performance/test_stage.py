"""The stage: speeds, breaks, and where rings prove that all is clear."""

import math

import pytest

from core import Dance, Dragon, Part, Passage, Performance, Spiral
from core.performance.stage import Stage
from tests.support.shared_dances import lane

STREET = lane((-30.0, 0.0), (30.0, 0.0))


def test_steps_break_where_a_speed_changes():
    slow = Dance(Dragon(3), STREET, 1.0, [Passage(0.5, until_time=20.0), Passage(0.0, until_time=25.0)])
    other = Part(Dance(Dragon(3), Spiral(1.0, 5.0, (90.0, 0.0)), 1.5))
    stage = Stage(Performance([Part(slow, 4.0), other]), (0.0, 45.0), 0.0)
    player = stage.players[0]
    first = player.begin
    assert stage.breaks(0.0, 45.0) == [0.0, 4.0, first, 24.0, 29.0, 45.0]  # at 4 s the first passage begins
    spans = (0.0, first), (first, 24.0), (24.0, 29.0), (29.0, 45.0)
    assert [player.speed(*span) for span in spans] == [0.0, 0.5, 0.0, 1.0]
    # Before its delay is over the dragon stands at its beginning.
    assert player.travel(0.0) == slow.clock.travel(slow.begin)


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
def test_rings_prove_nothing_elsewhere(second):
    performance = Performance([Part(Dance(Dragon(80), path)) for path in (Spiral(1.1, 10.0), second)])
    stage = Stage(performance, (0.0, 50.0), 0.0)
    assert (stage.rings, stage.clear_until()) == ({}, 0.0)
