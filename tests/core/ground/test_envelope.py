"""The envelope against sampled poses, against dense sampling, and against grounds known from formulas."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely

from core import (
    Arc,
    Budget,
    Coil,
    Dance,
    Dragon,
    Envelope,
    InvalidValue,
    Line,
    OutsideRun,
    Route,
    Spiral,
    TooMuchWork,
    Turn,
    Waypoints,
    bench_outlines,
    envelope,
    trajectory,
)
from tests.support.depth import examples

POSES = 10_000
RING = 5.0  # radius of a round dance [m]
LAPS = Route([Arc((0.0, 0.0), RING, 0.0, 15.0)], start=40.0)
WINDING = Waypoints(((0.0, 0.0), (25.0, 0.0), (35.0, 8.0), (28.0, 16.0), (10.0, 12.0)))
MIXED = Dragon.of([3.4, 1.5, 2.2, 4.0, 2.2], [0.3, 0.5, 0.3, 0.2, 0.3], [0.2, 0.1, 0.275, 0.5, 0.275])
# Dances, each with start and stop [s].
DANCES: dict[str, tuple[Dance, float | None, float | None]] = {
    "the default up to its contact": (Dance(Dragon(examples(40, 223)), Spiral()), 350.0, 412.4738),
    "to the fold": (Dance(Dragon(20), Spiral()), 415.0, None),
    "the contest's turn": (Dance(Dragon(20), Turn(1.7)), -10.0, 50.0),
    "a second": (Dance(Dragon(30), Spiral()), 300.0, 301.0),
    "waypoints, benches of many sizes": (Dance(MIXED, Route([WINDING], start=15.0), 0.7), None, None),
    "rounds": (Dance(Dragon(6), LAPS), None, None),
    "straight on": (Dance(Dragon(3), Route([Line((0.0, 0.0), (20.0, 5.0))], start=9.0)), None, None),
}


def ground(result: Envelope) -> shapely.MultiPolygon:
    return shapely.MultiPolygon([(rings[0], rings[1:]) for rings in result.polygons])


def outlines(dance: Dance, times: np.ndarray) -> np.ndarray:
    """Corners (T n, 4, 2) of all benches."""
    return bench_outlines(dance.dragon, trajectory(dance, times).position).reshape(-1, 4, 2)


@pytest.mark.parametrize("name", DANCES)
def test_ten_thousand_poses_are_inside_of_valid_polygons(name: str) -> None:
    dance, start, stop = DANCES[name]
    result = envelope(dance, start=start, stop=stop)
    polygons = ground(result)
    assert polygons.is_valid
    assert polygons.area == pytest.approx(result.area)
    assert result.excess <= 1e-3
    random = np.random.default_rng(15)
    instants = math.ceil(POSES / dance.dragon.benches)
    times = np.concatenate([[result.start, result.stop], random.uniform(result.start, result.stop, instants)])
    corners = outlines(dance, times)
    edges = np.roll(corners, -1, axis=1) - corners
    points = np.concatenate([corners, corners + edges * random.uniform(size=(len(corners), 4, 1))])
    assert len(corners) >= POSES
    shapely.prepare(polygons)
    assert shapely.contains_xy(polygons, points.reshape(-1, 2)).all()


@pytest.mark.parametrize(
    ("dance", "start", "stop"),
    [
        (Dance(Dragon(3), Spiral()), 432.4, None),
        (Dance(Dragon(4), Turn(1.7)), 3.0, 3.6),
        (Dance(MIXED, Route([WINDING], start=15.0)), 20.0, 20.6),
    ],
)
def test_no_point_is_further_from_a_bench_than_the_excess(dance: Dance, start: float, stop: float | None) -> None:
    result = envelope(dance, start=start, stop=stop)
    times = result.stop - (result.stop - result.start) * np.linspace(1.0, 0.0, 1_501) ** (1.0 if stop else 3.0)
    benches = shapely.polygons(outlines(dance, times))
    border = shapely.points(shapely.get_coordinates(shapely.segmentize(ground(result).boundary, 0.1)))
    _, furthest = shapely.STRtree(benches).query_nearest(border, return_distance=True, all_matches=False)
    assert len(furthest) == len(border)
    assert 1e-4 < furthest.max() <= result.excess <= 1e-3
    sampled = shapely.union_all(benches[::20])
    assert sampled.area < result.area
    assert ground(result).covers(sampled)


def test_a_round_dance_keeps_its_hole_and_sweeps_the_ring_between_two_circles() -> None:
    dance, _, _ = DANCES["rounds"]
    result = envelope(dance)
    ((outer, *holes),) = result.polygons
    assert len(holes) == 1
    head, width = dance.dragon, 0.15
    inner = min(math.sqrt(RING**2 - 0.25 * chord**2) for chord in head.chords.tolist()) - width
    middle = [math.sqrt(RING**2 - 0.25 * chord**2) + width for chord in head.chords.tolist()]
    outside = max(math.hypot(y, 0.5 * length) for y, length in zip(middle, head.lengths.tolist(), strict=True))
    radii = np.linalg.norm(outer, axis=1), np.linalg.norm(holes[0], axis=1)
    assert outside <= radii[0].min()
    assert radii[0].max() <= outside + result.excess
    assert inner - result.excess <= radii[1].min()
    assert radii[1].max() <= inner
    area = math.pi * (outside**2 - inner**2)
    assert area < result.area < area + 2.0 * math.pi * (outside + inner) * result.excess


def test_what_a_span_sweeps_is_part_of_what_the_whole_dance_sweeps() -> None:
    dance = Dance(Dragon(10), Spiral())
    span, whole = (envelope(dance, start=start, stop=stop) for start, stop in ((100.0, 110.0), (90.0, 130.0)))
    assert span.area < whole.area
    assert (span.start, span.stop) == (100.0, 110.0)
    assert ground(whole).buffer(span.excess).covers(ground(span))


def test_a_coil_sweeps_what_the_same_spiral_does() -> None:
    spiral = envelope(Dance(Dragon(8), Spiral()), start=50.0, stop=90.0)
    coil = envelope(Dance(Dragon(8), Route([Coil(0.55, 16.0, 4.0)])), start=50.0, stop=90.0)
    assert ground(coil).symmetric_difference(ground(spiral)).buffer(-spiral.excess).is_empty


def test_the_cost_follows_the_track_and_not_the_number_of_benches() -> None:
    few, many = (envelope(Dance(Dragon(benches), Spiral()), stop=300.0, excess=0.01) for benches in (3, 60))
    assert many.certificate.cells < 1.4 * few.certificate.cells


def test_a_larger_excess_costs_less() -> None:
    dance = Dance(Dragon(5), Spiral())
    fine, rough = (envelope(dance, stop=30.0, excess=excess) for excess in (1e-3, 0.05))
    assert rough.certificate.cells < 0.3 * fine.certificate.cells
    assert fine.area < rough.area
    assert 1e-3 < rough.excess <= 0.05


def test_the_distance_of_spectators_from_a_straight_dance() -> None:
    dance = Dance(Dragon(3), Route([Line((0.0, 0.0), (50.0, 0.0))], start=9.0))
    result = envelope(dance)
    for line in ([(0.0, 2.0), (30.0, 2.0)], [(20.0, 2.0)], [(-9.0, 5.0), (25.0, 2.0), (60.0, 7.0)]):
        assert 2.0 - 0.15 - result.excess < result.distance(line) < 2.0 - 0.15
    assert result.distance([(10.0, -3.0), (11.0, 3.0)]) == 0.0
    assert result.distance([(10.0, 0.1)]) == 0.0


@pytest.mark.parametrize(
    ("arguments", "field"),
    [({"excess": 0.0}, "excess"), ({"excess": 2.0}, "excess"), ({"start": 5.0, "stop": 4.0}, "stop")],
)
def test_what_cannot_be_is_refused_by_its_field(arguments: dict[str, float], field: str) -> None:
    with pytest.raises(InvalidValue, match=f"^{field} must be") as caught:
        envelope(Dance(Dragon(3), Spiral()), **arguments)
    assert caught.value.field == field


def test_a_time_after_the_run_is_refused() -> None:
    with pytest.raises(OutsideRun, match=r"^stop must be at most 432\.917924"):
        envelope(Dance(Dragon(3), Spiral()), stop=440.0)


@pytest.mark.parametrize("line", [[], [(1.0,)], 3.0, [(1.0, math.nan)]])
def test_a_line_without_points_is_refused(line: object) -> None:
    result = envelope(Dance(Dragon(1), Spiral()), stop=1.0, excess=0.01)
    with pytest.raises(InvalidValue, match=r"^line") as caught:
        result.distance(line)
    assert caught.value.field.startswith("line")


def test_a_budget_ends_it() -> None:
    with pytest.raises(TooMuchWork, match="the ground that benches sweep was not found within 10000 steps of work"):
        envelope(Dance(Dragon(), Spiral()), budget=Budget(1e4))
