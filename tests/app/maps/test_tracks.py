"""Walked tracks: thinned and smoothed to what benches follow, at most so far from the walk, with times as passages."""

import math
import re

import numpy as np
import pytest
from scipy.spatial import KDTree

from app.maps.gpx import seconds_of
from app.maps.places import places_of
from app.maps.tracks import (
    APART,
    CHORD,
    PASSAGES,
    POINTS_MOST,
    apart,
    evenly,
    noise_of,
    passages_of,
    smoothed,
    walk_of,
)
from app.wire.question import BYTES
from core import Coil, Dragon, InvalidValue, Legs, Route
from core.language import speaking
from core.paths.following import tightest_bend
from tests.support.asking import assert_problem
from tests.support.near import assert_near

CORNERS = np.array([(0.0, 0.0), (60.0, 0.0), (60.0, 40.0), (0.0, 40.0), (0.0, 8.0)])
REST = (80.0, 140.0)  # [s] of standing still
NOISE = 1.2  # [m]


def ways_to(corners):
    """Length of the way to each corner [m]."""
    return np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(corners, axis=0).T))])


def places_along(corners, way):
    """Places on the straight lines between corners. way: to each of them [m]"""
    return np.column_stack([np.interp(way, ways_to(corners), axis) for axis in corners.T])


def walked(times):
    """Places of somebody who walks around a square at 1 m/s, and stands still for a minute."""
    return places_along(CORNERS, times - np.clip(times - REST[0], 0.0, REST[1] - REST[0]))


def with_noise(points, noise, seed):
    """Points that a receiver takes for these, each with noise of its own [m]."""
    return points + np.random.default_rng(seed).normal(0.0, noise, points.shape)


def read(data):
    return places_of(data.encode() if isinstance(data, str) else data, None)


def walk_along(points, times, *chord):
    walk = walk_of(points, times, *chord)
    return walk, Legs([tuple(one) for one in walk.points.tolist()])


def noisy(seed):
    times = np.arange(0.0, 250.0)
    drift = np.random.default_rng(seed).normal(0.0, NOISE, (len(times) + 19, 2))
    smooth = np.column_stack([np.convolve(axis, np.full(20, 20**-0.5), "valid") for axis in drift.T])
    return walked(times) + smooth, times


def assert_easy(walk, path, dragon):
    assert walk.is_easy
    assert not path.tighter(tightest_bend(dragon)[0])


def farthest(points, path):
    """How far the points are from a path at most [m]."""
    line = path.position(np.linspace(path.begin, path.end, 4_000))
    return KDTree(line).query(points)[0].max()


@pytest.mark.parametrize("seed", range(4))
def test_a_noisy_walk_becomes_a_path_that_benches_follow(seed):
    points, times = noisy(seed)
    walk, path = walk_along(points, times)
    assert_easy(walk, path, Dragon())
    # The distance of a place from the way at its time is never below that from the whole way.
    assert farthest(points, path) <= walk.largest + 0.2
    assert walk.largest < 6.0 * NOISE
    assert_near(walk.points[[0, -1]], points[[0, -1]], 1e-9)


@pytest.mark.parametrize("chord", [1.5, 4.0])
def test_a_walk_is_smoothed_as_the_longest_bench_needs(chord):
    points, _ = noisy(0)
    (walk, path), (usual, _) = walk_along(points, None, chord), walk_along(points, None)
    assert (walk.width < usual.width) is (chord < CHORD)
    assert_easy(walk, path, Dragon(9, chord, 1.0, overhang=0.0))


@pytest.mark.parametrize("noise", [0.8, 1.5])
@pytest.mark.parametrize("seed", range(3))
def test_noise_of_every_point_is_no_change_of_speed(noise, seed):
    """One pace, a pause, the same pace: not a passage for each few metres of noise."""
    times = np.arange(0.0, 250.0)
    walk, _ = walk_along(with_noise(walked(times), noise, seed), times)
    assert_near([passage["speed"] for passage in walk.passages], [1.0, 0.0, 1.0], 0.1)
    assert_near([passage["until_time"] for passage in walk.passages], [*REST, times[-1]], 6.0)
    assert walk.passages[1]["speed"] == 0.0


def test_a_walk_there_and_back_on_one_line_turns_on_the_spot():
    there = np.column_stack([np.arange(0.0, 40.0), np.zeros(40)])
    with pytest.raises(InvalidValue, match=r"turn on the spot.* smoothed over 14\.4 m$"):
        walk_of(np.concatenate([there, there[::-1]]), None)


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("pitch, noise, turns", [(1.0, 0.1, 6), (1.2, 0.2, 8), (1.5, 0.3, 6)])
def test_a_close_coil_keeps_its_windings_and_the_times_of_its_walk(pitch, noise, turns, seed):
    coil = Route([Coil(pitch, 1.0 / pitch, turns + 1.0 / pitch)])
    times = np.arange(coil.end)
    points = coil.position(times)
    walk, path = walk_along(with_noise(points, noise, seed), times)
    assert not walk.is_easy
    assert farthest(points, path) < 5.0 * noise
    assert walk.largest < 7.0 * noise
    assert 0.93 * coil.end < walk.length < 1.03 * coil.end
    assert_near([passage["speed"] for passage in walk.passages], [1.0] * len(walk.passages), 0.5)
    assert len(walk.passages) < 8


# Radius of the arcs that would cost least [m], and how much more than they a smooth curve may cost [1].
EASIEST = 1.1 * tightest_bend(Dragon())[0]
DEARER = 1.2
SQUARES = {
    "corners alone": [(0, 0), (20, 0), (20, 20), (0, 20), (0, 0)],
    "stairs": [(6 * ((k + 1) // 2), 6 * (k // 2)) for k in range(9)],
    "twice around": [(0, 0), (9, 0), (9, 9), (0, 9)] * 2,
    "one corner": [(0, 0), (30, 0), (30, 30)],
}


@pytest.mark.parametrize("spaced", [None, 1.0, 0.3])
@pytest.mark.parametrize("name", SQUARES)
def test_a_walk_of_right_angles_loses_little_more_than_the_least_arcs(name, spaced):
    corners = np.array(SQUARES[name], dtype=float)
    s = ways_to(corners)
    along = s if spaced is None else np.union1d(s, np.arange(0.0, s[-1], spaced))
    walk, path = walk_along(places_along(corners, along), along)
    assert_easy(walk, path, Dragon())
    least = (2.0 - 0.5 * math.pi) * EASIEST * (len(corners) - 2)
    assert s[-1] - walk.length <= DEARER * least
    assert walk.passages is not None
    assert all(one["speed"] == pytest.approx(1.0, abs=0.15) for one in walk.passages)


@pytest.mark.parametrize("noise", [0.1, 0.5, 2.0])
def test_the_noise_of_a_receiver_is_measured_beside_corners(noise):
    assert noise_of(with_noise(walked(np.arange(0.0, 250.0, 0.5)), noise, 0)) == pytest.approx(noise, rel=0.1)
    assert noise_of(walked(np.arange(200.0))) < 1e-9


def test_times_that_do_not_grow_are_none_and_many_speeds_become_few():
    assert passages_of(np.zeros(5), np.arange(5.0)) is None
    assert passages_of(np.array([math.nan, 1.0, 2.0]), np.arange(3.0)) is None
    assert passages_of(np.array([0.0, math.nan, 2.0]), np.arange(3.0)) == [{"speed": 1.0, "until_time": 2.0}]
    places = np.cumsum(np.repeat(np.random.default_rng(0).uniform(0.5, 1.5, 200), 100))
    passages = passages_of(np.arange(20_000.0), places)
    assert 10 < len(passages) <= PASSAGES
    speeds, ends = np.array([(passage["speed"], passage["until_time"]) for passage in passages]).T
    assert np.diff(ends, prepend=0.0) @ speeds == pytest.approx(places[-1], rel=0.01)


def test_thinning_and_smoothing_keep_a_straight_way_and_its_ends():
    way = np.column_stack([np.linspace(0.0, 50.0, 501), np.full(501, 3.0)])
    kept = apart(way)
    assert (np.hypot(*np.diff(way[kept], axis=0).T) >= 0.5 * APART).all()
    assert kept[0] == 0
    assert kept[-1] == 500
    even = evenly(way)
    assert_near(smoothed(even, 4.0), even, 1e-9)
    assert walk_of(way[:5], None) is None
    assert walk_along(np.repeat(way, 1 + 2 * POINTS_MOST // len(way), axis=0), None)[0].largest < 1e-6


def track(points, name="walk"):
    return f"<trk><name>{name}</name><trkseg>{''.join(points)}</trkseg></trk>"


def gpx(points):
    return f"<gpx><wpt lat='48.0001' lon='9.0003'/>{track(points)}</gpx>".encode()


def point(k, time=None):
    stamp = "" if time is None else f"<time>{time}</time>"
    return f"<trkpt lat='{48 + 1e-5 * k:.6f}' lon='9'>{stamp}</trkpt>"


LANE = [point(k, f"2026-11-27T10:{k // 60:02d}:{k % 60:02d}Z") for k in range(70)]


def test_gpx_is_a_path_with_its_waypoints_as_obstacles():
    # A point without a time does not end the times.
    lane = [re.sub("<time>.*</time>", "", one) if k in (30, 31, 45) else one for k, one in enumerate(LANE)]
    for points in (LANE, lane):
        parts = read(gpx(points))
        assert parts.path["kind"] == "waypoints"
        assert parts.passages == [{"speed": pytest.approx(1.112, abs=0.02), "until_time": 69.0}]
        assert any("at most 0.0" in note and "what was walked" in note for note in parts.notes)
        assert len(parts.venue.obstacles) == 1
    with speaking("zh"):
        without = read(gpx([point(k) for k in range(70)]))
    assert without.passages is None
    assert "轨迹没有递增的时间。" in without.notes


def test_the_service_smooths_a_walk_for_the_longest_bench(client):
    hairpin = [(min(k, 40 - k), 2 if k > 20 else 0) for k in range(41)]
    bent = [f"<trkpt lat='{48 + 1e-4 * up:.6f}' lon='{9 + 1e-4 * across:.6f}'/>" for up, across in hairpin]
    file = {"content": gpx(bent), "headers": {"Content-Type": BYTES}}
    notes = client.post("/places?longest_chord=40", **file).raise_for_status().json()["notes"]
    assert any(note.endswith("m, which a bench needs whose handles are 40.00 m apart.") for note in notes)
    assert_problem(client.post("/places?longest_chord=51", **file), 422, "longest_chord 50 51")


def test_a_track_of_kml_is_a_path_and_a_place_that_is_missing_has_no_time():
    when = "".join(f"<when>2026-11-27T10:00:{k:02d}Z</when>" for k in range(60))
    where = "".join(f"<gx:coord>{'' if k == 30 else f'9 {48 + 1e-5 * k:.6f} 5'}</gx:coord>" for k in range(60))
    space = "xmlns:gx='http://www.google.com/kml/ext/2.2'"
    parts = read(f"<kml {space}><Placemark><gx:Track>{when}{where}</gx:Track></Placemark></kml>")
    assert parts.passages[-1]["until_time"] == 59.0
    assert len(parts.path["points"]) > 1


def test_of_several_tracks_the_longest_is_danced_and_a_line_called_path_before_all():
    two = f"<gpx>{track(LANE[:30], 'a')}{track(LANE, 'b')}"
    notes = read(f"{two}</gpx>").notes
    assert any("the track b" in note for note in notes)
    assert any("2 lines are paths or tracks" in note for note in notes)
    route = "<rte><name>path</name><rtept lat='48' lon='9'/><rtept lat='48' lon='9.0005'/></rte>"
    parts = read(f"{two}{route}</gpx>")
    assert len(parts.path["points"]) == 2
    assert parts.passages is None


@pytest.mark.parametrize(
    "data, words",
    [
        (b"<gpx><trk></gpx>", "mismatched tag in line 1"),
        (b"<gpx><wpt lat='north' lon='9'/></gpx>", "got 'north'"),
        (gpx([point(0), point(0)]), "at least 2 m apart"),
    ],
)
def test_a_wrong_file_is_refused_in_one_sentence(data, words):
    with pytest.raises(InvalidValue, match=words):
        read(data)


def test_times_are_read_with_any_offset():
    assert seconds_of("2026-11-27T08:00:00+08:00") == seconds_of("2026-11-27T00:00:00Z")
    assert math.isnan(seconds_of("noon"))
