"""Answer of a search for first contact: its drawing. The words in it: tests/app/files/test_figures.py."""

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


def test_without_a_contact_there_is_nothing_to_enlarge(axes):
    with refused("enlarged"):
        first_contact(Dance(Dragon(5), Spiral(0.8))).plot(axes, enlarged=True)
