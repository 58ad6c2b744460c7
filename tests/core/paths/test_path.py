"""Path: a spiral, a turn and a route answer every question about a path alike."""

import math

import numpy as np
import pytest

from core import Arc, Clothoid, Coil, Line, Route, Spiral, Turn, Waypoints
from tests.support.near import assert_near

PATHS = {
    "spiral": Spiral(0.55, 16.0),
    "spiral elsewhere": Spiral(0.55, 16.0, (40.0, -7.0), 0.3, clockwise=False),
    "turn": Turn(1.7),
    "line and arc": Route([Line((0.0, 0.0), (30.0, 0.0)), Arc((30.0, 3.0), 3.0, -math.pi / 2, 2.0)], 12.0),
    "coil": Route([Coil(0.9, 3.0, 9.0)]),
    "clothoid": Route([Clothoid((1.0, 2.0), 0.4, -0.3, 0.35, 30.0)]),
    "waypoints": Route([Waypoints(((0.0, 0.0), (6.0, 1.0), (11.0, 6.0), (9.0, 13.0)))]),
}
# Half of the distance of the points of a difference quotient [m], and what it is off by, far from joints [1], [1/m].
STEP = 1e-5
QUOTIENT_ERROR = 1e-6
# Handles lie on the path to this [m].
ON_PATH = 1e-9


@pytest.fixture(params=PATHS.values(), ids=PATHS)
def path(request):
    return request.param


@pytest.fixture
def s(path):
    """Arc lengths of the head at random, none so near to a joint of the pieces above that a quotient spans it [m]."""
    return np.random.default_rng(3).uniform(max(path.begin, -30.0) + 0.1, min(path.end, 60.0) - 0.1, 200)


def test_the_tangent_is_the_change_of_the_position_and_the_curvature_of_the_tangent(path, s):
    tangent = path.tangent(s)
    ahead, bend = ((ask(s + STEP) - ask(s - STEP)) / (2.0 * STEP) for ask in (path.position, path.tangent))
    assert_near(np.linalg.norm(tangent, axis=-1), np.ones(s.size), 1e-14)
    assert_near(ahead, tangent, QUOTIENT_ERROR)
    left = np.stack([-tangent[..., 1], tangent[..., 0]], axis=-1)
    assert_near((bend * left).sum(axis=-1), path.curvature(s), QUOTIENT_ERROR)


def test_one_place_has_the_answer_that_it_has_among_many(path, s):
    for ask in (path.position, path.tangent, path.curvature):
        many = ask(s.reshape(10, 20))
        assert np.array_equal(many, np.array([ask(place) for place in s.tolist()]).reshape(many.shape))


def test_the_head_stands_at_its_place_and_angles_belong_to_spirals(path, s):
    for travel in [*s[:20].tolist(), path.end if math.isfinite(path.end) else 0.0]:
        head = path.head(travel)
        assert_near([head.x, head.y], path.position(travel), ON_PATH)
        assert_near(head.radius, math.dist((head.x, head.y), path.frame.centre), ON_PATH)
        assert (head.theta is None) is (path.spiral is None)
    assert path.limit >= path.end


def test_the_path_as_a_route_is_the_same_in_its_own_frame(path, s):
    route = path.as_route(60.0)
    assert_near(path.frame.points(route.position(s)), path.position(s), ON_PATH)
    assert route.spiral is None


def test_the_curvature_is_below_its_bounds(path):
    s = np.linspace(path.begin, path.end, 2_000)[:-1]
    bends = np.abs(path.curvature(s))
    assert bends.max() <= path.sharpest_before(float(s[-1])) * (1.0 + 1e-12)
    if path.spiral is not None:
        gentle = path.along(np.array(path.gentle_lag(0.5)))
        assert bends[s <= gentle].max() <= 0.5 < bends.max()
    else:
        tight = sum((a <= s) & (s <= b) for a, b, _ in path.tighter(2.5))
        assert (bends[tight == 0] <= 0.4).all()


def test_a_drawing_of_the_whole_path_begins_where_its_first_point_is(path):
    low, high = path.drawn_between(path.begin, path.end)
    assert low == path.begin
    assert high == path.end
    assert_near(path.drawn_begin(path.position(np.array([low, low + 5.0]))), low, ON_PATH)
    assert path.drawn_between(-1e4, path.end)[0] == (-1e4 if path.spiral else path.begin)
