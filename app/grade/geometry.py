"""Known errors in the places of the handles, each with the motion that it gives.

Input: the right dance and the student's numbers, which give free values such as the start. Output: models, each with
the name of its error, its motion and the numbers in its words. State: none.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass, field
from functools import partial

import numpy as np

from app.grade.chains import Arc, Bent, equal_arcs, on_bent, rounded_angles, spiral_arc, times_at
from app.grade.expected import PITCH, Motion, Workbook, dance_of, of_dance, right_turn
from app.grade.handles import Ints
from app.grade.instants import Span, agreed_span, simplest
from app.grade.judged import ARITHMETIC, DECIMALS_OF_CONTEST, ROUNDED
from app.grade.words import Values
from core import BenchDragonError, Dance, Dragon, Route, Spiral, Turn
from core.values import Floats

# Decimals to try for a constant or an angle that was rounded early.
CONSTANT_DECIMALS, ANGLE_DECIMALS = (2, 3, 4, 5), (1, 2, 3, 4, 5)
PI_ROUNDED = (3.14, 3.1416)
# Steps of the search for the time at which the head, or a handle behind it, passes a place [s], and largest distance
# from that place beside half a step [m].
PLACE_STEP, PLACE_STEP_BEHIND, PLACE_NEAR = 0.01, 0.25, 0.05
# Most places of a handle of which the shift is taken.
PLACES_MOST = 50
# Least and largest shift of the times that is looked for [s]: six decimals of a place show 1e-6 s.
SHIFT_LEAST, SHIFT_MOST = 1e-5, 500.0
# A start counts as one of three decimals up to this distance from it [turns].
SIMPLE_TURNS = 1e-5
# An angle counts as one of so many decimals up to this distance from it [degrees].
TURNED_DECIMALS, TURNED_OFF = 4, 1e-6
# An entry counts as one at a radius of three decimals up to this distance from it [m], or to this part of the last
# decimal of a place: on a coil the radius changes by a sixteenth of the way, and all places show the way to a tenth.
SIMPLE_RADIUS, RADIUS_OFF = 1e-6, 0.01
# Most benches by which rows are shifted.
ROWS_MOST = 10
# Decimals of a length that a student types, error of a length that is measured between places of six decimals [m], and
# difference below which two lengths are the same [m].
LENGTH_DECIMALS, MEASURED, SAME_LENGTH = (2, 3, 4, 5), 2e-6, 1e-4


# A matrix by which x, y and speed are multiplied from the right.
Mirror = Floats
# The matrices of places with a wrong sign of y or x, or with x and y exchanged, by the names of these errors.
MIRRORS: dict[str, Mirror] = {
    "anticlockwise": np.diag([1.0, -1.0, 1.0]),
    "x_negated": np.diag([-1.0, 1.0, 1.0]),
    "axes_exchanged": np.array([[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]),
}


@dataclass(frozen=True)
class Model:
    """A known error, recomputed. error: its name; motion: its result; values: numbers in its words

    is_simplest: True if the models beside it have this error and a further one
    beside: a second error that the motion has too; shift: of the times [s], if that is the error
    """

    error: str
    motion: Motion
    values: Values = field(default_factory=dict)
    is_simplest: bool = False
    beside: Model | None = None
    shift: float | None = None

    @property
    def errors(self) -> tuple[str, ...]:
        """The names of its errors."""
        return (self.error, *(self.beside.errors if self.beside else ()))


@dataclass(frozen=True)
class SheetClues:
    """What the student's sheet shows of free values.

    leader: first handle that has places; lead: these (T, 2) [m], NaN where they are missing; None if there are none
    chords: distances [m] between the first two handles, and between any two others, if they are steady; else None
    turned: angle [rad] by which most places are turned about the centre, counter-clockwise; None without places
    unit: of the last decimal of a place [m]
    """

    leader: int = 0
    lead: Floats | None = None
    chords: tuple[float, float] | None = None
    turned: float | None = None
    unit: float = 0.0

    @property
    def instants(self) -> Ints:
        """The instants at which the leader has a place."""
        return np.flatnonzero(np.isfinite(self.lead).all(axis=1)) if self.lead is not None else np.zeros(0, np.int64)

    @property
    def decimals(self) -> int:
        """Decimals of a place, which all places together show of a time [s] and of an angle [degrees]."""
        return round(-math.log10(self.unit)) if self.unit else DECIMALS_OF_CONTEST


def geometries(dance: Dance, times: Floats, seen: SheetClues) -> Iterator[Model]:
    """Every known error in the positions, the likeliest first. times: (T,) [s] of the sheet"""
    right = of_dance(dance)
    for error, mirror in MIRRORS.items():
        yield Model(error, mirrored(right, mirror))
    yield from shifted_rows(right)
    if seen.turned is not None:
        yield _turned(right, seen.turned, seen.decimals)
    yield Model("equal_arcs", equal_arcs(dance))
    yield from other_dragons(dance)
    yield from own_lengths(dance, seen)
    spiral = dance.path.spiral
    if spiral is None:
        yield from other_turns(dance)
    else:
        yield from _other_angles(dance, spiral, times.size > 1)
        yield from _rounded_spirals(dance, spiral)
    yield from other_starts(dance, times, seen)
    yield from _other_questions(dance, times, seen)


def mirrored(motion: Motion, mirror: Mirror) -> Motion:
    """The motion whose places are mirrored, or have x and y exchanged."""
    return lambda times: motion(times) @ mirror


def shifted_rows(motion: Motion, most: int = ROWS_MOST) -> Iterator[Model]:
    """Each handle has the numbers of one that is some benches behind it, or before it; those left over have none."""
    for count in range(1, most + 1):
        for by in (count, -count):
            yield Model("shifted_rows", partial(_shifted, motion, by), {"by": f"k {'+' if by > 0 else '-'} {count}"})


def _shifted(motion: Motion, by: int, times: Floats) -> Floats:
    numbers = np.roll(motion(times), -by, axis=1)
    numbers[:, slice(-by, None) if by > 0 else slice(-by)] = np.nan
    return numbers


def shifted_time(motion: Motion, shift: float, decimals: int = DECIMALS_OF_CONTEST) -> Model:
    """The numbers of a motion at times that are later by a shift [s], of which so many decimals are known."""
    words = {"shift": f"{round(shift, decimals):+.6g}"}
    return Model("shifted_time", lambda t: motion(t + shift), words, shift=shift)


def _turned(motion: Motion, angle: float, decimals: int) -> Model:
    """All places turned about the centre by one angle [rad], counter-clockwise.

    decimals: those of the angle in degrees that are known
    """
    degrees = math.degrees(angle)
    if abs(round(degrees, TURNED_DECIMALS) - degrees) < TURNED_OFF:
        degrees = round(degrees, TURNED_DECIMALS)
    if round(degrees, decimals) == -180.0:
        degrees += 360.0
    cosine, sine = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    turn = np.array([[cosine, sine, 0.0], [-sine, cosine, 0.0], [0.0, 0.0, 1.0]])
    is_exact = decimals >= TURNED_DECIMALS or degrees == 180.0
    shown = f"{degrees:+.6g}" if is_exact else f"{degrees:+.{decimals}f}"
    return Model("turned", lambda t: motion(t) @ turn, {"angle": shown})


# Lengths and overhangs of benches by the known errors in the distances of the handles [m].
OTHER_LENGTHS = {
    "length_for_chord": {"head_length": 3.41, "body_length": 2.20, "overhang": 0.0},
    "overhang_once": {"head_length": 3.41, "body_length": 2.20, "overhang": 0.1375},
    "head_as_body": {"head_length": 2.20},
    "body_as_head": {"body_length": 3.41},
}


def other_dragons(dance: Dance) -> Iterator[Model]:
    """Wrong distances between the handles."""
    for error, lengths in OTHER_LENGTHS.items():
        yield Model(error, _on_path(Dragon(dance.dragon.benches, **lengths), dance.path))


def _on_path(dragon: Dragon, path: Spiral | Route) -> Motion:
    try:
        return of_dance(Dance(dragon, path))
    except BenchDragonError:  # The arcs are too tight for this chord: a handle would jump.
        if not isinstance(path, Turn):
            raise
        return on_bent(dragon, Bent(path, tuple(arcs_of(path))))


def own_lengths(dance: Dance, seen: SheetClues) -> Iterator[Model]:
    """Distances between the handles that are steady in the student's sheet, and neither right nor a known error."""
    if seen.chords is None:
        return
    known = [Dragon(2), *(Dragon(2, **lengths) for lengths in OTHER_LENGTHS.values())]
    if any(np.abs(dragon.chords[:2] - seen.chords).max() < SAME_LENGTH for dragon in known):
        return
    head, body = (_simple(chord) for chord in seen.chords)
    margin = 2.0 * float(Dragon(1).overhangs[0])
    with suppress(BenchDragonError):
        dragon = Dragon(dance.dragon.benches, head_length=head + margin, body_length=body + margin)
        yield Model("own_lengths", _on_path(dragon, dance.path), {"head": f"{head:.6g}", "body": f"{body:.6g}"})


def _simple(length: float) -> float:
    """A measured length with as few decimals as it allows, because students type lengths [m]."""
    return next((one for k in LENGTH_DECIMALS if abs((one := round(length, k)) - length) < MEASURED), length)


def _other_questions(dance: Dance, times: Floats, seen: SheetClues) -> Iterator[Model]:
    """The numbers of another question, at the times at which its handles are at the student's places."""
    is_turn = dance.path.spiral is None
    other = dance_of(Workbook.RESULT1 if is_turn else Workbook.RESULT4)
    if (shift := _shift(other, times, seen)) is not None:
        right = of_dance(other)
        shown = f"{round(shift, seen.decimals):+.6g}"
        words = {"question": 1 if is_turn else 4, "shift": shown}
        yield Model("other_question", lambda t: right(t + shift), words)


def _other_angles(dance: Dance, path: Spiral, many: bool) -> Iterator[Model]:
    """Models whose head has an angle from a wrong arc length.

    many: True for several times, which allow rounded angles too: a single angle looks rounded by chance
    """
    b, start = path.growth, path.start_theta

    def head_at(theta: Floats) -> Floats:
        return times_at(path, b * theta) / dance.head_speed

    def circles(t: Floats) -> Floats:
        # ds = r dtheta; the arc length without its logarithm gives the same six decimals: theta sqrt(1 + theta^2) is
        # theta^2 + 1/2 - 1 / (8 theta^2), and theta is 25 or more.
        return np.sqrt(np.maximum(start**2 - 2.0 * t / b, 0.0))

    def steady(t: Floats) -> Floats:
        return start - t / (b * start)  # the angular speed of the start, kept

    def explicit(t: Floats) -> Floats:
        """Explicit Euler in steps of 1 s, the last one as long as is left."""
        whole = np.floor(np.maximum(t, 0.0)).astype(np.int64)
        angles = [start]
        for _ in range(int(whole.max(initial=0)) + 1):
            angles.append(angles[-1] - 1.0 / (b * math.sqrt(1.0 + angles[-1] ** 2)))
        before, after = np.array(angles)[whole], np.array(angles)[whole + 1]
        return np.asarray(before + (np.maximum(t, 0.0) - whole) * (after - before))

    def rounded_head(decimals: int, t: Floats) -> Floats:
        return np.round(path.theta(t * dance.head_speed), decimals)

    right = of_dance(dance)

    def led_by(law: Callable[[Floats], Floats]) -> Motion:
        return lambda t: right(head_at(law(t)))

    for factor in (180.0 / math.pi, math.pi / 180.0):
        for is_wrapped in (False, True):
            turned = partial(_mixed_up, right, path, factor, is_wrapped)
            yield Model("degrees", turned, {"factor": f"{factor:.4g}"})
    yield Model("arc_of_circle", led_by(circles))
    yield Model("steady_angle", led_by(steady))
    yield Model("euler_steps", led_by(explicit))
    for decimals in ANGLE_DECIMALS if many else ():
        what = f"theta of the head, {decimals} decimals"
        yield Model("rounded_early", led_by(partial(rounded_head, decimals)), {"what": what})


def _mixed_up(right: Motion, path: Spiral, factor: float, is_wrapped: bool, times: Floats) -> Floats:
    """Handles at the right distances from the centre, at so many times their angles. is_wrapped: of one turn each"""
    numbers = right(times)
    radii = np.hypot(numbers[..., 0], numbers[..., 1])
    angles = radii / path.growth
    angles = factor * (angles % (2.0 * math.pi) if is_wrapped else angles)
    numbers[..., 0], numbers[..., 1] = radii * np.cos(angles), radii * np.sin(angles)
    return numbers


def _rounded_spirals(dance: Dance, path: Spiral) -> Iterator[Model]:
    """Models with numbers rounded before their use."""
    growths = [round(path.growth, decimals) for decimals in CONSTANT_DECIMALS]
    pitches = {f"b = {growth:g}": 2.0 * math.pi * growth for growth in growths}
    pitches |= {f"pi = {rounded:g}": path.pitch * math.pi / rounded for rounded in PI_ROUNDED}
    for what, pitch in pitches.items():
        with suppress(BenchDragonError):
            yield Model("rounded_early", of_dance(Dance(dance.dragon, Spiral(pitch, path.start_turns))), {"what": what})
    for decimals in ANGLE_DECIMALS:
        yield Model("rounded_early", rounded_angles(dance, path, decimals), {"what": f"theta, {decimals} decimals"})


def other_turns(dance: Dance) -> Iterator[Model]:
    """Turns of another shape."""
    path = right_turn()
    for error, ratio in (("ratio_inverted", 1.0 / path.ratio), ("equal_arcs_of_turn", 1.0)):
        yield Model(error, of_dance(Dance(dance.dragon, Turn(PITCH, ratio=ratio))))
    entry, leaving = complex(*path.entry), complex(*path.exit)
    # Semicircles on the line from entry to exit, which are tangent to the turning circle instead of the spiral.
    along = (leaving - entry) / abs(leaving - entry)
    total, begin = 0.5 * abs(leaving - entry), cmath.phase(-along)
    first, last = total * path.ratio / (1.0 + path.ratio), total / (1.0 + path.ratio)
    arcs = (entry + first * along, first, begin, -math.pi), (leaving - last * along, last, begin, math.pi)
    yield Model("arcs_not_tangent", on_bent(dance.dragon, Bent(path, arcs)))
    mirrored = tuple(
        (along * (centre / along).conjugate(), radius, 2.0 * cmath.phase(along) - start, -angle)
        for centre, radius, start, angle in arcs_of(path)
    )
    yield Model("wrong_centre", on_bent(dance.dragon, Bent(path, mirrored)))


def arcs_of(path: Turn) -> list[Arc]:
    """The right arcs."""
    pieces = zip(path.centres, path.radii, (path.entry, path.tangent_point), (-1.0, 1.0), path.angles, strict=True)
    return [
        (complex(*centre), radius, cmath.phase(complex(*first) - complex(*centre)), sign * angle)
        for centre, radius, first, sign, angle in pieces
    ]


def other_starts(dance: Dance, times: Floats, seen: SheetClues) -> Iterator[Model]:
    """Models with another starting turn, or with shifted times; both follow from the student's places of one handle."""
    if seen.lead is None or not seen.instants.size:
        return
    first, spiral = seen.instants[0], dance.path.spiral
    shift, simple = _shift(dance, times, seen), False
    if spiral is not None and times[first] == 0.0 and seen.leader == 0:
        radius = float(np.hypot(*seen.lead[first])) / spiral.pitch
        turns = round(radius, 3)
        simple = abs(turns - radius) < SIMPLE_TURNS and turns > 1.0 and abs(turns - spiral.start_turns) > 1e-3
        if simple:
            with suppress(BenchDragonError):
                moved = of_dance(Dance(dance.dragon, Spiral(spiral.pitch, turns)))
                yield Model("other_start", moved, {"turns": f"{turns:g}"})
    if shift is None or abs(shift) < SHIFT_LEAST:
        return
    if spiral is None and seen.leader == 0:
        yield from _other_entries(dance, shift, seen)
    # Another start and a shifted time are the same motion: the simpler number of both is the likelier one.
    if not simple or abs(round(shift, 2) - shift) < SHIFT_LEAST:
        yield shifted_time(of_dance(dance), shift, seen.decimals)


def _other_entries(dance: Dance, shift: float, seen: SheetClues) -> Iterator[Model]:
    """The turn that begins at another distance from the centre. shift: how much later the right head is there [s]"""
    path = right_turn()
    coil = Spiral(path.pitch)
    arc = spiral_arc(path.entry_radius, coil.growth) - shift * dance.head_speed
    if arc <= 0.0:
        return
    radius = coil.growth * float(coil.theta(coil.length - arc))
    if abs(round(radius, 3) - radius) < max(SIMPLE_RADIUS, RADIUS_OFF * seen.unit):
        radius = round(radius, 3)
    with suppress(BenchDragonError):
        entered = _on_path(dance.dragon, Turn(path.pitch, radius))
        yield Model("other_entry_radius", entered, {"radius": f"{round(radius, seen.decimals + 2):.6g}"})


def _shift(dance: Dance, times: Floats, seen: SheetClues) -> float | None:
    """Time from an instant of the sheet to that at which a dance has its handle there [s]; None if it is never near."""
    span = shift_span(dance, times, seen)
    return span and simplest(span)


def shift_span(dance: Dance, times: Floats, seen: SheetClues) -> Span | None:
    """The span of shifts [s] that the digits of the places of a handle allow."""
    lead, known = seen.lead, seen.instants
    if lead is None or not known.size:
        return None
    first, step = known[0], PLACE_STEP if seen.leader == 0 else PLACE_STEP_BEHIND
    place_at = places_of(dance, seen.leader)
    span = np.arange(times[first] - SHIFT_MOST, min(times[first] + SHIFT_MOST, dance.end.time), step)
    off = np.linalg.norm(place_at(span) - lead[first], axis=-1)
    if not off.size or off.min() > PLACE_NEAR + 0.5 * step:
        return None
    shift = float(span[off.argmin()] - times[first])

    def agreed(some: Ints, shift: float, far: float) -> Span:
        tolerance = np.full((some.size, 2), ROUNDED * seen.unit + ARITHMETIC)
        return agreed_span(lead[some], tolerance, lambda by: place_at(times[some] + by), shift, far)

    # One place shows it only to its rounding; all that have the same shift show it together.
    low, high = agreed(known[:1], shift, step)
    some = known[:: max(1, known.size // PLACES_MOST)]
    some = some[times[some] + high <= dance.end.time]
    return agreed(some, 0.5 * (low + high), 0.5 * (high - low))


def places_of(dance: Dance, handle: int) -> Callable[[Floats], Floats]:
    """The places of a handle in a dance [m], by the time."""
    if handle == 0:
        return lambda times: np.asarray(dance.path.position(times * dance.head_speed))
    motion = of_dance(dance)
    return lambda times: motion(times)[:, handle, :2]
