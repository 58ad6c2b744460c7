"""Poses that show a contact: they overlap, keep every chord, and stray little further than what is proven safe."""

import pytest

from core import Dance, Dragon, Line, Route, Spiral, Turn, tolerance
from tests.campaigns.adversaries import to_circle
from tests.core.tolerance.test_tolerance import BRACKET
from tests.support.shown_poses import assert_contact_shown

LINE = Route([Line((0.0, 0.0), (50.0, 0.0))])
WIDE = Dragon(20, body_length=1.2, width=0.5)
SIZES = Dragon.of([2.6, 1.9, 2.2, 2.0, 2.4] * 8, [0.3, 0.5] * 20, [0.2] * 40)


@pytest.mark.parametrize(
    "dance, stop, least, part, pair",
    [
        (*to_circle(0.55), 0.0465, BRACKET, (0, 19)),
        (Dance(Dragon(60), Spiral(0.9)), None, 0.05, BRACKET, None),
        (Dance(SIZES, Turn(1.7)), 60.0, 0.01, BRACKET, None),
        # the first pose that is tried does not overlap
        (Dance(Dragon(40, 2.6, 2.4, 0.2, 0.2), Spiral(1.1, 10.0)), 40.0, 0.3, 6e-3, None),
        # the benches between two that stray far stray no further
        (Dance(Dragon(36, 3.6, 1.95, 0.2, 0.06), Spiral(1.08, 10.0)), 22.0, 0.6, BRACKET, None),
        # the next turn limits the stray, not the next bench but one
        (Dance(Dragon(60), Spiral(2.0)), Spiral(2.0).travel_to(4.5), 0.67, 0.03, None),
        # short chords and wide benches on a line: a small bend of all three is enough
        (Dance(WIDE, LINE), None, 0.05, 0.06, None),
        # the bound for three benches is not as tight as that for two
        (Dance(Dragon(3, 1.6, 1.6, 1.0, 0.275), LINE), None, 0.1, 0.2, (0, 2)),
        # the head and bench 2 come first where benches are taken to be independent, but fold with 10 cm only
        (Dance(WIDE, Spiral(5.0)), Spiral(5.0).travel_to(20.0), 0.06, 0.03, (1, 3)),
    ],
    ids=[
        *("default", "to its fold", "many sizes", "second pose", "far", "next turn"),
        *("wide", "very wide", "of three in a row"),
    ],
)
def test_the_shown_contact_is_one(dance, stop, least, part, pair):
    """Its pose strays little further than is proven safe."""
    result = tolerance(dance, stop=stop)
    safe, touching = result.stray_bracket
    assert least < safe < touching < safe * (1.0 + part)
    assert_contact_shown(dance, result.exhibit)
    assert result.exhibit.stray == touching
    first, second = result.exhibit.benches
    assert pair in (None, (first, second))
    assert (second == first + 2) is (dance.path is LINE or pair == (1, 3))
    if dance.path is LINE:
        assert "are held apart by it" in result.certificate.method
        assert 1.1 * result.independent < safe
    else:
        assert result.benches == result.exhibit.benches
