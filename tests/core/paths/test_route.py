"""Routes: joints, arc length, and the same answers as an independent slow way."""

from __future__ import annotations

import cmath
import math
from itertools import pairwise

import numpy as np
import pytest
import shapely
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.optimize import brentq

from core import (
    Arc,
    Coil,
    Dance,
    Dragon,
    InvalidValue,
    Line,
    Outcome,
    OutsideRun,
    Piece,
    Route,
    Spiral,
    Turn,
    Waypoints,
    bench_poses,
    clearance_profile,
    first_contact,
    trajectory,
)
from core.paths.path import Path
from core.shapes.rectangles import corners
from tests.support.depth import examples
from tests.support.near import assert_near

TURN = Turn(1.7, 4.5, 2.0)
SAME = 1e-10  # [m], [m/s], [s]: one curve written in two ways
CHORD_ERROR = 1e-11  # [m], at coordinates to 100 m
PLACE_ERROR = 1e-9  # [m]: handles by a scan and brentq, each good to 1e-12 m, along a chain
TANGENT_ERROR = 1e-6  # [1]: by difference quotients
QUOTIENT_STEP = 1e-6  # [s]
QUOTIENT_ERROR = 1e-4  # [m/s]: accelerations jump at joints, which moves a quotient by their size times the step
TOUCHING = 1e-8  # [m]: two benches at the far end of a contact's bracket

DRAGON = Dragon(benches=16, head_length=1.8, body_length=1.4, width=0.3, overhang=0.2)


# -- joints and other faults ---------------------------------------------------------------------------------


def test_a_gap_is_refused_with_its_joint_and_size() -> None:
    with pytest.raises(
        InvalidValue, match=r"path\.pieces\[0\] and path\.pieces\[1\] must close: \(5, 0\) m is 0\.25 m"
    ) as e:
        Route([Line((0, 0), (5, 0)), Line((5.25, 0), (9, 0))])
    assert e.value.field == "path.pieces.1"


def test_a_kink_is_refused_with_its_joint_and_angle() -> None:
    kinked = Line((6, 0), (6 + math.cos(0.1), math.sin(0.1)))
    with pytest.raises(
        InvalidValue, match=r"path\.pieces\[2\] must be smooth: at \(6, 0\) m .* turns by 0\.1 rad"
    ) as e:
        Route([Line((0, 0), (5, 0)), Line((5, 0), (6, 0)), kinked])
    assert e.value.field == "path.pieces.2"


def test_a_way_back_on_itself_is_a_kink() -> None:
    with pytest.raises(InvalidValue, match=r"turns by 3\.14 rad"):
        Route([Line((0, 0), (5, 0)), Line((5, 0), (0, 0))])


def test_no_pieces_are_refused() -> None:
    with pytest.raises(InvalidValue, match="at least one piece"):
        Route([])


def test_what_is_no_piece_is_refused() -> None:
    with pytest.raises(
        InvalidValue, match=r"^path\.pieces\[0\] must be a Line, Arc, Coil, Clothoid or Waypoints, got 3$"
    ) as e:
        Route([3])  # type: ignore[list-item]
    assert e.value.field == "path.pieces.0"


@pytest.mark.parametrize("pieces", [None, 3, "line", Line((0, 0), (1, 0))])
def test_pieces_that_are_no_list_are_refused(pieces: list[Piece]) -> None:
    with pytest.raises(InvalidValue, match=r"path\.pieces must be a list of pieces, got") as e:
        Route(pieces)
    assert e.value.field == "path.pieces"


LENGTH = float(DRAGON.chords.sum())  # 16.4 m


@pytest.mark.parametrize(
    ("path", "head_speed", "first", "instants"),
    [
        (Route([Line((0, 0), (100, 0))]), 1.0, 17.0, range(17, 101)),
        (Route([Line((0, 0), (100.5, 0))], 10.0), 1.0, 7.0, range(7, 91)),
        (Route([Line((0, 0), (100, 0))], 60.0), 1.0, 0.0, range(41)),
        (Route([Line((0, 0), (100, 0))], 200.0), 1.0, -183.0, range(-183, -99)),
        (Route([Line((0, 0), (1000, 0))]), 1.0, 17.0, range(17, 318)),
        (Route([Line((0, 0), (100, 0))]), 7.0, 3.0, range(3, 15)),
        (TURN, 1.0, 0.0, range(301)),
        (Route([Coil(0.55, 16, 4)]), 1.0, 0.0, range(301)),
        (Route([Coil(0.55, 16, 4)], -7.5), 1.0, 8.0, range(8, 309)),
    ],
    ids=["line", "started", "long started", "ended", "long", "fast", "turn", "coil", "coil later"],
)
def test_default_instants_are_whole_seconds_that_the_run_has(
    path: Route, head_speed: float, first: float, instants: range
) -> None:
    times = Dance(DRAGON, path, head_speed).default_times
    assert times.tolist() == list(instants)
    assert math.ceil(Dance(DRAGON, path, head_speed).default_start) == first
    assert trajectory(Dance(DRAGON, path, head_speed), times).speed.min() >= 0.0


def test_a_run_too_short_for_a_whole_second_has_one_default_instant() -> None:
    path = Route([Line((0, 0), (LENGTH + 0.2, 0))])
    (time,) = Dance(DRAGON, path).default_times.tolist()
    assert_near(time, LENGTH, 1e-6)
    assert_near(trajectory(Dance(DRAGON, path), [time]).position[0, -1, 0], 0.0, 1e-6)


def test_an_instant_after_the_end_of_the_path_is_refused() -> None:
    route = Route([Line((0, 0), (100, 0))])
    trajectory(Dance(DRAGON, route), [100.0])
    with pytest.raises(OutsideRun, match=r"at most 100\.000000000 s, when the path ends"):
        trajectory(Dance(DRAGON, route), [100.001])


# -- a spiral written as a route -----------------------------------------------------------------------------


def as_route(spiral: Spiral, end_turns: float, cuts: tuple[float, ...] = ()) -> Route:
    turns = (spiral.start_turns, *cuts, end_turns)
    return Route([Coil(spiral.pitch, a, b) for a, b in pairwise(turns)])


@pytest.mark.parametrize("cuts", [(), (10.0, 4.2)], ids=["one coil", "three coils"])
def test_a_spiral_as_a_route_has_the_spirals_trajectory(cuts: tuple[float, ...]) -> None:
    times = np.linspace(-50.0, 412.0, 9)
    a = trajectory(Dance(Dragon(), Spiral()), times)
    b = trajectory(Dance(Dragon(), as_route(Spiral(), 3.0, cuts)), times)
    for name in ("position", "velocity", "speed"):
        assert np.abs(getattr(a, name) - getattr(b, name)).max() < SAME, name


@pytest.mark.parametrize("cuts", [(), (10.0, 4.2)], ids=["one coil", "three coils"])
def test_a_spiral_as_a_route_has_the_spirals_first_contact(cuts: tuple[float, ...]) -> None:
    a = first_contact(Dance(Dragon(), Spiral()))
    b = first_contact(Dance(Dragon(), as_route(Spiral(), 3.0, cuts)))
    assert (a.outcome, a.benches, a.corner, a.edge) == (b.outcome, b.benches, b.corner, b.edge)
    assert_near(a.time, b.time, SAME)
    assert_near(a.point, b.point, 10 * SAME)  # the time's error at the corner's speed
    assert b.head.theta is None
    assert_near([a.head.x, a.head.y], [b.head.x, b.head.y], 2 * SAME)


def test_a_spiral_as_a_route_has_the_spirals_clearance() -> None:
    times = np.linspace(300.0, 412.0, 15)
    a = clearance_profile(Dance(Dragon(), Spiral()), times)
    b = clearance_profile(Dance(Dragon(), as_route(Spiral(), 3.0)), times)
    assert_near(a.clearance, b.clearance, SAME)
    assert [g.benches for g in a.grazes] == [g.benches for g in b.grazes]
    assert_near([g.time for g in a.grazes], [g.time for g in b.grazes], 1e-7)  # flat at the bottom


# -- random routes -------------------------------------------------------------------------------------------


class Pen:
    """Draws pieces one after the other from a place in a direction, so that every joint is smooth."""

    def __init__(self, place: complex, heading: float) -> None:
        self.place, self.heading, self.pieces = place, heading, []

    def line(self, length: float) -> None:
        end = self.place + length * cmath.rect(1.0, self.heading)
        self.pieces.append(Line((self.place.real, self.place.imag), (end.real, end.imag)))
        self.place = end

    def arc(self, radius: float, sweep: float) -> None:
        angle = self.heading - math.copysign(0.5 * math.pi, sweep)
        centre = self.place - cmath.rect(radius, angle)
        self.pieces.append(Arc((centre.real, centre.imag), radius, angle, sweep))
        self.place, self.heading = centre + cmath.rect(radius, angle + sweep), self.heading + sweep

    def coil(self, pitch: float, start: float, end: float) -> None:
        growth, sign = pitch / (2.0 * math.pi), 1.0 if end > start else -1.0
        theta, last = 2.0 * math.pi * start, 2.0 * math.pi * end
        rotation = self.heading - cmath.phase(sign * complex(1.0, theta)) - theta
        centre = self.place - cmath.rect(growth * theta, theta + rotation)
        self.pieces.append(Coil(pitch, start, end, (centre.real, centre.imag), rotation))
        self.place = centre + cmath.rect(growth * last, last + rotation)
        self.heading = cmath.phase(sign * complex(1.0, last)) + last + rotation

    def waypoints(self, legs: list[tuple[float, float]]) -> None:
        points, place, heading = [self.place], self.place, self.heading
        for length, swerve in legs:
            heading += swerve
            place += cmath.rect(length, heading)
            points.append(place)
        self.pieces.append(Waypoints(tuple((p.real, p.imag) for p in points), self.heading, heading))
        self.place, self.heading = place, heading


lengths = st.floats(0.3, 3.0)
radii = st.floats(0.9, 3.0)
sweeps = st.floats(0.2, 5.5).flatmap(lambda angle: st.sampled_from([angle, -angle]))
coils = st.tuples(st.floats(0.9, 2.0), st.floats(2.0, 3.5), st.floats(2.0, 3.5)).filter(
    lambda c: abs(c[2] - c[1]) > 0.1
)
legs = st.lists(st.tuples(st.floats(2.5, 5.0), st.floats(-0.5, 0.5)), min_size=2, max_size=4)
strokes = st.one_of(
    st.tuples(st.just("line"), lengths.map(lambda x: (x,))),
    st.tuples(st.just("arc"), st.tuples(radii, sweeps)),
    st.tuples(st.just("coil"), coils),
    st.tuples(st.just("waypoints"), legs.map(lambda x: (x,))),
)


@st.composite
def routes(draw: st.DrawFn) -> Route:
    """Three to seven smooth pieces of any kind behind a line as long as the dragon; they may cross themselves."""
    pen = Pen(complex(draw(st.floats(-20, 20)), draw(st.floats(-20, 20))), draw(st.floats(-3.0, 3.0)))
    pen.line(1.01 * float(DRAGON.chords.sum()))
    for kind, values in draw(st.lists(strokes, min_size=3, max_size=7)):
        getattr(pen, kind)(*values)
    route = Route(pen.pieces)
    assume(0.5 * route.sharpest[0] * DRAGON.chords.max() < 0.9)
    return route


def instants(route: Route, count: int) -> np.ndarray:
    return np.linspace(1.005 * float(DRAGON.chords.sum()), route.end - QUOTIENT_STEP, count)


@settings(max_examples=40, deadline=None)
@given(routes())
def test_chords_keep_their_length_on_any_route(route: Route) -> None:
    handles = trajectory(Dance(DRAGON, route), instants(route, 25)).position
    chords = np.linalg.norm(np.diff(handles, axis=1), axis=-1)
    assert_near(chords, DRAGON.chords, CHORD_ERROR)


@settings(max_examples=40, deadline=None)
@given(routes())
def test_velocities_are_difference_quotients_on_any_route(route: Route) -> None:
    times = instants(route, 15)
    motion = trajectory(Dance(DRAGON, route), times)
    before, after = (
        trajectory(Dance(DRAGON, route), times + step).position for step in (-QUOTIENT_STEP, QUOTIENT_STEP)
    )
    assert_near((after - before) / (2.0 * QUOTIENT_STEP), motion.velocity, QUOTIENT_ERROR)
    assert_near(np.linalg.norm(motion.velocity, axis=-1), motion.speed, CHORD_ERROR)


def first_behind(route: Route, s: float, chord: float) -> float:
    """The first place behind s at the chord's distance, by a dense scan and brentq."""

    def beyond(back: float | np.ndarray) -> np.ndarray:
        return np.hypot(*(route.position(s - back) - route.position(s)).T) - chord

    backs = np.linspace(0.0, 2.0 * chord, 2_001)
    k = int(np.argmax(beyond(backs) >= 0.0))
    assert k > 0
    return s - brentq(beyond, backs[k - 1], backs[k], xtol=1e-14)


@settings(max_examples=20, deadline=None)
@given(routes())
def test_the_next_handle_is_the_first_point_behind_at_chord_distance(route: Route) -> None:
    times = instants(route, 4)
    motion = trajectory(Dance(DRAGON, route), times).position
    for handles, time in zip(motion, times, strict=True):
        s = float(time)
        for k, chord in enumerate(DRAGON.chords.tolist()):
            assert_near(route.position(s), handles[k], PLACE_ERROR)
            s = first_behind(route, s, chord)
        assert_near(route.position(s), handles[-1], PLACE_ERROR)


@settings(max_examples=40, deadline=None)
@given(routes(), st.floats(0.0, 1.0))
def test_position_runs_along_the_tangent_at_unit_speed(route: Route, share: float) -> None:
    step = 1e-6
    s = route.begin + step + share * (route.end - route.begin - 2.0 * step)
    quotient = (route.position(s + step) - route.position(s - step)) / (2.0 * step)
    assert_near(quotient, route.tangent(s), TANGENT_ERROR)
    assert_near(np.linalg.norm(route.tangent(s)), 1.0, 1e-14)


def slow_clearance(route: Route, times: np.ndarray) -> np.ndarray:
    """Least distance of benches that share no handle, by shapely; 0 where two overlap. (T,) [m]

    A pair whose middles are farther apart than both half diagonals together counts as infinitely far.
    """
    a, b = np.triu_indices(DRAGON.benches, 2)
    size = np.stack([DRAGON.lengths, DRAGON.widths], axis=-1)
    poses = bench_poses(trajectory(Dance(DRAGON, route), times).position)
    shapes = shapely.polygons(corners(poses, np.broadcast_to(size, (times.size, *size.shape))))
    reach = np.hypot(*size.T) / 2.0
    near = np.hypot(*np.moveaxis(poses[:, a, :2] - poses[:, b, :2], -1, 0)) < reach[a] + reach[b]
    least = np.full((times.size, a.size), np.inf)
    least[near] = shapely.distance(shapes[:, a][near], shapes[:, b][near])
    return least.min(axis=1)


@settings(max_examples=examples(8, 40), deadline=None)
@given(routes())
def test_first_contact_on_any_route_is_that_of_a_slow_search(route: Route) -> None:
    times = np.linspace(float(instants(route, 2)[0]), route.end, 2_000)
    slow = slow_clearance(route, times)
    contact = first_contact(Dance(DRAGON, route), start=float(times[0]))
    if contact.outcome is Outcome.CLEAR:
        assert slow.min() > 0.0
        return
    assert contact.outcome is Outcome.CONTACT
    clear, touching = contact.time_bracket
    assert touching - clear < 1.1e-9
    assert slow[times < clear].min() > 0.0
    assert slow_clearance(route, np.array([touching]))[0] < TOUCHING


def test_random_routes_do_meet_themselves() -> None:
    pen = Pen(0j, 0.0)
    pen.line(18.0)
    pen.arc(1.0, 5.5)
    pen.line(6.0)
    contact = first_contact(Dance(DRAGON, Route(pen.pieces)), start=17.0)
    assert contact.outcome is Outcome.CONTACT


# -- s and batches -------------------------------------------------------------------------------------------


def test_s_counts_from_the_start_of_the_route() -> None:
    pieces = [Line((0, 0), (5, 0)), Arc((5, 2), 2, -0.5 * math.pi, math.pi)]
    route = Route(pieces, start=3.0)
    assert (route.begin, route.joints, route.end) == (-3.0, (2.0,), pytest.approx(2.0 + 2.0 * math.pi, abs=1e-14))
    assert_near(route.position(0.0), [3.0, 0.0], 1e-15)
    assert_near(route.position(2.0 + math.pi), [7.0, 2.0], 1e-14)
    assert_near(route.curvature(np.array([1.0, 3.0])), [0.0, 0.5], 1e-15)


def test_a_batch_of_places_equals_a_loop_over_its_items() -> None:
    s = np.linspace(-20.0, 30.0, 12).reshape(3, 4)
    for name in ("position", "tangent", "curvature"):
        batch = getattr(TURN, name)(s)
        assert (batch == [[getattr(TURN, name)(x) for x in row] for row in s]).all(), name


@pytest.mark.uncompiled
@pytest.mark.parametrize("path", [Spiral(), Turn(1.7), Route([Line((3, 4), (60, 4))])], ids=["spiral", "turn", "line"])
def test_the_head_of_any_path_is_at_its_position(path: Path) -> None:
    for s in np.linspace(path.begin, 0.9 * path.end, 7).tolist():
        head, (x, y) = path.head(s), path.position(s).tolist()
        assert_near([head.x, head.y], [x, y], SAME)
        assert_near(head.radius, math.hypot(x, y), SAME)
        assert (head.theta is None) == isinstance(path, Route)
        assert path.limit >= path.end
