"""Typed answers to the contest's questions: whether they are right to their digits, and which known shortcut fits.

Input: the name of a number, its value and its rounding. Output: a verdict, remarks and findings. State: none.

A shortcut is only a guess as long as numbers of as many digits fit one by chance. Within the distance d of a number
from the right value, on both sides of it, there are 2 d / u numbers with a last digit of size u, and some of them, f,
fit a shortcut. Someone who errs by up to d may type any of them, so that f u / (2 d) is the chance of a fit. Findings
carry it: at most CERTAIN for a diagnosis, at most POSSIBLE for a guess; beyond that nothing is reported.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import core
from app.grade.contacts import PITCH_RANGE, longest_overlap
from app.grade.expected import Workbook, dance_of
from app.grade.judged import DECIMALS_OF_CONTEST, Rating
from app.grade.limits import SAFE_SIDE, WIDER_LENGTH, beyond, broken, limit_of
from app.grade.shortcuts import UNITS, Finding, Shortcut, pitch_grids, right_answer, shortcuts
from app.grade.typed_number import OTHER_UNITS
from app.grade.words import Note, note

# Half units of the last digit within which a number agrees: 2 % more for numbers that were rounded twice.
HALF = 1.02
# Half of the last decimal that the contest asks for: a number is graded to six decimals, if it has more.
HALF_UNIT_LEAST = 0.5e-6
# Largest half of the last digit, relative to the number, at which a shortcut is reported [1]: 1.3 has too few digits.
DIGITS_SHARE = 2e-3
# Largest chance of a fit at which a shortcut is a diagnosis, and at which it is reported as a guess [1].
CERTAIN, POSSIBLE = 2e-4, 0.1
# Shortcuts that students hand in exactly must agree to this, in the unit of the number; or to its digits.
EXACTLY = 1e-6
# A search for a number ends up to this beside its limit, in the unit of the number: many bisections stop at 1e-8, and
# all their digits are written. Counts only for a number that no shortcut gives to its digits.
SEARCH_END = 0.5e-8
# Longest overlap on the way to the circle that a check of it in steps may miss [m].
OVERLAP_MOST = 0.1
# Fewest digits of a number that is right, from its first one, or that of the right value if it comes later: a single
# one is that of many wrong numbers too, and that of the speed of 1 m/s which the contest gives.
DIGITS_LEAST = 2
# Most decimals of a rounded number.
DECIMALS_MOST = 4
# A time as near to the nearest pass before first contact is that of the pass [s].
PASS_SPAN = 0.05
MM = 1000.0
# Length that every turn exceeds whose first arc has twice the radius of the second [m], as core.shortest_turn() proves.
TURN_OF_TWO_LEAST = 11.7991513


@dataclass(frozen=True)
class Graded:
    """Grade of a typed number.

    notes: remarks in words; findings: shortcuts that give it, with the chance of each
    breaks: the limit that it breaks, and what happens there; None if it breaks none
    headline: name of the verdict in words; empty: that of the verdict
    rounded: it is the right one, to fewer decimals than the contest asks for or to another side
    """

    verdict: Rating
    notes: list[Note]
    findings: list[Finding]
    breaks: Note | None = None
    headline: str = ""
    rounded: bool = False


def graded_number(name: str, value: float, half_unit: float) -> Graded:
    """The grade of one of UNITS. value: in its unit; half_unit: half of its last digit

    A number is right if it is the right one to its own digits. One that is off by less than its last digit was rounded
    the other way, and nothing else follows from that. A limit is rounded to its safe side: the least pitch and the
    shortest turn up, the highest speed down; on the other side benches touch, or somebody is too fast. It is kept to
    half of the last decimal that the contest asks for. Whatever else is wrong with a number, a limit that it breaks
    comes first. A number of too few digits to be right is incomplete.
    """
    half, excess = max(half_unit, HALF_UNIT_LEAST), beyond(name, value)
    digits = math.floor(math.log10(min(value, right_answer(name)))) + 1 + _decimals_of(half)
    few = note("few_digits", least=DIGITS_LEAST) if digits < DIGITS_LEAST else None
    if excess > HALF * HALF_UNIT_LEAST:
        if excess < 2.0 * half:
            way = "rounded_unsafely" if excess <= HALF * half else "beyond"
            safe = note(f"{name}_{way}", safe=_safe(name, _decimals_of(half)))
            is_nearest = excess <= HALF * half and not few
            return Graded(Rating.INFEASIBLE, [few or safe], [], broken(name, value), rounded=is_nearest)
        return replace(_wrong(name, value, half_unit), breaks=broken(name, value))
    grade = _graded(name, value, half_unit)
    return Graded(Rating.INCOMPLETE, [few], []) if few and grade.verdict is not Rating.WRONG else grade


def _graded(name: str, value: float, half_unit: float) -> Graded:
    """The grade of a number that breaks no limit."""
    right, half = right_answer(name), max(half_unit, HALF_UNIT_LEAST)
    is_nearest, is_near = abs(value - right) <= HALF * half, abs(value - right) < 2.0 * half
    decimals = _decimals_of(half)
    words = {"nearest": f"{round(right, decimals):.{max(decimals, 0)}f}", "unit": UNITS[name]}
    is_safe = name in SAFE_SIDE and SAFE_SIDE[name] * (value - right) > 0.0
    if is_nearest or (is_near and is_safe):
        is_whole = decimals >= DECIMALS_OF_CONTEST
        notes = [] if is_nearest else [note(f"{name}_rounded_safely", **words)]
        return Graded(Rating.RIGHT, notes, [], headline="" if is_whole else "to_digits", rounded=not is_whole)
    if is_near and name not in SAFE_SIDE:
        remark = note("rounded_otherwise", **words)
        return Graded(Rating.ROUNDED, [remark], [], headline="not_to_the_nearest", rounded=True)
    if name == "turn_length" and value < right:
        kinds = ("possible_turn", TURN_OF_TWO_LEAST), ("possible_turn_of_ratio", WIDER_LENGTH)
        kind = next((kind for kind, least in kinds if value + half_unit >= least), "possible_turn_tighter")
        return Graded(Rating.RIGHT, [note(kind, length=f"{right:.7f}", wider=f"{WIDER_LENGTH:.7f}")], [])
    return _wrong(name, value, half_unit)


def _wrong(name: str, value: float, half_unit: float) -> Graded:
    """The grade of a wrong number."""
    if in_other := _in_other_unit(name, value, half_unit):
        return Graded(Rating.WRONG, [in_other], [])
    is_tight = name == "pitch" and beyond(name, value) > 0.0
    findings = explained(name, value, half_unit)
    notes = _overlap_of(value) if is_tight else [_meaning_of(name, value)] if beyond(name, value) <= 0.0 else []
    if not findings:
        notes.append(note("too_few_digits" if half_unit > DIGITS_SHARE * value else "nothing_fits"))
    is_possible = name in SAFE_SIDE and beyond(name, value) <= 0.0
    return Graded(Rating.WRONG, notes, findings, headline=f"not_best_{name}" if is_possible else "")


def _meaning_of(name: str, value: float) -> Note:
    """What is true at a wrong number that breaks no limit: how far it is from the best one, or what a time shows."""
    far = abs(value - right_answer(name))
    if name in SAFE_SIDE:
        return note(f"{name}_{'slower' if name == 'speed' else 'longer'}", far=_length_of(far, UNITS[name]))
    if value > right_answer(name):
        return note("time_late", far=f"{far:.3g}")
    dance = dance_of(Workbook.RESULT2)
    graze = core.first_contact(dance).certificate.least_clearance
    if graze and abs(graze.time - value) <= PASS_SPAN:
        return note("time_of_pass", time=f"{graze.time:.2f}", far=f"{far:.3g}", gap=_length_of(graze.clearance, "m"))
    gap = float(core.clearance_profile(dance, [value]).clearance[0])
    return note("time_early", far=f"{far:.3g}", gap=_length_of(gap, "m"))


def _length_of(size: float, unit: str) -> str:
    """A small size in three digits, lengths below a metre in millimetres."""
    return f"{MM * size:.3g} mm" if unit == "m" and size < 1.0 else f"{size:.3g} {unit}"


def _in_other_unit(name: str, value: float, half_unit: float) -> Note | None:
    """That a number is the right one in another unit than asked for, if it is."""
    for other, size in OTHER_UNITS[UNITS[name]].items():
        if abs(value - right_answer(name) / float(size)) < 2.0 * half_unit <= DIGITS_SHARE * value:
            number = f"{value * float(size):.{_decimals_of(half_unit * float(size))}f}"
            return note("in_other_unit", other=other, unit=UNITS[name], number=number)
    return None


def _safe(name: str, digits: int) -> str:
    """The number of so many decimals that is next to the limit, on its safe side."""
    unit, limit = 10.0**-digits, limit_of(name)
    assert limit is not None
    steps = math.ceil(limit / unit) if SAFE_SIDE[name] > 0 else math.floor(limit / unit)
    return f"{steps * unit:.{max(digits, 0)}f}"


def _overlap_of(pitch: float) -> list[Note]:
    """Where benches overlap at a pitch that is a little too small, which shows how finely the way must be checked."""
    if pitch <= PITCH_RANGE[0] or (overlap := longest_overlap(pitch)) is None:
        return []
    way = overlap[0] - overlap[1]
    if way > OVERLAP_MOST:
        return []
    values = {"first": f"{overlap[0]:.6f}", "last": f"{overlap[1]:.6f}", "way": f"{1000.0 * way:.3g}"}
    return [note("pitch_overlap", **values)]


def _decimals_of(half_unit: float) -> int:
    return round(-math.log10(2.0 * half_unit))


def rounded_right(name: str, value: float, off: float) -> int | None:
    """Decimals to which a value known within `off` is the right one, rounded to the nearest; None if it is not."""
    right = right_answer(name)
    return next((k for k in range(DECIMALS_MOST + 1) if abs(round(right, k) - value) <= off), None)


def explained(name: str, value: float, half_unit: float) -> list[Finding]:
    """The known error that gives a wrong number; none if several errors give it, or if its digits are too few.

    value: one of UNITS, in its unit; half_unit: half of its last digit, or the distance within which it is known
    """
    known = [*shortcuts(name), *(pitch_grids() if name == "pitch" else ())]
    fits = [one for one in known if gives(one, value, half_unit)]
    if not fits and half_unit < SEARCH_END:
        half_unit = SEARCH_END
        fits = [one for one in known if gives(one, value, half_unit)]
    if not fits or half_unit > DIGITS_SHARE * value or len({one.error for one in fits}) > 1:
        return []
    chance = chance_of(name, value, half_unit, known)
    if chance > POSSIBLE:
        return []
    one = _together(fits)
    words = "gives_on_grid" if "grid" in one.values else "gives"
    numbers = {"unit": UNITS[name], "right": f"{right_answer(name):.9g}", "value": f"{value:.9g}"}
    result = f"{one.values.get('source', one.value):.9g}"
    evidence = note(words, gives=result, **numbers, **one.values)
    return [Finding(one.error, note(f"error_{one.error}", **one.values), evidence, chance)]


def gives(one: Shortcut, value: float, half_unit: float) -> bool:
    """True if a shortcut gives a number to its digits."""
    return abs(one.value - value) <= (min(half_unit, EXACTLY) if one.exact else HALF * half_unit)


def chance_of(name: str, value: float, half_unit: float, known: Sequence[Shortcut]) -> float:
    """Share of the numbers with as many decimals, as far from the right one as this or nearer, that fit a shortcut."""
    right, unit = right_answer(name), 2.0 * half_unit
    far = abs(value - right) + half_unit
    near = {round(one.value / unit) for one in known if abs(one.value - right) <= far}
    return min(1.0, max(len(near), 1) * unit / (2.0 * far))


def _together(fits: list[Shortcut]) -> Shortcut:
    """One of the shortcuts of the same error, with all steps that give the number."""
    steps = sorted({str(one.values["step"]) for one in fits if "step" in one.values}, key=float)
    first = next((one for one in fits if "grid" not in one.values), fits[0])
    return replace(first, values={**first.values, **({"step": " / ".join(steps)} if steps else {})})
