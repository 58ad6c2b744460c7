"""The bound without samples: its first order and the remainder, against chains drawn at random."""

import numpy as np
import pytest

from core import Budget, Dance, Dragon, Spiral, Wobble, contact_probability, trajectory
from core.tolerance.union_bound import first_order, left_out, union_bound
from tests.core.tolerance.test_chance import correlate, laid_out
from tests.support.slow_search import in_plane

DANCE = Dance(Dragon(12), Spiral())
TIMES = np.array([300.0, 340.0])
PLACED = trajectory(DANCE, TIMES)
TANGENTS = PLACED.velocity / PLACED.speed[..., None]
COUNT = 10_000


def chains(model):
    """The first order, then of COUNT chains drawn at random at the last instant: e_k, its first order (COUNT, n + 1, 2)
    and, in first order, the four numbers of every bench that are assumed to be small (COUNT, n, 4) [m]."""
    rng = np.random.default_rng(1)
    chords = DANCE.dragon.chords
    places = PLACED.position[-1] @ [1.0, 1j]
    ahead = TANGENTS[-1] @ [1.0, 1j]
    z = rng.standard_normal((COUNT, len(places), 2))
    correlate(z, model.along)
    wants = (z @ [1j * model.lateral, model.forward]) * ahead
    linear = [wants[:, 0]]
    small = []
    for k, chord in enumerate(chords.tolist()):
        u = (places[k] - places[k + 1]) / chord
        e, want = linear[k] / u, wants[:, k + 1] / u  # along and across the chord
        small.append(in_plane(np.stack([e, want - e], axis=1)).reshape(COUNT, 4))
        linear.append((e.real + 1j * want.imag) * u)
    laid = first_order(DANCE.dragon, model, PLACED.position, TANGENTS)
    front, rear = laid_out((places + wants).T, chords)
    strays = np.concatenate([front[:1], rear]).T - places
    return laid, in_plane(strays), in_plane(np.stack(linear, axis=1)), np.stack(small, axis=1)


def test_chains_drawn_at_random_have_the_covariances_of_the_first_order():
    model = Wobble(2e-5, 1e-5)
    laid, strays, linear, small = chains(model)
    # so small that the first order is nearly all
    np.testing.assert_allclose(strays, linear, rtol=0.0, atol=1e-8)
    both = np.concatenate([strays[:, :-1], strays[:, 1:]], axis=2)
    drawn = np.einsum("ski,skj->kij", both, both) / COUNT
    size = np.sqrt(np.einsum("kii->ki", laid.joint[-1]))
    relative = (drawn - laid.joint[-1]) / (size[:, :, None] * size[:, None])
    assert np.abs(relative).max() < 6.0 / np.sqrt(COUNT)
    assert small.std(axis=0) == pytest.approx(laid.deviations[-1], rel=6.0 / np.sqrt(2 * COUNT))


@pytest.mark.parametrize("size", [0.002, 0.01])
def test_no_chain_within_the_assumption_leaves_its_first_order_by_more_than_the_bounds(size):
    laid, strays, linear, small = chains(Wobble(size, size))
    deviations = 2.5
    bounds = left_out(DANCE.dragon, laid, deviations)
    rest = strays - linear
    ways = np.stack([laid.along[-1], laid.across[-1]], axis=1)
    front, rear = (np.einsum("ski,kfi->skf", part, ways) for part in (rest[:, :-1], rest[:, 1:]))
    beyond = np.abs(np.concatenate([front, rear], axis=2)) / np.maximum(bounds[-1], 1e-15)
    held = (np.abs(small) <= deviations * laid.deviations[-1]).all(axis=(1, 2))
    assert 0.1 < held.mean() < 0.9
    assert 0.2 < beyond[held].max() <= 1.0
    assert beyond.max() > 1.0  # others do leave it


def test_nothing_is_claimed_of_steep_turns():
    laid = chains(Wobble(0.1, 0.1))[0]
    assert left_out(DANCE.dragon, laid, 8.0) is None
    assert union_bound(DANCE, Wobble(0.1, 0.1), TIMES, Budget()) == 1.0


def test_the_bound_grows_with_the_wobble_and_holds_of_every_sample():
    span = {"start": 384.0, "stop": 394.0}
    bounds = []
    for size in (0.0003, 0.001, 0.002, 0.004, 0.03):
        result = contact_probability(DANCE, Wobble(size, size), 200, 1, **span)
        assert result.limits[0] <= result.union_bound
        bounds.append(result.union_bound)
    assert bounds[0] < 1e-9
    assert bounds == sorted(bounds)
    assert bounds[-1] == 1.0
    assert 1e-6 < bounds[3] < 1e-3
