"""The known error that explains the wrong cells of a workbook.

Input: the judgements of its sheets. Output: findings, each with the numbers that support it; none if nothing fits.
State: none. Argument: an error is recomputed as a model, and counts only if it gives nearly all of the wrong cells, and
if digits decide for it (app/grade/fits.py). First come the handles outside the spiral, which are left out of the rest;
then the positions are explained, by an error of geometry or by the right motion; then the speeds, by those of the same
motion, of the right one, of any other error of geometry, or by an error in computing them.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from functools import partial
from itertools import chain

import numpy as np

from app.files.tables import handle_titles
from app.grade.decimals import digits_of, usual_of
from app.grade.expected import Motion, Workbook, cells_of, contact_time, of_dance
from app.grade.fits import DECISIVE_LEAST, also, best_fit, findings_of, fit, matches
from app.grade.geometry import (
    MIRRORS,
    Model,
    SheetClues,
    geometries,
    own_lengths,
    shift_span,
    shifted_rows,
    shifted_time,
)
from app.grade.handles import BENCHES, HANDLES
from app.grade.instants import Span, agreed_span, decimals_of, simplest
from app.grade.judged import JudgedSheet, Rating
from app.grade.labels import SPEED
from app.grade.layout import COMPONENTS, OVER_TIME, SHEETS, TableKind
from app.grade.numbers import explained, rounded_right
from app.grade.outside import Outside, outside_of, same_cells, without
from app.grade.pairs import pairs
from app.grade.rings import wrong_ring
from app.grade.seen_paths import other_paths, other_spiral, rotated, rotation_by
from app.grade.shortcuts import Finding
from app.grade.words import Note, Values, note, word
from core import Budget, Dance, Spiral
from core.values import Floats

# Fewest decimals with which errors can be distinguished.
DECIMALS_LEAST = 2
# Steps of difference quotients to try [s].
STEPS = (1.0, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 0.001)
# Ends of the difference quotients of speeds, in steps after the instant.
QUOTIENTS = {"forward_difference": (0.0, 1.0), "backward_difference": (-1.0, 0.0), "central_difference": (-1.0, 1.0)}
# Share of the links that must have the length of the others, and by how much it may differ, beside rounding [m].
STEADY_SHARE, STEADY = 0.9, 1e-5
# Uncertainty of an instant that the places of all handles show, in units of the last decimal of a place at 1 m/s: their
# rounding errors, 0.29 units each, average out over more than 300 numbers to 0.017 units.
INSTANT_OFF = 0.1
# Images of places that known errors give: themselves, y negated, x negated, x and y exchanged, both negated.
HALF_TURN = np.diag([-1.0, -1.0])
IMAGES = [np.eye(2), *(mirror[:2, :2] for mirror in MIRRORS.values()), HALF_TURN]
# Step of the derivative by which an instant is found [s], and most decimals of one.
INSTANT_STEP, INSTANT_DECIMALS = 1e-4, 6
# Steps in which an instant and an angle are found together; a place counts for them up to so many times the middle
# distance [1]; and the plane of complex numbers.
TURNED_STEPS, OUTLIER, PLANE = 6, 5.0, np.array([1.0, 1j])
# Largest shift of the times that speeds show, step of the search for it, and step of their derivative [s]: they hardly
# change on the spiral, and in the turn within 0.3 s.
SHIFT_MOST, SHIFT_STEP, SPEED_STEP = 100.0, 0.1, 0.01
# Speeds count for it that a further shift up to these explains, round after round [s]; and its uncertainty, in units of
# what their largest roundings give if all are independent.
SHIFT_FAR, SHIFT_OFF = (1e3, 1e3, 1e3, 1e-3), 2.5
# Largest uncertainty of a shift that is named [s].
SHIFT_KNOWN = 0.5


def diagnosed(judgements: list[JudgedSheet], budget: Budget) -> list[Finding]:
    """Findings on the sheets of one workbook."""
    if not shows_errors(judgements):
        return []
    by_kind = {one.table.kind: one for one in judgements}
    if TableKind.CONTACT in by_kind:
        return _of_contact(by_kind[TableKind.CONTACT], budget)
    position, speed = by_kind.get(TableKind.POSITION), by_kind.get(TableKind.SPEED)
    findings, position, speed = _outside(position, speed)
    return findings + _over_time(position, speed, budget)


def shows_errors(judgements: list[JudgedSheet]) -> bool:
    """True if there are numbers enough, with decimals enough, to tell one error from another."""
    return _numbers_of(judgements) >= DECISIVE_LEAST and any(one.written >= DECIMALS_LEAST for one in judgements)


def why_unexplained(judgements: list[JudgedSheet]) -> Note:
    """Why wrong numbers have no cause: they are too few, have too few decimals, or no known error gives them."""
    if (count := _numbers_of(judgements)) < DECISIVE_LEAST:
        return _few_numbers(judgements, count)
    if 0 < (slips := sum(one.wrong for one in judgements)) < DECISIVE_LEAST:
        return note("slip") if slips == 1 else note("slips", count=slips)
    wrong = [one for one in judgements if one.verdict is Rating.WRONG]
    return note("nothing_fits") if shows_errors(wrong) else note("too_few_decimals", least=DECIMALS_LEAST)


def _numbers_of(judgements: list[JudgedSheet]) -> int:
    return sum(int(np.isfinite(one.off).sum()) for one in judgements)


def _few_numbers(judgements: list[JudgedSheet], count: int) -> Note:
    """The handles that have numbers, and how many have none."""
    names = handle_titles(BENCHES)
    filled = {k for one in judgements for k in one.handles[np.isfinite(one.off).any(axis=(0, 2))].tolist()}
    labelled = {k for one in judgements for k in one.handles.tolist() if k < HANDLES}
    shown = [names[k] for k in sorted(filled)]
    return note(
        "few_numbers" if labelled > filled else "few_numbers_alone",
        count=count,
        cells=f"{sum(cells_of(one.workbook, one.table.kind) for one in judgements):,}",
        handles=word("and_error").join(shown),
        empty=HANDLES - len(filled),
        least=DECISIVE_LEAST,
    )


def _outside(
    position: JudgedSheet | None, speed: JudgedSheet | None
) -> tuple[list[Finding], JudgedSheet | None, JudgedSheet | None]:
    """The finding on handles that are not yet on the spiral, and the sheets without those."""
    outside: Outside | None = outside_of(position) if position else None
    of_speed = outside_of(speed) if speed else None
    findings = [one.finding for one in (outside, of_speed) if one][:1]
    if outside and position:
        if speed:
            speed = without(speed, same_cells(outside, position, speed))
        position = without(position, outside.cells)
    if of_speed and speed:
        speed = without(speed, of_speed.cells)
    return findings, position, speed


def _over_time(position: JudgedSheet | None, speed: JudgedSheet | None, budget: Budget) -> list[Finding]:
    model, findings, quotients, is_known = None, [], [], True
    if position and position.is_off:
        seen = _seen(position)
        two = pairs(position.dance, position.times, seen)
        single = (models(position.dance, position.times, seen) for models in (geometries, other_paths))
        if best := best_fit(position, chain.from_iterable(single), budget, two):
            model = best.model
            findings += findings_of(best, position)
        elif ring := wrong_ring(position):
            findings.append(ring)
        else:
            quotients, is_known = list(_quotients_of(position)), False
    return _with_speeds(findings, speed, budget, model, quotients, is_known=is_known) if speed else findings


def _with_speeds(
    findings: list[Finding],
    speed: JudgedSheet,
    budget: Budget,
    wrong: Model | None = None,
    others: Iterable[Model] = (),
    *,
    is_known: bool = True,
) -> list[Finding]:
    """Findings on the places, and those on the speeds beside them.

    wrong: the error in the places, which the first finding tells; others: further models of the speeds
    is_known: False for places that are wrong for no known reason: their motion gives speeds like those of another error

    Speeds of the same motion are no error of their own, but wrong all the same. Beside a wrong motion, others are named
    without a known error too.
    """
    if not speed.is_off:
        return findings
    model = wrong or Model("", of_dance(speed.dance))
    if matches(speed, model):
        same = fit(speed, model)
        return [also(findings[0], same, speed), *findings[1:]] if wrong and same.explains else findings
    models = chain(_speed_models(speed, model.motion, wrong) if is_known else speed_errors(model.motion), others)
    if best := best_fit(speed, models, budget, _negated_beside(model.motion)):
        return [*findings, *findings_of(best, speed)]
    return [*findings, _of_no_motion(speed, wrong)] if wrong else findings


def _speed_models(speed: JudgedSheet, motion: Motion, wrong: Model | None) -> Iterator[Model]:
    """Known errors of speeds: in computing those of a motion, or of the right one, and those of another geometry."""
    yield from speed_errors(motion)
    if wrong:
        yield from speed_errors(of_dance(speed.dance))
        if wrong.error != "shifted_rows":
            yield from shifted_rows(motion)
    yield from geometries(speed.dance, speed.times, SheetClues())
    yield from _other_times(speed)


def _negated_beside(motion: Motion) -> Iterator[Model]:
    """Speeds with the wrong sign that have another error too."""
    for one in (_equal_speeds(), *shifted_rows(motion)):
        yield replace(speeds_negated(one.motion), beside=one)


def _other_times(speed: JudgedSheet) -> Iterator[Model]:
    """The right speeds of other times, which follow from all speeds of the sheet by least squares."""
    right, known = of_dance(speed.dance), speed.known
    values, rounding = speed.values[:, known, 0], speed.rounding[:, known, 0]
    spread = np.nan_to_num(np.where(np.isfinite(values), np.abs(values - 1.0), np.nan)).sum(axis=1)
    row = int(spread.argmax())
    shifts = np.arange(-SHIFT_MOST, SHIFT_MOST, SHIFT_STEP)
    shifts = shifts[speed.times[row] + shifts <= speed.dance.end.time]

    def speeds_at(times: Floats) -> Floats:
        return right(times)[:, speed.handles[known], SPEED]

    present = np.isfinite(values[row])
    if not present.any() or not shifts.size:
        return
    off = np.abs(speeds_at(speed.times[row] + shifts)[:, present] - values[row, present])
    shift = float(shifts[np.median(off, axis=1).argmin()])
    for far in SHIFT_FAR:
        before, middle, after = (speeds_at(speed.times + shift + step) for step in (-SPEED_STEP, 0.0, SPEED_STEP))
        slope, miss = (after - before) / (2.0 * SPEED_STEP), values - middle
        counts = np.abs(miss) <= np.maximum(far * np.abs(slope), rounding)
        weight = float((slope**2)[counts].sum())
        if weight < SPEED_STEP**4:  # speeds that do not change tell no time
            return
        shift += float((slope * miss)[counts].sum()) / weight
        off_by = SHIFT_OFF * float(np.hypot.reduce((slope * rounding)[counts])) / weight
    if abs(shift) > 2.0 * SHIFT_MOST or off_by > SHIFT_KNOWN:
        return
    at_first = float(speed.times[0]) if speed.workbook is Workbook.RESULT2 else 0.0
    span = at_first + shift - off_by, at_first + shift + off_by
    time, decimals = simplest(span), decimals_of(span, INSTANT_DECIMALS)
    shift = time - at_first
    if speed.workbook is Workbook.RESULT2:
        values_of = {"time": f"{time:.{decimals}f}", "what": note(SHEETS[TableKind.SPEED])}
        yield Model("other_instant", shifted_time(right, shift).motion, values_of)
    else:
        yield shifted_time(right, shift, decimals)


def _of_no_motion(speed: JudgedSheet, wrong: Model) -> Finding:
    """The finding that speeds belong neither to the right motion nor to that of the places."""
    off = np.nan_to_num(np.abs(speed.values - fit(speed, wrong).numbers))
    values = {
        "sheet": speed.title,
        "count": f"{int((off > speed.tolerance).sum()):,}",
        "cells": f"{int(np.isfinite(speed.values).sum()):,}",
        "worst": f"{float(off.max()):.6g}",
    }
    return Finding("other_speeds", note("error_other_speeds"), note("evidence_other_speeds", **values))


def _seen(one: JudgedSheet) -> SheetClues:
    """What the places of a sheet show of free values."""
    order = np.argsort(one.handles)
    links = np.linalg.norm(np.diff(one.values[:, order, :2], axis=1), axis=-1)
    is_link = np.diff(one.handles[order]) == 1
    is_head, tolerance = one.handles[order][:-1] == 0, STEADY + 2.0 * 10.0**-one.written
    head, body = (_steady(links[:, is_link & which], tolerance) for which in (is_head, ~is_head))
    chords = None if head is None or body is None else (head, body)
    return SheetClues(*_lead(one), chords, _angle(one), 10.0**-one.written)


def _angle(one: JudgedSheet) -> float | None:
    """The middle one of the angles by which the places are turned from the right ones [rad]."""
    (x, y), (right_x, right_y) = (np.moveaxis(each[..., :2], -1, 0) for each in (one.values, one.wanted))
    turned = ((x + 1j * y) * (right_x - 1j * right_y)).ravel()
    turned = turned[np.isfinite(turned) & (turned != 0.0)]
    if not turned.size:
        return None
    mean = complex((turned / np.abs(turned)).sum())
    return float(np.angle(mean) + np.median(np.angle(turned * mean.conjugate())))


def _steady(lengths: Floats, tolerance: float) -> float | None:
    """The length that nearly all links have [m]; None if they differ."""
    known = lengths[np.isfinite(lengths)]
    if not known.size:
        return None
    middle = float(np.median(known))
    return middle if float((np.abs(known - middle) <= tolerance).mean()) >= STEADY_SHARE else None


def _quotients_of(one: JudgedSheet) -> Iterator[Model]:
    """Difference quotients of the places in the student's own sheet, whatever these are."""
    step = float(np.median(np.diff(one.times))) if one.times.size > 2 else 0.0
    if step <= 0.0:
        return
    yield from _quotients(step, partial(_own_quotient, one))


def _own_quotient(one: JudgedSheet, before: float, after: float, times: Floats) -> Floats:
    """Numbers (T, HANDLES, 3) with speeds from the places of the sheet, NaN elsewhere."""
    numbers = np.full((times.size, HANDLES, 3), np.nan)
    for n, time in enumerate(times):
        first, last = (np.flatnonzero(np.abs(one.times - time - end) < INSTANT_STEP) for end in (before, after))
        if first.size and last.size:
            way = one.values[last[0], :, :2] - one.values[first[0], :, :2]
            numbers[n, one.handles[one.known], SPEED] = np.linalg.norm(way[one.known], axis=-1) / (after - before)
    return numbers


def _lead(one: JudgedSheet) -> tuple[int, Floats | None]:
    """The first handle with places in the student's sheet, and these (T, 2), NaN where they are missing."""
    has_places = np.isfinite(one.values[..., :2]).all(axis=2).any(axis=0) & one.known
    if not has_places.any():
        return 0, None
    line = min(np.flatnonzero(has_places).tolist(), key=lambda k: int(one.handles[k]))
    return int(one.handles[line]), one.values[:, line, :2]


def _equal_speeds() -> Model:
    """All speeds 1, as they are where the handles are equal arcs apart too."""
    return Model("equal_speeds", lambda times: np.ones((times.size, HANDLES, 3)), is_simplest=True)


def speeds_negated(motion: Motion) -> Model:
    return Model("speeds_negated", lambda times: motion(times) * [1.0, 1.0, -1.0])


def speed_errors(motion: Motion) -> Iterator[Model]:
    """Known errors in the speeds of a motion."""
    yield _equal_speeds()
    yield speeds_negated(motion)
    for step in STEPS:
        yield from _quotients(step, partial(_quotient, motion))


def _quotients(step: float, quotient: Callable[[float, float, Floats], Floats]) -> Iterator[Model]:
    """Models of speeds that are difference quotients with a step [s]. quotient: the numbers, from its ends and times"""
    for error, ends in QUOTIENTS.items():
        before, after = (end * step for end in ends)
        words = {"step": f"{step:g}", "span": _span(before, after)}
        yield Model(error, partial(quotient, before, after), words)


def _span(before: float, after: float) -> str:
    """Times of a difference quotient, as in "t ... t + 0.1 s"."""
    first, last = ("t" + (f" {'-' if end < 0.0 else '+'} {abs(end):g}" if end else "") for end in (before, after))
    return f"{first} ... {last} s"


def _quotient(motion: Motion, before: float, after: float, times: Floats) -> Floats:
    """Numbers (T, H, 3) of a motion, with speeds from its places `before` and `after` each time [s]."""
    first, last = motion(times + before), motion(times + after)
    last[..., SPEED] = np.linalg.norm(last[..., :2] - first[..., :2], axis=-1) / (after - before)
    return last


def _of_contact(one: JudgedSheet, budget: Budget) -> list[Finding]:
    """Findings on result2, whose instant follows from the place of the head: on its places, then on its speeds."""
    position, speed = (_part(one, kind) for kind in OVER_TIME)
    for instant, decimals, models in _at_instants(position, _seen(position)) if position.is_off else ():
        is_other, at = instant != one.times[0], replace(position, times=np.array([instant]))
        if best := best_fit(at, models, budget):
            why = _why_then(instant, one.written) if is_other else []
            if is_other and best.model.error != "other_instant":
                evidence = note("evidence_rounded_instant", time=f"{contact_time():.6f}")
                sentence = note("error_other_instant", **_what(instant, decimals))
                why.insert(0, Finding("other_instant", sentence, evidence))
            moved = replace(best.model, motion=shifted_time(best.model.motion, instant - one.times[0]).motion)
            return _with_speeds([*findings_of(best, at), *why], speed, budget, moved)
    return _with_speeds([], speed, budget)


def _at_instants(position: JudgedSheet, seen: SheetClues) -> Iterator[tuple[float, int, Iterable[Model]]]:
    """Instants [s] of result2, each with its decimals and with known errors, the likeliest first: a single one at the
    right instant, or at the one that places show; two at the right one; then turned places at another instant, and
    other lengths."""
    dance, at_right = position.dance, float(position.times[0])
    yield at_right, INSTANT_DECIMALS, geometries(dance, position.times, replace(seen, lead=None))
    others: list[tuple[float, int]] = []
    for image in IMAGES if seen.lead is not None else ():
        if (span := _instants(replace(position, values=position.values @ image), seen, image)) is None:
            continue
        instant, decimals = simplest(span), decimals_of(span, INSTANT_DECIMALS)
        others.append((instant, decimals))
        turned = math.pi if image is HALF_TURN else seen.turned
        models = geometries(dance, np.array([instant]), SheetClues(turned=turned, unit=seen.unit))
        yield instant, decimals, chain([_only_then(dance, instant, decimals)], models)
    yield at_right, INSTANT_DECIMALS, pairs(dance, position.times, replace(seen, lead=None))
    head = seen.lead[0] if seen.lead is not None and seen.leader == 0 else None
    if head is not None and (turned_then := _turned_instant(position, head)) is not None:
        instant, angle = turned_then
        decimals = min(position.written, INSTANT_DECIMALS)
        models = geometries(dance, np.array([instant]), SheetClues(turned=angle, unit=seen.unit))
        if abs(angle) * float(np.nanmax(np.abs(position.values))) < 10.0**-position.written:  # as good as not turned
            models = iter([_only_then(dance, instant, decimals)])
        yield instant, decimals, models
    for instant, decimals in others:
        yield instant, decimals, own_lengths(dance, seen)
    yield at_right, INSTANT_DECIMALS, _on_other_spiral(position, seen)


def _on_other_spiral(position: JudgedSheet, seen: SheetClues) -> Iterator[Model]:
    """The motion on a spiral of another pitch, at the instant at which the head is at its place there."""
    if seen.lead is None or (shown := other_spiral(position)) is None:
        return
    dance, pitch, angle = shown
    back = rotation_by(-angle)[:2, :2]
    on_spiral = replace(position, dance=dance, values=position.values @ back)
    if (span := _instants(on_spiral, seen, back)) is not None:
        shift = simplest(span) - float(position.times[0])
        values = {"pitch": f"{pitch:.6g}", "right": f"{Spiral().pitch:g}"}
        yield Model("other_pitch_then", shifted_time(rotated(of_dance(dance), angle), shift).motion, values)


def _only_then(dance: Dance, instant: float, decimals: int) -> Model:
    """The right places at another instant [s]."""
    return Model("other_instant", of_dance(dance), _what(instant, decimals), is_simplest=True)


def _what(instant: float, decimals: int) -> Values:
    """The words for places at an instant [s], with as many decimals as they tell."""
    return {"time": f"{instant:.{decimals}f}", "what": note(SHEETS[TableKind.POSITION])}


def _part(one: JudgedSheet, kind: TableKind) -> JudgedSheet:
    """The places, or the speeds, of a sheet that holds both, with the decimals of these."""
    components = list(COMPONENTS[kind])
    values, table = one.values[..., components], replace(one.table, kind=kind)
    digits = digits_of(values, one.written)
    written = usual_of(digits, values)
    parts = {name: getattr(one, name)[..., components] for name in ("wanted", "rounded")}
    return replace(one, table=table, values=values, written=written, digits=digits, **parts)


def _instants(one: JudgedSheet, seen: SheetClues, image: Floats) -> Span | None:
    """The span of instants [s] at which most handles are at their places in a sheet; None if the first one never is.

    image: of the student's plane, of which the sheet holds the places
    """
    assert seen.lead is not None
    first = shift_span(one.dance, np.zeros(1), replace(seen, lead=seen.lead @ image))
    if first is None:
        return None
    known, right = one.known, of_dance(one.dance)

    def places_at(time: float) -> Floats:
        return right(np.array([time]))[0, one.handles[known], :2]

    middle, far = 0.5 * (first[0] + first[1]), 0.5 * (first[1] - first[0])
    return agreed_span(one.values[0, known], one.rounding[0, known], places_at, middle, far)


def _turned_instant(one: JudgedSheet, head: Floats) -> tuple[float, float] | None:
    """The instant [s] and the angle [rad] of places that are turned about the centre, by least squares.

    head: place of the head [m], whose distance from the centre tells the instant nearly; None if it tells none
    """
    dance, known = one.dance, one.known
    right, path = of_dance(dance), dance.path.spiral
    if path is None or not np.isfinite(head).all():
        return None
    time, angle = path.travel_to(float(np.hypot(*head))) / dance.head_speed, 0.0
    values = one.values[0, known, :2] @ PLANE
    for k in range(TURNED_STEPS):
        if not 0.0 < time < dance.end.time:
            return None
        ends = right(time + INSTANT_STEP * np.array([-1.0, 0.0, 1.0]))[:, one.handles[known], :2] @ PLANE
        if not k:
            angle = float(np.angle(np.nansum(values * ends[1].conj())))
        turned = ends * np.exp(1j * angle)
        off = values - turned[1]
        present = np.isfinite(off)
        present[present] = np.abs(off[present]) <= OUTLIER * np.median(np.abs(off[present]))
        slopes = np.stack([(turned[2] - turned[0]) / (2.0 * INSTANT_STEP), 1j * turned[1]], axis=-1)[present]
        sides, wanted = (np.concatenate([each.real, each.imag]) for each in (slopes, off[present]))
        step = np.linalg.lstsq(sides, wanted, rcond=None)[0]
        time, angle = time + float(step[0]), angle + float(step[1])
    return time, angle


def _why_then(instant: float, written: int) -> list[Finding]:
    """The rounding, or else the shortcuts, that give an instant, either exactly or as a rounded number."""
    off = INSTANT_OFF * 10.0**-written
    if (decimals := rounded_right("collision_time", instant, off)) is not None:
        sentence = note("error_rounded_instant", decimals=decimals)
        return [Finding("rounded_instant", sentence, note("evidence_rounded_instant", time=f"{contact_time():.6f}"))]
    exact = explained("collision_time", instant, off)
    decimals = next((k for k in range(4) if abs(round(instant, k) - instant) < off), None)
    if exact or decimals is None:
        return exact
    return explained("collision_time", round(instant, decimals), 0.5 * 10.0**-decimals)
