"""Cues of several dragons: every meeting and no other, against small steps and shapely; the rest as for one dance."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from typing import NamedTuple

import numpy as np
import pytest
from shapely import LineString, Polygon

from core import (
    BenchDragonError,
    Dance,
    Dragon,
    InvalidValue,
    Line,
    Part,
    Passage,
    Performance,
    Route,
    Spiral,
    bench_cues,
    bench_outlines,
    bench_poses,
    performance_cues,
    performance_trajectory,
)
from core.people.meetings import EVEN

# Time between two looks of the slow search [s].
STEP = 0.01
LANES = [Line((0.0, 0.0), (30.0, 0.0)), Line((30.0, 2.0), (0.0, 2.0)), Line((12.0, -12.0), (12.0, 20.0))]
PARTS = [
    Part(Dance(Dragon(4), Route([LANES[0]])), name="east"),
    Part(Dance(Dragon(3), Route([LANES[1]]), 1.3, [Passage(0.0, until_time=9.0)]), 4.0),
    Part(Dance(Dragon(3, 3.0), Route([LANES[2]])), 16.0),
]


class Met(NamedTuple):
    time: float
    dragon: int
    bench: int
    is_left: bool
    gap: float


def slow_meetings(
    performance: Performance, dragon: int, bench: int, reach: float, span: tuple[float, float]
) -> list[Met]:
    """Changes of sign of the way ahead of every other bench, in small steps, unless a third bench hides it."""
    times = np.arange(*span, STEP)
    results = performance_trajectory(performance, times)
    poses = [bench_poses(one.position) for one in results]
    outlines = [
        bench_outlines(part.dance.dragon, one.position) for part, one in zip(performance.parts, results, strict=True)
    ]
    own, met = poses[dragon][:, bench], []
    for j, others in enumerate(poses):
        for b in range(others.shape[1]):
            if j == dragon and abs(b - bench) <= 1:
                continue
            away = others[:, b, :2] - own[:, :2]
            along = away[:, 0] * np.cos(own[:, 2]) + away[:, 1] * np.sin(own[:, 2])
            counts = np.flatnonzero(np.abs(along) > EVEN)
            for before, after in pairwise(counts.tolist()):
                if along[before] * along[after] > 0.0:
                    continue
                k = before + int(np.abs(along[before : after + 1]).argmin())
                shapes = [[Polygon(one) for one in some[k]] for some in outlines]
                gap = shapes[dragon][bench].distance(shapes[j][b])
                sight = LineString([own[k, :2], others[k, b, :2]])
                third = (
                    shape for i, some in enumerate(shapes) for c, shape in enumerate(some)
                    if (i, c) not in ((dragon, bench), (j, b))
                )  # fmt: skip
                if gap <= reach and not any(shape.intersects(sight) for shape in third):
                    left = away[k, 1] * np.cos(own[k, 2]) - away[k, 0] * np.sin(own[k, 2])
                    met.append(Met(float(times[k]), j, b, bool(left > 0.0), gap))
    return sorted(met)


def test_meetings_are_those_of_a_slow_search_in_small_steps() -> None:
    performance, reach = Performance(PARTS), 3.0
    span = performance.span()
    count = 0
    for dragon, part in enumerate(PARTS):
        for one in performance_cues(performance, dragon, reach=reach):
            slow = slow_meetings(performance, dragon, one.bench, reach, span)
            met = sorted(Met(m.time, m.dragon or 0, m.bench, m.side.value == "left", m.gap) for m in one.meetings)
            assert [m[1:4] for m in met] == [m[1:4] for m in slow]
            assert [m.time for m in met] == pytest.approx([m.time for m in slow], abs=2 * STEP)
            assert [max(m.gap, 0.0) for m in met] == pytest.approx([m.gap for m in slow], abs=0.05)
            count += len({m.dragon for m in met} - {dragon})
        assert part.dance.dragon.benches >= 3
    assert count > 8


def test_a_bench_of_another_dragon_hides_one_behind_it() -> None:
    walls = [Line((0.0, y), (30.0, y)) for y in (0.0, 1.0)] + [Line((30.0, 2.0), (0.0, 2.0))]
    rows = [Part(Dance(Dragon(4), Route([wall]))) for wall in walls]
    first = performance_cues(Performance(rows), 0, reach=8.0)
    assert {
        m.dragon for one in first for m in one.meetings
    } == set()  # the second row walks beside, and hides the third
    without = Performance([rows[0], rows[2]])
    assert {m.dragon for one in performance_cues(without, 0, reach=8.0) for m in one.meetings} == {1}


def test_a_dragon_that_meets_no_other_has_the_cues_of_its_dance_on_the_clock_of_the_performance() -> None:
    coil = Dance(Dragon(20), Spiral(0.7, 4.0), 0.9, [Passage(0.5, until_time=10.0), Passage(0.0, until_time=14.0)])
    far = Part(Dance(Dragon(3), Route([Line((200.0, 0.0), (300.0, 0.0))])))
    performance = Performance([far, Part(coil, 7.0)])
    own = bench_cues(coil, [0, 5, 19], start=0.0, stop=38.0)
    several = performance_cues(performance, 1, [0, 5, 19], start=performance.begin, stop=45.0)
    for one, other in zip(own, several, strict=True):
        assert other.start == replace(one.start, time=performance.begin)
        assert (other.begin.time, other.done.time) == (one.begin.time + 7.0, one.done.time + 7.0)
        assert (other.direction, other.ahead, other.behind) == (one.direction, one.ahead, one.behind)
        assert other.fastest == replace(one.fastest, time=one.fastest.time + 7.0)
        assert [(p.begin - 7.0, p.end - 7.0) for p in other.pauses] == [(p.begin, p.end) for p in one.pauses]
        assert [(m.bench, m.side, m.oncoming, m.dragon) for m in other.meetings] == [
            (m.bench, m.side, m.oncoming, 1) for m in one.meetings
        ]
        assert [m.time - 7.0 for m in other.meetings] == pytest.approx([m.time for m in one.meetings], abs=1e-7)
        assert [m.gap for m in other.meetings] == pytest.approx([m.gap for m in one.meetings], abs=1e-7)
    assert sum(len(one.meetings) for one in own) > 10


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"dragon": 3}, "dragon must be at most 2, got 3"),
        ({"dragon": 0.5}, "dragon must be a whole number, got 0.5"),
        ({"dragon": 0, "benches": [4]}, r"benches\[0\] must be at most 3, got 4"),
        ({"dragon": 0, "reach": -1.0}, "reach must be zero or more, got -1 m"),
        ({"dragon": 0, "stop": 900.0}, "stop must be at most"),
    ],
)
def test_what_is_wrong_is_refused(arguments: dict[str, float], words: str) -> None:
    with pytest.raises(BenchDragonError, match=words):
        performance_cues(Performance(PARTS), **arguments)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("dragon", "start", "stop", "values"),
    [
        (1, None, 12.0, "got 12 s: it stands still from 7.810000004839435 s on"),
        (2, None, 20.0, "got 20 s: it stands still from 7.810000004839435 s on"),
        (0, 31.0, 40.0, "got 40 s: it stands still from 31 s on"),
    ],
    ids=["pause", "before", "after"],
)
def test_a_dragon_that_never_walks_is_named(dragon: int, start: float | None, stop: float, values: str) -> None:
    with pytest.raises(InvalidValue) as caught:
        performance_cues(Performance(PARTS), dragon, start=start, stop=stop)
    assert str(caught.value) == f"stop must be after dragon {dragon} begins to walk, {values}"


def test_a_stop_before_the_fold_is_needed() -> None:
    folding = Performance([Part(Dance(Dragon(20), Spiral(0.7, 4.0))), PARTS[0]])
    with pytest.raises(InvalidValue, match=r"stop must be given: it must be before .* when bench .* of dragon 0 folds"):
        performance_cues(folding, 1)
    with pytest.raises(InvalidValue, match="stop must be before "):
        performance_cues(folding, 1, stop=folding.end.time)
