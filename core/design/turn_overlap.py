"""An overlap that all turns of a box share: no turn of such a box can be danced.

Some turn of the box is the nominal one. In it benches i and j overlap by a depth at one instant; in every other turn
of the box they then overlap too, at some instant, if no point of either can move by so much between the turns.

Input:  the box, with the intervals that hold the sizes of all its turns (turn_boxes.py); the dragon.
State:  for a pose of the nominal turn: of each handle the place s on the path, and the interval of its places in all
        turns of the box; of each bench how far its points may be from where they are in the nominal turn.
Output: True if a pose was exhibited; its depth.

Places. s = 0 at the tangent point M of both arcs, in each turn. The frame rotates with the entry. The leading handle of
the pair stands at the same s in all turns: it passes every place, so there is such an instant. Where the others stand
depends on the path's curvature between two handles alone:

Lemma 1 (links). Two curves of unit speed on [0, l] whose curvatures differ by less than 2 H in total (the integral of
|k - k'|) have end points at distances d and d' with d' >= d - H sqrt(l^2 - d^2) - H^2 d / 2.
    Rotate the second curve so that both have one direction where half of the difference is passed: then directions
    differ by at most H everywhere. With psi the angle between the first curve and its chord,
    d' >= int cos(psi + eta) >= int cos psi cos eta - int |sin psi| |sin eta| >= d (1 - H^2 / 2) - H int |sin psi|,
    and (int |sin psi|)^2 <= l^2 - (int cos psi)^2 = l^2 - d^2, because |int (cos psi, |sin psi|)| <= l.

Lemma 2 (chains). Let the handle in front be in [low, high] in all turns of the box. Behind `high` on the nominal turn,
let u stand at the chord c less D, and behind `low` let w stand at c plus D. The next handle is in [w, u] in all turns
if
    D >= (H sqrt(l^2 - c^2) + H^2 l / 2) / (1 - H^2 / 2),  l = high - w.
    Say it were at q > u. In that turn the distance grows backwards (chord lemma, core/kernels/bounds.py), so u is
    further than c from the front handle f. In the nominal turn it is at most c - D, as f <= high. Lemma 1 with the
    curves exchanged: c - D >= d' - H sqrt(l^2 - d'^2) - H^2 d' / 2, d' > c: so D is less than it was. Similarly for w.
    The chord lemma needs curvature (c + D) / 2 < 1 on every path of the box, and l <= pi / curvature.

How far curvatures and points of the turns differ at one s: core/design/turn_moves.py.

Benches. A point of a bench is p + (p - q) z / c + (normal) y, |z| <= overhang beyond a handle p, |y| <= w / 2. If p and
q move by at most e and f, it moves by at most (1 + o / c) max(e, f) + (o / c) min(e, f) + w (e + f) / (2 c).
Depth. If rectangles overlap by d, along every axis their shadows overlap by d or more. Points that move by at most e
leave an overlap of d - 2 e along every axis, so no axis separates them.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from core import kernels
from core.design.turn_boxes import ROUNDING
from core.design.turn_moves import Box, bent, coil_bend, displaced
from core.dragon import Dragon
from core.kernels.constants import (
    CHORD,
    FRAME_COLUMNS,
    FRAME_HALF_LENGTH,
    FRAME_HALF_WIDTH,
    HALF_LENGTH,
    HALF_WIDTH,
    MX,
    PLACE,
    SEPARATION,
    UY,
)
from core.paths.turn import Turn
from core.values import Floats

# Distance between tried poses, as a part of the chord [1].
POSE_STEP = 0.25
# Number of deepest poses whose overlap is compared with the moves in the box.
POSES_TRIED = 3
# Number of remembered places of poses that were exhibited: neighbouring boxes often share one.
HINTS = 8
# D is chosen larger than the places so far need by this [1], because they need more with that D; number of choices.
SPARE_FACTOR = 1.3
SPARE_ROUNDS = 5
# Rounding of places, distances and separations [m]: they are below 1e3 m.
SPARE = 1e-8


class OverlapExhibit(NamedTuple):
    """Result of a search for a pose that overlaps in all turns of a box.

    shared: whether there is one; depth: of the deepest pose of the nominal turn [m]; excess: the least ratio of the
        moves of benches to the depth [1]; poses: number of tried ones
    """

    shared: bool
    depth: float
    excess: float
    poses: int


def _excess(exhibit: OverlapExhibit) -> float:
    return exhibit.excess


class OverlapSearch:
    """Search for a pose that overlaps in all turns of a box.

    dragon: its benches from `first` on are the ones of the pose; margin [m]: benches within it count as overlapping
    """

    def __init__(self, dragon: Dragon, margin: float, most: int) -> None:
        self.margin = margin
        first = (
            1 if dragon.benches > 3 else 0
        )  # a head is often so long that Lemma 2 says nothing about its rear handle
        count = min(dragon.benches - first, most)
        self.chords = dragon.chords[first : first + count]
        self.overhangs = dragon.overhangs[first : first + count]
        self.widths = dragon.widths[first : first + count]
        self.sizes = np.zeros((count, kernels.SIZE_COLUMNS))
        self.sizes[:, CHORD] = self.chords
        self.sizes[:, HALF_LENGTH] = 0.5 * dragon.lengths[first : first + count]
        self.sizes[:, HALF_WIDTH] = 0.5 * self.widths
        self.chain = np.empty((count + 1, kernels.CHAIN_COLUMNS))
        self.frames = np.empty((count, FRAME_COLUMNS))
        for half, column in ((HALF_LENGTH, FRAME_HALF_LENGTH), (HALF_WIDTH, FRAME_HALF_WIDTH)):
            self.frames[:, column] = self.sizes[:, half]
        self.out = np.empty((max(0, count - 2), kernels.SEPARATION_COLUMNS))
        self.hints: list[float] = []

    @property
    def equal(self) -> bool:
        """Whether all benches of a pose are equal, so that the same pose is one of the turn danced backwards."""
        return not any(np.ptp(sizes) for sizes in (self.chords, self.overhangs, self.widths))

    @property
    def count(self) -> int:
        """Number of benches of a pose."""
        return len(self.chords)

    def deepest(self, turn: Turn) -> float:
        """Depth of the deepest pose of a turn [m], negative if none overlaps."""
        return self._poses(turn)[0][0] if self.count > 2 else -math.inf

    def exhibited(self, box: Box) -> OverlapExhibit:
        """The search for a pose that overlaps in all turns of a box."""
        if self.count < 3:
            return OverlapExhibit(False, -math.inf, math.inf, 0)
        tried = [self._pose(box.nominal, box.nominal.length + beyond) for beyond in self.hints]
        poses, best = sorted(tried, reverse=True)[:1], OverlapExhibit(False, -math.inf, math.inf, 0)
        for whole in (False, True):
            if whole:
                poses = self._poses(box.nominal)
                tried += poses
            for depth, place, last in poses[:POSES_TRIED]:
                moved = self._moved(box, place, last) if depth > SPARE else math.inf
                excess = moved / max(depth, SPARE)
                best = min(best, OverlapExhibit(depth > moved + SPARE, depth, excess, len(tried)), key=_excess)
                if best.shared:
                    if whole:
                        self.hints = [place - box.nominal.length, *self.hints[: HINTS - 1]]
                    return best
        return OverlapExhibit(False, poses[0][0], best.excess, len(tried))

    def _poses(self, turn: Turn) -> list[tuple[float, float, int]]:
        """Depth [m], place of the first handle from the entry [m], and the other bench of poses, the deepest first."""
        around = 2.0 * math.pi * max(turn.entry_radius, turn.exit_radius)
        step = POSE_STEP * float(self.chords.max())
        places = np.arange(0.5 * step, turn.length + around, step)
        return sorted((self._pose(turn, float(place)) for place in places), reverse=True)

    def _pose(self, turn: Turn, place: float) -> tuple[float, float, int]:
        """Greatest depth at which another bench overlaps the first one [m], the given place, and that other bench."""
        turn.follow(-place, self.count, self.sizes, self.chain)
        self.frames[:, :FRAME_HALF_LENGTH] = self.chain[:-1, MX : UY + 1]
        kernels.pair_separations(np.repeat(self.frames[:1], self.count - 2, axis=0), self.frames[2:], self.out)
        other = int(self.out[:, SEPARATION].argmin())
        return self.margin - float(self.out[other, SEPARATION]), place, other + 2

    def _moved(self, box: Box, place: float, last: int) -> float:
        """Most by which points of the first bench and of bench `last` may come apart in the box [m]; infinite: unknown.

        place: of the first handle, from the entry [m]
        """
        chain = self.chain_within(box, place, last)
        if chain is None:
            return math.inf
        low, at, high = chain
        moves = np.maximum(high - at, at - low) + [
            displaced(box, a, b) for a, b in zip(low.tolist(), high.tolist(), strict=True)
        ]
        return self._apart(0, moves) + self._apart(last, moves)

    def chain_within(self, box: Box, place: float, last: int) -> tuple[Floats, Floats, Floats] | None:
        """Places of the handles 0 to last + 1: least, nominal and greatest in the turns of a box [m]; None if unknown.

        place: of the first handle, from the entry of the nominal turn [m]; the places are counted from M
        """
        middle = box.nominal.radii[0] * box.nominal.angles[0]
        chords = self.chords[: last + 1]
        bend = max(*box.sharpest, *(coil_bend(box.growth, radius) for radius in box.least))
        at = low = high = self.places(box.nominal, place, self.chords, last) - middle
        spare = np.zeros(last + 1)
        for _ in range(SPARE_ROUNDS):
            lengths = high[:-1] - low[1:]
            turned = np.array([bent(box, a, b) for a, b in zip(low[1:].tolist(), high[:-1].tolist(), strict=True)])
            needed = link_spare(chords, lengths, turned) + ROUNDING
            if (needed <= spare).all():
                return (low, at, high) if lengths.max() * bend < math.pi else None
            spare = SPARE_FACTOR * needed
            if not (chords + spare).max() * bend < 2.0 * kernels.ROUTE_SINE_LIMIT:
                return None
            high = self.places(box.nominal, place, self.chords - _padded(spare, self.count), last) - middle
            low = self.places(box.nominal, place, self.chords + _padded(spare, self.count), last) - middle
        return None

    def places(self, turn: Turn, place: float, chords: Floats, last: int) -> Floats:
        """Places of the handles 0 to last + 1 behind one at a place [m]."""
        sizes = self.sizes.copy()
        sizes[:, CHORD] = chords
        turn.follow(-place, last + 1, sizes, self.chain)
        return -self.chain[: last + 2, PLACE].copy()

    def _apart(self, bench: int, moves: Floats) -> float:
        """Most by which a point of a bench moves if its handles move by so much [m]."""
        near, far = sorted(moves[bench : bench + 2])
        over = self.overhangs[bench] / self.chords[bench]
        return float((1.0 + over) * far + over * near + 0.5 * self.widths[bench] * (near + far) / self.chords[bench])


def most_benches(dragon: Dragon, radius: float) -> int:
    """Number of benches behind one another that may come near the first of them in a circle of this radius [m]."""
    around = 2.0 * math.pi * radius + 4.0 * radius
    return 4 + math.ceil(around / float(dragon.chords[1:].min(initial=dragon.chords[0])))


def _padded(values: Floats, count: int) -> Floats:
    return np.concatenate([values, np.full(count - len(values), values[-1])])


def link_spare(chords: Floats, lengths: Floats, turned: Floats) -> Floats:
    """D of Lemma 2 [m]. turned: H [rad]; infinite where H is too large."""
    bow = np.sqrt(np.maximum(lengths**2 - chords**2, 0.0))
    with np.errstate(divide="ignore", invalid="ignore"):
        spare = (turned * bow + 0.5 * turned**2 * lengths) / (1.0 - 0.5 * turned**2)
    return np.where(turned < 1.0, spare, np.inf)
