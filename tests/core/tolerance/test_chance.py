"""Contact probability: against probabilities solved without sampling, and independence of samples."""

from itertools import pairwise

import numpy as np
import pytest

from core import (
    Dance,
    Dragon,
    Spiral,
    Wobble,
    bench_poses,
    clearance_profile,
    contact_probability,
    separation,
    trajectory,
)  # fmt: skip
from core.tolerance.chance import CONFIDENCE, clopper_pearson
from tests.support.near import assert_near
from tests.support.refused import refused
from tests.support.scenes import lengths_and_widths
from tests.support.slow_search import in_plane

SPIRAL = Dance(Dragon(20), Spiral())
# Shortly before the first contact of that dance [s].
LATE = {"start": 402.0, "stop": 410.0}
MODEL = Wobble(0.02, 0.01, 4.0, hole=0.06, pin=0.05)


def poses_of(holes):
    """Poses of benches with these holes (2, n), complex numbers."""
    return bench_poses(in_plane(holes).swapaxes(0, 1))[:, 0]


def laid_out(wanted, chords, front_play=None, rear_play=None):
    """Oracle: front and rear holes (2, n, ...) of benches whose people want their pins here (n + 1, ...) [m].

    Each rear hole is as near to where its person wants it as the chord allows. All places are complex numbers.
    """
    still = np.zeros(len(chords))
    pin = wanted[0]
    holes = []
    plays = [still if play is None else play for play in (front_play, rear_play)]
    for want, chord, ahead, behind in zip(wanted[1:], chords, *plays, strict=True):
        front = pin + ahead
        way = want + behind - front
        holes.append((front, front + way * (chord / abs(way))))
        pin = holes[-1][1] - behind
    return np.moveaxis(holes, 0, 1)


def correlate(wishes, along):
    """Make independent numbers (N, n + 1, ...) of variance 1 those of people who heed the one before them."""
    for k in range(1, wishes.shape[1]):
        wishes[:, k] = along * wishes[:, k - 1] + np.sqrt(1.0 - along**2) * wishes[:, k]


def test_each_dragon_is_the_one_that_is_laid_out_step_by_step():
    """On its own spiral, with the play of its own pins, and people who wobble along the chain and in time."""
    model = Wobble(0.02, 0.01, 4.0, 3.0, hole=0.06, pin=0.05, pitch_error=0.02)
    dragon = SPIRAL.dragon
    start = LATE["start"]
    touching = []
    result = contact_probability(SPIRAL, model, 300, 5, start=start, stop=start + 1.5)
    times = np.linspace(start, start + 1.5, 3)
    memory = np.exp(-result.step / 4.0)
    radii = [float(SPIRAL.path.head(time).radius) for time in times]
    sizes = lengths_and_widths(dragon)
    first, second = np.triu_indices(20, 2)
    for sample in range(300):
        spiral = Spiral(0.55 + model.pitch_error * numbers(5, sample, 1).standard_normal(), 20.0)
        motion = trajectory(Dance(dragon, spiral), [spiral.travel_to(radius) for radius in radii])
        places = motion.position @ [1.0, 1j]
        ahead = motion.velocity @ [1.0, 1j] / motion.speed
        distance, turn = numbers(5, sample, 0).random((2, 20, 2))
        play = model.play * np.sqrt(distance) * np.exp(2j * np.pi * turn)
        wish = numbers(5, sample, 2).standard_normal((3, 21, 2)) @ [1j * model.lateral, model.forward]
        correlate(wish, model.along)
        furthest = 0.0
        for t in range(3):
            if t:
                wish[t] = memory * wish[t - 1] + np.sqrt(1.0 - memory**2) * wish[t]
            holes = laid_out(places[t] + wish[t] * ahead[t], dragon.chords, *play.T)
            furthest = max(furthest, abs(holes - [places[t, :-1], places[t, 1:]]).max())
            poses = poses_of(holes)
            gaps = separation(poses[first], sizes[first], poses[second], sizes[second]).separation
            if gaps.min() <= 0.0:
                touching.append((sample, times[t]))
                break
        assert_near(result.strays[sample], furthest, 1e-7)
    assert list(zip(result.sample.tolist(), result.time.tolist(), strict=True)) == touching
    assert 20 < len(touching) < 200


def numbers(seed, sample, part):
    return np.random.Generator(np.random.Philox(key=seed, counter=[0, part, sample, 0]))


def test_a_sample_depends_on_no_other_sample():
    whole, *parts, backwards, other = (
        contact_probability(SPIRAL, MODEL, samples, seed, **LATE)
        for samples, seed in ((40, 7), (range(30), 7), (range(30, 40), 7), (range(39, -1, -1), 7), (40, 8))
    )
    assert 5 < whole.contacts == sum(part.contacts for part in parts) < 35
    for name in ("sample", "time", "benches", "strays"):
        known = getattr(whole, name)
        assert np.array_equal(np.concatenate([getattr(part, name) for part in parts]), known)
        assert np.array_equal(getattr(backwards, name)[::-1], known)
    assert not np.array_equal(other.strays, whole.strays)


def test_nobody_wobbles_with_a_size_of_0():
    result = contact_probability(SPIRAL, Wobble(0.0, 0.0), 3, 1, start=400.0, stop=420.0)
    profile = clearance_profile(SPIRAL, np.linspace(400.0, 420.0, result.instants))
    first = int(np.flatnonzero(profile.clearance <= 0.0)[0])
    assert result.time.tolist() == [profile.time[first]] * 3
    assert result.benches.tolist() == [profile.benches[first].tolist()] * 3
    assert result.strays.max() < 1e-12
    assert result.probability == 1.0
    assert result.limits[1] == 1.0


@pytest.mark.parametrize("time, step, instants", [(4.0, None, 11), (100.0, None, 2), (4.0, 0.3, 28), (0.35, 0.07, 116)])
def test_instants_are_a_fifth_of_the_correlation_time_apart_or_as_asked(time, step, instants):
    result = contact_probability(SPIRAL, Wobble(correlation_time=time, step=step), 1, 1, **LATE)
    assert result.instants == instants
    assert_near(result.step, 8.0 / (instants - 1), 1e-12)


def test_clopper_and_pearson_leave_as_much_beyond_either_limit():
    from scipy.stats import binom

    low, high = clopper_pearson(7, 50)
    assert_near(binom.sf(6, 50, low), 0.5 * (1.0 - CONFIDENCE), 1e-12)
    assert_near(binom.cdf(7, 50, high), 0.5 * (1.0 - CONFIDENCE), 1e-12)


def test_a_dance_is_sampled_to_its_fold_also_on_other_pitches():
    dance = Dance(Dragon(6), Spiral(1.2, 4.0))
    shares = []
    result = contact_probability(
        dance, Wobble(0.001, 0.001, pitch_error=0.05), 20, 1, start=dance.end.time - 20.0, progress=shares.append
    )
    assert result.stop == dance.end.time
    assert result.contacts < 20
    assert np.isfinite(result.strays).all()
    assert shares[-1] == 1.0
    assert all(one < other for one, other in pairwise(shares))


@pytest.mark.parametrize("name", ["correlation_time", "step"])
def test_instants_may_not_be_so_close_that_there_are_too_many(name):
    with refused(f"model.{name}", most=10_000_000):
        contact_probability(SPIRAL, Wobble(**{name: 1e-7}), 1, 1, **LATE)


def test_of_benches_that_touch_as_they_are_nothing_is_called_proven():
    result = contact_probability(Dance(Dragon(20), Spiral()), Wobble(), 2, 1, start=411.0, stop=414.0)
    assert result.tolerance == 0.0
    assert "proven" not in result.method
