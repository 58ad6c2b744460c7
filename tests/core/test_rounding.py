"""Rounding: errors of chains and gaps against their bounds, to 50 digits, and decisions by these bounds."""

from __future__ import annotations

import math
from collections.abc import Callable

import flint
import numpy as np
import pytest
from flint import arb

from core import (
    Arc,
    Dance,
    Dragon,
    Line,
    Outcome,
    Route,
    Spiral,
    Turn,
    clearance_profile,
    first_contact,
    kernels,
    minimum_pitch,
    trajectory,
)
from core.contact.fold import gap_rounding
from core.contact.search import ContactSearch
from core.design.ways import Ways
from core.extremes.speed import SPEED_ROUNDING, first_excess
from core.kernels.constants import CLIMB, CLIMB_ERROR, ERROR, RATE, RATE_ERROR
from tests.campaigns.rounding_sweep import Errors, compare, sweep
from tests.support.exact_chain import BITS, middle, next_delta, separation, spiral_place

# Gaps compared of every seed; `make rounding` compares 10,000.
GAPS = 300
# Newton's iteration for the head's theta, from its double [1].
STEPS = 4
# A gap of benches 0 and 19 of the default dragon is off by less [m].
NEAR = 1e-14
# Instants between the ends of an interval.
INSTANTS = 31


@pytest.mark.parametrize("seed", range(4))
def test_no_gap_of_a_random_chain_is_off_by_more_than_its_bound(seed: int) -> None:
    errors = sweep(GAPS, seed)
    assert len(errors.gaps) >= GAPS
    for ratios in (errors.gaps, errors.points, errors.directions, errors.slides):
        assert max(ratios) <= 1.0


def long_line() -> Route:
    return Route([Line((0, 0), (2000, 0)), Arc((2000, 40), 40.0, -math.pi / 2, 3.0)])


@pytest.mark.parametrize(
    ("path", "head"), [(Spiral(0.55, 200.0), 30.0), (long_line(), 2_050.0)], ids=["spiral", "line and arc"]
)
def test_two_thousand_benches_of_two_lengths_stand_at_their_places(path: Spiral | Route, head: float) -> None:
    lengths = np.where(np.arange(2_000) % 3 == 0, 1.2, 0.9)
    dragon = Dragon.of(lengths, np.full(2_000, 0.2), np.full(2_000, 0.1))
    errors = Errors()
    compare(errors, ContactSearch(dragon, path, 0.0), head, np.random.default_rng(0))
    for ratios in (errors.gaps, errors.points, errors.directions):
        assert max(ratios) <= 1.0


def test_towards_the_fold_the_bound_grows_with_the_error_until_nothing_is_claimed() -> None:
    dragon, spiral = Dragon(12), Spiral()
    fold, bounds = Dance(dragon, spiral).end.theta, []
    search = ContactSearch(dragon, spiral, 0.0)
    for beyond in (1.0, 1e-3, 1e-6, 1e-9):
        theta = fold * (1.0 + beyond)
        errors = Errors()
        compare(errors, search, theta, np.random.default_rng(0))
        assert max(errors.gaps + errors.points + errors.directions) <= 1.0
        bounds.append(float(search.placed[0, ERROR]))
    assert bounds == sorted(bounds)
    assert bounds[-1] > 100.0 * bounds[0]
    kernels.start_chain(fold, search.placed)
    if kernels.extend_chain(search.growth, 0, 1, kernels.FREE, search.sizes, search.placed) == 1:
        kernels.chain_rounding(search.curve, 1, search.sizes, search.placed)
        assert search.placed[0, ERROR] > bounds[-1]


def exact_theta(spiral: Spiral, time: float, head_speed: float = 1.0) -> arb:
    """Place of the head at a time [s], a double taken as exact."""
    flint.ctx.prec = BITS
    start, growth = 2 * arb.pi() * spiral.start_turns, spiral.pitch / (2 * arb.pi())
    arc = spiral_place(start) - arb(time) * head_speed / growth
    theta = arb(float(spiral.theta(time * head_speed)))
    for _ in range(STEPS):
        theta = middle(theta - (spiral_place(theta) - arc) / (1 + theta * theta).sqrt())
    return theta


def exact_gap(dragon: Dragon, spiral: Spiral, time: float, head_speed: float, pair: tuple[int, int]) -> float:
    """Separation of two benches at a time [s], a double taken as exact [m]."""
    theta = exact_theta(spiral, time, head_speed)
    growth = middle(spiral.pitch / (2 * arb.pi()))
    at, handles = theta, [(growth * theta, arb(0))]
    for chord in dragon.chords[: pair[1] + 1].tolist():
        at = middle(at + next_delta(at, arb(chord) / growth))
        handles.append((growth * at * (at - theta).cos(), growth * at * (at - theta).sin()))
    sizes = [np.array([dragon.chords[k], 0.5 * dragon.lengths[k], 0.5 * dragon.widths[k]]) for k in pair]
    first, second = ((handles[k], handles[k + 1]) for k in pair)
    return float(separation(first, second, (sizes[0], sizes[1])))


@pytest.mark.parametrize("benches", range(20, 32))
def test_a_margin_within_rounding_of_the_clearance_at_the_start_is_undecided(benches: int) -> None:
    """In some of these dances the benches are truly further apart than the margin, in some not."""
    dragon, spiral = Dragon(benches, width=0.28 + 1e-3 * benches), Spiral(0.7, 6.0)
    profile = clearance_profile(Dance(dragon, spiral), [0.0])
    margin = float(profile.clearance[0])
    contact = first_contact(Dance(dragon, spiral), margin=margin)
    assert contact.outcome is Outcome.UNDECIDED
    assert contact.time_bracket is not None
    assert contact.time_bracket[0] == 0.0
    apart = exact_gap(dragon, spiral, 0.0, 1.0, tuple(profile.benches[0].tolist()))
    search = ContactSearch(dragon, spiral, margin)
    assert abs(apart - margin) <= gap_rounding(search, 0.0, margin)
    certain = margin + 2.0 * gap_rounding(search, 0.0, margin) + 4.0 * search.travel_rounding(0.0)
    assert first_contact(Dance(dragon, spiral), margin=certain).outcome is Outcome.CONTACT_AT_START


@pytest.fixture(scope="module")
def graze() -> float:
    return minimum_pitch(Dragon(60)).pitch_bracket[0]


@pytest.mark.parametrize("head_speed", [1.0, 3.0, 0.37])
@pytest.mark.parametrize("below", [2e-12, 1e-10, 1e-8, 1e-6, 1e-3])
def test_both_ends_of_a_bracket_keep_their_promise(graze: float, below: float, head_speed: float) -> None:
    spiral = Spiral(graze - below)
    contact = first_contact(Dance(Dragon(60), spiral, head_speed))
    assert contact.outcome is Outcome.CONTACT
    clear, within = contact.time_bracket
    assert exact_gap(Dragon(60), spiral, clear, head_speed, contact.benches) > 0.0
    assert exact_gap(Dragon(60), spiral, within, head_speed, contact.benches) <= 0.0


@pytest.mark.parametrize("turns", [8.0, 30.0, 300.0, 3_000.0])
@pytest.mark.parametrize("margin", [0.0, 0.05])
def test_however_long_the_way_both_ends_of_a_bracket_are_true(turns: float, margin: float) -> None:
    """The travel of a head that has come a thousand kilometres is rounded to a tenth of a nanometre."""
    dragon, spiral = Dragon(30, head_length=2.5), Spiral(0.55, turns)
    contact = first_contact(Dance(dragon, spiral), margin=margin)
    assert contact.outcome is Outcome.CONTACT
    clear, within = contact.time_bracket
    assert exact_gap(dragon, spiral, clear, 1.0, contact.benches) > margin
    assert exact_gap(dragon, spiral, within, 1.0, contact.benches) <= margin
    assert within - clear <= 1e-9 + 8.0 * ContactSearch(dragon, spiral, margin).travel_rounding(contact.time)


@pytest.mark.parametrize("seed", range(20))
def test_what_is_within_a_margin_for_certain_stays_so_over_the_interval(seed: int) -> None:
    rng = np.random.default_rng(seed)
    dragon = Dragon(9, 2.0, 1.5, rng.uniform(0.1, 0.5), rng.uniform(0.0, 0.4))
    search = ContactSearch(dragon, Spiral(0.5, 3.0), 0.0)
    a = int(rng.integers(0, 3))
    b = int(rng.integers(a + 2, 9))
    h, place = 10 ** rng.uniform(-12.0, -2.0), search.place - rng.uniform(0.0, 6.0)
    most = kernels.pair_most(search.scene, search.probe, place, h, a, b)
    gaps = [
        kernels.gap_at(search.scene, place - part * h, a, b, search.placed) for part in np.linspace(0.0, 1.0, INSTANTS)
    ]
    assert max(gaps) <= max(most, 0.0)


@pytest.mark.parametrize(
    "joined",
    [lambda x: (x, 0.0), lambda x: (x - 9e-10, 0.0), lambda x: (x, 9e-10)],
    ids=["closed", "overlapping", "aside"],
)
def test_pieces_that_miss_each_other_count_as_rounding(joined: Callable[[float], tuple[float, float]]) -> None:
    """A line whose second half begins up to 1e-9 m off its first."""
    route = Route([Line((0.0, 0.0), (30.0, 0.0)), Line(joined(30.0), (60.0, joined(0.0)[1]))])
    x, y = joined(0.0)
    assert route.table[0, kernels.LOOSE] >= 2.0 * abs(y)
    assert route.slide >= abs(x)
    search = ContactSearch(Dragon(3), route, 0.0)
    search.clearance(30.5)
    kernels.chain_rounding(search.curve, 3, search.sizes, search.placed)
    assert search.placed[0, ERROR] >= abs(y)


@pytest.mark.parametrize("path", [Spiral(), Turn(1.7)], ids=["spiral", "turn"])
def test_what_a_chain_does_not_write_is_never_read(path: Spiral | Route) -> None:
    """The same march from rows that hold no numbers, and from rows of zeros."""
    entries = []
    for value in (math.nan, 0.0):
        search = ContactSearch(Dragon(40), path, 0.05)
        search.chains[:, 2:] = value
        entries.append(search.march(90.0 if isinstance(path, Route) else 400.0, 1e-10, start=-20.0))
    assert entries[0] == entries[1]


def exact_climbs(growth: float, theta: float | arb, chords: np.ndarray) -> tuple[list[arb], list[arb]]:
    """Rates of the handles of a spiral and their slopes [1/m], by twice differentiating |P_a - P_b| = chord."""
    flint.ctx.prec = BITS
    at, rate, slope = arb(theta), arb(1), arb(0)
    rates, slopes = [rate], [slope]

    def handle(theta: arb) -> tuple[arb, ...]:
        """Point, tangent along the way of the head, and curvature, which is to the right."""
        length, cos, sin = (1 + theta * theta).sqrt(), theta.cos(), theta.sin()
        x, y = growth * theta * cos, growth * theta * sin
        return x, y, (theta * sin - cos) / length, -(theta * cos + sin) / length, -(2 + theta**2) / length**3 / growth

    for chord in chords.tolist():
        ax, ay, atx, aty, bend_a = handle(at)
        at = middle(at + next_delta(at, arb(chord) / growth))
        bx, by, btx, bty, bend_b = handle(at)
        ux, uy = (ax - bx) / chord, (ay - by) / chord
        front, rear = atx * ux + aty * uy, btx * ux + bty * uy
        before, rate = rate, rate * front / rear
        apart = (before * atx - rate * btx) ** 2 + (before * aty - rate * bty) ** 2
        turned = before**2 * bend_a * (uy * atx - ux * aty) - rate**2 * bend_b * (uy * btx - ux * bty)
        slope = (apart / chord + slope * front + turned) / rear
        rates.append(rate)
        slopes.append(slope)
    return rates, slopes


@pytest.mark.parametrize("beyond", [1e-7, 1e-5, 1e-3, 1e-1, 1.0])
@pytest.mark.parametrize("seed", range(6))
def test_rates_and_slopes_near_the_centre_are_within_their_bounds(seed: int, beyond: float) -> None:
    rng = np.random.default_rng(seed)
    dragon = Dragon.of(rng.uniform(1.0, 3.0, 9), np.full(9, 0.3), np.full(9, 0.1))
    spiral = Spiral(rng.uniform(0.5, 1.2), 4.0)
    theta = (Dance(dragon, spiral).end.theta or 0.0) + beyond
    search = ContactSearch(dragon, spiral, 0.0)
    chain, growth = search.placed, spiral.growth
    kernels.start_chain(theta, chain)
    assert kernels.extend_chain(growth, 0, 9, kernels.FREE, search.sizes, chain) == 9
    kernels.climbs(search.curve, 9, search.sizes, chain)
    kernels.chain_rounding(search.curve, 9, search.sizes, chain)
    kernels.spiral_errors(growth, 9, search.sizes, chain, chain, search.motion)
    rates, slopes = exact_climbs(growth, theta, dragon.chords)
    for k in range(1, 10):
        assert abs(float(rates[k] - chain[k, RATE])) <= search.motion[k, RATE_ERROR] < 1.0
        assert abs(float(slopes[k] - chain[k, CLIMB])) <= search.motion[k, CLIMB_ERROR] < kernels.FREE


@pytest.mark.parametrize("seed", range(4))
def test_a_speed_above_a_limit_by_the_kernel_is_above_it(seed: int) -> None:
    """Limits around the speed at an instant, down to its rounding: what exceeds one in the kernel does to 50 digits."""
    dragon, spiral = Dragon(5, 3.0, np.random.default_rng(seed).uniform(2.0, 2.6)), Spiral(1.2, 3.0)
    end = Dance(dragon, spiral).end
    for left in (1e-1, 1e-3, 1e-5):
        time, values = end.time - left, set()
        speed = float(trajectory(Dance(dragon, spiral), time).speed.max())
        for above in (-1e-3, -1e-9, *(units * kernels.ULP for units in range(-6, 7, 2)), 1e-9):
            limit = speed * (1.0 + above) / (1.0 + SPEED_ROUNDING)
            result = first_excess(Dance(dragon, spiral), limit, start=math.nextafter(time, 0.0), stop=time)
            values.add(result is not None and result.handle is not None)
            if result is not None and result.time is not None:
                rates, _ = exact_climbs(spiral.growth, exact_theta(spiral, result.time), dragon.chords)
                assert abs(float(rates[result.handle])) > limit
        assert values == {True, False}


def test_a_pitch_at_which_rounding_hides_whether_benches_graze_is_not_called_infeasible() -> None:
    """Pitches around that at which benches 0 and 19 graze by the doubles, nearer than gaps are proven good to."""
    dragon, result = Dragon(60), minimum_pitch(Dragon(60))
    ways = Ways(dragon, 4.5, 16.0, 0.0, 0.0, None)
    ways.bands.graze = result.benches, result.head_radius
    low, high = result.pitch_bracket
    while low < (middle := 0.5 * (low + high)) < high:
        low, high = (middle, high) if ways.bands.dip(middle, *reversed(ways.bands.graze))[0] <= 0.0 else (low, middle)
    values = []
    for pitch in np.concatenate([high + NEAR * np.linspace(-4.0, 4.0, 41), result.pitch_bracket]).tolist():
        values.append(ways.grazes(pitch))
        gap, radius = ways.bands.dip(pitch, *reversed(ways.bands.graze))
        travel = ways.search.travel_at(radius / ways.search.growth)
        exact = exact_gap(dragon, Spiral(pitch), travel, 1.0, result.benches)
        assert abs(exact - gap) <= NEAR
        assert not values[-1] or exact <= 0.0
    assert values[-2:] == [True, False]
    assert not any(values[:-2])
