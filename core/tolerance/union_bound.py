"""An upper bound of the probability of a contact when people wobble, without any sample: a union of unlikely events.

It holds for the same instants as the samples (core/tolerance/chance.py), for pins without play and the exact pitch.

The chain, in first order. In the symbols of core/kernels/wobble.py let e_k be the displacement of handle k from its
place, d_k the displacement that person k wants, u the direction of bench k from handle k + 1 to handle k, n across it,
c its chord, and v = d_{k+1} - e_k. The chord keeps its length and turns by psi, with sin psi = (n . v) / |v - c u|, so
that exactly
    e_{k+1} = e_k + (n . v) n + s,    |u . s| = c (1 - cos psi),    |n . s| = |n . v| |c / |v - c u| - 1|.
Without s, e is linear in normal numbers, e_{k+1} = u (u . e_k) + n (n . d_{k+1}), and its covariance follows along the
chain, together with that of e_k and z_k, the numbers behind d_k, whose correlation from person to person is known.

The remainder. Assume that u . e_k, n . e_k, u . v and n . v, in first order, are all within m of their standard
deviations. Then with p and q, bounds of the remainder of e_k beyond its first order, along and across bench k,
    |u . v| <= V = m sd(u . v) + p,    |n . v| <= W = m sd(n . v) + q,
    |u . s| <= c (1 - sqrt(1 - (W / (c - V))^2)),    |n . s| <= W max(V / (c - V), (V + W^2 / (2 c)) / c),
as c - V <= |v - c u| <= c + V + W^2 / (2 c). So along the chain p grows by |u . s|. The bound q is that of n . s alone,
because the displacement that the next person wants replaces that of e_k across the bench. Both turn with the next
bench.

The pairs. Let g be the gap of a corner of one bench and a corner of another along the normal of their separation. The
benches stay apart while no two such corners approach along this normal by their g. A corner z moves by
e_k (1/2 + z / c) + e_{k+1} (1/2 - z / c) (core/shapes/reach.py): along the normal by a normal number with a known
standard deviation, plus at most the remainder. Two such numbers, whatever their correlation, differ by a normal number
whose standard deviation is at most the sum of theirs. Pairs too far apart for their corners to meet within the
assumption are skipped.

The bound is the sum of the probabilities of all these events: 2 Q(m) for each number assumed to be within m deviations,
and Q((g - remainder) / deviation) for each pair of corners. The result is the least over some m, computed in doubles.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from core.dance import Dance
from core.dragon import Dragon
from core.errors import TooLarge
from core.kernels import Budget
from core.motion.trajectory import trajectory
from core.shapes.reach import gains
from core.shapes.rectangles import CENTRE, CORNER_SIDES, bench_poses, frames, frames_separation, meeting_pairs
from core.tolerance.wobble import Wobble
from core.values import Floats

# Numbers m of standard deviations that are tried [1], and number of quantities of a bench assumed to be within them
# [1].
DEVIATIONS = (8.0, 7.0, 6.0, 5.0)
NUMBERS = 4
# Largest sine of the rotation of a bench, and largest displacement relative to its chord, at which the bound is used
# [1].
STEEPEST = 0.5
# Number of benches, over all instants, whose covariances are held at once [1]: 64 MB.
BENCHES_TOGETHER = 250_000
# Subtracted from gaps and added to deviations, far above the rounding of places up to 1e4 m [m].
ROUNDING = 1e-9


@dataclass(frozen=True)
class FirstOrder:
    """A dragon in first order at some instants.

    along, across: (T, n, 2) u and n of every bench; joint: (T, n, 4, 4) covariance of its e_k and e_{k+1} [m^2]
    deviations: (T, n, 4) of u . e_k, n . e_k, u . v and n . v [m]
    """

    along: Floats
    across: Floats
    joint: Floats
    deviations: Floats


def union_bound(dance: Dance, model: Wobble, times: Floats, budget: Budget) -> float:
    """Upper bound of the probability that two benches touch at one of some instants (T,) [s]; 1 if no bound is known.

    raises: Halted
    """
    from scipy.special import ndtr  # type: ignore[import-untyped]

    least, together = 1.0, max(1, BENCHES_TOGETHER // dance.dragon.benches)
    for deviations in DEVIATIONS:
        # the probability that the assumption fails for one of the benches, at most
        bound = 2.0 * NUMBERS * (times.size * dance.dragon.benches) * float(ndtr(-deviations))
        if bound >= least:
            break
        for first in range(0, times.size, together):
            placed = trajectory(dance, times[first : first + together])
            budget.afford(float(placed.speed.size))
            laid = first_order(dance.dragon, model, placed.position, placed.velocity / placed.speed[..., None])
            bound += _meeting(dance.dragon, placed.position, laid, deviations, budget)
            if bound >= least:
                break
        least = min(least, bound)
    return least


def first_order(dragon: Dragon, model: Wobble, places: Floats, tangents: Floats) -> FirstOrder:
    """The chain in first order. places, tangents: (T, n + 1, 2) of the handles"""
    link = places[:, :-1] - places[:, 1:]
    along = link / np.hypot(link[..., 0], link[..., 1])[..., None]
    across = np.stack([-along[..., 1], along[..., 0]], axis=-1)
    left = np.stack([-tangents[..., 1], tangents[..., 0]], axis=-1)
    wants = np.stack([model.lateral * left, model.forward * tangents], axis=-1)  # d_k = wants z_k
    joint, deviations = np.empty((*along.shape[:2], 4, 4)), np.empty((*along.shape[:2], 4))
    with_z = wants[:, 0]
    covariance = with_z @ with_z.swapaxes(1, 2)
    for k in range(dragon.benches):
        u, n, want = along[:, k], across[:, k], wants[:, k + 1]
        kept, taken = u[:, :, None] * u[:, None], n[:, :, None] * n[:, None]
        z_next = model.along * with_z  # covariance of e_k with z_{k+1}
        mixed = z_next @ want.swapaxes(1, 2)  # of e_k with d_{k+1}
        wanted = want @ want.swapaxes(1, 2)
        onward = covariance @ kept + mixed @ taken  # of e_k with e_{k+1}
        following = kept @ onward + taken @ (mixed.swapaxes(1, 2) @ kept + wanted @ taken)
        joint[:, k, :2, :2], joint[:, k, :2, 2:] = covariance, onward
        joint[:, k, 2:, :2], joint[:, k, 2:, 2:] = onward.swapaxes(1, 2), following
        spread = wanted + covariance - mixed - mixed.swapaxes(1, 2)  # of v
        for column, (way, of) in enumerate(((u, covariance), (n, covariance), (u, spread), (n, spread))):
            deviations[:, k, column] = np.einsum("ti,tij,tj->t", way, of, way)
        with_z, covariance = kept @ z_next + taken @ want, following
    return FirstOrder(along, across, joint, np.sqrt(np.maximum(deviations, 0.0)))


def left_out(dragon: Dragon, laid: FirstOrder, deviations: float) -> Floats | None:
    """Bounds (T, n, 4) of e_k and e_{k+1} minus their first order, along and across bench k [m].

    None where the assumption allows a rotation beyond STEEPEST
    """
    bounds = np.zeros_like(laid.deviations)
    p = q = np.zeros(len(bounds))
    for k, chord in enumerate(dragon.chords.tolist()):
        if k:
            cosine = np.abs((laid.along[:, k] * laid.along[:, k - 1]).sum(axis=1))
            sine = np.abs((laid.along[:, k] * laid.across[:, k - 1]).sum(axis=1))
            p, q = cosine * p + sine * q, sine * p + cosine * q
        v = deviations * laid.deviations[:, k, 2] + p
        w = deviations * laid.deviations[:, k, 3] + q
        if max(float(v.max()) / chord, float((w / np.abs(chord - v)).max())) > STEEPEST:
            return None
        bounds[:, k, 0], bounds[:, k, 1] = p, q
        p = p + chord * (1.0 - np.sqrt(1.0 - (w / (chord - v)) ** 2))
        q = w * np.maximum(v / (chord - v), (v + 0.5 * w * w / chord) / chord)
        bounds[:, k, 2], bounds[:, k, 3] = p, q
    return bounds


def _meeting(dragon: Dragon, places: Floats, laid: FirstOrder, deviations: float, budget: Budget) -> float:
    """Probability that two benches touch at one of these instants and the assumption holds, at most; 1 if nothing is
    known of it. places: (T, n + 1, 2) [m]"""
    from scipy.special import ndtr

    bounds = left_out(dragon, laid, deviations)
    if bounds is None:
        return 1.0
    along, across, _, turning = np.moveaxis(deviations * laid.deviations, -1, 0)
    # Along the bench, e_{k+1} equals e_k; across it, it equals the sum of e_k and v.
    front = np.hypot(along + bounds[..., 0], across + bounds[..., 1])
    rear = np.hypot(along + bounds[..., 2], across + turning + bounds[..., 3])
    furthest = (gains(dragon) * np.maximum(front, rear)).max(axis=1)
    sizes, chance = np.stack([dragon.lengths, dragon.widths], axis=1), 0.0
    for t, handles in enumerate(places):
        frame = frames(bench_poses(handles), sizes)
        try:
            pairs = meeting_pairs(frame, 2.0 * float(furthest[t]), True, exact=True, budget=budget)
        except TooLarge:  # so many pairs that their sum would say nothing
            return 1.0
        budget.afford(float(len(handles) + len(pairs)))
        nearest = frames_separation(frame[pairs[:, 0]], frame[pairs[:, 1]])
        if (nearest.separation <= 0.0).any():
            return 1.0
        apart = ((frame[pairs[:, 1], CENTRE] - frame[pairs[:, 0], CENTRE]) * nearest.normal).sum(axis=1)
        first, second = (_corners(dragon, laid, bounds, t, pairs[:, side], nearest.normal) for side in (0, 1))
        gap = apart[:, None, None] + second.place[:, None] - first.place[:, :, None] - ROUNDING
        gap -= first.left_out[:, :, None] + second.left_out[:, None]
        chance += float(ndtr(-gap / (first.deviation[:, :, None] + second.deviation[:, None] + ROUNDING)).sum())
    return min(1.0, chance)


class _Corners(NamedTuple):
    """Corners of benches along a normal, (P, 4): their places from the centres, the standard deviations of how far they
    go, and what is left out of that at most [m]."""

    place: Floats
    deviation: Floats
    left_out: Floats


def _corners(
    dragon: Dragon, laid: FirstOrder, bounds: Floats, t: int, benches: NDArray[np.int64], normal: Floats
) -> _Corners:
    """Corners of benches (P,) at instant t along normals (P, 2). bounds: as left_out() returns"""
    half = 0.5 * np.stack([dragon.lengths, dragon.widths], axis=1)[benches]
    own = half[:, None] * CORNER_SIDES
    z, u = own[..., 0] + 1j * own[..., 1], laid.along[t, benches]
    facing = (normal[:, 0] - 1j * normal[:, 1])[:, None]  # its product with a point has the place along the normal as
    place = (facing * (u[:, 0] + 1j * u[:, 1])[:, None] * z).real  # its real part
    z = z / dragon.chords[benches, None]
    pulls = np.stack([facing * (0.5 + z), facing * (0.5 - z)], axis=-1)
    weights = np.stack([pulls.real, -pulls.imag], axis=-1)  # (P, corner, hole, x and y)
    ways = np.stack([u, laid.across[t, benches]], axis=1)
    parts = np.abs(np.einsum("pchi,pfi->pchf", weights, ways)).reshape(len(benches), 4, 4)
    weights = weights.reshape(len(benches), 4, 4)
    variance = np.einsum("pci,pij,pcj->pc", weights, laid.joint[t, benches], weights)
    return _Corners(place, np.sqrt(np.maximum(variance, 0.0)), np.einsum("pcf,pf->pc", parts, bounds[t, benches]))
