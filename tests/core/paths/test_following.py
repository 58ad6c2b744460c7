"""A dragon on a route: bends that are too tight for a chord, and room for the whole dragon."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest

from core import (
    Arc,
    Coil,
    Dance,
    Dragon,
    InvalidValue,
    Line,
    OutsideRun,
    Route,
    Waypoints,
    check,
    clearance_profile,
    first_contact,
    highest_speed,
    maximum_head_speed,
    trajectory,
)
from core.paths.following import ROOM_WIDTH, earliest_travel
from tests.core.paths.test_route import DRAGON, PLACE_ERROR, SAME, first_behind
from tests.support.near import assert_near


def test_a_bend_too_tight_for_a_chord_names_the_bench_and_the_place() -> None:
    route = Route([Line((-30, 0), (0, 0)), Arc((0, 1.2), 1.2, -0.5 * math.pi, math.pi), Line((0, 2.4), (-30, 2.4))])
    with pytest.raises(InvalidValue, match=r"bench 0 \(2\.86 m\), got 1\.2 m near \(.*\) m, s = 30 m") as e:
        trajectory(Dance(Dragon(benches=5), route), [20.0])
    assert e.value.field == "path"
    assert trajectory(Dance(Dragon(benches=5, head_length=2.2), route), [20.0]).speed.min() > 0.0


def test_a_start_before_the_beginning_of_the_path_is_refused() -> None:
    route = Route([Line((0, 0), (100, 0))])
    length = float(DRAGON.chords.sum())
    assert_near(trajectory(Dance(DRAGON, route), [length + 1e-6]).position[0, -1, 0], 1e-6, SAME)
    with pytest.raises(OutsideRun, match=rf"at least {length:.5f}[01] s, when the whole dragon is on the path"):
        trajectory(Dance(DRAGON, route), [length - 0.001])
    with pytest.raises(OutsideRun) as e:
        first_contact(Dance(DRAGON, route), start=0.0)
    assert e.value.field == "start"


TOO_SHORT = {
    "a line": Route([Line((0, 0), (10, 0))]),
    "a line a hair shorter than the dragon": Route([Line((0, 0), (float(DRAGON.chords.sum()) - 1e-6, 0))]),
    "an arc as long as the dragon when straight": Route([Arc((0, 0), 3.7, 0, float(DRAGON.chords.sum()) / 3.7)]),
    "a hook": Route([Waypoints(((0, 0), (6, 0), (7, 4), (4, 6)))]),
    "a coil outwards": Route([Coil(3.0, 0.5, 1.0)]),
}


@pytest.mark.parametrize("name", TOO_SHORT)
@pytest.mark.parametrize(
    "ask",
    [
        lambda path: check(Dance(DRAGON, path)),
        lambda path: highest_speed(Dance(DRAGON, path)),
        lambda path: maximum_head_speed(Dance(DRAGON, path), 2.0),
        lambda path: trajectory(Dance(DRAGON, path), [5.0]),
        lambda path: clearance_profile(Dance(DRAGON, path), [50.0]),
        lambda path: first_contact(Dance(DRAGON, path)),
        lambda path: Dance(DRAGON, path).default_times,
    ],
    ids=["check", "highest_speed", "maximum_head_speed", "trajectory", "clearance", "first_contact", "default_times"],
)
def test_a_path_too_short_for_the_dragon_says_so(ask: Callable[[Route], object], name: str) -> None:
    path = TOO_SHORT[name]
    with pytest.raises(InvalidValue) as e:
        ask(path)
    length = f"{path.end - path.begin:.9g}"
    assert e.value.message == (
        "path is too short for the whole dragon, which takes 16.4 m of it from handle 0 to handle 16 (more along "
        f"bends), got {length} m"
    )
    assert e.value.field == "path"


def test_a_path_a_hair_longer_than_the_dragon_has_room() -> None:
    length = float(DRAGON.chords.sum())
    path = Route([Line((0, 0), (length + 1e-6, 0))])
    assert_near(check(Dance(DRAGON, path)).start, length, 1e-6)


@pytest.mark.parametrize("begin", [0.0, 3.0])
def test_at_its_earliest_travel_the_head_is_a_dragon_ahead_of_the_beginning(begin: float) -> None:
    route = Route([Waypoints(((0, 0), (8, 1), (12, 6), (9, 12), (0, 14)))])
    s = head = earliest_travel(DRAGON, route, begin)
    for chord in DRAGON.chords.tolist():
        s = first_behind(route, s, chord)
    assert begin - PLACE_ERROR <= s <= begin + ROOM_WIDTH * (1.0 + head)
