"""Students whom the grader might judge wrongly: python -m tests.campaigns.hunt_grades [SEED [SECONDS [CASES]]]

Random sheets and typed numbers that are nearly right, in the ways in which students' results are: rounded, cut off,
from single precision, with noise, with a few wrong, missing or exchanged cells, with errors that add up along the
benches or come from a solver, or with a small bias. None has a known error, so that each diagnosis is a fault; so is a
verdict "wrong" on a number that is right to its digits. Files in random layouts are right in every number, or wrong by
one of the commonest errors, which is named. Spirals of another pitch or speed are named too, and a team's own turn is
judged by itself. With CASES it ends after so many, not after SECONDS.
"""

from functools import cache

import numpy as np

from app.grade.diagnosis import diagnosed
from app.grade.expected import Workbook, dance_of, of_dance, times_of
from app.grade.handles import HANDLES
from app.grade.judged import judged
from app.grade.layout import COMPONENTS, SheetTable, TableKind
from app.grade.report import graded, typed
from app.grade.seen_paths import judged_by_turn
from app.grade.shortcuts import UNITS, right_answer
from core import Budget, Dance, Dragon, Spiral, Turn
from tests.campaigns import hunting
from tests.support.student_files import as_csv, in_random_layout
from tests.support.students import by_xlsxwriter

SECONDS = 120.0
# Shares of typed numbers, of files and of other paths among the cases, and of sheets with all instants: others have
# every 25th.
TYPED, FILES, PATHS, WHOLE, THINNED = 0.4, 0.2, 0.1, 0.02, 25
# Numbers of instants in a file, from and below; and share of the files with one sheet that are workbooks.
INSTANTS = (2, 7)
WORKBOOKS = 0.3
# Decimals of sheets, and of typed numbers.
SHEET_DECIMALS = (2, 9)
TYPED_DECIMALS = (1, 11)


@cache
def right(workbook):
    """Right numbers (T, HANDLES, 3) of a workbook."""
    return of_dance(dance_of(workbook))(times_of(workbook))


def rounded(values, decimals, random):
    """Numbers rounded to the nearest, cut off, or rounded down."""
    scaled = values * 10.0**decimals
    return [np.round, np.trunc, np.floor][random.integers(3)](scaled) / 10.0**decimals


def single_precision(values, random):
    return values.astype(np.float32).astype(np.float64)


def noise(values, random):
    return values + random.normal(0.0, 10.0 ** -random.uniform(2.0, 8.0), values.shape)


def with_one_kind(values, random):
    """A copy of the numbers, and its positions alone or its speeds alone, to be changed in it."""
    result = values.copy()
    return result, result[..., [slice(0, 2), slice(2, 3)][random.integers(2)]]


def noise_of_one_kind(values, random):
    result, some = with_one_kind(values, random)
    some += random.normal(0.0, 10.0 ** -random.uniform(2.0, 8.0), some.shape)
    return result


def along_benches(values, random):
    """Errors that add up from bench to bench."""
    steps = random.normal(0.0, 10.0 ** -random.uniform(4.0, 8.0), values.shape)
    return values + np.cumsum(steps, axis=1)


def of_solver(values, random):
    """Smooth errors over handles and instants, as from a solver that stops early, the same in x, y and speed or not."""
    waves = random.uniform(0.0, 0.5, 2)
    t, h = np.meshgrid(*(np.arange(size) for size in values.shape[:2]), indexing="ij")
    shape = np.sin(waves[0] * t + waves[1] * h + random.uniform(0.0, 6.0))
    return values + 10.0 ** -random.uniform(4.0, 8.0) * shape[..., None] * random.uniform(-1.0, 1.0, 3)


def biased(values, random):
    """All speeds, or all places, too small or too large by the same part."""
    result, some = with_one_kind(values, random)
    some *= 1.0 + random.normal(0.0, 10.0 ** -random.uniform(4.0, 8.0))
    return result


def last_digit(values, random):
    """Some cells off by one in the sixth decimal."""
    return np.round(values, 6) + 1e-6 * random.integers(-1, 2, values.shape) * (random.random(values.shape) < 0.1)


def few_cells(values, random):
    """Some cells with another sign, a misplaced point or another number."""
    result = values.copy()
    for _ in range(random.integers(1, 30)):
        at = tuple(random.integers(size) for size in values.shape)
        result[at] = [-result[at], 10.0 * result[at], result[at] + random.normal()][random.integers(3)]
    return result


def exchanged(values, random):
    """Two handles exchanged, at all instants."""
    result = values.copy()
    a, b = random.integers(HANDLES, size=2)
    result[:, [a, b]] = result[:, [b, a]]
    return result


def missing(values, random):
    result = values.copy()
    result[random.random(values.shape) < random.uniform(0.0, 0.5)] = np.nan
    return result


CHANGES = [
    single_precision, noise, noise_of_one_kind, along_benches, of_solver, biased, last_digit, few_cells, exchanged,
    missing,
]  # fmt: skip


def sheet_fault(random):
    """What the grader finds in a workbook that is nearly right; empty for nothing."""
    workbook = list(Workbook)[random.integers(3)]
    values = right(workbook)
    times = times_of(workbook)
    if workbook is not Workbook.RESULT2 and random.random() > WHOLE:
        values, times = values[::THINNED], times[::THINNED]
    changes = [CHANGES[k] for k in random.integers(len(CHANGES), size=random.integers(3))]
    for change in changes:
        values = change(values, random)
    decimals = int(random.integers(*SHEET_DECIMALS))
    values = rounded(values, decimals, random)
    kinds = [TableKind.CONTACT] if workbook is Workbook.RESULT2 else [TableKind.POSITION, TableKind.SPEED]
    judgements = [judged(table_of(kind, times, values), workbook, decimals) for kind in kinds]
    findings = diagnosed(judgements, Budget())
    if not findings:
        return ""
    names = ", ".join(change.__name__ for change in changes)
    return f"{workbook.value}, {names or 'rounded'}, {decimals} decimals: {', '.join(one.error for one in findings)}"


def table_of(kind, times, values):
    """A sheet with these numbers (T, HANDLES, 3)."""
    some = values[..., list(COMPONENTS[kind])]
    handles = np.arange(HANDLES)
    places = np.zeros(some.shape, dtype=np.int64)
    instants = np.array([np.nan]) if kind is TableKind.CONTACT else times
    return SheetTable("", kind, instants, handles, handles, some, places, places)


def turned(values, random):
    """Places turned about the centre by one angle."""
    angle = random.uniform(0.1, 6.0)
    turn = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    return np.concatenate([values[..., :2] @ turn, values[..., 2:]], axis=-1)


# The commonest errors of students by their names, and what each makes of the right numbers.
ERRORS = {
    "": lambda values, random: values,
    "anticlockwise": lambda values, random: values * [1.0, -1.0, 1.0],
    "x_negated": lambda values, random: values * [-1.0, 1.0, 1.0],
    "axes_exchanged": lambda values, random: values[..., [1, 0, 2]],
    "turned": turned,
    "shifted_rows": lambda values, random: np.roll(values, random.choice([-1, 1]), axis=1),
    "speeds_negated": lambda values, random: values * [1.0, 1.0, -1.0],
}


def file_fault(random):
    """What is false in the grade of a file in a random layout, right or with one of ERRORS; empty for nothing."""
    workbook = list(Workbook)[random.integers(len(Workbook))]
    error = list(ERRORS)[random.integers(len(ERRORS))]
    values = right(workbook)
    times = times_of(workbook)
    if workbook is not Workbook.RESULT2:
        some = np.sort(random.choice(times.size, random.integers(*INSTANTS), replace=False))
        values, times = values[some], times[some]
    values = np.round(ERRORS[error](values, random), 6)
    sheets, layout = in_random_layout(values, times, random)
    is_csv = len(sheets) == 1 and random.random() > WORKBOOKS
    data = as_csv(*sheets.values()) if is_csv else by_xlsxwriter(sheets)
    grade = graded(f"{workbook.value}.csv", data, Budget())
    names = [one.error for one in grade.diagnosis]
    count = sum(one.right for one in grade.sheets)
    if error:
        is_fine = grade.verdict == "wrong" and names == [error]
    else:
        is_fine = grade.verdict in ("right", "incomplete") and (names, count) == ([], values.size)
    if is_fine:
        return ""
    return f"{workbook.value}, {error or 'right'}, {layout}: {grade.verdict.value}, {count} right, {', '.join(names)}"


def path_fault(random):
    """What is false about another pitch, another speed, or a turn that question 4 allows; empty for nothing."""
    decimals = int(random.integers(4, 7))
    if random.random() < 0.5:
        workbook, times = Workbook.RESULT1, times_of(Workbook.RESULT1)[:: random.integers(1, 11)]
        pitch, speed = round(random.uniform(0.5, 0.62), 3), round(random.uniform(0.8, 1.2), random.integers(1, 3))
        dance = Dance(Dragon(), Spiral(pitch, 16.0 if random.random() < 0.5 else 8.8 / pitch), speed)
        wanted = ["other_pitch"] * (pitch != 0.55) + ["other_speed"] * (speed != 1.0)
        what = f"pitch {pitch}, speed {speed}"
    else:
        workbook, times = Workbook.RESULT4, times_of(Workbook.RESULT4)[:: random.integers(1, 6)]
        entry, ratio = round(random.uniform(4.3, 4.49), random.integers(2, 4)), round(random.uniform(1.05, 1.6), 2)
        dance, wanted = Dance(Dragon(), Turn(1.7, entry_radius=entry, ratio=ratio)), []
        what = f"entry {entry}, ratio {ratio}"
    values = np.round(of_dance(dance)(np.minimum(times, dance.end.time)), decimals)
    kinds = [TableKind.POSITION, TableKind.SPEED]
    budget, sheets = Budget(), [judged(table_of(kind, times, values), workbook, decimals) for kind in kinds]
    judgements, own = judged_by_turn(sheets, decimals, budget)
    names = [one.error for one in diagnosed(judgements, budget)]
    is_fine = names == wanted and (
        workbook is Workbook.RESULT1 or (own is not None and not sum(one.wrong for one in judgements))
    )
    return "" if is_fine else f"{what}, {times.size} instants, {decimals} decimals: {', '.join(names)}; {own}"


def typed_fault(random):
    """What the grader finds in a number that is right to its digits, nearly right, or random; empty for nothing."""
    name = list(UNITS)[random.integers(len(UNITS))]
    value = right_answer(name)
    decimals = int(random.integers(*TYPED_DECIMALS))
    way = random.integers(3)
    if way == 1:
        value *= 1.0 + random.normal(0.0, 10.0 ** -random.uniform(2.0, 9.0))
    elif way == 2:
        value *= random.uniform(0.8, 1.2)
    text = f"{float(rounded(np.array(value), decimals, random)) if random.random() < 0.5 else value:.{decimals}f}"
    if float(text) <= 0.0:
        return ""
    result = typed(name, text)
    if result.diagnosis or (way == 0 and (result.verdict == "wrong" or result.possible)):
        return f"{name} {text}: {result.verdict.value}, {', '.join(one.error for one in result.diagnosis)}"
    return ""


def hunt(seed, seconds=SECONDS, cases=None):
    """Random cases from one row of random numbers. cases: number of them, instead of the seconds"""
    random = np.random.default_rng(seed)

    def fault(seed, case):
        faults = {"typed number": typed_fault, "file": file_fault, "path": path_fault, "sheet": sheet_fault}
        kind = str(random.choice(list(faults), p=[TYPED, FILES, PATHS, 1.0 - TYPED - FILES - PATHS]))
        return kind, faults[kind](random)

    return hunting.hunt(fault, seed, seconds, cases)


if __name__ == "__main__":
    seed, seconds, cases = hunting.arguments(1, SECONDS, 0)
    hunting.main(hunt, "sheets, files and typed numbers", seed, seconds, cases or None)
