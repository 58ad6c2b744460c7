"""Drawings on axes of matplotlib: what was found, in metres and seconds."""

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure

from core import (
    Dance,
    Dragon,
    Spiral,
    bench_outlines,
    clearance_profile,
    pitch_scan,
    trajectory,
)

DANCE = Dance(Dragon(30), Spiral())


@pytest.fixture(autouse=True)
def no_window():
    before = matplotlib.get_backend()
    plt.switch_backend("Agg")
    yield
    plt.close("all")
    plt.switch_backend(before)


@pytest.fixture
def axes():
    return Figure().add_subplot()


def legend(axes):
    return [text.get_text() for text in axes.get_legend().get_texts()]


def test_without_axes_a_new_figure_is_made_and_given_ones_are_drawn_on(axes):
    assert clearance_profile(DANCE, [0.0, 1.0]).plot(axes) is axes
    assert plt.get_fignums() == []
    drawn = trajectory(DANCE, 0.0).plot()
    assert plt.fignum_exists(drawn.figure.number)
    assert drawn.get_xlabel() == "x [m]"
    assert drawn.get_ylabel() == "y [m]"


@pytest.mark.parametrize("instant", [0, 1, -1])
def test_a_trajectory_shows_the_benches_and_handles_of_one_instant(axes, instant):
    motion = trajectory(DANCE, [0.0, 60.0, 120.0])
    motion.plot(axes, instant=instant)
    benches, *_, dots = axes.collections
    position = motion.position[instant]
    assert np.array_equal(dots.get_offsets(), position)
    assert np.array_equal(dots.get_array(), motion.speed[instant])
    drawn = [path.vertices[:4] for path in benches.get_paths()]
    assert np.array_equal(drawn, bench_outlines(DANCE.dragon, position))
    assert f"at {motion.time[instant]:g} s" in axes.get_title()


def test_a_clearance_profile_shows_its_grazes(axes):
    result = clearance_profile(Dance(Dragon(), Spiral()), np.arange(400.0, 412.0))
    result.plot(axes)
    curve, grazes = (line.get_xydata() for line in axes.lines[:2])
    assert np.array_equal(curve, np.stack([result.time, result.clearance], axis=-1))
    assert np.array_equal(grazes, [(graze.time, graze.clearance) for graze in result.grazes])
    assert legend(axes) == ["clearance", "graze", "touch"]


def test_a_scan_is_a_staircase_with_its_jumps(axes):
    result = pitch_scan(Dragon(30), np.linspace(0.4, 0.45, 3), start_turns=8.0)
    result.plot(axes)
    stairs, falls = (one.get_segments() for one in axes.collections if isinstance(one, LineCollection))
    assert [len(part) for part in stairs] == [end - start for start, end in result.pieces]
    assert len(falls) == len(result.pieces) - 1


def test_samples_of_a_scan_that_stand_alone_are_dots(axes):
    result = pitch_scan(Dragon(30), [0.4, 0.42, 0.45], start_turns=8.0, locate=False)
    result.plot(axes)
    assert axes.lines[0].get_xdata().tolist() == result.pitch.tolist()
    assert [text.get_text() for text in axes.get_legend().get_texts()] == ["first contact"]
