"""Drawings on axes of matplotlib: what was found, in metres and seconds."""

from __future__ import annotations

from collections.abc import Iterator

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure

from core import (
    Dance,
    Dragon,
    Spiral,
    Trajectory,
    Turn,
    bench_outlines,
    clearance_profile,
    pitch_scan,
    trajectory,
)

DANCE = Dance(Dragon(30), Spiral())
METRES = ("x [m]", "y [m]")


@pytest.fixture(autouse=True)
def no_window() -> Iterator[None]:
    before = matplotlib.get_backend()
    plt.switch_backend("Agg")
    yield
    plt.close("all")
    plt.switch_backend(before)


@pytest.fixture
def axes() -> Axes:
    return Figure().add_subplot()


def labels(axes: Axes) -> tuple[str, str]:
    return axes.get_xlabel(), axes.get_ylabel()


def legend(axes: Axes) -> list[str]:
    box = axes.get_legend()
    assert box is not None
    return [text.get_text() for text in box.get_texts()]


def test_without_axes_a_new_figure_is_made() -> None:
    drawn = trajectory(DANCE, 0.0).plot()
    assert plt.fignum_exists(drawn.figure.number)
    assert labels(drawn) == METRES


def test_given_axes_are_drawn_on_and_returned(axes: Axes) -> None:
    assert clearance_profile(DANCE, [0.0, 1.0]).plot(axes) is axes
    assert plt.get_fignums() == []


@pytest.mark.parametrize("instant", [0, 1, -1])
def test_a_trajectory_shows_the_handles_of_one_instant(axes: Axes, instant: int) -> None:
    motion = trajectory(DANCE, [0.0, 60.0, 120.0])
    motion.plot(axes, instant=instant)
    dots = axes.collections[-1]
    assert np.array_equal(dots.get_offsets(), motion.position[instant])
    assert np.array_equal(np.asarray(dots.get_array()), motion.speed[instant])
    assert f"at {motion.time[instant]:g} s" in axes.get_title()


def test_benches_are_drawn_around_their_handles(axes: Axes) -> None:
    motion = trajectory(DANCE, 60.0)
    motion.plot(axes)
    outlines = bench_outlines(DANCE.dragon, motion.position)
    drawn = axes.collections[0].get_paths()
    assert len(drawn) == DANCE.dragon.benches
    assert np.array_equal(drawn[7].vertices[:4], outlines[7])


def test_a_trajectory_without_its_dance_shows_the_handles_alone(axes: Axes) -> None:
    motion = trajectory(DANCE, [60.0])
    Trajectory(motion.time, motion.position, motion.velocity, motion.speed).plot(axes)
    assert len(axes.collections) == 1


def test_an_instant_that_is_not_there_is_refused(axes: Axes) -> None:
    with pytest.raises(IndexError):
        trajectory(DANCE, [0.0]).plot(axes, instant=1)
    with pytest.raises(IndexError, match="there is no instant to plot"):
        trajectory(DANCE, []).plot(axes)


def test_a_clearance_profile_shows_its_grazes(axes: Axes) -> None:
    result = clearance_profile(Dance(Dragon(), Spiral()), np.arange(400.0, 412.0))
    result.plot(axes)
    curve, grazes = axes.lines[:2]
    assert np.array_equal(curve.get_xydata(), np.stack([result.time, result.clearance], axis=-1))
    assert np.array_equal(grazes.get_xydata(), [(graze.time, graze.clearance) for graze in result.grazes])
    assert labels(axes) == ("time [s]", "clearance of the nearest pair [m]")
    assert legend(axes) == ["clearance", "graze", "touch"]


def test_a_scan_is_a_staircase_with_its_jumps(axes: Axes) -> None:
    result = pitch_scan(Dragon(30), np.linspace(0.4, 0.45, 3), start_turns=8.0)
    result.plot(axes)
    stairs, falls = (one for one in axes.collections if isinstance(one, LineCollection))
    assert [len(part) for part in stairs.get_segments()] == [end - start for start, end in result.pieces]
    assert len(falls.get_segments()) == len(result.pieces) - 1
    assert labels(axes) == ("pitch [m]", "radius of the head at first contact [m]")


def test_a_turn_is_drawn_whole(axes: Axes) -> None:
    turn = Turn(1.7, start_turns=4.0)
    trajectory(Dance(Dragon(5), turn), 0.0).plot(axes)
    drawn = axes.lines[0].get_xydata()
    ends = turn.position(np.array([turn.begin, turn.end]))
    assert np.array_equal(np.asarray(drawn)[[0, -1]], ends)
