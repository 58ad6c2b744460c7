"""Right and wrong cells of a sheet.

Input: a table and its workbook. Output: a judgement with counts, the worst and the first wrong cell, and a picture of
their places. State: none.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from enum import StrEnum
from typing import Any

import numpy as np

from app.grade.decimals import digits_of, usual_of
from app.grade.expected import Workbook, cells_of, contact_time, dance_of, of_dance, times_of
from app.grade.handles import EXTRA_MOST, HANDLES, Ints, Mask
from app.grade.layout import COMPONENTS, SHEETS, SheetTable, TableKind
from app.grade.words import Note, note
from core import Dance
from core.values import Floats

# Name of a workbook in the name of a file.
NAME_OF_WORKBOOK = re.compile(r"result\s*_?([124])(?!\d)", re.IGNORECASE)
# Tolerance of six decimals: half a unit of the last, and 2 % more for numbers that were rounded twice [m, m/s, s].
RIGHT = 5.1e-7
# Tolerance of k decimals, fewer than six, in units of 10^-k, beside half a unit of the sixth decimal [m, m/s]: many
# numbers were rounded to six decimals before. Such numbers count as rounded.
ROUNDED, BEFORE, DECIMALS = 0.51, 5e-7, (5, 4, 3, 2)
# Decimals that the contest asks for; and largest difference of numbers that count as equal [m, m/s].
DECIMALS_OF_CONTEST, FLAT = 6, 2e-6
# Error of a student's own arithmetic, in addition to the rounding of the written decimals [m, m/s].
ARITHMETIC = 2e-6
# Ranges of the ratio to the right numbers of numbers in centimetres and millimetres; quantiles of their sizes at which
# the ratio is taken; and the largest quotient of two of these ratios.
SCALES = {1e-2: (50.0, 200.0), 1e-3: (500.0, 2000.0)}
SPREAD, STEADY = (0.1, 0.25, 0.5, 0.75, 0.9), 1.25
# Distance within which a number counts for a handle, when labels are compared with the order [m, m/s].
NEAR = 0.01
# Least share of the numbers that count for their handles in the order of the rows, so that it replaces the labels [1]:
# of wrong numbers some do by chance.
FITTING = 0.5
# Size of the picture, and its marks: right, rounded, wrong, missing.
PICTURE_ROWS, PICTURE_COLUMNS = 14, 42
MARKS = ".o#?"
WRONG, MISSING = MARKS[2], MARKS[3]
# Difference of two instants that are the same [s].
SAME_TIME = 1e-9
# Earliest time of a column to grade [s].
EARLIEST = -1000.0


class Rating(StrEnum):
    """Verdict on a sheet or a file, from the best to the worst; a number that breaks its limit is infeasible."""

    RIGHT = "right"
    ROUNDED = "rounded"
    INCOMPLETE = "incomplete"
    INFEASIBLE = "infeasible"
    WRONG = "wrong"
    UNREADABLE = "unreadable"


def rounding_of(decimals: Any) -> Any:
    """Distance of a number with so many decimals from the one that was rounded to it [m, m/s]: of one, or of many."""
    return ROUNDED * 10.0**-decimals + BEFORE * (decimals < DECIMALS_OF_CONTEST)


def worst_of(verdicts: Iterator[Rating]) -> Rating:
    return max(verdicts, key=list(Rating).index, default=Rating.UNREADABLE)


@dataclass(frozen=True)
class JudgedSheet:
    """The judgement of a sheet.

    dance: the right one
    values, wanted: the student's and the right numbers (T, H, C) [m, m/s]; handles (H,), times (T,) [s]
    decimals: number to which the numbers are right, if they are rounded; written: decimals that its numbers usually
        have; digits: those with which each number counts (T, H, C)
    cells: number that the contest requires; right, missing: how many of them
    rounded: the numbers (T, H, C) that are not right, but to their decimals, or to two
    """

    table: SheetTable
    workbook: Workbook
    dance: Dance
    verdict: Rating
    decimals: int | None
    written: int
    digits: Ints
    cells: int
    right: int
    rounded: Mask
    missing: int
    times: Floats
    handles: Ints
    values: Floats
    wanted: Floats
    notes: list[Note] = field(default_factory=list)

    @property
    def title(self) -> str | Note:
        """Title of the sheet, or what it holds."""
        return self.table.title or note(SHEETS[self.table.kind])

    @property
    def components(self) -> tuple[int, ...]:
        """Of the last axis."""
        return COMPONENTS[self.table.kind]

    @property
    def known(self) -> Mask:
        """Lines (H,) of handles that the dragon has."""
        return np.asarray(self.handles < HANDLES)

    @property
    def off(self) -> Floats:
        """Distance of every number from the right one (T, H, C), NaN where there is none."""
        off: Floats = np.abs(self.values - self.wanted)
        return off

    @property
    def rounding(self) -> Floats:
        """Distance of each number (T, H, C) from the one that was rounded to it [m, m/s]."""
        return np.asarray(rounding_of(self.digits))

    @property
    def tolerance(self) -> Floats:
        """Distance within which each number agrees with another one that was computed the same way [m, m/s]."""
        return self.rounding + ARITHMETIC

    @property
    def usual_tolerance(self) -> float:
        """The tolerance of most numbers [m, m/s]."""
        return float(rounding_of(self.written)) + ARITHMETIC

    @property
    def is_off(self) -> bool:
        """True if a number is further off than its decimals and a student's arithmetic allow."""
        return bool((self.off > self.tolerance).any())

    @property
    def is_rounded(self) -> bool:
        """True if every number is the right one, rounded to its decimals."""
        return not bool((self.off > self.rounding).any())

    @property
    def _is_wrong(self) -> Mask:
        """The numbers (T, H, C) that are wrong: those that are only rounded count where no others are."""
        wrong = self.off > RIGHT
        further = wrong & ~self.rounded
        return np.asarray(further if further.any() else wrong)

    @property
    def wrong(self) -> int:
        """Number of the cells that are wrong, and not only rounded."""
        return int(((self.off > RIGHT) & ~self.rounded).sum())

    def worst(self) -> tuple[int, ...] | None:
        """Index of the wrong number with the largest error; None if all are right."""
        off = np.where(self._is_wrong, self.off, 0.0)
        return tuple(map(int, np.unravel_index(off.argmax(), off.shape))) if off.size and off.max() > RIGHT else None

    def first(self) -> tuple[int, ...] | None:
        """Index of the first wrong number of the sheet in reading order."""
        wrong = self._is_wrong
        if not wrong.any():
            return None
        reading = np.where(wrong, self.table.row * (self.table.column.max() + 1) + self.table.column, np.inf)
        return tuple(map(int, np.unravel_index(reading.argmin(), reading.shape)))

    def picture(self) -> list[str]:
        """Lines of marks: a line for some handles, the head first; a mark for some instants, or for x, y and speed."""
        off = self.off
        level = np.where(off > RIGHT, 1, 0)
        level[off > rounding_of(DECIMALS[-1])] = 2
        level[np.isnan(off)] = 3
        level = level[0].T if len(level) == 1 else level.max(axis=2)
        level = level.T[np.argsort(self.handles)]
        height, width = min(PICTURE_ROWS, level.shape[0]), min(PICTURE_COLUMNS, level.shape[1])
        bands = [band.max(axis=0) for band in np.array_split(level, height)]
        return ["".join(MARKS[part.max()] for part in np.array_split(band, width)) for band in bands]


def workbook_of(tables: list[SheetTable], name: str) -> Workbook:
    """Workbook of some tables: by their kinds and instants; by the name of the file where these are in two of them."""
    if any(table.kind is TableKind.CONTACT for table in tables):
        return Workbook.RESULT2
    if any(table.times.min() < 0 for table in tables):
        return Workbook.RESULT4
    if "4" in name and any(abs(table.times.size - times_of(Workbook.RESULT4).size) <= 1 for table in tables):
        return Workbook.RESULT4
    named = NAME_OF_WORKBOOK.search(name)
    if named and named[1] == "4" and all(table.times.max() <= times_of(Workbook.RESULT4).max() for table in tables):
        return Workbook.RESULT4
    return Workbook.RESULT1


def judged(table: SheetTable, workbook: Workbook, decimals_beside: int = 0, dance: Dance | None = None) -> JudgedSheet:
    """The judgement of one table.

    decimals_beside: those of the numbers of its file; dance: the right one, by default that of the workbook
    """
    right, instants = dance or dance_of(workbook), _instants(table)
    return max(
        (_judged(table, workbook, right, decimals_beside, times) for times in instants), key=lambda one: one.right
    )


def _instants(table: SheetTable) -> list[Floats]:
    """Times at which the numbers may be right [s]: for result2 also the stated one, if it is right to six decimals."""
    if table.kind is not TableKind.CONTACT:
        return [table.times]
    right = np.array([contact_time()])
    return [right, table.times] if abs(table.times[0] - right[0]) <= RIGHT else [right]


def _judged(table: SheetTable, workbook: Workbook, dance: Dance, decimals_beside: int, times: Floats) -> JudgedSheet:
    notes = [*table.notes]
    is_on_path = (times >= EARLIEST) & (times <= dance.end.time)
    motion = of_dance(dance)(np.where(is_on_path, times, 0.0))[..., list(COMPONENTS[table.kind])]
    # result2 has places and speeds in one table.
    parts = (slice(0, 2), slice(2, 3)) if table.kind is TableKind.CONTACT else (slice(None),)
    scaled = [table.values[..., one] * _scale(table.values[..., one], motion[..., one], notes) for one in parts]
    values = np.concatenate(scaled, axis=-1)
    is_vague = 0 < decimals_beside < DECIMALS_OF_CONTEST and table.shown is None and _is_one_number(values)
    has_fewer = is_vague and decimals_beside > DECIMALS[-1]
    if is_vague:
        decimals_beside = DECIMALS[-1]
    elif table.shown is not None:  # zeros behind numbers that were rounded before show nothing more
        decimals_beside = min(table.shown, decimals_beside or table.shown)
    handles = _handles(table, values, motion, decimals_beside, notes)
    known = handles < HANDLES
    if not known.all():
        notes.append(note("extra_handles", count=int((~known).sum())))
    wanted = np.full(values.shape, np.nan)
    wanted[:, known] = motion[:, handles[known]]
    is_of_contest = np.abs(times[:, None] - times_of(workbook)).min(axis=1) < SAME_TIME
    is_wanted = is_on_path & (is_of_contest | (table.kind is TableKind.CONTACT))
    if not is_wanted.all():
        notes.append(note("extra_times", count=int((~is_wanted).sum())))
    wanted[~is_wanted] = np.nan
    values = np.where(np.isnan(wanted), np.nan, values)
    off, cells = np.abs(values - wanted), cells_of(workbook, table.kind)
    present, right = int((~np.isnan(off)).sum()), int((off <= RIGHT).sum())
    largest = float(np.nanmax(off)) if present else np.inf
    decimals = next((k for k in DECIMALS if largest <= rounding_of(k)), None)
    digits = digits_of(values, decimals_beside)
    written = usual_of(digits, values)
    if decimals is None and written == 1 and not (off > rounding_of(digits)).any():
        decimals = 1
    near = (off <= rounding_of(DECIMALS[-1])) | ((digits > 0) & (off <= rounding_of(digits)))
    if (flat := _decimals_of_flat(values, wanted, max(written, decimals_beside))) >= 0:
        near &= off <= rounding_of(flat)
        decimals = None if decimals is not None and decimals < flat else decimals
    if not present:
        notes.append(note("no_numbers", handles=int(known.sum()), kind=note(SHEETS[table.kind])))
    if has_fewer and decimals == DECIMALS[-1]:
        notes.append(note("vague", number=f"{np.nanmax(values):g}", decimals=decimals))
    missing = cells - present
    if missing and present:
        has_number = np.isfinite(values)
        absent = HANDLES - np.unique(handles[has_number.any(axis=(0, 2))]).size
        late = times_of(workbook).size - np.unique(times[has_number.any(axis=(1, 2))]).size
        notes.append(note("missing", count=missing, handles=absent, times=late))
    return JudgedSheet(
        table,
        workbook,
        dance,
        _rating(present, cells, largest, is_rounded=decimals is not None),
        decimals=None if largest <= RIGHT else decimals,
        written=written,
        digits=digits,
        cells=cells,
        right=right,
        rounded=np.asarray(near & (off > RIGHT)),
        missing=missing,
        times=times,
        handles=handles,
        values=values,
        wanted=wanted,
        notes=notes,
    )


def _rating(present: int, cells: int, largest: float, *, is_rounded: bool) -> Rating:
    """The rating of a sheet. present: of its cells, those with numbers; largest: error of these"""
    if not present:
        return Rating.UNREADABLE
    if largest > RIGHT and not is_rounded:
        return Rating.WRONG
    if present < cells:
        return Rating.INCOMPLETE
    return Rating.RIGHT if largest <= RIGHT else Rating.ROUNDED


def with_errors(judgements: list[JudgedSheet], kinds: set[TableKind]) -> list[JudgedSheet]:
    """Judgements after the diagnosis. kinds: of the sheets whose digits decide for an error: they were not rounded"""
    wrong = {component for kind in kinds for component in COMPONENTS[kind]}
    return [
        replace(
            one,
            verdict=Rating.WRONG,
            decimals=None,
            rounded=one.rounded & ~np.isin(one.components, list(wrong)),
        )
        if kinds and one.table.kind in kinds | {TableKind.CONTACT}
        else one
        for one in judgements
    ]


def _decimals_of_flat(values: Floats, wanted: Floats, decimals: int) -> int:
    """Decimals to count for numbers that are all equal although the right ones differ; -1 for numbers that differ.

    Equal numbers show no decimals of their own, so they count with those of the file, or with those that the contest
    asks for: all speeds 1 are right to two decimals by chance.
    decimals: of the numbers in the file
    """
    known = np.isfinite(values) & np.isfinite(wanted)
    if not known.any() or np.ptp(values[known]) > FLAT or np.ptp(wanted[known]) <= ROUNDED * 10.0 ** -DECIMALS[0]:
        return -1
    return decimals if decimals >= DECIMALS[-1] else DECIMALS_OF_CONTEST


def _is_one_number(values: Floats) -> bool:
    """True for one whole number in all cells, which may be rounded: beside others that are, nothing shows how far."""
    known = values[np.isfinite(values)]
    return bool(known.size and np.ptp(known) == 0.0 and known[0] % 1.0 == 0.0)


def _scale(values: Floats, motion: Floats, notes: list[Note]) -> float:
    """Factor from the numbers to metres; numbers in a steady ratio to the right ones are in centimetres or millimetres.

    Angles of some hundred radians or degrees are as large as centimetres, but not spread alike.
    """
    sizes = np.abs(values[np.isfinite(values) & (values != 0.0)])
    if not sizes.size:
        return 1.0
    ratios = np.quantile(sizes, SPREAD) / np.quantile(np.abs(motion), SPREAD)
    for scale, (low, high) in SCALES.items():
        if low <= ratios.min() and ratios.max() <= high and ratios.max() <= STEADY * ratios.min():
            said = note("unit", unit="cm" if scale == 1e-2 else "mm")
            notes += [] if said in notes else [said]
            return scale
    return 1.0


def _handles(table: SheetTable, values: Floats, motion: Floats, decimals_beside: int, notes: list[Note]) -> Ints:
    """Handle of every line: by its label, or by its order if that fits more numbers."""

    def near(handles: Ints) -> int:
        known = handles < HANDLES
        return int((np.abs(values[:, known] - motion[:, handles[known]]) < far[:, known]).sum())

    # Of a few handles the order does not tell which they are.
    if np.array_equal(table.handles, table.by_order) or table.handles.size < HANDLES - EXTRA_MOST:
        return table.handles
    far = np.full(values.shape, NEAR)
    if table.kind is TableKind.SPEED:  # those of neighbours hardly differ
        far = np.minimum(NEAR, ROUNDED * 10.0 ** -digits_of(values, decimals_beside) + ARITHMETIC)
    fits = near(table.by_order)
    if fits <= near(table.handles) or fits < FITTING * np.isfinite(values).sum():
        return table.handles
    notes.append(note("by_order"))
    return table.by_order
