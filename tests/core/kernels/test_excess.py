"""The first excess over a limit: how it ends. That none is earlier: tests/core/test_failures.py."""

import pytest

from core import Dragon, Turn
from core.kernels import Excess, Judged
from tests.support.searches import search_on

WIDTH = 1e-9


@pytest.mark.parametrize("links, judged", [(0, Judged.UNDECIDED), (10**6, Judged.EXCEEDED)])
def test_a_search_with_links_ends_and_without_them_is_given_up(links, judged):
    search = search_on(Dragon(6), Turn(1.7))
    excess = Excess(search.interval, 0.0)
    assert excess.run(0.0, 25.0, 0.5, 1.2, 1.2 * (1.0 + 1e-9), WIDTH, 1e-13, links) is judged
    if links:
        assert abs(search.rates(excess.exceeded)[excess.handle]) > 1.2
        assert excess.exceeded - 2.0 * WIDTH <= excess.proven <= excess.exceeded
