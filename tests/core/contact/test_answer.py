"""Answer of a search for first contact: its drawing, and the title that says how the search ended."""

import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.patches import Polygon

from core import Dance, Dragon, Spiral, bench_outlines, first_contact, trajectory
from tests.core.test_plots import legend
from tests.support.near import assert_near
from tests.support.refused import refused

DANCE = Dance(Dragon(), Spiral())
CONTACT = first_contact(DANCE)


@pytest.fixture
def axes():
    return Figure().add_subplot()


def test_first_contact_marks_the_two_benches(axes):
    CONTACT.plot(axes)
    assert legend(axes) == ["bench 0 (head)", "bench 8"]
    outlines = bench_outlines(Dragon(), trajectory(DANCE, CONTACT.time).position)
    marked = [patch.get_xy()[:4] for patch in axes.patches if isinstance(patch, Polygon)]
    assert np.array_equal(marked, outlines[[0, 8]])


def test_the_enlarged_view_is_centred_on_the_contact(axes):
    CONTACT.plot(axes, enlarged=True)
    assert_near(CONTACT.point, np.mean([axes.get_xlim(), axes.get_ylim()], axis=1), 1e-9)
    assert legend(axes)[2:] == ["inner edge of bench 8", "front-outer corner of bench 0"]


def test_without_a_contact_there_is_nothing_to_enlarge(axes):
    with refused("enlarged"):
        first_contact(Dance(Dragon(5), Spiral(0.8))).plot(axes, enlarged=True)


TITLES = {
    "First contact: 412.473838 s, head at radius 2.288743 m": (0.55, {}),
    "First contact: already at the start": (0.3, {}),
    "Within 0.2 m from the start on": (0.3, {"margin": 0.2}),
    "No contact: the run ends clear at the stop, 100.000000 s": (0.55, {"stop": 100.0}),
    "No contact, but bench 0 folds at ": (0.8, {}),
    "First within 0.05 m: 383.867583 s, head at radius 3.200607 m": (0.55, {"margin": 0.05}),
}


@pytest.mark.parametrize("title", TITLES)
def test_the_title_says_how_the_search_ended(axes, title):
    pitch, query = TITLES[title]
    first_contact(Dance(Dragon(30), Spiral(pitch)), **query).plot(axes)
    assert axes.get_title().startswith(title)
    assert (axes.get_legend() is None) is title.startswith("No contact")
