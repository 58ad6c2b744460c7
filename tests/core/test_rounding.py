"""Rounding: errors of chains and gaps against their bounds, to 50 digits, and decisions by these bounds."""

import math
from collections import defaultdict

import flint
import numpy as np
import pytest
from flint import arb

from core import (
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
from core.design.ways import Ways
from core.extremes.speed import SPEED_ROUNDING, first_excess
from core.kernels.constants import CLIMB, CLIMB_ERROR, ERROR, RATE, RATE_ERROR
from core.sampling import bisect
from tests.campaigns.rounding_sweep import compare, sweep
from tests.support.depth import further
from tests.support.exact_chain import BITS, angles_behind, coil_handles, middle, separation, spiral_place
from tests.support.searches import search_on

# Gaps compared of every seed; `make rounding` compares 10,000.
GAPS = 300
# A gap of benches 0 and 19 of the default dragon is off by less [m].
NEAR = 1e-14
NO_CHORDS = np.empty(0)
# What the head turns by for a difference quotient [rad], of which 60 digits leave 40.
TURNED = arb(1e-20)


@pytest.mark.parametrize("seed", further(range(4), 2))
def test_no_gap_of_a_random_chain_is_off_by_more_than_its_bound(seed):
    errors = sweep(GAPS, seed)
    assert len(errors["gaps"]) >= GAPS
    assert {*errors} == {"gaps", "points", "directions", "slides"}
    assert max(map(max, errors.values())) <= 1.0


def test_two_thousand_benches_of_two_lengths_stand_at_their_places():
    dragon = Dragon.of([1.2, 0.9] * 1_000, [0.2] * 2_000, [0.1] * 2_000)
    errors = defaultdict(list)
    compare(errors, search_on(dragon, Spiral(0.55, 200.0)), 30.0, np.random.default_rng(0))
    assert max(map(max, errors.values())) <= 1.0


def exact_gap(dragon, spiral, way, pair):
    """Separation of two benches when the head has come this way, taken as exact [m]."""
    handles = coil_handles(spiral.pitch, spiral.start_turns, arb(way), dragon.chords[: pair[1] + 1])
    sizes = [np.array([dragon.chords[k], 0.5 * dragon.lengths[k], 0.5 * dragon.widths[k]]) for k in pair]
    return float(separation(*((handles[k], handles[k + 1]) for k in pair), sizes))


@pytest.mark.parametrize("benches", range(20, 32))
def test_a_margin_within_rounding_of_the_clearance_at_the_start_is_undecided(benches):
    """In some of these dances the benches are truly further apart than the margin, in some not."""
    dance = Dance(Dragon(benches, width=0.28 + 1e-3 * benches), Spiral(0.7, 6.0))
    profile = clearance_profile(dance, 0.0)
    margin = float(profile.clearance)
    assert first_contact(dance, margin=margin).outcome is Outcome.UNDECIDED
    search = search_on(dance.dragon, dance.path, margin)
    rounding = gap_rounding(search, 0.0, margin)
    assert abs(exact_gap(dance.dragon, dance.path, 0.0, profile.benches.tolist()) - margin) <= rounding
    certain = margin + 2.0 * rounding + 4.0 * search.travel_rounding(0.0)
    assert first_contact(dance, margin=certain).outcome is Outcome.CONTACT_AT_START


def true_bracket(dragon, spiral, head_speed=1.0, margin=0.0):
    """A contact of which both ends of the bracket keep their promise."""
    contact = first_contact(Dance(dragon, spiral, head_speed), margin=margin)
    assert contact.outcome is Outcome.CONTACT
    clear, within = (
        exact_gap(dragon, spiral, arb(time) * head_speed, contact.benches) for time in contact.time_bracket
    )
    assert clear > margin >= within
    return contact


@pytest.mark.parametrize("below", [2e-12, 1e-10, 1e-8, 1e-6, 1e-3])
def test_both_ends_of_a_bracket_keep_their_promise(below):
    graze = minimum_pitch(Dragon(60)).pitch_bracket[0]
    for head_speed in (1.0, 0.37):
        true_bracket(Dragon(60), Spiral(graze - below), head_speed)


@pytest.mark.parametrize("turns", [8.0, 30.0, 300.0, 3_000.0])
@pytest.mark.parametrize("margin", [0.0, 0.05])
def test_however_long_the_way_both_ends_of_a_bracket_are_true(turns, margin):
    """The travel of a head that has come a thousand kilometres is rounded to a tenth of a nanometre."""
    dragon = Dragon(30, head_length=2.5)
    spiral = Spiral(0.55, turns)
    contact = true_bracket(dragon, spiral, margin=margin)
    clear, within = contact.time_bracket
    search = search_on(dragon, spiral, margin)
    assert within - clear <= 1e-9 + 8.0 * search.travel_rounding(contact.time)


@pytest.mark.parametrize("x, y", [(-9e-10, 0.0), (0.0, 9e-10)], ids=["overlapping", "aside"])
def test_pieces_that_miss_each_other_count_as_rounding(x, y):
    """A line whose second half begins up to 1e-9 m off its first."""
    route = Route([Line((0.0, 0.0), (30.0, 0.0)), Line((30.0 + x, y), (60.0, y))])
    assert route.table[0, kernels.LOOSE] >= 2.0 * y
    assert route.slide >= abs(x)
    search = search_on(Dragon(3), route)
    search.clearance(30.5)
    kernels.chain_rounding(search.curve, 3, search.sizes, search.placed)
    assert search.placed[0, ERROR] >= y


@pytest.mark.parametrize("path, until", [(Spiral(), 400.0), (Turn(1.7), 90.0)], ids=["spiral", "turn"])
def test_what_a_chain_does_not_write_is_never_read(path, until):
    """The same march from rows that hold no numbers, and from rows of zeros."""
    entries = []
    for value in (math.nan, 0.0):
        search = search_on(Dragon(40), path, 0.05)
        search.chains[:, 2:] = value
        entries.append(search.march(until, 1e-10, start=-20.0))
    assert entries[0] == entries[1]


def exact_climbs(growth, theta, chords):
    """Rates of the handles of a spiral and their slopes [1/m]: difference quotients of their places, to 50 digits."""
    flint.ctx.prec = BITS
    before, at, after = (
        [growth * spiral_place(angle) for angle in angles_behind(arb(theta) + turned, arb(growth), chords)]
        for turned in (-TURNED, arb(0), TURNED)
    )
    first = at[0] - before[0]
    second = after[0] - at[0]
    pairs = [((b - a) / first, (c - b) / second) for a, b, c in zip(before, at, after, strict=True)]
    # The head walks towards the centre, from which places are counted.
    return [(low + high) / 2 for low, high in pairs], [2 * (low - high) / (first + second) for low, high in pairs]


@pytest.mark.parametrize("beyond", [1e-7, 1e-5, 1e-3, 1e-1, 1.0])
@pytest.mark.parametrize("seed", range(6))
def test_rates_and_slopes_near_the_centre_are_within_their_bounds(seed, beyond):
    rng = np.random.default_rng(seed)
    dragon = Dragon.of(rng.uniform(1.0, 3.0, 9), np.full(9, 0.3), np.full(9, 0.1))
    spiral = Spiral(rng.uniform(0.5, 1.2), 4.0)
    theta = (Dance(dragon, spiral).end.theta or 0.0) + beyond
    search = search_on(dragon, spiral)
    chain, sizes, growth, motion = search.placed, search.sizes, spiral.growth, search.motion
    kernels.start_chain(theta, chain)
    assert kernels.extend_chain(growth, 0, 9, kernels.FREE, sizes, chain) == 9
    kernels.climbs(search.curve, 9, sizes, chain)
    kernels.chain_rounding(search.curve, 9, sizes, chain)
    kernels.spiral_errors(growth, 9, sizes, chain, chain, motion)
    rates, slopes = exact_climbs(growth, theta, dragon.chords)
    for k in range(1, 10):
        assert abs(float(rates[k] - chain[k, RATE])) <= motion[k, RATE_ERROR] < 1.0
        assert abs(float(slopes[k] - chain[k, CLIMB])) <= motion[k, CLIMB_ERROR] < kernels.FREE


@pytest.mark.parametrize("seed", range(4))
def test_a_speed_above_a_limit_by_the_kernel_is_above_it(seed):
    """Limits around the speed at an instant, down to its rounding: what exceeds one in the kernel does to 50 digits."""
    spiral = Spiral(1.2, 3.0)
    dance = Dance(Dragon(5, 3.0, np.random.default_rng(seed).uniform(2.0, 2.6)), spiral)
    for left in (1e-1, 1e-3, 1e-5):
        time = dance.end.time - left
        above_it = set()
        speed = float(trajectory(dance, time).speed.max())
        for above in (-1e-3, -1e-9, *(units * kernels.ULP for units in range(-6, 7, 2)), 1e-9):
            limit = speed * (1.0 + above) / (1.0 + SPEED_ROUNDING)
            result = first_excess(dance, limit, start=math.nextafter(time, 0.0), stop=time)
            above_it.add(result is not None and result.handle is not None)
            if result is not None and result.time is not None:
                (head,) = coil_handles(spiral.pitch, spiral.start_turns, arb(result.time), NO_CHORDS)
                theta = middle(abs(head) * 2 * arb.pi() / spiral.pitch)
                rates, _ = exact_climbs(spiral.growth, theta, dance.dragon.chords)
                assert abs(float(rates[result.handle])) > limit
        assert above_it == {True, False}


def test_a_pitch_at_which_rounding_hides_whether_benches_graze_is_not_called_infeasible():
    """Pitches around that at which benches 0 and 19 graze by the doubles, nearer than gaps are proven good to."""
    dragon = Dragon(60)
    result = minimum_pitch(Dragon(60))
    ways = Ways(dragon, 4.5, 16.0, 0.0, 0.0, None)
    ways.bands.graze = result.benches, result.head_radius

    def dip(pitch):
        return ways.bands.dip(pitch, result.head_radius, result.benches)

    _, high = bisect(lambda pitch: dip(pitch)[0] > 0.0, *result.pitch_bracket)
    grazes = []
    for pitch in np.concatenate([high + NEAR * np.linspace(-4.0, 4.0, 41), result.pitch_bracket]).tolist():
        grazes.append(ways.grazes(pitch))
        gap, radius = dip(pitch)
        exact = exact_gap(dragon, Spiral(pitch), ways.search.travel_at(radius / ways.search.growth), result.benches)
        assert abs(exact - gap) <= NEAR
        assert not grazes[-1] or exact <= 0.0
    assert grazes == [False] * 41 + [True, False]
