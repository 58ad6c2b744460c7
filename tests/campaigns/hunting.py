"""One way to run a random campaign: cases from a seed until the time is over, each judged by a slow oracle.

A campaign gives a function `fault(seed, case)` that returns the kind of the answer and its fault in words, '' for none.
"""

from __future__ import annotations

import sys
import time
from collections import Counter
from typing import NamedTuple

import numpy as np

# Time that a campaign runs by default [s].
SECONDS = 300.0


class Hunted(NamedTuple):
    """Number of cases and of faults, and how often each kind of answer came."""

    cases: int
    faults: int
    kinds: Counter


def generator(seed, case):
    """The random numbers of one case: a case can be repeated alone."""
    return np.random.default_rng([seed, case])


def hunt(fault, seed, seconds, cases=None):
    """Judge case after case until the time is over [s], or for a number of cases; prints every fault."""
    kinds: Counter[str] = Counter()
    stop, case, faults = time.monotonic() + seconds, 0, 0
    while time.monotonic() < stop if cases is None else case < cases:
        kind, wrong = fault(seed, case)
        kinds[kind] += 1
        if wrong:
            faults += 1
            print(f"seed {seed}, case {case}: {kind}: {wrong}", flush=True)
        case += 1
    return Hunted(case, faults, kinds)


def main(fault, what):
    """Run a campaign from the command line: SEED (0) and SECONDS; exit 1 for any fault."""
    seed = int(sys.argv[1]) if len(sys.argv) > 1 else 0
    seconds = float(sys.argv[2]) if len(sys.argv) > 2 else SECONDS
    result = hunt(fault, seed, seconds)
    for kind, times in sorted(result.kinds.items()):
        print(f"{times:6d}  {kind}")
    print(f"{result.cases} {what}, {result.faults} false")
    sys.exit(result.faults > 0)
