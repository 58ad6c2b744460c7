"""What a refusal says would be followed is followed, and hardly less is not."""

import math
import re

import pytest

from core import Arc, Dance, Dragon, InvalidValue, Legs, Line, Route
from core.paths.following import follows

DRAGON = Dragon(20)
STREET = [(0.0, 0.0), (60.0, 0.0)]


def bent(radius, degrees):
    turn = math.radians(degrees)
    end = complex(60.0 + radius * math.sin(turn), radius * (1.0 - math.cos(turn)))
    far = end + complex(30.0 * math.cos(turn), 30.0 * math.sin(turn))
    bend = Arc((60.0, radius), radius, -0.5 * math.pi, turn)
    return Route([Line(*STREET), bend, Line((end.real, end.imag), (far.real, far.imag))])


def number(pattern, path):
    with pytest.raises(InvalidValue) as refused:
        Dance(DRAGON, path)
    return float(re.search(pattern, str(refused.value))[1])


@pytest.mark.parametrize("radius, degrees", [(0.5, 150.0), (1.0, 149.0), (1.25, 250.0)])
def test_the_missing_angle_and_the_nearest_radius_of_a_bend_are_true(radius, degrees):
    missing = number(r"of which ([0-9.]+) degrees are too much", bent(radius, degrees))
    assert follows(DRAGON, bent(radius, degrees - missing))
    assert not follows(DRAGON, bent(radius, degrees - missing + 0.2))
    least = number(r"is followed with a radius of ([0-9.]+) m", bent(radius, degrees))
    assert follows(DRAGON, bent(least, degrees))
    assert not follows(DRAGON, bent(least - 0.02, degrees))


def test_drawn_legs_are_followed_with_the_radius_that_the_refusal_names_also_where_corners_are_near_each_other():
    points = [*STREET, (61.0, 2.0), (59.0, 3.5), (40.0, 20.0)]
    least = number(r"with a radius of ([0-9.]+) m at its corners", Legs(points, range(4), radius=0.2))
    assert follows(DRAGON, Legs(points, range(4), radius=least))
    assert not follows(DRAGON, Legs(points, range(4), radius=least - 0.02))
