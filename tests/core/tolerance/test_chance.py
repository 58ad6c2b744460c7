"""Contact probability: against probabilities solved without sampling, and independence of samples."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from scipy.special import ndtr
from scipy.stats import binom

from core import (
    Arc,
    Budget,
    ContactProbability,
    Dance,
    Dragon,
    InvalidValue,
    Line,
    Route,
    Spiral,
    TooMuchWork,
    Wobble,
    bench_poses,
    clearance_profile,
    contact_probability,
    separation,
    trajectory,
)  # fmt: skip
from core.sampling import bisect
from core.tolerance.chance import CONFIDENCE, clopper_pearson
from core.tolerance.union_bound import union_bound
from core.tolerance.wobble import INSTANTS_PER_TIME
from core.values import Floats
from tests.support.every_digit import every_digit

SPIRAL = Dance(Dragon(20), Spiral())
# Shortly before the first contact of that dance [s].
LATE = {"start": 402.0, "stop": 410.0}
MODEL = Wobble(0.02, 0.01, 4.0, hole=0.06, pin=0.05)

# A hairpin: bench 0 is on the way back while bench 4 is on the way out, 3 m from it, both 2.8 m wide.
WIDE = Dragon.of([1.65] * 5, [2.8, 0.3, 0.3, 0.3, 2.8], [0.0] * 5)
HAIRPIN = Route([Line((-20, 0), (0, 0)), Arc((0, 1.5), 1.5, -0.5 * np.pi, np.pi), Line((0, 3), (-20, 3))])
OPPOSITE = 20.0 + 1.5 * np.pi + 1.95


def gap_of_all_alike(places: Floats, left: Floats, aside: float) -> float:
    """Gap of benches 0 and 4 on the hairpin when everybody wants to stand so far to the left [m]."""
    wanted = places + aside * left
    pins = [wanted[0]]
    for chord, want in zip(WIDE.chords.tolist(), wanted[1:], strict=True):
        way = want - pins[-1]
        pins.append(pins[-1] + way * (chord / np.hypot(*way)))
    poses = bench_poses(np.array(pins))
    return float(separation(poses[:1], (1.65, 2.8), poses[4:], (1.65, 2.8)).separation[0])


def chance_to_exceed(limits: list[float], memory: float) -> float:
    """The probability that an AR(1) process of variance 1 ever exceeds its limit of the instant, by quadrature."""
    grid = np.linspace(-6.0, 6.0, 2_401)
    width = grid[1] - grid[0]
    fresh = np.sqrt(1.0 - memory**2)
    below = np.exp(-0.5 * grid**2) / np.sqrt(2.0 * np.pi)
    step = np.exp(-0.5 * ((grid[:, None] - memory * grid) / fresh) ** 2) / (fresh * np.sqrt(2.0 * np.pi)) * width
    for k, limit in enumerate(limits):
        below = np.where(grid < limit, below if k == 0 else step @ below, 0.0)
    return 1.0 - float(below.sum() * width)


def test_the_probability_of_a_hairpin_is_that_of_its_quadrature() -> None:
    """With a long correlation along the chain all stand alike, and one number at each instant decides."""
    dance, size, stop = Dance(WIDE, HAIRPIN), 0.05, OPPOSITE + 0.5
    result = contact_probability(dance, Wobble(size, 0.0, 0.625, 1e9), 4_000, 1, start=OPPOSITE, stop=stop)
    assert result.instants == 5
    placed = trajectory(dance, np.linspace(OPPOSITE, stop, 5))
    limits = []
    for places, velocity in zip(placed.position, placed.velocity, strict=True):
        left = np.stack([-velocity[:, 1], velocity[:, 0]], axis=1) / np.hypot(*velocity.T)[:, None]
        limit = bisect(lambda aside: gap_of_all_alike(places, left, aside) <= 0.0, 0.0, 0.3)[1]  # noqa: B023
        limits.append(limit / size)
    memory = np.exp(-result.step / 0.625)
    exact = chance_to_exceed(limits, memory)
    # each instant alone is less likely, and independent instants would be more
    assert 1.0 - ndtr(min(limits)) < 0.7 * exact < 0.7 * (1.0 - np.prod(ndtr(limits)))
    assert result.limits[0] < exact < result.limits[1] < result.limits[0] + 0.02
    assert {tuple(pair) for pair in result.benches.tolist()} == {(0, 4)}
    for deviations, factor in ((4.0, 630.0), (5.0, 520.0)):  # docs/tolerance.md: far from sharp
        part = min(limits) / deviations
        rare = chance_to_exceed([limit / part for limit in limits], memory)
        bound = union_bound(dance, Wobble(part * size, 0.0, 0.625, 1e9), np.linspace(OPPOSITE, stop, 5), Budget())
        assert 0.99 * factor < bound / rare < 1.01 * factor


def test_the_probability_of_an_error_of_the_pitch_is_that_of_the_pitches_that_touch() -> None:
    """Nobody wobbles, so a dance touches if the pitch is below the one at which it would."""
    size, radius = 0.02, float(SPIRAL.path.head(LATE["start"]).radius)

    def clear(pitch: float) -> bool:
        spiral = Spiral(pitch, 20.0)
        dance = Dance(SPIRAL.dragon, spiral)
        return bool(clearance_profile(dance, spiral.travel_to(radius)).clearance > 0.0)

    least = bisect(clear, 0.5, 0.55, width=1e-6)[1]
    still = {"start": LATE["start"], "stop": LATE["start"] + 1e-6}
    result = contact_probability(SPIRAL, Wobble(0.0, 0.0, pitch_error=size), 2_000, 1, **still)
    exact = float(ndtr((least - 0.55) / size))
    assert 0.05 < exact < 0.5
    assert result.limits[0] < exact < result.limits[1]
    assert result.tolerance is None


def test_play_is_uniform_in_the_hole() -> None:
    """One bench on a line: the play sets its front hole, and how far aside its rear hole is, which is as far ahead."""
    play, samples = 0.01, 2_000
    dance = Dance(Dragon(1), Route([Line((0, 0), (20, 0))]))
    result = contact_probability(dance, Wobble(0.0, 0.0, hole=0.05, pin=0.03), samples, 1, start=5.0, stop=5.1)
    ahead, aside = np.meshgrid(*[np.linspace(-1.0, 1.0, 801)] * 2)
    for part in (0.4, 0.6, 0.8, 1.0):
        # ahead and aside of the front hole are in the disc; aside of the rear hole is the same as of any point in it
        most = np.sqrt(np.maximum(part**2 - ahead**2, 0.0))
        rear = 2.0 / np.pi * (np.arcsin(np.minimum(most, 1.0)) + most * np.sqrt(np.maximum(1.0 - most**2, 0.0)))
        exact = float(np.where(ahead**2 + aside**2 <= part**2, rear, 0.0).sum() / (ahead**2 + aside**2 <= 1.0).sum())
        low, high = clopper_pearson(int((result.strays <= part * play).sum()), samples)
        assert low - 0.002 < exact < high + 0.002  # the grid, and what is of second order in play over chord


def test_play_and_an_error_of_the_pitch_together_are_those_of_chains_laid_out_one_by_one() -> None:
    """Nobody wobbles; each dragon is laid out in Python, on its own spiral, with the play of its own pins."""
    size, model, dragon = 0.02, Wobble(0.0, 0.0, hole=0.06, pin=0.05, pitch_error=0.02), SPIRAL.dragon
    still = {"start": LATE["start"], "stop": LATE["start"] + 1e-6}
    result = contact_probability(SPIRAL, model, 300, 5, **still)
    radius, touching = float(SPIRAL.path.head(LATE["start"]).radius), []
    sizes = np.stack([dragon.lengths, dragon.widths], axis=1)
    first, second = np.triu_indices(20, 2)
    for sample in range(300):
        spiral = Spiral(0.55 + size * numbers(5, sample, 1).standard_normal(), 20.0)
        places = trajectory(Dance(dragon, spiral), spiral.travel_to(radius)).position
        distance, angle = numbers(5, sample, 0).random((2, 20, 2))
        play = np.stack([np.cos(2.0 * np.pi * angle), np.sin(2.0 * np.pi * angle)], axis=-1)
        play *= model.play * np.sqrt(distance)[..., None]
        pin, holes = places[0], []
        for k, chord in enumerate(dragon.chords.tolist()):
            front = pin + play[k, 0]
            way = places[k + 1] + play[k, 1] - front
            rear = front + way * (chord / np.hypot(*way))
            holes.append([front, rear])
            pin = rear - play[k, 1]
        held = np.array(holes)
        strays = np.hypot(*np.moveaxis(held - np.stack([places[:-1], places[1:]], axis=1), -1, 0))
        assert result.strays[sample] == pytest.approx(strays.max(), abs=1e-7)
        poses = np.concatenate([bench_poses(two) for two in held])
        gaps = separation(poses[first], sizes[first], poses[second], sizes[second]).separation
        touching += [sample] if gaps.min() <= 0.0 else []
    assert result.sample.tolist() == touching
    assert 20 < len(touching) < 200


def numbers(seed: int, sample: int, part: int) -> np.random.Generator:
    return np.random.Generator(np.random.Philox(key=seed, counter=[0, part, sample, 0]))


def test_a_sample_depends_on_no_other_sample() -> None:
    whole = contact_probability(SPIRAL, MODEL, 40, 7, **LATE)
    assert 5 < whole.contacts < 35
    order = np.r_[30:40, 0:30]
    parts = [contact_probability(SPIRAL, MODEL, some, 7, **LATE) for some in (range(30, 40), range(30))]
    assert np.concatenate([part.strays for part in parts]).tolist() == whole.strays[order].tolist()
    assert sum(part.contacts for part in parts) == whole.contacts
    values = {sample: (time, pair) for part in parts for sample, time, pair in contacts_of(part)}
    assert values == {sample: (time, pair) for sample, time, pair in contacts_of(whole)}
    backwards = contact_probability(SPIRAL, MODEL, range(39, -1, -1), 7, **LATE)
    assert backwards.strays[::-1].tolist() == whole.strays.tolist()
    assert contact_probability(SPIRAL, MODEL, 40, 8, **LATE).strays.tolist() != whole.strays.tolist()


def contacts_of(result: ContactProbability) -> list[tuple[int, float, tuple[int, ...]]]:
    return [
        (sample, time, tuple(pair))
        for sample, time, pair in zip(
            result.sample.tolist(), result.time.tolist(), result.benches.tolist(), strict=True
        )
    ]


def test_nobody_wobbles_with_a_size_of_0() -> None:
    span = {"start": 400.0, "stop": 420.0}
    result = contact_probability(SPIRAL, Wobble(0.0, 0.0), 3, 1, **span)
    times = np.linspace(400.0, 420.0, result.instants)
    profile = clearance_profile(SPIRAL, times)
    first = int(np.flatnonzero(profile.clearance <= 0.0)[0])
    assert result.time.tolist() == [times[first]] * 3
    assert result.benches.tolist() == [profile.benches[first].tolist()] * 3
    assert result.strays.max() < 1e-12
    assert (result.probability, result.limits[1]) == (1.0, 1.0)
    clear = contact_probability(SPIRAL, Wobble(0.0, 0.0), 3, 1, **LATE)
    assert (clear.contacts, clear.strayed, clear.limits[0]) == (0, 0, 0.0)


def test_only_those_who_stray_beyond_the_tolerance_touch() -> None:
    dance, model = Dance(WIDE, HAIRPIN), Wobble(0.04, 0.02, correlation_benches=20.0)
    result = contact_probability(dance, model, 400, 3, start=OPPOSITE, stop=OPPOSITE + 0.5)
    assert result.tolerance is not None
    assert 0 < result.contacts <= (result.strayed or 0) < 400
    assert result.strays[result.sample].min() > result.tolerance


@pytest.mark.parametrize(("time", "step"), [(0.7, None), (4.0, None), (100.0, None), (4.0, 0.3), (0.35, 0.07)])
def test_instants_are_a_fifth_of_the_correlation_time_apart_or_as_asked(time: float, step: float | None) -> None:
    result = contact_probability(SPIRAL, Wobble(correlation_time=time, step=step), 1, 1, **LATE)
    widest = step or time / INSTANTS_PER_TIME
    assert result.step <= widest
    assert result.instants == 2 or result.step > 0.9 * widest
    assert result.step * (result.instants - 1) == pytest.approx(8.0, abs=1e-12)


def test_clopper_and_pearson_leave_as_much_beyond_either_limit() -> None:
    low, high = clopper_pearson(7, 50)
    assert binom.sf(6, 50, low) == pytest.approx(0.5 * (1.0 - CONFIDENCE), abs=1e-12)
    assert binom.cdf(7, 50, high) == pytest.approx(0.5 * (1.0 - CONFIDENCE), abs=1e-12)


def test_a_dance_is_sampled_to_its_fold_also_on_other_pitches() -> None:
    dance = Dance(Dragon(6), Spiral(1.2, 4.0))
    shares: list[float] = []
    result = contact_probability(
        dance, Wobble(0.001, 0.001, pitch_error=0.05), 20, 1, start=dance.end.time - 20.0, progress=shares.append
    )
    assert result.stop == dance.end.time
    assert result.contacts < 20
    assert np.isfinite(result.strays).all()
    assert shares[-1] == 1.0
    assert all(one < other for one, other in pairwise(shares))


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"samples": 0}, "samples must be a whole number from 1 to 10000000, or a range"),
        ({"samples": 10**9}, "samples must be a whole number from 1 to 10000000, or a range"),
        ({"samples": range(-1, 3)}, "samples must be a whole number"),
        ({"samples": 1.5}, "samples must be a whole number"),
        ({"seed": -1}, "seed must be a whole number from 0 to"),
        ({"model": 0.01}, "model must be a Wobble, got 0.01"),
        ({"model": Wobble(correlation_time=1e-7)}, "model.correlation_time must be at least 4e-06 s"),
        (
            {"model": Wobble(step=1e-7)},
            "model.step must be at least 8e-07 s, got 1e-07 s: a dance has at most 10000000 instants",
        ),
        ({"model": Wobble(lateral=0.3)}, "model.lateral must be at most 0.1 of the chord"),
    ],
    ids=[
        "none",
        "too many",
        "negative number",
        "half a sample",
        "seed",
        "no model",
        "too many instants",
        "too close instants",
        "too wide",
    ],
)
def test_what_cannot_be_is_refused(changes: dict[str, Any], message: str) -> None:
    request: dict[str, Any] = {"model": MODEL, "samples": 1, "seed": 1} | changes
    with pytest.raises(InvalidValue) as refused:
        contact_probability(SPIRAL, **request, **LATE)
    assert refused.value.message.startswith(message)


def test_a_budget_ends_it() -> None:
    with pytest.raises(TooMuchWork, match="the probability of a contact was not found within 1000 steps"):
        contact_probability(SPIRAL, MODEL, 100, 1, budget=Budget(1000.0), **LATE)
    with pytest.raises(TooMuchWork, match=r"dragon\.benches must be fewer, or .* shorter, got 20: the prob"):
        contact_probability(SPIRAL, MODEL, 1, 1, budget=Budget(100.0), start=300.0, stop=400.0)
    stopped = Budget()
    stopped.stop()
    with pytest.raises(TooMuchWork, match="was not found before it was stopped"):
        contact_probability(SPIRAL, MODEL, 100, 1, budget=stopped, **LATE)


def test_the_answer_in_one_line() -> None:
    result = contact_probability(SPIRAL, MODEL, 10, 7, **LATE)
    assert repr(result).startswith(f"<ContactProbability: {result.probability:g}, between ")
    assert every_digit(result)["seed"] == 7


def test_of_benches_that_touch_as_they_are_nothing_is_called_proven() -> None:
    result = contact_probability(Dance(Dragon(20), Spiral()), Wobble(), 2, 1, start=411.0, stop=414.0)
    assert result.tolerance == 0.0
    assert "proven" not in result.method
