"""The notebook examples/tour.py: it converts, every cell runs, and its sentences are true."""

from types import SimpleNamespace

import matplotlib.pyplot as plt
import pytest
from matplotlib.axes import Axes

from core.display import Readable
from tests.conftest import ROOT
from tests.support.notebooks import cells, ran

TOUR = ROOT / "examples" / "tour.py"
# Longest line of an answer under a cell [characters].
DISPLAY_MOST = 220


@pytest.fixture(scope="module")
def tour():
    """Names after all cells ran in order; `answers` are what each one shows."""
    before = plt.get_backend()
    plt.switch_backend("Agg")
    yield SimpleNamespace(**ran(TOUR))
    plt.close("all")
    plt.switch_backend(before)


def test_it_is_a_notebook_of_words_and_code():
    import jupytext

    notebook = jupytext.read(TOUR, fmt="py:percent")
    words = cells(TOUR, "markdown")
    assert words[0].startswith("# A dragon of benches")
    assert len(words) > 10
    assert len(cells(TOUR, "code")) > 10
    assert jupytext.reads(jupytext.writes(notebook, fmt="ipynb"), fmt="ipynb").cells[-1].source == words[-1]


def test_every_cell_runs_and_shows_something_short_or_a_picture(tour):
    assert sum(isinstance(answer, Axes) for answer in tour.answers) >= 4
    values = [repr(each) for each in tour.answers if isinstance(each, Readable) or hasattr(each, "to_dataframe")]
    assert len(values) >= 6
    assert max(map(len, values)) <= DISPLAY_MOST


def test_its_sentences_are_so(tour):
    low, high = tour.contact.time_bracket
    assert 0.0 < high - low < 1e-9  # "a fraction of a nanosecond apart"
    assert tour.contact.corner.name == "front-outer"
    assert tour.contact.corner.bench == 0
    assert 0.0 < tour.profile.grazes[-1].clearance < 1e-3  # "less than a millimetre"
    assert tour.tightest.proven_up_to is None  # "every larger one works too"
    assert tour.walk.speed[-1, -1] < tour.walk.speed[-1, 0]  # "a little slower than the head"
    assert not ((tour.stairs.radius > 4.41) & (tour.stairs.radius < 4.57)).any()  # "it never crosses"
    stray = tour.stray.stray
    assert 0.02 < stray < 0.06  # "a few centimetres"
    assert stray < tour.stray.exhibit.stray == tour.stray.stray_bracket[1]  # "can touch"
    assert tour.kinder.stray > stray
