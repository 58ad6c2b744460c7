"""Cases of which a newcomer runs the first ones, and `make test-all` all."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import islice
from typing import Any

import pytest


def further(cases: Iterable[Any], quick: int) -> list[Any]:
    """Values for parametrize: all the cases, of which those after the first `quick` are thorough."""
    rest = iter(cases)
    return [*islice(rest, quick), *(pytest.param(case, marks=pytest.mark.thorough) for case in rest)]
