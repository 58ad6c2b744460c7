"""Numbers that must agree to an error that a test names."""

import numpy as np


def assert_near(result, expected, within):
    """No number, alone or in an array, is further than `within` from the expected one, in its unit; none is NaN."""
    np.testing.assert_allclose(result, expected, rtol=0.0, atol=within, equal_nan=False)
