"""Cubics, divided until the kernels' quadrature is exact on each piece and tight bounds enclose its curvature.

The curvature of r(t) = (x, y) on [0, e] is k = T / F^(3/2) with T = x' y'' - y' x'' (of degree 2, as its cubes cancel)
and F = x'^2 + y'^2 (of degree 4), so
    k' = D / F^(5/2),   D = T' F - 3/2 T F'   (of degree 5),   and   dk / ds = k' / F^(1/2).
A polynomial is between the least and the largest of its Bernstein coefficients. If those of D do not change sign, the
curvature is monotonic and between the values at its ends, as on a spiral. Else k' is in [a, b], a < 0 < b, and k is
below both k0 + b t and k1 - a (e - t), which meet at the height (b k1 - a k0 - a b e) / (b - a); the lower bound is
found in the same way. Near a crest a and b fall as e, so the excess over the ends falls as e^2 and few cuts are enough.
"""

from __future__ import annotations

from math import comb

import numpy as np

from core import kernels
from core.errors import InvalidValue
from core.kernels import Budget
from core.kernels.constants import K_END, K_SLOPE, K_START, PIECE_KIND, S_END, T_END, X0, X3, Y0, Y3
from core.values import Floats

# A cubic is divided until halving it changes its quadrature by less than this [1] ...
CUBIC_ARC = 1e-13
# ... and its curvature is monotonic, or its bounds exceed the ends by less than this [1/m] or this fraction [1].
CREST_EXCESS = 0.01
# A squared speed below this part of the largest one on its cubic is only rounding [1].
SPEED_ROUNDING = 1e-15
# Shortest cubic [m]: a shorter one that is not yet exact comes to rest or turns on the spot. The lengths of its halves
# differ by a factor of at most 16, so no cubic is shorter than 6e-7 m: ten times the rounding of an arc length on a
# curve of 4e8 m.
CUBIC_SHORT = 1e-5
# Largest number of cubics in one curve: a zigzag of 1,000 points has 6,000; 34,000 were made in 0.07 s (measured
# 2026-11-21).
CUBICS_MAX = 100_000

# In place of the kind of a cubic that must be divided.
DIVIDED = -1.0


def cut(name: str, coefficients: Floats, ends: Floats, budget: Budget) -> Floats:
    """Rows of the kernels' table for cubics r(t) = sum c_k t^k on [0, end], in order, each divided as often as needed.

    coefficients: (N, 4, 2), ends: (N,); returns (rows, PIECE_COLUMNS), each from S_START 0 to S_END, its length
    raises: InvalidValue (name) if a curve comes to rest or needs more than CUBICS_MAX; Halted
    """
    piece, place = np.arange(len(ends)), np.zeros(len(ends))
    lengths = _arcs(coefficients, ends)
    done: list[Floats] = []
    order: list[tuple[Floats, Floats]] = []
    while len(ends):
        budget.afford(float(len(ends)))
        half = 0.5 * ends
        halves = np.stack([coefficients, _shifted(coefficients, half)], axis=1)
        arcs = _arcs(halves.reshape(-1, 4, 2), np.repeat(half, 2)).reshape(-1, 2)
        kinds, bounds, slopes = _curvatures(coefficients, ends)
        whole = (np.abs(lengths - arcs.sum(axis=1)) <= CUBIC_ARC * lengths) & (kinds != DIVIDED)
        rows = _rows(coefficients[whole], ends[whole])
        rows[:, PIECE_KIND], rows[:, S_END], rows[:, K_SLOPE] = kinds[whole], lengths[whole], slopes[whole]
        rows[:, K_START : K_END + 1] = bounds[whole]
        done.append(rows)
        order.append((piece[whole], place[whole]))
        left = ~whole
        if (lengths[left] < CUBIC_SHORT).any():
            k = int(piece[left][lengths[left] < CUBIC_SHORT].min())
            rule = "must not make the curve stop or turn on the spot, as between points {first} and {second}"
            raise InvalidValue(name, rule, first=k, second=k + 1)
        if sum(map(len, done)) + 2 * int(left.sum()) > CUBICS_MAX:
            raise InvalidValue(name, "must make a curve of at most {most} cubics: take fewer points", most=CUBICS_MAX)
        coefficients, ends = halves[left].reshape(-1, 4, 2), np.repeat(half[left], 2)
        lengths, piece = arcs[left].reshape(-1), np.repeat(piece[left], 2)
        place = (place[left, None] + half[left, None] * [0.0, 1.0]).reshape(-1)
    pieces, places = map(np.concatenate, zip(*order, strict=True))
    table: Floats = np.concatenate(done)[np.lexsort((places, pieces))]
    return table


def _rows(coefficients: Floats, ends: Floats) -> Floats:
    """Rows with the columns of the curve alone."""
    rows = np.zeros((len(ends), kernels.PIECE_COLUMNS))
    rows[:, X0 : X3 + 1], rows[:, Y0 : Y3 + 1], rows[:, T_END] = coefficients[..., 0], coefficients[..., 1], ends
    return rows


def _arcs(coefficients: Floats, ends: Floats) -> Floats:
    arcs = np.empty(len(ends))
    kernels.cubic_arcs(_rows(coefficients, ends), arcs)
    return arcs


def _shifted(coefficients: Floats, t: Floats) -> Floats:
    """Coefficients of r(t + u) in u. (N, 4, 2), t (N,)"""
    c0, c1, c2, c3 = np.moveaxis(coefficients, 1, 0)
    t = t[:, None]
    shifted: Floats = np.stack(
        [c0 + t * (c1 + t * (c2 + t * c3)), c1 + t * (2 * c2 + 3 * t * c3), c2 + 3 * t * c3, c3], 1
    )
    return shifted


def _curvatures(coefficients: Floats, ends: Floats) -> tuple[Floats, Floats, Floats]:
    """Kind of every cubic, -1 if it must be divided; two curvatures (N, 2) [1/m]; bound on |dk / ds| [1/m^2].

    The curvature of a 'cubic' is monotonic, and the two are those of its ends; for a 'crest' they are bounds.
    """
    # In u = t / end, which does not change curvatures.
    _, c1, c2, c3 = np.moveaxis(coefficients * ends[:, None, None] ** np.arange(4)[:, None], 1, 0)
    first, second = np.stack([c1, 2 * c2, 3 * c3], axis=1), np.stack([2 * c2, 6 * c3], axis=1)
    cross = (_product(first[..., 0], second[..., 1]) - _product(first[..., 1], second[..., 0]))[:, :3]
    fast = _product(first[..., 0], first[..., 0]) + _product(first[..., 1], first[..., 1])
    change = _bernstein(_product(_derivative(cross), fast) - 1.5 * _product(cross, _derivative(fast)))
    speeds = _bernstein(fast)
    slowest = speeds.min(axis=1)
    moves = slowest > SPEED_ROUNDING * speeds.max(axis=1)
    slowest[~moves], fast[~moves] = 1.0, np.eye(1, 5)  # these are divided in any case
    k0, k1 = cross[:, 0] / fast[:, 0] ** 1.5, cross.sum(axis=1) / fast.sum(axis=1) ** 1.5
    least, most = change.min(axis=1) / slowest**2.5, change.max(axis=1) / slowest**2.5
    monotonic = (least >= 0.0) | (most <= 0.0)
    span = np.where(monotonic, 1.0, most - least)
    high = np.where(monotonic, k1, (most * k1 - least * k0 - least * most) / span)
    low = np.where(monotonic, k0, (most * k0 - least * k1 + least * most) / span)
    excess = np.maximum(high - np.maximum(k0, k1), np.minimum(k0, k1) - low)
    near = monotonic | (excess <= CREST_EXCESS * np.maximum(1.0, np.maximum(np.abs(k0), np.abs(k1))))
    kinds = np.where(monotonic, kernels.CUBIC, kernels.CREST)
    slopes = np.maximum(most, -least) / np.sqrt(slowest)
    return np.where(moves & near, kinds, DIVIDED), np.stack([low, high], axis=1), slopes


# Own code for all cubics at once: numpy's polymul takes one pair at a time, 45 times as long for 1,000 pairs, and
# scipy's BPoly.from_power_basis takes 13 to 20 times as long (a curve through five points 1.8 ms instead of 1.1 ms,
# measured 2026-11-21).
def _product(a: Floats, b: Floats) -> Floats:
    """Product of polynomials with coefficients (N, n + 1) and (N, m + 1), the constant first; returns (N, n + m + 1)"""
    product = np.zeros((len(a), a.shape[1] + b.shape[1] - 1))
    for k in range(b.shape[1]):
        product[:, k : k + a.shape[1]] += a * b[:, k, None]
    return product


def _derivative(a: Floats) -> Floats:
    return a[:, 1:] * np.arange(1.0, a.shape[1])


def _bernstein(a: Floats) -> Floats:
    """Bernstein coefficients on [0, 1]. (N, n + 1)"""
    n = a.shape[1] - 1
    weights = np.array([[comb(k, i) / comb(n, i) for k in range(n + 1)] for i in range(n + 1)])
    coefficients: Floats = a @ weights
    return coefficients
