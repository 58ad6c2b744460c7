"""Boxes of turns that no dragon can dance, because in each of their turns a bench cannot follow or the path meets
itself.

Input:  boxes with what closed forms say about their turns (turn_boxes.py); the dragon.
Output: the boxes that hold no turn that can be danced.

Arcs of half a circle. Let an arc of radius r turn by pi or more, and a chord c be longer than 2 r ROUTE_SINE_LIMIT. If
2 r >= c, both handles of a bench fit on the arc, and its rear handle goes at acos(sqrt(1 - (c / 2 r)^2)) to it: less
than REAR_COSINE_LEAST. If 2 r < c, let h be the last half circle of the first arc, or the first one of the second arc,
with the ends p and q; q, or p, is then the tangent point M. The line pq divides the plane in the side of h and the
other one.
    First arc: with the rear handle at p, the front handle is at the first place x ahead at the distance c,
    beyond M, where the path bends away. A curve of curvature 1 / R or less that begins across a line meets it again no
    nearer than 2 R. So x is on the other side, if 2 r + 2 R >= c, and the point of the circle of h that is furthest
    from x, behind its centre, is on h: a place nearer than p and further than c, and the rear handle would have been
    beyond p.
    Second arc: with the front handle at q, the rear handle is at the last place y behind at the distance c,
    before M, on the other side for the same reason. The direction of travel at q leads to that side, so u . T is
    negative: the rear handle would go backwards.
Hairpins. Let both arcs be so tight that no place of them is a chord c away from the exit X: they are within 2 r1 + 2 r2
of it. With the front handle at X, the rear handle is on the coil inwards, at the first place R that is c away. If
(X - R) . T is 0 or less for all places R that may be it, T the direction of travel at X, the front handle would go
backwards. R and X depend on the ends of the turn alone, so this holds for large boxes, whatever the arcs do. That
2 r1 + 2 r2 < c is known if r2 is less than c / (2 + 2 q) for the largest ratio q of the box (turn_boxes.py: tighter).
The same holds for the turn danced backwards: with the rear handle at E, it would go backwards.
All other proofs: core/kernels/turn_refusal.py.

An angle that is followed below 0 or above 2 pi is 2 pi larger or smaller in truth (turn_boxes.py). So a box may hold
two families of turns for each arc, and each is to be refused.
"""

from __future__ import annotations

import math
from functools import partial
from itertools import product
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from core import kernels
from core.checks import SIZE_MIN
from core.design.spans import Span
from core.design.turn_boxes import ROUNDING, Turns, tighter
from core.dragon import Dragon
from core.kernels import constants as columns
from core.sampling import bisect
from core.values import Floats

# Most by which the angle of an arc may differ in a box that is looked at [rad].
ANGLE_MOST = 1.0
# Parts of the coil inwards on which a rear handle is looked for.
HAIRPIN_PARTS = 12


class Around(NamedTuple):
    """Numbers that differ from `at` by `half` at most, (N,)."""

    at: Floats
    half: Floats

    def reversed(self) -> Around:
        """The numbers with the other sign."""
        return Around(-self.at, self.half)


class TurnRefusal:
    """Proofs that no turn of a box can be danced.

    growth: of the coils [m/rad]
    """

    def __init__(self, dragon: Dragon, growth: float) -> None:
        self.growth = growth
        self.chords = np.unique(dragon.chords[: dragon.uniform_from + 1])[::-1].copy()
        bodies = slice(1, None) if dragon.benches > 1 else slice(None)
        narrowest = 0.5 * float(dragon.widths[bodies].min())
        held = np.minimum(0.5 * dragon.widths, dragon.overhangs)[[0, -1]]
        ends = dragon.chords[[0, -1]]
        longest = dragon.chords[bodies].max()
        reach = dragon.chords.sum() - 2.0 * longest  # of a dragon, along any path, less a bench at each end
        self.benches = np.array([*ends, longest, *(held + narrowest), reach])
        self.box = kernels.TurnBox(growth, columns.REAR_COSINE_LEAST)

    def least_ends(self, radius: float) -> tuple[float, float]:
        """Radii within which no turn begins, and none ends, up to that of the circle [m].

        On the coil inwards a bench with its front handle there would go backwards; on the coil outwards one with its
        rear handle there stands across the path. Both are shown at one radius, which all deeper turns pass.
        """

        def cosine(at: float, chord: float) -> float:
            """u . T at the handle that is further in [1], see core/kernels/fold.py."""
            theta, long = at / self.growth, chord / self.growth
            delta = float(kernels.first_root(theta, long**2))
            if delta <= 0.0:
                return -1.0
            slope = delta + theta * (1.0 - math.cos(delta)) + theta * (theta + delta) * math.sin(delta)
            slope -= (2.0 * theta + delta) * (1.0 - math.cos(delta))
            return slope / (long * math.hypot(1.0, theta))

        def is_beyond(chord: float, limit: float, at: float) -> bool:
            return cosine(at, chord) > limit

        ends = []
        for limit in (-ROUNDING, columns.REAR_COSINE_LEAST - ROUNDING):
            found = SIZE_MIN
            for chord in self.chords.tolist():
                if cosine(SIZE_MIN, chord) <= limit < cosine(radius, chord):
                    beyond = partial(is_beyond, chord, limit)
                    found = max(found, bisect(beyond, SIZE_MIN, radius, width=1e-6)[0])
            ends.append(found)
        return ends[0], ends[1]

    def hairpins(self, centres: Floats, halves: Floats) -> NDArray[np.bool_]:
        """Boxes of hairpins in all of whose turns a bench would go backwards at the exit, or at the entry, (N,)."""
        entry, turned, log_ratio = centres
        leaving = entry + self.growth * turned
        own, spread = halves[0], halves[0] + self.growth * halves[1]
        sizes = 2.0 + 2.0 * np.exp(log_ratio + halves[2])
        found = np.zeros(entry.size, dtype=np.bool_)
        for chord in self.chords.tolist():
            look = np.flatnonzero(tighter(self.growth, centres, halves, (chord - ROUNDING) / sizes)[0] & ~found)
            inner, outer = Around(entry[look], own[look]), Around(leaving[look], spread[look])
            around = Around(turned[look], halves[1, look])
            at_exit = self._backwards(inner, outer, around, chord)
            found[look] = at_exit | self._backwards(outer, inner, around.reversed(), chord)
        return found

    def _backwards(self, inner: Around, outer: Around, turned: Around, chord: float) -> NDArray[np.bool_]:
        """Where the front handle goes backwards at the exit, with the rear one on the coil inwards, (N,).

        inner, outer: radii of the entry and the exit [m]; turned: polar angle between them, as v of the boxes [rad]
        """
        theta = np.maximum(outer.at - outer.half, 0.0) / self.growth
        ways = turned.half + outer.half / (self.growth * (1.0 + theta * theta))  # of directions at the exit [rad]
        moved = inner.half + outer.half + (np.maximum(outer.at, 0.0) + outer.half) * turned.half
        left = -outer.at * np.exp(1j * turned.at)
        direction = -(self.growth + 1j * outer.at) * np.exp(1j * turned.at)
        direction /= np.abs(direction)
        apart = np.abs(left - inner.at) + moved
        far = (chord + apart + 2.0 * moved) / np.maximum(inner.at, SIZE_MIN)
        steep = np.hypot(self.growth, inner.at + inner.half + self.growth * far)
        begin = np.maximum(chord - apart, 0.0) / steep
        part = (far - begin) / HAIRPIN_PARTS
        worst, reached = np.full(far.size, -np.inf), np.zeros(far.size, dtype=np.bool_)
        for k in range(HAIRPIN_PARTS):
            angle = begin + (k + 0.5) * part
            way = left - (inner.at + self.growth * angle) * np.exp(1j * angle)
            error = 0.5 * part * steep + moved
            size = np.abs(way)
            cosine = (way * direction.conj()).real + error + (size + error) * ways
            worst = np.where(reached, worst, np.maximum(worst, cosine))
            reached |= size - error >= chord
        are_coils = np.minimum(inner.at - inner.half, outer.at - outer.half) > SIZE_MIN
        return np.asarray(are_coils & reached & (worst < -ROUNDING))

    def refused(
        self, turns: Turns, centres: Floats, halves: Floats, proofs: Floats, longest: float
    ) -> NDArray[np.bool_]:
        """Boxes none of whose turns is shorter than `longest` [m] and can be danced, (N,).

        proofs: (N, columns.PROOF_COLUMNS) of the proofs that held for larger boxes, and of these ones afterwards
        """
        count = centres.shape[1]
        refused = np.ones(count, dtype=np.bool_)
        for first, second in product((0, 1), (0, 1)):
            rows, held, usable, angles = self.family(turns, centres, halves, (first, second))
            length = np.maximum(rows[:, columns.TURN_LOW : columns.TURN_LOW + 2], 0.0).sum(axis=1)
            held &= ~(length >= longest) & ~self._half_circles(turns, centres[0] - halves[0], angles)
            look = np.flatnonzero(held & usable & refused)
            is_own = not first and not second
            known = np.ascontiguousarray(proofs[look]) if is_own else np.zeros((look.size, columns.PROOF_COLUMNS))
            kernels.refuse_turns(np.ascontiguousarray(rows[look]), self.chords, self.benches, known, self.box)
            if is_own:
                proofs[look] = known
            refused &= ~held
            refused[look] = known[:, columns.PROOF_KIND] > 0.0
        return refused

    def _half_circles(self, turns: Turns, entries: Floats, angles: list[Span]) -> NDArray[np.bool_]:
        """Boxes in all of whose turns an arc of half a circle is too tight for a chord, (N,).

        entries: least entry radius of each box [m]; angles: of the family of turns [rad]
        """
        found = np.zeros(turns.whole.size, dtype=np.bool_)
        for k, coil in enumerate((turns.exit.low, entries)):
            turned = np.maximum(coil, 0.0) / self.growth
            bend = (2.0 + turned**2) * (1.0 + turned**2) ** -1.5 / self.growth
            both = 2.0 * (turns.radii[k].low + np.minimum(turns.radii[1 - k].low, 1.0 / bend))
            for chord in self.chords:
                tight = turns.radii[k].high < 0.5 * chord / kernels.ROUTE_SINE_LIMIT - ROUNDING
                found |= tight & (angles[k].low >= math.pi) & (both > chord)
        return found

    def family(
        self, turns: Turns, centres: Floats, halves: Floats, other: tuple[int, int]
    ) -> tuple[Floats, NDArray[np.bool_], NDArray[np.bool_], list[Span]]:
        """Rows of the boxes for turns whose angles are those that were followed (0), or 2 pi larger or smaller (1).

        returns: (N, TURN_BOX); True where there are such turns; True where rows say something about them; their angles
        """
        rows = np.zeros((centres.shape[1], columns.TURN_BOX))
        held = np.ones(centres.shape[1], dtype=np.bool_)
        usable = held.copy()
        coils = centres[0], turns.middle[5]
        spreads = halves[0], halves[0] + self.growth * halves[1]
        angles = []
        whole = 2.0 * math.pi
        for k in range(2):
            radius, angle = turns.radii[k], turns.angles[k]
            shift = np.where(angle.low < 0.0, whole, -whole) if other[k] else 0.0
            low, high = np.clip(angle.low + shift, 0.0, whole), np.clip(angle.high + shift, 0.0, whole)
            held &= (angle.low < 0.0) | (angle.high >= whole) if other[k] else (angle.high >= 0.0) & (angle.low < whole)
            angles.append(Span(low, high))
            own = np.clip(turns.middle[2 + k] + shift, low, high)
            length = turns.middle[k] * own
            with np.errstate(invalid="ignore"):
                least, most = radius.low * low, radius.high * high
            if not other[k]:
                arc = Span(np.fmax(turns.arcs[k].low, least), np.fmin(turns.arcs[k].high, most))
                least, most = np.where(turns.whole, arc.low, least), np.where(turns.whole, arc.high, most)
            least, most = np.minimum(least, length), np.maximum(most, length)
            usable &= (radius.low > 0.0) & (coils[k] - spreads[k] > 0.0) & (high - low < ANGLE_MOST)
            with np.errstate(divide="ignore", invalid="ignore"):
                bends = [np.abs(1.0 / end - 1.0 / turns.middle[k]) for end in (radius.low, radius.high)]
                sharpest = 1.0 / radius.low
            values = {
                columns.TURN_RADIUS: turns.middle[k],
                columns.TURN_ANGLE: own,
                columns.TURN_BEND: np.maximum(*bends),
                columns.TURN_LOW: least,
                columns.TURN_HIGH: most,
                columns.TURN_LONGER: np.maximum(most - length, length - least),
                columns.TURN_COIL: coils[k],
                columns.TURN_COIL_LESS: spreads[k],
                columns.TURN_SHARPEST: sharpest,
                columns.TURN_WIDER: np.maximum(radius.high - turns.middle[k], turns.middle[k] - radius.low),
                columns.TURN_FURTHER: np.maximum(high - own, own - low),
            }
            for column, value in values.items():
                rows[:, column + k] = value
        return rows, held, usable & np.isfinite(rows).all(axis=1), angles
