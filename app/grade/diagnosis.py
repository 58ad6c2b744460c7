"""The known error that explains the wrong cells of a workbook.

Input: the judgements of its sheets. Output: findings, each with the numbers that support it; none if nothing fits.
State: none. Argument: an error is recomputed as a model, and counts only if it gives nearly all of the wrong cells.
First the positions are explained, by an error of geometry or by the right motion; then the speeds, by those of the same
motion or by an error in computing them.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from app.grade.chains import Motion
from app.grade.expected import Workbook, contact_time, dance_of
from app.grade.geometry import Model, geometries, of_dance, time_at
from app.grade.labels import SPEED
from app.grade.layout import COMPONENTS, HANDLES, SHEETS, Ints, Kind
from app.grade.rings import places, wrong_ring
from app.grade.shortcuts import Finding, explained
from app.grade.verdict import RIGHT, ROUNDED, Judgement
from app.grade.words import note
from core import Budget
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


def diagnosed(judgements: list[Judgement], budget: Budget) -> list[Finding]:
    """Findings on the sheets of one workbook."""
    written = max((one.written for one in judgements), default=0)
    # A sheet of whole numbers, such as equal speeds, has the decimals of the other one.
    judgements = [one if one.written >= DECIMALS_LEAST else replace(one, written=written) for one in judgements]
    if written < DECIMALS_LEAST or not any(one.is_off for one in judgements):
        return []
    by_kind = {one.table.kind: one for one in judgements}
    if Kind.CONTACT in by_kind:
        return _of_contact(by_kind[Kind.CONTACT], budget)
    return _over_time(by_kind.get(Kind.POSITION), by_kind.get(Kind.SPEED), budget)


def _fit(one: Judgement, given: Floats, at: Ints | slice = slice(None)) -> _Fit:
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


def _best(one: Judgement, times: Floats, models: Iterable[Model], budget: Budget) -> tuple[Model, _Fit] | None:
    """The model that explains a sheet best; None if none does."""
    found: list[tuple[Model, _Fit]] = []
    some = np.unique(np.linspace(0, times.size - 1, LOOKS).astype(np.int64))
    for model in models:
        budget.look()
        # Most models are already far off at a few instants.
        if _fit(one, model.motion(times[some]), some).all < LOOK_SHARE:
            continue
        fit = _fit(one, model.motion(times))
        if fit.explains:
            found.append((model, fit))
    return max(found, key=lambda pair: (round(pair[1].all, 3), -pair[1].off), default=None)


def _finding(model: Model, fit: _Fit, one: Judgement) -> Finding:
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


def _over_time(position: Judgement | None, speed: Judgement | None, budget: Budget) -> list[Finding]:
    either = position or speed
    assert either is not None
    right = Model("", of_dance(dance_of(either.workbook)))
    findings: list[Finding] = []
    base: Model | None = right
    if position and position.is_off:
        times = position.times
        found = _best(position, times, geometries(dance_of(position.workbook), times, _head(position)), budget)
        base = found[0] if found else None
        if found:
            findings.append(_finding(*found, position))
        elif ring := wrong_ring(position):
            findings.append(ring)
    if speed is None or not speed.is_off:
        return findings
    if base is not None and _fit(speed, base.motion(speed.times)).explains:
        return findings
    models = [] if base is None else [*speed_errors(base.motion)]
    if position is None:
        models += geometries(dance_of(speed.workbook), speed.times, None)
    elif base is None:
        models += [_equal_speeds()]
    if found := _best(speed, speed.times, models, budget):
        findings.append(_finding(*found, speed))
    return findings


def _head(one: Judgement) -> Floats | None:
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

            def moved(times: Floats, before: float = before, after: float = after) -> Floats:
                first, last = motion(times + before), motion(times + after)
                last[..., SPEED] = np.linalg.norm(last[..., :2] - first[..., :2], axis=-1) / (after - before)
                return last

            yield Model(error, moved, {"step": f"{step:g}"})


def _of_contact(one: Judgement, budget: Budget) -> list[Finding]:
    """Findings on result2, whose instant follows from the place of the head."""
    right = of_dance(dance_of(Workbook.RESULT2))
    time = np.array([contact_time()])
    head = _head(one)
    times = [contact_time(), *(_instants(head) if head is not None else [])]
    findings: list[Finding] = []
    for instant in times:
        at = np.array([instant])
        base = Model("other_instant", right, {"time": f"{instant:.6f}"})
        models = [base] if instant != time[0] else []
        models += [*geometries(dance_of(Workbook.RESULT2), at, None), *speed_errors(right)]
        if found := _best(one, at, models, budget):
            findings.append(_finding(*found, one))
            if instant != time[0]:
                findings += _why_then(instant)
            break
    return findings


def _why_then(instant: float) -> list[Finding]:
    """Shortcuts that give an instant, either exactly or as a rounded number."""
    decimals = next((k for k in range(4) if abs(round(instant, k) - instant) < INSTANT_OFF), 4)
    exact = round(instant, decimals) if decimals < 4 else instant
    return explained("collision_time", exact, INSTANT_OFF) or explained("collision_time", exact, 0.5 * 10.0**-decimals)


def _instants(head: Floats) -> Iterator[float]:
    """Times at which the head is at the student's place [s], also on the mirrored spiral."""
    dance = dance_of(Workbook.RESULT2)
    for point in (head[0], head[0] * [1.0, -1.0]):
        s = float(places(dance.path, point))
        if np.isfinite(s):
            yield time_at(dance, s / dance.head_speed, point)
