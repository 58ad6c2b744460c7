"""Depth of the tests: some of the random cases in every run, all of them and those marked `deep` by `make deep`."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import TypeVar

Case = TypeVar("Case")
DEEP = "DEEP" in os.environ


def some(cases: Sequence[Case], count: int) -> Sequence[Case]:
    """`count` of the cases, evenly spread; all of them by `make deep`."""
    return cases if DEEP or count >= len(cases) else [cases[k * len(cases) // count] for k in range(count)]


def examples(count: int, all_of_them: int) -> int:
    """Number of examples of hypothesis; the full number by `make deep`."""
    return all_of_them if DEEP else count
