"""How deep the tests sample: some of the random cases in every run, all of them by `make deep`."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import TypeVar

Case = TypeVar("Case")
DEEP = "DEEP" in os.environ


def some(cases: Sequence[Case], count: int) -> Sequence[Case]:
    """So many of the cases, evenly spread; by `make deep` all."""
    return cases if DEEP or count >= len(cases) else [cases[k * len(cases) // count] for k in range(count)]


def examples(count: int, all_of_them: int) -> int:
    """So many examples of hypothesis; by `make deep` all."""
    return all_of_them if DEEP else count
