"""How well a known error explains the numbers of a sheet, and whether their digits decide for it.

Input: the judgement of a sheet, and models. Output: the one model that explains it, or none. State: none. Argument: two
numbers are distinguished by the digits of a third one where they differ by more than twice its tolerance, because it
agrees with at most one of them. A model counts only where the digits decide between it and the right motion, and
between it and every other model that explains the sheet as well, the right numbers with a small bias among them; so
noise, rounding, cut digits and a slightly wrong constant support none.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from app.grade.geometry import Model
from app.grade.handles import Ints
from app.grade.judged import JudgedSheet
from app.grade.labels import SPEED
from app.grade.shortcuts import Finding
from app.grade.words import Note, note
from core import Budget
from core.values import Floats

# Shares of the wrong cells, and of all cells, that a model must give [1].
WRONG_SHARE, ALL_SHARE = 0.9, 0.95
# Fewest cells that must decide between two models: noise of several tolerances agrees with a model in one cell of five,
# so with nine of ten cells in one of 10^5 models.
DECISIVE_LEAST = 10
# Share of the numbers that agree with exact arithmetic to their last digit [1].
EXACT_SHARE = 0.99
# Least size of a number that shows by which part a student's numbers are too large [m, m/s]; and largest bias [m, m/s,
# 1].
LARGE, BIAS_MOST = 0.5, 1e-3
# Instants at which a model is tried first, and share of their cells that it must give to be tried at all instants [1].
LOOKS, LOOK_SHARE = 12, 0.75


@dataclass(frozen=True)
class Fit:
    """Fit of a model to a sheet.

    numbers: (T, H, C) of the model, NaN where the sheet has none; wrong, all: shares of the wrong cells and of all
    cells that it gives; off: mean distance from the others; count: of wrong cells; is_decided: True if digits decide
    for it against the right motion
    """

    model: Model
    numbers: Floats
    wrong: float
    all: float
    off: float
    count: int
    is_decided: bool

    @property
    def explains(self) -> bool:
        return self.wrong >= WRONG_SHARE and self.all >= ALL_SHARE and self.is_decided


def fit(one: JudgedSheet, model: Model, at: Ints | slice = slice(None)) -> Fit:
    """Fit of a model to a sheet, or to its instants in `at`."""
    motion = model.motion(one.times[at])
    numbers = np.full(one.values[at].shape, np.nan)
    numbers[:, one.known] = motion[:, one.handles[one.known]][..., list(one.components)]
    off = np.abs(one.values[at] - numbers)
    tolerance = one.tolerance[at]
    present, fits = np.isfinite(off), off <= tolerance
    wrong = present & (one.off[at] > tolerance)
    if not present.any():
        return Fit(model, numbers, 0.0, 0.0, np.inf, 0, False)
    share, count = float(fits[wrong].mean()) if wrong.any() else 0.0, int(wrong.sum())
    decided = _decided(one.values[at], numbers, one.wanted[at], tolerance)
    return Fit(model, numbers, share, float(fits[present].mean()), float(np.median(off[present])), count, decided)


def matches(one: JudgedSheet, model: Model) -> bool:
    """True if a sheet holds the numbers of a model, whether or not they differ from the right ones."""
    return fit(one, model).all >= ALL_SHARE


def _decided(values: Floats, modelled: Floats, other: Floats, tolerance: Floats) -> bool:
    """True if the digits of the values decide for the numbers of a model, against other ones."""
    apart = np.isfinite(values) & (np.abs(modelled - other) > 2.0 * tolerance)
    agrees = (np.abs(values - modelled) <= tolerance)[apart]
    return agrees.size >= DECISIVE_LEAST and float(agrees.mean()) >= WRONG_SHARE


def best_fit(one: JudgedSheet, models: Iterable[Model], budget: Budget, beside: Iterable[Model] = ()) -> Fit | None:
    """The model that explains a sheet; None if none does, or if another error explains it as well.

    Of models that the digits do not tell apart, the simplest wins, because each other one has a further error that does
    not show; difference quotients are named together.
    beside: models of two errors, which are tried if no model of one explains the sheet
    """
    fits = _explaining(one, models, budget) or _explaining(one, beside, budget)
    if not fits:
        return None
    best = max(fits, key=lambda one: (round(one.all, 3), -one.off))
    if any(_gives(one, numbers) and not _is_better(one, best.numbers, numbers) for numbers in _biased(one)):
        return None
    alike = [each for each in fits if not _is_better(one, best.numbers, each.numbers)]
    simplest = [each for each in alike if each.model.is_simplest]
    if len({each.model.errors for each in simplest}) == 1:
        return simplest[0]
    if len({each.model.errors for each in alike}) == 1:
        return replace(best, model=_together([each.model for each in alike]))
    spans = [each.model.values.get("span") for each in alike]
    if None in spans:
        return None
    every = "; ".join(dict.fromkeys(map(str, spans)))
    return replace(best, model=replace(best.model, error="difference_quotient", values={"span": every}))


def _explaining(one: JudgedSheet, models: Iterable[Model], budget: Budget) -> list[Fit]:
    """The fits of the models that explain a sheet."""
    fits: list[Fit] = []
    some = np.unique(np.linspace(0, one.times.size - 1, LOOKS).astype(np.int64))
    for model in models:
        budget.look()
        # Most models are already far off at a few instants.
        is_near = fit(one, model, some).all >= LOOK_SHARE
        if is_near and (whole := fit(one, model)).explains:
            fits.append(whole)
    return fits


def _biased(one: JudgedSheet) -> Iterator[Floats]:
    """The right numbers with the student's own bias: each component moved, or scaled, by the same amount everywhere.

    A small bias has many causes, and it can be as large as what a difference quotient adds to every speed.
    """
    off, large = one.values - one.wanted, np.abs(one.wanted) > LARGE
    part = off / np.where(large, one.wanted, 1.0)
    moved, scaled = one.wanted.copy(), one.wanted.copy()
    for c in range(off.shape[-1]):
        known = np.isfinite(off[..., c])
        moved[..., c] += _small(off[..., c][known])
        scaled[..., c] *= 1.0 + _small(part[..., c][known & large[..., c]])
    yield from (moved, scaled)


def _small(biases: Floats) -> float:
    """The middle one of some biases, or the largest that counts as one."""
    return float(np.clip(np.median(biases), -BIAS_MOST, BIAS_MOST)) if biases.size else 0.0


def _gives(one: JudgedSheet, numbers: Floats) -> bool:
    """True if nearly all numbers of a sheet agree with these (T, H, C)."""
    known = np.isfinite(one.values) & np.isfinite(numbers)
    return bool(known.any() and (np.abs(one.values - numbers) <= one.tolerance)[known].mean() >= ALL_SHARE)


def _is_better(one: JudgedSheet, best: Floats, other: Floats) -> bool:
    """True if digits decide between the numbers (T, H, C) of two models that both explain a sheet.

    Two models may be nearer than a student's arithmetic is exact. Then one is better if nearly all numbers agree with
    it to the last digit that is written, and not with the other.
    """
    if _decided(one.values, best, other, one.tolerance):
        return True
    apart = np.isfinite(one.values) & (np.abs(best - other) > 0.5 * one.rounding)
    if apart.sum() < DECISIVE_LEAST:
        return False
    exact, less = (float((np.abs(one.values - each) <= one.rounding)[apart].mean()) for each in (best, other))
    return exact >= EXACT_SHARE and less < WRONG_SHARE


def _together(models: list[Model]) -> Model:
    """One of the models of the same errors, with all values in their words that give the same digits."""
    first = models[0]
    texts = {name: dict.fromkeys(str(model.values[name]) for model in models) for name in first.values}
    values = {name: " / ".join(each) if len(each) > 1 else first.values[name] for name, each in texts.items()}
    others = [model.beside for model in models if model.beside]
    return replace(first, values=values, beside=_together(others) if others else None)


def findings_of(explaining: Fit, one: JudgedSheet) -> list[Finding]:
    """The errors of the model that explains a sheet, the first with the numbers that support it."""
    worst = one.worst()
    assert worst is not None
    values = {
        "sheet": one.title,
        "share": f"{100 * explaining.wrong:.1f}",
        "count": explaining.count,
        "tolerance": f"{one.usual_tolerance:.1e}",
        "worst": f"{one.off[worst]:.6g}",
        "unit": "m/s" if one.components[worst[2]] == SPEED else "m",
    }
    model, kinds = explaining.model, frozenset((one.table.kind,))
    first = Finding(model.error, _sentence(model), note("evidence", **values), kinds=kinds)
    if (second := model.beside) is None:
        return [first]
    return [first, Finding(second.error, _sentence(second), note("evidence_beside"), kinds=kinds)]


def _sentence(model: Model) -> Note:
    return note(f"error_{model.error}", **model.values)


def also(first: Finding, explaining: Fit, one: JudgedSheet) -> Finding:
    """The finding on a sheet, with the numbers of a second sheet that the same model explains."""
    second, *_ = findings_of(explaining, one)
    evidence = note("evidence_both", first=first.evidence, second=second.evidence)
    return replace(first, evidence=evidence, kinds=first.kinds | second.kinds)
