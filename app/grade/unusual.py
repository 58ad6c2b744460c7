"""Some wrong numbers of a file, by which the files of a class are compared.

Input: the judgements of its sheets, and what was found. Output: numbers with their places. State: none. Argument: right
numbers are the same for everyone, and so are those of an error that many make; what is left is rarely the same in two
files by chance. Of each file the same cells are taken, so that a few of them show how much two files share.
"""

from __future__ import annotations

import zlib
from collections.abc import Iterator, Sequence

import numpy as np

from app.grade.judged import JudgedSheet
from app.grade.layout import TableKind
from app.grade.shortcuts import Finding

# Most numbers of a file, and fewest decimals of one.
MOST, DECIMALS_LEAST = 24, 4
# Errors with a size of their own, which few teams share by chance.
OWN_SIZES = {"other_pitch", "other_pitch_then", "other_speed", "own_lengths"}


def unusual_of(judgements: Sequence[JudgedSheet], findings: Sequence[Finding]) -> list[str]:
    """Up to MOST wrong numbers of a file, as "x 300 s 12: 8.173446", of the cells that come first in every file."""
    common = [one for one in findings if one.error not in OWN_SIZES]
    kinds = {kind for one in common for kind in one.kinds or TableKind}
    some = (number for one in judgements if one.table.kind not in kinds for number in _numbers(one))
    return [words for _, words in sorted(some)[:MOST]]


def _numbers(one: JudgedSheet) -> Iterator[tuple[int, str]]:
    """Wrong numbers of a sheet, each with the place of its cell among all cells of any file."""
    wrong = (one.off > one.tolerance) & ~one.rounded & (one.digits >= DECIMALS_LEAST)
    for t, h, c in np.argwhere(wrong).tolist():
        cell = f"{('x', 'y', 'v')[one.components[c]]} {one.times[t]:.9g} s {one.handles[h]}"
        yield zlib.crc32(cell.encode()), f"{cell}: {one.values[t, h, c]:.6f}"
