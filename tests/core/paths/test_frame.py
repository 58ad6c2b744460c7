"""Frame: a moved spiral gives the moved results of the standard one; the mirror image is made by complex numbers."""

from __future__ import annotations

import cmath
from collections.abc import Callable

import numpy as np
import pytest

from core import (
    Area,
    Coil,
    Dance,
    Dragon,
    InvalidValue,
    Route,
    Spiral,
    Venue,
    check,
    clearance_profile,
    envelope,
    first_contact,
    tolerance,
    trajectory,
    venue_clearance,
)
from core.values import Floats
from tests.support.near import assert_near

DRAGON = Dragon(30)
PLACES = {
    "shifted": ((120.0, -45.5), 0.0, True),
    "turned": ((0.0, 0.0), 2.2, True),
    "mirrored": ((0.0, 0.0), 0.0, False),
    "far, turned and mirrored": ((-30_000.0, 50_000.0), -0.7, False),
}
# Rounding of a coordinate in the world, by its size [m].
ROUNDING = 1e-10
SQUARE = ((-9.5, -9.0), (9.2, -9.0), (9.2, 9.4), (-9.5, 9.4), (-9.5, -9.0))
TREE = ((2.0, 0.5), (2.5, 0.5), (2.5, 1.0), (2.0, 1.0), (2.0, 0.5))


def moved(centre: tuple[float, float], rotation: float, clockwise: bool) -> Callable[[Floats], Floats]:
    """Points of the standard spiral as they should be in the world."""

    def move(points: Floats) -> Floats:
        own = np.asarray(points) @ [1.0, 1.0j]
        world = complex(*centre) + cmath.exp(1j * rotation) * (own if clockwise else own.conj())
        return np.stack([world.real, world.imag], axis=-1)

    return move


@pytest.fixture(params=PLACES.values(), ids=PLACES)
def two(request: pytest.FixtureRequest) -> tuple[Dance, Dance, Callable[[Floats], Floats]]:
    """The standard dance, the same elsewhere, and the way from one to the other."""
    standard = Spiral(0.55, 14.0)
    return Dance(DRAGON, standard), Dance(DRAGON, Spiral(0.55, 14.0, *request.param)), moved(*request.param)


Two = tuple[Dance, Dance, Callable[[Floats], Floats]]


def test_everything_that_has_a_place_is_moved(two: Two) -> None:
    standard, elsewhere, move = two
    times = [0.0, 100.0, 250.0]
    old, new = trajectory(standard, times), trajectory(elsewhere, times)
    near = {"rtol": 0, "atol": ROUNDING}
    np.testing.assert_allclose(new.position, move(old.position), **near)
    np.testing.assert_allclose(new.velocity, move(old.velocity) - move(np.zeros(2)), **near)
    assert (new.speed == old.speed).all()
    assert (trajectory(elsewhere, times[1]).position == new.position[1]).all()
    head, there = elsewhere.path.head(100.0), standard.path.head(100.0)
    assert (head.radius, head.theta) == (there.radius, there.theta)
    np.testing.assert_allclose([head.x, head.y], move(np.array([there.x, there.y])), **near)
    drawn = elsewhere.path.drawn(new.position)
    assert_near(drawn, move(standard.path.drawn(old.position)), 10 * ROUNDING)


def test_no_time_and_no_distance_depends_on_the_place(two: Two) -> None:
    standard, elsewhere, move = two
    old, new = first_contact(standard), first_contact(elsewhere)
    assert (new.time, new.time_bracket, new.benches, new.corner) == (
        old.time,
        old.time_bracket,
        old.benches,
        old.corner,
    )
    assert new.certificate.method == old.certificate.method
    assert_near(new.point, move(np.array(old.point)), ROUNDING)
    profile = clearance_profile(elsewhere, [0.0, 200.0])
    assert profile.clearance.tolist() == clearance_profile(standard, [0.0, 200.0]).clearance.tolist()


def test_a_venue_is_met_where_it_is(two: Two) -> None:
    standard, elsewhere, move = two

    def venue(place: Callable[[Floats], Floats]) -> Venue:
        areas = [Area(name, (tuple(map(tuple, place(np.array(ring)))),)) for name, ring in rings.items()]
        return Venue(areas[0], tuple(areas[1:]))

    rings = {"square": SQUARE, "tree": TREE}
    old = venue_clearance(standard, venue(lambda points: points), stop=200.0)
    new = venue_clearance(elsewhere, venue(move), stop=200.0)
    for one, other in zip(old.areas, new.areas, strict=True):
        assert (one.outcome, one.bench, one.nearest.bench) == (other.outcome, other.bench, other.nearest.bench)
        assert_near(other.nearest.distance, one.nearest.distance, ROUNDING)
        assert_near(other.nearest.point, move(np.array(one.nearest.point)), 1e-6)
        assert_near(other.nearest.wall, move(np.array(one.nearest.wall)), 1e-6)
    assert new.misplaced == old.misplaced
    assert (
        check(elsewhere, venue=venue(move), stop=150.0).verdict
        is check(standard, venue=venue(lambda p: p), stop=150.0).verdict
    )


def test_the_ground_and_the_pose_that_shows_a_contact_lie_where_the_dance_is(two: Two) -> None:
    standard, elsewhere, move = two
    span = {"start": 300.0, "stop": 310.0}
    old, new = envelope(standard, excess=0.01, **span), envelope(elsewhere, excess=0.01, **span)
    assert new.area == pytest.approx(old.area, rel=1e-9)
    for rings, others in zip(old.polygons, new.polygons, strict=True):
        for ring, other in zip(rings, others, strict=True):
            flip = 1 if elsewhere.path.frame.clockwise else -1
            assert_near(other[::flip], move(ring), ROUNDING)
    result = tolerance(elsewhere, **span)
    assert result.stray == tolerance(standard, **span).stray
    strays = result.exhibit.handles - trajectory(elsewhere, result.exhibit.time).position
    assert_near(np.hypot(*strays.T).max(), result.exhibit.stray, 1e-9)


def test_a_spiral_lies_as_a_coil_does() -> None:
    centre, rotation = (7.0, -3.0), 1.1
    spiral, coil = Spiral(0.55, 14.0, centre, rotation), Route([Coil(0.55, 14.0, 3.0, centre, rotation)])
    times = [0.0, 80.0, 200.0]
    ours, theirs = (trajectory(Dance(DRAGON, path), times).position for path in (spiral, coil))
    assert_near(ours, theirs, 1e-10)


@pytest.mark.parametrize(
    ("field", "place"),
    [("path.centre", {"centre": (0.0,)}), ("path.centre.1", {"centre": (0.0, 1e9)}),
     ("path.rotation", {"rotation": float("nan")}), ("path.clockwise", {"clockwise": 1})],
)  # fmt: skip
def test_an_invalid_place_is_refused_by_name(field: str, place: dict[str, object]) -> None:
    with pytest.raises(InvalidValue) as refused:
        Spiral(**place)  # type: ignore[arg-type]
    assert refused.value.field == field
