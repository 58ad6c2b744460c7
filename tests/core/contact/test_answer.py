"""Answer of a search for first contact: its drawing, and the title that says how the search ended."""

from __future__ import annotations

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Polygon

from core import Dance, Dragon, InvalidValue, Spiral, bench_outlines, first_contact, trajectory
from tests.core.test_plots import legend


@pytest.fixture
def axes() -> Axes:
    return Figure().add_subplot()


def test_first_contact_marks_the_two_benches(axes: Axes) -> None:
    contact = first_contact(Dance(Dragon(), Spiral()))
    contact.plot(axes)
    assert legend(axes) == ["bench 0 (head)", "bench 8"]
    assert axes.get_title() == "First contact: 412.473838 s, head at radius 2.288743 m"
    assert contact.time is not None
    outlines = bench_outlines(Dragon(), trajectory(Dance(Dragon(), Spiral()), contact.time).position)
    marked = [patch.get_xy()[:4] for patch in axes.patches if isinstance(patch, Polygon)]
    assert np.array_equal(marked, outlines[[0, 8]])


def test_the_enlarged_view_is_centred_on_the_contact(axes: Axes) -> None:
    contact = first_contact(Dance(Dragon(), Spiral()))
    contact.plot(axes, enlarged=True)
    assert contact.point == pytest.approx((np.mean(axes.get_xlim()), np.mean(axes.get_ylim())))
    assert legend(axes)[2:] == ["inner edge of bench 8", "front-outer corner of bench 0"]


def test_a_run_without_contact_is_drawn_before_its_end(axes: Axes) -> None:
    first_contact(Dance(Dragon(5), Spiral(0.8))).plot(axes)
    assert axes.get_legend() is None
    assert axes.get_title().startswith("No contact, but bench 0 folds at ")


def test_without_a_contact_there_is_nothing_to_enlarge(axes: Axes) -> None:
    with pytest.raises(InvalidValue, match="enlarged must be False where no two benches meet, got True"):
        first_contact(Dance(Dragon(5), Spiral(0.8))).plot(axes, enlarged=True)


@pytest.mark.parametrize(
    ("spiral", "query", "title"),
    [
        (Spiral(0.3), {}, "First contact: already at the start"),
        (Spiral(0.3), {"margin": 0.2}, "Within 0.2 m from the start on"),
        (Spiral(), {"stop": 100.0}, "No contact: the run ends clear at the stop, 100.000000 s"),
        (Spiral(), {"margin": 0.05}, "First within 0.05 m: 383.867583 s, head at radius 3.200607 m"),
    ],
    ids=["at the start", "margin at the start", "clear", "margin"],
)
def test_the_title_says_how_the_search_ended(axes: Axes, spiral: Spiral, query: dict[str, float], title: str) -> None:
    first_contact(Dance(Dragon(), spiral), **query).plot(axes)
    assert axes.get_title().startswith(title)
