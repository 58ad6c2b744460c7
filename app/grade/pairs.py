"""Two of the commonest errors in the same places, as one motion.

Input: the right dance, and what the student's numbers show. Output: models of an error beside another one. State: the
motions of one call, each computed once. Argument: places are mirrored or exchanged, or their rows are shifted, whatever
the motion is, so an error of that kind and one of the motion are their composition. They are tried only where no single
error explains a sheet.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace
from itertools import chain

import numpy as np

from app.grade.chains import equal_arcs
from app.grade.expected import Motion, of_dance
from app.grade.geometry import (
    MIRRORS,
    OTHER_LENGTHS,
    Mirror,
    Model,
    SheetClues,
    mirrored,
    other_dragons,
    other_starts,
    other_turns,
    own_lengths,
    shifted_rows,
    shifted_time,
)
from app.grade.seen_paths import other_paths
from app.grade.words import Values
from core import BenchDragonError, Dance, Dragon
from core.values import Floats

# Most benches by which rows are shifted beside another error.
ROWS_MOST = 3
# Half a turn of all places, which is x and y negated, in the words of places that are turned.
HALF_TURN, HALF_TURN_VALUES = np.diag([-1.0, -1.0, 1.0]), {"angle": "+180"}


def pairs(dance: Dance, times: Floats, seen: SheetClues) -> Iterator[Model]:
    """Every pair of the commonest errors in the positions. times: (T,) [s] of the sheet"""
    right = _kept(of_dance(dance))
    rows = list(_shifted_rows(right))
    lengths = [_with_kept(one) for one in chain(other_dragons(dance), own_lengths(dance, seen))]
    others = [*rows, *lengths, _with_kept(Model("equal_arcs", equal_arcs(dance)))]
    if dance.path.spiral is None:
        others += [_with_kept(one) for one in other_turns(dance)]
    for error, mirror, values in _mirrors():
        # A mirror is its own inverse.
        lead = None if seen.lead is None else seen.lead @ mirror[:2, :2]
        clues = replace(seen, lead=lead)
        for one in (*others, *other_starts(dance, times, clues), *other_paths(dance, times, clues)):
            yield Model(error, mirrored(one.motion, mirror), values, beside=one)
    for length in lengths:
        for one in _shifted_rows(length.motion):
            yield replace(one, beside=length)
    for error, sizes in OTHER_LENGTHS.items():
        with suppress(BenchDragonError):  # a turn too tight for these lengths
            with_lengths = replace(dance, dragon=Dragon(dance.dragon.benches, **sizes))
            for one in other_paths(with_lengths, times, seen):
                yield replace(one, beside=Model(error, one.motion))
    for one in other_starts(dance, times, seen):
        if one.shift is not None:
            for length in lengths:
                yield replace(shifted_time(length.motion, one.shift), beside=length)


def _mirrors() -> Iterator[tuple[str, Mirror, Values]]:
    for error, mirror in MIRRORS.items():
        yield error, mirror, {}
    yield "turned", HALF_TURN, HALF_TURN_VALUES


def _shifted_rows(motion: Motion) -> Iterator[Model]:
    return shifted_rows(motion, ROWS_MOST)


def _with_kept(one: Model) -> Model:
    return replace(one, motion=_kept(one.motion))


def _kept(motion: Motion) -> Motion:
    """The same motion, which keeps its last numbers."""
    last: dict[bytes, Floats] = {}

    def moved(times: Floats) -> Floats:
        key = times.tobytes()
        if key not in last:
            last.clear()
            last[key] = motion(times)
        return last[key].copy()

    return moved
