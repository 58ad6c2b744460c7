"""The stage: where rings prove that all is clear. Speeds that change within a step: test_clearance.py."""

import math

import pytest

from core import Dance, Dragon, Part, Performance, Spiral
from core.contact.stage import Stage


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
    assert stage.rings == {}
    assert stage.clear_until() == 0.0
