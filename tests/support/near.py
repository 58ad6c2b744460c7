"""Numbers that must agree to an error that a test names."""

from __future__ import annotations

from typing import Any

import numpy as np


def assert_near(result: Any, expected: Any, within: float) -> None:
    """No number, alone or in an array, is further than `within` from the expected one, in its unit; none is NaN."""
    np.testing.assert_allclose(result, expected, rtol=0.0, atol=within, equal_nan=False)
