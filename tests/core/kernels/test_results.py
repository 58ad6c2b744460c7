"""Results of a march: numbers of Python, which are those of the arrays."""

from core.kernels import Ended
from core.kernels.results import Dip
from tests.core.kernels.test_marching import forty, marched


def test_a_march_hands_over_numbers_of_python():
    result = marched(forty())
    assert [type(value) for value in result] == [Ended, float, float, tuple, float, int, float, float, Dip]
    assert [type(value) for value in (*result.pair, *result.graze)] == [int, int, float, float, tuple]
    assert result.steps > 0
    assert result.gap_curvature > 0.0
