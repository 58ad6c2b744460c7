"""Many questions at once, on all cores: Python's lock is free while the compiled loops run."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from itertools import chain
from typing import TypeVar

T = TypeVar("T")
R = TypeVar("R")

# Pieces for each thread [1]: enough that none waits long for the last one, and few enough to cost nothing themselves.
PIECES = 16


def usable_cores() -> int:
    """Number of cores that this process may use; all cores of the machine if the system has no such limit."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def on_all_cores(function: Callable[[T], R], items: Sequence[T]) -> list[R]:
    """The values of a function for all items, in their order, as if it were called for one after the other.

    raises: what the function raises for the first item for which it does; pieces that have not begun are left out then
    """

    def values(piece: Sequence[T]) -> list[R]:
        return [function(one) for one in piece]

    threads = min(usable_cores(), len(items))
    if threads < 2:
        return values(items)
    size = -(-len(items) // (PIECES * threads))
    pieces = [items[k : k + size] for k in range(0, len(items), size)]
    pool = ThreadPoolExecutor(threads)
    try:
        return list(chain.from_iterable(pool.map(values, pieces)))
    finally:
        pool.shutdown(cancel_futures=True)
