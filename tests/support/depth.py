"""Depth of the tests: what `make test` runs, what is left to `make test-all` (thorough) and to `make deep` (deep)."""

import os
from itertools import islice

import pytest

DEEP = "DEEP" in os.environ


def some(cases, count):
    """`count` of the cases, evenly spread; all of them by `make deep`."""
    return cases if DEEP or count >= len(cases) else [cases[k * len(cases) // count] for k in range(count)]


def examples(count, all_of_them):
    """Number of examples of hypothesis; the full number by `make deep`."""
    return all_of_them if DEEP else count


def thorough(*cases):
    """The cases as thorough parameters of a test; a tuple holds the values of several arguments."""
    return [pytest.param(*(case if isinstance(case, tuple) else (case,)), marks=pytest.mark.thorough) for case in cases]


def further(cases, quick):
    """Values for parametrize: all the cases, of which those after the first `quick` are thorough."""
    rest = iter(cases)
    return [*islice(rest, quick), *(pytest.param(case, marks=pytest.mark.thorough) for case in rest)]


def often(cases, quick):
    """All cases as parameters of a test, of which those that are not among the quick ones are thorough."""
    return [case if case in quick else thorough(case)[0] for case in cases]


def few(cases, count):
    """All cases as parameters of a test: `count` of them, evenly spread, in every run, and the others as thorough."""
    first = {k * len(cases) // count for k in range(count)}
    return [case if k in first else pytest.param(case, marks=pytest.mark.thorough) for k, case in enumerate(cases)]
