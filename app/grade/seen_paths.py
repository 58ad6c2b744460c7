"""The path that the head's places show: a spiral of another pitch, another speed, or a turn of the team's own.

Input: the right dance, and the head's places in a sheet. Output: models, or a dance. State: none. Argument: on a spiral
the radius is linear in the unwrapped angle, and the arc length in the time, so two fits of a line give its pitch, its
start and the speed. A turn of two arcs has three free numbers, and its own places after the entry show the ratio and
the exit: the nearest of a few turns is improved by least squares. A number is taken as one of few decimals wherever the
places allow that.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass

import numpy as np

from app.grade.chains import spiral_arc
from app.grade.expected import PITCH, Motion, Workbook, of_dance
from app.grade.geometry import Model, SheetClues
from app.grade.judged import ARITHMETIC, ROUNDED, JudgedSheet, judged
from app.grade.layout import TableKind
from app.grade.words import Note, note
from core import BenchDragonError, Budget, Dance, Spiral, Turn, first_contact
from core.values import Floats

# Longest time between two places over which the angle unwraps by itself [s], and fewest places of a coil.
STEP_MOST, PLACES_LEAST = 5.0, 4
# Pitches that are tried where places are further apart, as parts of the right one, the nearest first [1].
PITCHES = np.array(sorted(np.arange(0.6, 1.4, 0.005), key=lambda part: abs(part - 1.0)))
# Least difference of a place [m], a speed [m/s] or an angle [rad] that is measured.
MEASURED = 1e-5
# Least difference from the right pitch [m], speed [m/s] and number of turns that is another one.
PITCH_LEAST, SPEED_LEAST, TURNS_LEAST = 5e-5, 1e-5, 1e-3
# Decimals of a number that a team chooses, and of a pitch; and distance from a coil in tolerances of a place [1].
DECIMALS, PITCH_DECIMALS, WITHIN = range(1, 9), (2, 3, 4, 5, 6, 9), 2.0
# Share of the head's places that must agree, for some may be slips [1].
SHARE = 0.95
# Turns from which the search for the team's own begins: ratios, and exits beside that at the entry [m].
RATIOS, EXITS, RADIUS_MOST = (0.5, 2.0 / 3.0, 1.0, 1.5, 2.0, 3.0), (3.5, 4.0, 4.5), 4.5
# Rounds of least squares, and step of its derivatives [m, 1].
ROUNDS, STEP = 12, 1e-6
# Distance up to which a place counts: one that is further off is a slip [m].
FAR = 1e-3
# By how much a sum of squares may be larger, in squares of a rounding error: of three one in a hundred is larger [1].
WORSE = 12.0
# Ratios on the circle itself that are the contest's, or errors with a name: no turn is shorter for them. Difference
# from such a turn that makes another one [m, 1].
NAMED_RATIOS, SAME_TURN = (2.0, 1.0, 0.5), 1e-4


@dataclass(frozen=True)
class _Coil:
    """A spiral inwards. pitch [m]; turns: at time 0; speed [m/s]; rotation [rad]"""

    pitch: float
    turns: float
    speed: float
    rotation: float


def other_paths(dance: Dance, times: Floats, seen: SheetClues) -> Iterator[Model]:
    """The motion on the spiral of another pitch, or at another speed, that the head's places show. times: (T,) [s]"""
    if seen.leader != 0 or seen.lead is None:
        return
    spiral = dance.path.spiral
    known = seen.instants if spiral is not None else seen.instants[times[seen.instants] <= 0.0]
    right = PITCH if spiral is None else spiral.pitch
    coil = _coil_of(times[known], seen.lead[known], right, ROUNDED * seen.unit + ARITHMETIC)
    if coil is None:
        return
    has_pitch, has_speed = abs(coil.pitch - right) > PITCH_LEAST, abs(coil.speed - dance.head_speed) > SPEED_LEAST
    if not has_pitch and not has_speed:
        return
    with suppress(BenchDragonError):
        radius = coil.pitch * coil.turns
        path = Turn(coil.pitch, radius) if spiral is None else Spiral(coil.pitch, coil.turns)
        motion = rotated(of_dance(Dance(dance.dragon, path, coil.speed)), coil.rotation)
        values = {"pitch": f"{coil.pitch:.6g}", "radius": f"{radius:.6g}", "right": f"{right:g}"}
        speed = Model("other_speed", motion, {"speed": f"{coil.speed:.6g}"})
        if not has_pitch:
            yield speed
        else:
            yield Model("other_pitch", motion, values, beside=speed if has_speed else None)


def other_spiral(one: JudgedSheet) -> tuple[Dance, float, float] | None:
    """The dance on a spiral of another pitch on which all handles stand at one instant, its pitch [m] and
    rotation [rad].

    At one instant nothing shows where the dance began: it begins on the right turn.
    """
    order = np.argsort(one.handles)
    places = one.values[0, order][one.known[order], :2]
    spiral = one.dance.path.spiral
    if spiral is None or len(places) < PLACES_LEAST or not np.isfinite(places).all():
        return None
    radii, angles = np.hypot(*places.T), np.unwrap(np.arctan2(places[:, 1], places[:, 0]))
    fitted = 2.0 * math.pi * float(np.polyfit(angles, radii, 1)[0])
    for decimals in PITCH_DECIMALS:
        pitch = round(fitted, decimals)
        if pitch <= 0.0 or abs(pitch - spiral.pitch) <= PITCH_LEAST:
            continue
        growth = pitch / (2.0 * math.pi)
        rotation = float(np.median(angles - radii / growth))
        if np.quantile(np.abs(radii - growth * (angles - rotation)), SHARE) > WITHIN * one.usual_tolerance:
            continue
        begun = spiral.pitch * spiral.start_turns / growth
        near = max(MEASURED, one.usual_tolerance) / growth
        rotation = next((one for one in (0.0, -begun) if abs(_wrapped(rotation - one)) < near), rotation)
        with suppress(BenchDragonError):
            path = Spiral(pitch, spiral.start_turns)
            return Dance(one.dance.dragon, path, one.dance.head_speed), pitch, rotation
    return None


def rotated(motion: Motion, angle: float) -> Motion:
    turn = rotation_by(angle)
    return lambda times: motion(times) @ turn


def rotation_by(angle: float) -> Floats:
    """What turns the rows x, y, speed about the centre by an angle [rad]."""
    cosine, sine = math.cos(angle), math.sin(angle)
    return np.array([[cosine, sine, 0.0], [-sine, cosine, 0.0], [0.0, 0.0, 1.0]])


def _coil_of(times: Floats, places: Floats, right: float, tolerance: float) -> _Coil | None:
    """The spiral inwards on which a handle moves steadily; None if it does not.

    times (T,) [s]; places (T, 2) [m]; right: pitch [m] that helps where the places are far apart; tolerance [m]
    """
    if times.size < PLACES_LEAST:
        return None
    order = np.argsort(times)
    times, places = times[order], places[order]
    radii = np.hypot(*places.T)
    for angles in _unwrapped(times, places, radii, right):
        growth = float(np.polyfit(angles, radii, 1)[0])
        if growth <= 0.0:
            continue
        for decimals in PITCH_DECIMALS:
            with suppress(BenchDragonError):
                coil, off = _along(times, radii, angles, round(2.0 * math.pi * growth, decimals), tolerance)
                if off <= WITHIN * tolerance:
                    return coil
    return None


def _along(times: Floats, radii: Floats, angles: Floats, pitch: float, tolerance: float) -> tuple[_Coil, float]:
    """The coil of a pitch [m] that fits places best, and how far most are from it [m].

    tolerance: of a place [m]: its start, its speed and its rotation are the simplest ones that it allows
    """
    near, growth = max(MEASURED, tolerance), pitch / (2.0 * math.pi)
    rotation = float(np.median(angles - radii / growth))
    arcs = spiral_arc(radii, growth)
    slope, begin = np.polyfit(times, arcs, 1).tolist()
    # A digit of a place moves it along the arc by as much more as the coil is steep.
    speed = _simple(-slope, near * float(radii.max() / growth / np.ptp(times)))
    begin = float(np.median(arcs + speed * times))
    path = Spiral(pitch)
    turns = float(path.theta(path.length - begin)) / (2.0 * math.pi)
    turns = next(
        (one for one in (_simple(turns, near / pitch), _simple(turns * pitch, near) / pitch) if one != turns), turns
    )
    along = np.abs(arcs + speed * times - spiral_arc(turns * pitch, growth)) * growth / radii
    across = np.abs(radii - growth * (angles - rotation))
    simple = (one for one in (0.0, -2.0 * math.pi * turns) if abs(_wrapped(rotation - one)) < near / growth)
    coil = _Coil(pitch, turns, speed, next(simple, rotation))
    return coil, float(np.quantile(np.maximum(along, across), SHARE))


def _simple(number: float, near: float) -> float:
    """The number with three decimals at most that is so near; else the number itself."""
    return next((one for k in DECIMALS[:3] if abs((one := round(number, k)) - number) < near), number)


def _wrapped(angle: float) -> float:
    return (angle + math.pi) % (2.0 * math.pi) - math.pi


def _unwrapped(times: Floats, places: Floats, radii: Floats, right: float) -> Iterator[Floats]:
    """Angles (T,) of places on a spiral inwards [rad], which go on where a turn begins."""
    angles = np.arctan2(places[:, 1], places[:, 0])
    if np.diff(times).max() <= STEP_MOST:
        yield np.unwrap(angles)
        return
    for growth in right / (2.0 * math.pi) * PITCHES:
        turned = angles[0] + (radii - radii[0]) / growth - angles
        yield np.asarray(angles + 2.0 * math.pi * np.round(turned / (2.0 * math.pi)))


def judged_by_turn(
    judgements: list[JudgedSheet], decimals: int, budget: Budget
) -> tuple[list[JudgedSheet], Note | None]:
    """The judgements by the turn that the team dances, with a note on it; as they are where that is the contest's, or
    an impossible one, or no turn fits. decimals: of the numbers of the file; raises: Halted if the budget is stopped"""
    position = next((one for one in judgements if one.table.kind is TableKind.POSITION), None)
    if position is None or position.workbook is not Workbook.RESULT4 or not position.is_off:
        return judgements, None
    path = own_turn(position, budget)
    if path is None:
        return judgements, None
    with suppress(BenchDragonError):
        dance = Dance(position.dance.dragon, path, position.dance.head_speed)
        others = [judged(one.table, one.workbook, decimals, dance) for one in judgements]
        near = next(one for one in others if one.table.kind is TableKind.POSITION)
        if near.wrong > (1.0 - SHARE) * np.isfinite(near.off).sum():
            return judgements, None
        values = {"entry": f"{path.entry_radius:.7g}", "exit": f"{path.exit_radius:.7g}", "ratio": f"{path.ratio:.6g}"}
        touching = first_contact(dance, budget=budget)
        if touching.time is not None and touching.benches is not None:
            a, b = touching.benches
            return judgements, note("own_turn_touches", **values, a=a, b=b, time=f"{touching.time:.3f}")
        return others, note("own_turn", **values, length=f"{path.length:.4f}")
    return judgements, None


def own_turn(one: JudgedSheet, budget: Budget) -> Turn | None:
    """The turn on the contest's coils, but for its entry, ratio and exit, that the head's places show; None if another
    path does, or the contest's turn."""
    head = np.flatnonzero(one.handles == 0)
    places = one.values[:, head[0], :2] if head.size else np.full((one.times.size, 2), np.nan)
    known = np.isfinite(places).all(axis=1)
    times, places = one.times[known], places[known]
    before = times <= 0.0
    if min(before.sum(), (~before).sum()) < PLACES_LEAST:
        return None
    tolerance = one.usual_tolerance

    def head_off(numbers: Floats) -> Floats:
        """Distances (T, 2) of the head's places from those of a turn by its entry, ratio and exit [m]."""
        return np.asarray(_turn(numbers).position(times)) - places

    def all_off(numbers: Floats) -> Floats:
        """Distances (T, H, 2) of all places, those of slips cut short [m]."""
        budget.look()
        motion = of_dance(Dance(one.dance.dragon, _turn(numbers), one.dance.head_speed))
        far = motion(one.times)[:, one.handles[one.known], :2] - one.values[:, one.known, :2]
        return np.clip(np.nan_to_num(far), -FAR, FAR)

    coil = _coil_of(times[before], places[before], PITCH, tolerance)
    if coil is None or abs(coil.pitch - PITCH) > PITCH_LEAST or abs(coil.speed - one.dance.head_speed) > SPEED_LEAST:
        return None
    if (
        coil.pitch * coil.turns > RADIUS_MOST + MEASURED
        or (best := _nearest(head_off, coil.pitch * coil.turns)) is None
    ):
        return None
    numbers = _improved(head_off, best)
    if _far(head_off, numbers) > WITHIN * tolerance:
        return None
    numbers = _simplest(all_off, _improved(all_off, numbers), 10.0**-one.written)
    is_named = any(np.abs(numbers - [RADIUS_MOST, ratio, RADIUS_MOST]).max() < SAME_TURN for ratio in NAMED_RATIOS)
    return None if is_named else _turn(numbers)


def _turn(numbers: Floats) -> Turn:
    """The turn of an entry [m], a ratio and an exit [m]."""
    entry, ratio, leaving = numbers.tolist()
    return Turn(PITCH, RADIUS_MOST, ratio, entry_radius=entry, exit_radius=leaving)


def _far(off: Callable[[Floats], Floats], numbers: Floats) -> float:
    """How far most places are from those of a turn [m]; infinite if there is none."""
    try:
        return float(np.quantile(np.abs(off(numbers)), SHARE))
    except BenchDragonError:
        return math.inf


def _nearest(off: Callable[[Floats], Floats], entry: float) -> Floats | None:
    """The nearest one of a few turns from an entry [m]."""
    entry = min(entry, RADIUS_MOST)
    some = [np.array([entry, ratio, leaving]) for ratio in RATIOS for leaving in (entry, *EXITS)]
    best = min(some, key=lambda numbers: _squares(off, numbers))
    return best if math.isfinite(_squares(off, best)) else None


def _squares(off: Callable[[Floats], Floats], numbers: Floats) -> float:
    """Sum of the squared distances of places from those of a turn [m^2]; infinite if there is none."""
    try:
        return float((off(numbers) ** 2).sum())
    except BenchDragonError:
        return math.inf


def _improved(off: Callable[[Floats], Floats], numbers: Floats) -> Floats:
    """The turn near another one that fits best, by least squares, each step halved until it is better."""
    for _ in range(ROUNDS):
        try:
            now = off(numbers)
            # Inwards, for an entry on the circle goes no further out.
            sides = [(now - off(numbers - step)).ravel() / STEP for step in STEP * np.eye(numbers.size)]
        except BenchDragonError:
            break
        change = np.linalg.lstsq(np.stack(sides, axis=1), -now.ravel(), rcond=None)[0]
        for _ in range(ROUNDS):
            moved = np.minimum(numbers + change, [RADIUS_MOST, math.inf, RADIUS_MOST])
            if _squares(off, moved) < _squares(off, numbers):
                numbers = moved
                break
            change = 0.5 * change
        else:
            break
    return numbers


def _simplest(off: Callable[[Floats], Floats], numbers: Floats, unit: float) -> Floats:
    """The numbers with as few decimals as the places allow, which are rounded to a unit [m].

    The numbers from which the places were rounded fit worse than the best ones, by a sum of three squares of a rounding
    error, nearly.
    """
    most, every = _squares(off, numbers) + WORSE * unit**2 / 12.0, np.arange(numbers.size)
    for some in (every >= 0, *(every == k for k in every)):
        rounded = (np.where(some, np.round(numbers, decimals), numbers) for decimals in DECIMALS)
        numbers = next((one for one in rounded if _squares(off, one) <= most), numbers)
    return numbers
