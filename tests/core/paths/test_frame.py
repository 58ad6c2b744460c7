"""Frame: a moved spiral gives the moved results of the standard one; the mirror image is made by complex numbers."""

import cmath

import numpy as np
import pytest

from core import (
    Dance,
    Dragon,
    Spiral,
    envelope,
    first_contact,
    tolerance,
    trajectory,
)
from tests.support.near import assert_near

DRAGON = Dragon(30)
STANDARD = Dance(DRAGON, Spiral(0.55, 14.0))
PLACES = {
    "shifted": ((120.0, -45.5), 0.0, True),
    "mirrored": ((0.0, 0.0), 0.0, False),
    "far, turned and mirrored": ((-30_000.0, 50_000.0), -0.7, False),
}
# Rounding of a coordinate in the world, by its size [m].
ROUNDING = 1e-10


@pytest.fixture(params=PLACES.values(), ids=PLACES)
def moved(request):
    """The standard dance elsewhere, and where its points should be in the world."""
    centre, rotation, clockwise = request.param

    def move(points):
        own = np.asarray(points) @ [1.0, 1.0j]
        world = complex(*centre) + cmath.exp(1j * rotation) * (own if clockwise else own.conj())
        return np.stack([world.real, world.imag], axis=-1)

    return Dance(DRAGON, Spiral(0.55, 14.0, *request.param)), move


def test_everything_that_has_a_place_is_moved(moved):
    dance, move = moved
    times = [0.0, 100.0, 250.0]
    old = trajectory(STANDARD, times)
    new = trajectory(dance, times)
    assert_near(new.position, move(old.position), ROUNDING)
    assert_near(new.velocity, move(old.velocity) - move(np.zeros(2)), ROUNDING)
    assert (new.speed == old.speed).all()
    head = dance.path.head(100.0)
    there = STANDARD.path.head(100.0)
    assert head.radius == there.radius
    assert head.theta == there.theta
    assert_near(dance.path.drawn(new.position), move(STANDARD.path.drawn(old.position)), 10 * ROUNDING)


def test_no_time_and_no_distance_depends_on_the_place(moved):
    dance, move = moved
    old = first_contact(STANDARD)
    new = first_contact(dance)
    assert (new.time_bracket, new.benches, new.corner) == (old.time_bracket, old.benches, old.corner)
    assert_near(new.point, move(np.array(old.point)), ROUNDING)


def test_the_ground_and_the_pose_that_shows_a_contact_lie_where_the_dance_is(moved):
    dance, move = moved
    span = {"start": 300.0, "stop": 310.0}
    old = envelope(STANDARD, excess=0.01, **span)
    new = envelope(dance, excess=0.01, **span)
    assert new.area == pytest.approx(old.area, rel=1e-9)
    flip = 1 if dance.path.frame.clockwise else -1
    for rings, others in zip(old.polygons, new.polygons, strict=True):
        for ring, other in zip(rings, others, strict=True):
            assert_near(other[::flip], move(ring), ROUNDING)
    result = tolerance(dance, **span)
    assert result.stray == tolerance(STANDARD, **span).stray
    strays = result.exhibit.handles - trajectory(dance, result.exhibit.time).position
    assert_near(np.hypot(*strays.T).max(), result.exhibit.stray, 1e-9)
