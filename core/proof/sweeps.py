"""Sweeps: all the places that one bench passes, tiled with stretches over which every later bench is apart from it."""

from __future__ import annotations

import math
from bisect import bisect_left
from collections.abc import Callable, Iterator, Sequence
from typing import Any

from flint import acb, arb

from core.errors import ProofRefused
from core.proof.chain import Chain, Pose, Unproven, above, below, bend, slopes

# The first try for the width of a stretch, how it grows after a success, and where the search gives up [rad].
WIDTH_FIRST = 0.5
WIDTH_GROWTH = 1.5
WIDTH_LEAST = 1e-10
# Turns that bring the faces +x, +y, -x, -y of a bench's own frame to +x.
FACES = (acb(1), acb(0, -1), acb(-1), acb(0, 1))

Progress = Callable[[float], None]
# (highest theta, lowest theta, one face for each bench from the next but one on, until all others are far)
Tile = tuple[float, float, str]
# Sweep of one bench: (bench, highest theta, lowest theta, places of 6.) -> proven tiles, from outside in.
Source = Callable[[int, float, float, Sequence[float]], Iterator["tuple[Stretch, str]"]]


class Overlap(Exception):
    """Benches a < b strictly overlap when the front handle of a is at theta [rad]."""

    def __init__(self, a: int, b: int, theta: float) -> None:
        super().__init__(f"benches {a} and {b} overlap when handle {a} is at theta = {theta!r} rad")
        self.a, self.b, self.theta = a, b, theta


class Stretch:
    """The benches from one on while its front handle goes through [low, high] rad: at both ends, and all between.

    thetas, rates: of the handles, and their derivatives by the front handle's theta, enclosed over the stretch
    placed: of the benches, grown one by one: centre, direction, and their derivatives, enclosed over the stretch
    rising: 3. holds for the first link; last: one more than the last bench that counts
    """

    def __init__(self, chain: Chain, bench: int, low: float, high: float, last: int) -> None:
        self.chain, self.bench, self.low, self.high, self.last = chain, bench, low, high, last
        self.ends = Pose(chain, bench, arb(low)), Pose(chain, bench, arb(high))
        self.width = arb(high) - arb(low)
        self.thetas, self.rates = [arb(low).union(arb(high))], [arb(1)]
        self.points, self.moves = [acb(chain.growth * self.thetas[0])], [acb(chain.growth)]
        self.placed: list[tuple[acb, acb, acb, acb]] = []
        self.rising = self._hull = True
        self.grow()

    def grow(self) -> None:
        """Add the next bench: between the ends by 3., or by the mean value once a handle may turn back."""
        k = len(self.placed)
        size, theta = self.chain.sizes[self.bench + k], self.thetas[k]
        before, after = self.ends
        before.grow()
        after.grow()
        if self._hull:
            bends = after.bends[k].union(before.bends[k])
        else:
            bends = bend(theta.upper(), size.needed).union(bend(theta.lower(), size.needed))
        by_theta, by_bend = slopes(theta, bends)
        if not by_bend > 0:
            raise Unproven(f"handle {self.bench + k + 1} is not enclosed")
        rise = 1 - by_theta / by_bend
        self.rates.append(self.rates[k] * rise)
        self._hull = self._hull and bool(rise > 0)
        if self._hull:
            self.thetas.append(before.thetas[-1].union(after.thetas[-1]))
            turn = before.turns[-1].union(after.turns[-1])
        else:
            self.rising = self.rising and k > 0
            passed = arb(0).union(self.width)
            self.thetas.append(before.thetas[-1] + self.rates[-1] * passed)
            turn = before.turns[-1] + (self.rates[-1] - 1) * passed
        self._place(turn, size.chord)

    def _place(self, turn: arb, chord: arb) -> None:
        theta, rate = self.thetas[-1], self.rates[-1]
        sine, cosine = turn.sin_cos()
        outwards = self.chain.growth * acb(cosine, sine)
        self.points.append(outwards * theta)
        self.moves.append(outwards * acb(rate, theta * (rate - 1)))
        front, rear, front_move, rear_move = *self.points[-2:], *self.moves[-2:]
        self.placed.append(
            ((front + rear) / 2, (front - rear) / chord, (front_move + rear_move) / 2, (front_move - rear_move) / chord)
        )

    @property
    def complete(self) -> bool:
        """Are all benches that are not placed either far (5.) or none of this stretch's (6.)?"""
        count = len(self.placed)
        return self.bench + count >= self.last or (
            count >= 2 and self.chain.far(self.bench, self.thetas[1], self.thetas[-1])
        )

    @property
    def rear(self) -> tuple[float, float]:
        """Between which thetas the next handle stays [rad]; when it rises, to the last digit of a double."""
        first, last = (pose.thetas[1] for pose in self.ends) if self.rising else (self.thetas[1], self.thetas[1])
        return below(first), above(last)

    def apart(self, partner: int, face: int) -> bool:
        """Is one of the two wholly beyond this face of the other, all over the stretch (4.)?

        partner: counted from bench; face: 0 to 3 of bench, 4 to 7 of partner, in the order of FACES
        """
        owner, side = divmod(face, 4)
        a, b = (partner, 0) if owner else (0, partner)
        own, other = self.chain.sizes[self.bench + a], self.chain.sizes[self.bench + b]
        half = own.half_width if side % 2 else own.half_length
        centre_a, along_a, centre_move_a, along_move_a = self.placed[a]
        centre_b, along_b, centre_move_b, along_move_b = self.placed[b]
        turn, turning = FACES[side] * along_a.conjugate(), FACES[side] * along_move_a.conjugate()
        to_move = turn * (centre_move_b - centre_move_a) + turning * (centre_b - centre_a)
        axis_move = turn * along_move_b + turning * along_b
        to_low, axis_low = self._seen(0, a, b, side)
        to_high, axis_high = self._seen(1, a, b, side)
        return all(
            _stays_positive(
                (to_low + axis_low * corner).real - half,
                (to_high + axis_high * corner).real - half,
                (to_move + axis_move * corner).real,
                self.width,
            )
            for corner in other.corners
        )

    def _seen(self, end: int, a: int, b: int, side: int) -> tuple[acb, acb]:
        """Centre and direction of b seen from a, turned so that the face of that side is +x."""
        pose = self.ends[end]
        turn = FACES[side] * pose.along[a].conjugate()
        return turn * (pose.centres[b] - pose.centres[a]), turn * pose.along[b]


def _stays_positive(low: arb, high: arb, slope: arb, width: arb) -> bool:
    """Is g > 0 over a stretch, from g at its ends and an enclosure of g' (4.)?"""
    if not (low > 0 and high > 0):
        return False
    if slope >= 0 or slope <= 0:
        return True
    least, most = slope.lower(), slope.upper()
    return bool(most * low - least * high + least * most * width > 0)


def _faces(stretch: Stretch) -> str:
    """A face for each bench that needs one, verified; Overlap when an end of the stretch shows one."""
    faces = ""
    while not stretch.complete:
        stretch.grow()
        partner = len(stretch.placed) - 1
        if partner < 2:
            continue
        low, high = (pose.gaps(partner) for pose in stretch.ends)
        for theta, gaps in ((stretch.low, low), (stretch.high, high)):
            if all(gap < 0 for gap in gaps):
                absent = stretch.chain.count - stretch.last
                raise Overlap(stretch.bench + absent, stretch.bench + absent + partner, theta)
        face = max(range(8), key=lambda k: min(float(low[k]), float(high[k])))
        if not stretch.apart(partner, face):
            raise Unproven(f"benches {stretch.bench} and {stretch.bench + partner} are not shown to be apart")
        faces += str(face)
    return faces


def found(chain: Chain) -> Source:
    """Stretches as wide as the balls allow."""

    def source(bench: int, high: float, low: float, places: Sequence[float]) -> Iterator[tuple[Stretch, str]]:
        width = WIDTH_FIRST
        while high > low:
            start = max(low, high - width)
            try:
                stretch = Stretch(chain, bench, start, high, chain.count - bisect_left(places, start))
                faces = _faces(stretch)
            except Unproven as why:
                width = (high - start) / 2
                if width < WIDTH_LEAST:
                    place = f"where handle {bench} is at theta = {high!r} rad"
                    raise ProofRefused("claim", f"not proven {place}: {why}") from None
                continue
            yield stretch, faces
            high, width = start, width * WIDTH_GROWTH

    return source


def recorded(chain: Chain, sweeps: Sequence[Any]) -> Source:
    """The stretches of a certificate, each verified as it stands."""

    def source(bench: int, high: float, low: float, places: Sequence[float]) -> Iterator[tuple[Stretch, str]]:
        if bench >= len(sweeps):
            raise ProofRefused("sweeps", f"the certificate is malformed: sweeps.{bench} is missing")
        if sweeps[bench]["bench"] != bench:
            raise ProofRefused("sweeps", f"sweep {bench} is of another bench: {sweeps[bench]['bench']}")
        for k, (high, low, faces) in enumerate(sweeps[bench]["stretches"]):
            most = chain.count - bench - 2
            if len(faces) > most:
                place = f"sweeps.{bench}.stretches.{k}.2"
                words = f"must have at most {most} faces, one for each bench behind, got {len(faces)}"
                raise ProofRefused(place, f"the certificate is malformed: {place} {words}")
            stretch = Stretch(chain, bench, low, high, chain.count - bisect_left(places, low))
            while len(stretch.placed) < len(faces) + 2:
                stretch.grow()
            if not stretch.complete:
                raise Unproven(f"pairs are missing from [{high!r}, {low!r}] of bench {bench}")
            for partner, face in enumerate(faces, 2):
                if not stretch.apart(partner, int(face)):
                    pair = f"benches {bench} and {bench + partner}"
                    raise Unproven(f"{pair} are not apart by face {face} over [{high!r}, {low!r}]")
            yield stretch, faces

    return source


def swept(
    chain: Chain, high: float, low: float, repeats_from: int, source: Source, progress: Progress
) -> list[dict[str, Any]]:
    """The sweeps that show that nothing touches while the head goes from theta = high in to low [rad].

    repeats_from: u of 6.; source: where the proven stretches come from
    raises: Unproven when the stretches leave a place uncovered
    """
    sweeps: list[dict[str, Any]] = []
    if chain.count < 3 or low >= high:
        return sweeps
    for bench in range(repeats_from + 1):
        places = [math.inf]
        if bench == repeats_from:
            places = chain.outermost(bench, high)
            high = places[-1]
        tiles: list[list[Any]] = []
        rears: list[tuple[float, float]] = []
        end = high
        for stretch, faces in source(bench, high, low, places):
            if stretch.high < end or (tiles and stretch.high > end) or not 0.0 < stretch.low < stretch.high:
                raise Unproven(f"the stretches of bench {bench} do not join at theta = {end!r} rad")
            if not stretch.rising and len(places) > 1 and not stretch.rear[1] <= places[1]:
                raise Unproven(f"handle {bench + 1} may turn back far outside")
            tiles.append([stretch.high, stretch.low, faces])
            rears.append(stretch.rear)
            end = stretch.low
            progress((bench + min(1.0, (high - end) / (high - low))) / (repeats_from + 1))
        if not end <= low:
            raise Unproven(f"the sweep of bench {bench} ends at theta = {end!r} rad, short of {low!r}")
        sweeps.append({"bench": bench, "stretches": tiles})
        high, low = max(rear[1] for rear in rears), min(rear[0] for rear in rears)
    return sweeps
