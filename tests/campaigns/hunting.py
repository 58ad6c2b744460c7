"""One way to run a random campaign: cases from a seed until the time is over, each judged by a slow oracle.

A campaign gives a function `fault(seed, case)` that returns the kind of the answer and its fault in words, '' for none.
"""

import sys
import time
from collections import Counter
from typing import NamedTuple

import numpy as np

from core import BenchDragonError

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


def unless_refused(judged, case_of, *case):
    """The kind of the answer of a case, and its fault in words ('' for none); what core refuses is a kind too."""
    try:
        return judged(*case_of(*case))
    except BenchDragonError as refused:
        return f"refused: {type(refused).__name__}", ""


def hunt(fault, seed, seconds=SECONDS, cases=None):
    """Judge case after case until the time is over [s], or for a number of cases; prints every fault."""
    kinds = Counter()
    stop = time.monotonic() + seconds
    case = 0
    faults = 0
    while time.monotonic() < stop if cases is None else case < cases:
        kind, wrong = fault(seed, case)
        kinds[kind] += 1
        if wrong:
            faults += 1
            print(f"seed {seed}, case {case}: {kind}: {wrong}", flush=True)
        case += 1
    return Hunted(case, faults, kinds)


def arguments(*defaults):
    """The numbers of the command line in their order, and the defaults of those that are not there."""
    words = sys.argv[1:]
    return [type(value)(words[k]) if k < len(words) else value for k, value in enumerate(defaults)]


def main(hunt, what, *how):
    """Run a campaign from the command line, with SEED and SECONDS unless it says otherwise; exit 1 for any fault."""
    result = hunt(*(how or arguments(0, SECONDS)))
    for kind, times in sorted(result.kinds.items()):
        print(f"{times:6d}  {kind}")
    print(f"{result.cases} {what}, {result.faults} false")
    sys.exit(result.faults > 0)
