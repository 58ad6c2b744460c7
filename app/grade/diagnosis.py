"""The known error that explains the wrong cells of a workbook.

Input: the judgements of its sheets. Output: findings, each with the numbers that support it; none if nothing fits.
State: none. Argument: an error is recomputed as a model, and counts only if it gives nearly all of the wrong cells.
First the positions are explained, by an error of geometry or by the right motion; then the speeds, by those of the same
motion or by an error in computing them.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from app.grade.expected import Motion, Workbook, contact_time, dance_of, of_dance
from app.grade.geometry import Model, geometries, time_at
from app.grade.judged import RIGHT, ROUNDED, JudgedSheet
from app.grade.labels import SPEED
from app.grade.layout import COMPONENTS, HANDLES, SHEETS, Ints, TableKind
from app.grade.rings import places, wrong_ring
from app.grade.shortcuts import Finding, explained
from app.grade.words import note
from core import Budget, Dance
from core.values import Floats

# Shares of the wrong cells, and of all cells, that a model must give [1].
WRONG_SHARE, ALL_SHARE = 0.9, 0.95
# Instants at which a model is tried first, and share of their cells that it must give to be tried at all instants [1].
LOOKS, LOOK_SHARE = 12, 0.75
# Error of a student's own arithmetic, in addition to the rounding of the written decimals [m, m/s].
ARITHMETIC = 2e-6
# Fewest decimals with which errors can be told apart.
DECIMALS_LEAST = 2
# Uncertainty of an instant that follows from the head's place [s].
INSTANT_OFF = 1e-5
# Steps of difference quotients to try [s].
STEPS = (1.0, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 0.001)


@dataclass(frozen=True)
class _Fit:
    """Fit of a model: shares of the wrong cells and of all cells that it gives, and mean distance from the others."""

    wrong: float
    all: float
    off: float
    count: int
    tolerance: float

    @property
    def explains(self) -> bool:
        return self.wrong >= WRONG_SHARE and self.all >= ALL_SHARE


def diagnosed(judgements: list[JudgedSheet], budget: Budget) -> list[Finding]:
    """Findings on the sheets of one workbook."""
    written = max((one.written for one in judgements), default=0)
    # A sheet of whole numbers, such as equal speeds, has the decimals of the other one.
    judgements = [one if one.written >= DECIMALS_LEAST else replace(one, written=written) for one in judgements]
    if written < DECIMALS_LEAST or not any(one.is_off for one in judgements):
        return []
    by_kind = {one.table.kind: one for one in judgements}
    if TableKind.CONTACT in by_kind:
        return _of_contact(by_kind[TableKind.CONTACT], budget)
    return _over_time(by_kind.get(TableKind.POSITION), by_kind.get(TableKind.SPEED), budget)


def _fit(one: JudgedSheet, given: Floats, at: Ints | slice = slice(None)) -> _Fit:
    """given: (T, HANDLES, 3), motion of a model at the times of the sheet, or at the ones in `at`"""
    components = list(COMPONENTS[one.table.kind])
    known = one.handles < given.shape[1]
    off = np.abs(one.values[at][:, known] - given[:, one.handles[known]][..., components])
    wrong = one.off[at][:, known] > RIGHT
    tolerance = ROUNDED * 10.0**-one.written + ARITHMETIC
    present, fits = np.isfinite(off), off <= tolerance
    count = int(wrong.sum())
    share = float(fits[wrong].mean()) if count else 1.0
    if not present.any():
        return _Fit(0.0, 0.0, np.inf, count, tolerance)
    return _Fit(share, float(fits[present].mean()), float(np.median(off[present])), count, tolerance)


def _best(one: JudgedSheet, times: Floats, models: Iterable[Model], budget: Budget) -> tuple[Model, _Fit] | None:
    """The model that explains a sheet best; None if none does."""
    found: list[tuple[Model, _Fit]] = []
    some = np.unique(np.linspace(0, times.size - 1, LOOKS).astype(np.int64))
    for model in models:
        budget.look()
        # Most models are already far off at a few instants.
        is_near = _fit(one, model.motion(times[some]), some).all >= LOOK_SHARE
        if is_near and (fit := _fit(one, model.motion(times))).explains:
            found.append((model, fit))
    return max(found, key=lambda pair: (round(pair[1].all, 3), -pair[1].off), default=None)


def _finding(model: Model, fit: _Fit, one: JudgedSheet) -> Finding:
    worst = one.worst()
    assert worst is not None
    values = {
        "sheet": one.table.title or note(SHEETS[one.table.kind]),
        "share": f"{100 * fit.wrong:.1f}",
        "count": fit.count,
        "tolerance": f"{fit.tolerance:.1e}",
        "worst": f"{one.off[worst]:.6g}",
        "unit": "m/s" if COMPONENTS[one.table.kind][worst[2]] == SPEED else "m",
    }
    return Finding(model.error, note(f"error_{model.error}", **model.values), note("evidence", **values))


def _over_time(position: JudgedSheet | None, speed: JudgedSheet | None, budget: Budget) -> list[Finding]:
    either = position or speed
    assert either is not None
    dance = dance_of(either.workbook)
    base: Motion | None = of_dance(dance)
    findings: list[Finding] = []
    if position and position.is_off:
        found = _best(position, position.times, geometries(dance, position.times, _head(position)), budget)
        base = found[0].motion if found else None
        if found:
            findings.append(_finding(*found, position))
        elif ring := wrong_ring(position):
            findings.append(ring)
    if speed is None or not speed.is_off or (base and _fit(speed, base(speed.times)).explains):
        return findings
    models = [*speed_errors(base)] if base else [_equal_speeds()]
    if position is None:
        models += geometries(dance, speed.times, None)
    if found := _best(speed, speed.times, models, budget):
        findings.append(_finding(*found, speed))
    return findings


def _head(one: JudgedSheet) -> Floats | None:
    """Points of the head in the student's sheet (T, 2), NaN where they are missing."""
    line = np.flatnonzero(one.handles == 0)
    return one.values[:, line[0], :2] if line.size else None


def _equal_speeds() -> Model:
    return Model("equal_speeds", lambda times: np.ones((times.size, HANDLES, 3)))


def speed_errors(motion: Motion) -> Iterator[Model]:
    """Known errors in the speeds of a motion."""
    yield _equal_speeds()
    for step in STEPS:
        for error, before, after in (
            ("forward_difference", 0.0, step),
            ("backward_difference", -step, 0.0),
            ("central_difference", -step, step),
        ):
            yield Model(error, partial(_quotient, motion, before, after), {"step": f"{step:g}"})


def _quotient(motion: Motion, before: float, after: float, times: Floats) -> Floats:
    """Numbers (T, H, 3) of a motion, with speeds from its places `before` and `after` each time [s]."""
    first, last = motion(times + before), motion(times + after)
    last[..., SPEED] = np.linalg.norm(last[..., :2] - first[..., :2], axis=-1) / (after - before)
    return last


def _of_contact(one: JudgedSheet, budget: Budget) -> list[Finding]:
    """Findings on result2, whose instant follows from the place of the head."""
    dance, head = dance_of(Workbook.RESULT2), _head(one)
    right = of_dance(dance)
    for instant in [contact_time(), *(_instants(dance, head) if head is not None else [])]:
        at, is_other = np.array([instant]), instant != contact_time()
        models = [Model("other_instant", right, {"time": f"{instant:.6f}"})] if is_other else []
        models += [*geometries(dance, at, None), *speed_errors(right)]
        if found := _best(one, at, models, budget):
            return [_finding(*found, one), *(_why_then(instant) if is_other else [])]
    return []


def _why_then(instant: float) -> list[Finding]:
    """Shortcuts that give an instant, either exactly or as a rounded number."""
    decimals = next((k for k in range(4) if abs(round(instant, k) - instant) < INSTANT_OFF), 4)
    exact = round(instant, decimals) if decimals < 4 else instant
    return explained("collision_time", exact, INSTANT_OFF) or explained("collision_time", exact, 0.5 * 10.0**-decimals)


def _instants(dance: Dance, head: Floats) -> Iterator[float]:
    """Times at which the head is at the student's place [s], also on the mirrored spiral."""
    for point in (head[0], head[0] * [1.0, -1.0]):
        s = float(places(dance.path, point))
        if np.isfinite(s):
            yield time_at(dance, s / dance.head_speed, point)
