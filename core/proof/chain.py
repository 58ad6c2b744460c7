"""The dragon on its spiral in balls: deltas, the chain at one exact place, and over a stretch of places."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import Generic, TypeVar

from flint import acb, arb

from core.dragon import Dragon
from core.proof.ground import AT_ONCE, ONE_BY_ONE, BenchGround, PolygonSide
from core.proof.pairs import Benches, Size, TouchingLine, Unproven, above, below
from core.quantities import Quantity, format_number

# A guess from doubles is within this of its root [rad]; an interval Newton step verifies it.
GUESS_RADIUS = 1e-8
# Longest Newton step towards a guess [rad]: near the centre the first steps overshoot.
STEP_MOST = 1.0
# Pieces of [pi, d] over which F_d > 0 is proven, near the centre, and the largest number of tries, with the halves of
# pieces: 95 for a pitch of 2 m that is 2e-7 m wider than one with a fold (measured 2026-11-21).
PIECES_PAST_PI, PIECES_MOST = 32, 1000
# Number of poses that a chain remembers: the one that two stretches share, and those of failed tries.
POSES_KEPT = 16

P = TypeVar("P", bound=Benches)


class DragonOnPath(ABC, Generic[P]):
    """A dragon on some path, and the margin that its benches keep [m]. A place falls as the dance goes on.

    repeats_from: u of 6., from which one sweep covers all, at most the last bench that has a pair
    longest, reach: the longest chord, the largest h of 5. [m]
    """

    def __init__(self, dragon: Dragon, margin: float) -> None:
        table = list(zip(dragon.lengths.tolist(), dragon.widths.tolist(), dragon.overhangs.tolist(), strict=True))
        kinds = {sizes: Size(*sizes) for sizes in set(table)}
        self.sizes = [kinds[sizes] for sizes in table]
        self.count = len(table)
        self.repeats_from = max(0, min(dragon.uniform_from, self.count - 3))
        self.margin = arb(margin)
        self.longest = max(above(kind.chord) for kind in kinds.values())
        self.reach = max(above(kind.reach) for kind in kinds.values())
        self._poses: dict[tuple[int, float], P] = {}

    @abstractmethod
    def pose_at(self, bench: int, place: arb) -> P:
        """A bench and those behind it when its front handle is at a place."""

    def pose(self, bench: int, place: float) -> P:
        """The pose of pose_at(), remembered: neighbouring stretches share one."""
        if (bench, place) not in self._poses:
            if len(self._poses) >= POSES_KEPT:
                self._poses.clear()
            self._poses[bench, place] = self.pose_at(bench, arb(place))
        return self._poses[bench, place]


class Chain(DragonOnPath["Pose"]):
    """A dragon on a spiral: growth b [m/rad], start [rad]. Its places are theta [rad], always above the floor.

    stray: how far every hole may be from its place [m]; grounds: of its benches, none without a stray
    """

    floor = 0.0

    def __init__(self, dragon: Dragon, pitch: arb, start_turns: float, margin: float = 0.0, stray: float = 0.0) -> None:
        super().__init__(dragon, margin)
        self.stray = arb(stray)
        strayed = set(self.sizes) if stray else ()
        self.grounds = {
            size: BenchGround(size.chord / 2, size.half_length, size.half_width, self.stray) for size in strayed
        }
        self.growth = pitch / (2 * arb.pi())
        self.start = 2 * arb.pi() * start_turns
        kinds = {size: (size.chord / self.growth) ** 2 for size in set(self.sizes)}
        self.needed = [kinds[size] for size in self.sizes]

    @staticmethod
    def place_quantity(theta: float) -> Quantity:
        """A place in a message."""
        return Quantity(theta, "rad", text=f"theta = {format_number(theta)} rad")

    def pose_at(self, bench: int, place: arb) -> Pose:
        """A bench and those behind it when its front handle is at a place [rad]."""
        return Pose(self, bench, place)

    def arc(self, theta: arb) -> arb:
        """Arc length from the centre [m]."""
        return coil_arc(self.growth, theta)

    def place_after(self, way: arb) -> arb:
        """Place of the head after this way from the start. way: [m], negative outside the start; returns [rad]."""
        left = self.arc(self.start) - way
        if not left > 0:
            raise Unproven("the claim reaches past the centre of the spiral")
        return coil_theta(self.growth, left)

    def far(self, bench: int, rear: arb, theta: arb) -> bool:
        """Whether all benches behind a handle at theta are apart from this one, its rear handle at rear (5., 14.)."""
        inner = (self.growth * theta.lower()) ** 2 - arb(self.longest) ** 2 / 4
        outer = self.growth * rear.upper() + self.sizes[bench].reach
        return bool(inner > 0 and inner.sqrt() - self.reach > outer + self.margin + 2 * self.stray)

    def outermost(self, bench: int, highest: float) -> list[float]:
        """P[bench], ..., P[n - 3] of 6., rounded up. highest: P[bench] [rad]"""
        places, theta = [highest], arb(highest)
        for needed in self.needed[bench : max(bench, self.count - 3)]:
            theta += delta(theta, needed)
            places.append(above(theta))
        return places


def coil_arc(growth: arb, theta: arb) -> arb:
    """Arc length of r = growth |theta| from its centre to theta, with the sign of theta [m]."""
    return growth / 2 * (theta * (1 + theta**2).sqrt() + theta.asinh())


def coil_slope(growth: arb, theta: arb) -> arb:
    """Derivative of coil_arc() [m]."""
    return growth * (1 + theta**2).sqrt()


def coil_theta(growth: arb, arc: arb) -> arb:
    """The theta at an arc length of coil_arc() [rad]."""
    sign = 1 if arc > 0 else -1
    theta = (sign * (2 * abs(arc) / growth).sqrt()).mid()
    for _ in range(20):  # quadratic from the first step on: the arc is convex on either side of the centre
        theta = (theta - (coil_arc(growth, theta) - arc) / coil_slope(growth, theta)).mid()
    around = theta + arb(0, GUESS_RADIUS)
    return newton(theta, around, coil_arc(growth, theta) - arc, coil_slope(growth, around))


def newton(guess: arb, around: arb, value: arb, slope: arb) -> arb:
    """The one root in a ball around a guess, from the value at the guess and the slope over the ball."""
    if not slope > 0:
        raise Unproven("no ball is shown to hold one place alone: a distance may not rise there")
    root = guess - value / slope
    if not around.contains(root):
        raise Unproven("a place is not shown to be where doubles put it")
    return root


def delta_guess(theta: float, needed: float) -> float:
    """The first root of F, unverified. A long chord starts at pi: there F is concave, so Newton comes from below."""
    chord = math.sqrt(needed)
    guess = 2.0 * math.asin(min(1.0, chord / (2.0 * math.sqrt(theta * theta + chord))))
    for _ in range(40):
        rest, outer = 1.0 - math.cos(guess), 2.0 * theta * (theta + guess)
        slope = 2.0 * (guess + theta * rest) + outer * math.sin(guess)
        step = (guess * guess + outer * rest - needed) / slope if slope > 0.0 else math.inf
        if not math.isfinite(step):
            raise Unproven("no next handle: the chain folds")
        guess -= max(-STEP_MOST, min(STEP_MOST, step))
        if abs(step) < 1e-14:
            break
    return guess


def squared_chord(theta: arb, d: arb) -> arb:
    """F(theta, d)."""
    return d**2 + 2 * theta * (theta + d) * (1 - d.cos())


def slopes(theta: arb, d: arb) -> tuple[arb, arb]:
    """F_theta and F_d."""
    sine, cosine = d.sin_cos()
    rest, outer = 2 * (1 - cosine), theta + d
    return (theta + outer) * rest, 2 * d + theta * (rest + 2 * outer * sine)


def delta(theta: arb, needed: arb) -> arb:
    """The first root d of F(theta, d) = needed (1.) [rad]."""
    guess = arb(delta_guess(float(theta), float(needed)))
    around = guess + arb(0, GUESS_RADIUS)
    root = newton(guess, around, squared_chord(theta, guess) - needed, slopes(theta, around)[1])
    if not root > 0:
        raise Unproven("the next handle is not shown to be behind")
    if not root < arb.pi() and not rises_to(theta, root):
        raise Unproven("a next handle is not shown to be the nearest behind")
    return root


def rises_to(theta: arb, d: arb) -> bool:
    """Whether F(theta, .) < F(theta, d) before d > pi (1.), if F_d > 0 at d is known."""
    step = (d - arb.pi()) / PIECES_PAST_PI
    pieces = [(float(k), k + 1.0) for k in reversed(range(PIECES_PAST_PI))]
    for _ in range(PIECES_MOST):
        if not pieces:
            return True
        low, high = pieces.pop()
        start, end = (arb.pi() + place * step for place in (low, high))
        if _curving(theta, start.union(d)) < 0:
            return True
        if not _rises(theta, start, end):
            middle = (low + high) / 2
            pieces += [(middle, high), (low, middle)]
    return False


def _rises(theta: arb, start: arb, end: arb) -> bool:
    """Whether F_d > 0 from one delta to another: by one ball, or from the middle by the mean value theorem."""
    hull, middle = start.union(end), (start + end) / 2
    return bool(slopes(theta, hull)[1] > 0 or slopes(theta, middle)[1] + _curving(theta, hull) * (hull - middle) > 0)


def _curving(theta: arb, d: arb) -> arb:
    """F_dd."""
    sine, cosine = d.sin_cos()
    return 2 + 4 * theta * sine + 2 * theta * (theta + d) * cosine


class Pose(Benches):
    """A bench and those behind it when its front handle is at theta, in the frame that rotates with that handle.

    thetas, rotations from the first [rad], points [m]: of the handles; deltas: of the benches, grown one by one
    """

    def __init__(self, chain: Chain, bench: int, theta: arb) -> None:
        super().__init__(chain.sizes[bench:])
        self.chain, self.bench = chain, bench
        self.thetas, self.rotations, self.points = [theta], [arb(0)], [acb(chain.growth * theta)]
        self.deltas: list[arb] = []

    @property
    def places(self) -> list[arb]:
        """Places of the handles [rad]."""
        return self.thetas

    def far_from(self, count: int) -> bool:
        """Whether all benches behind this number of benches are apart from the first one (5.)."""
        return self.chain.far(self.bench, self.thetas[1], self.thetas[count])

    def grow_to(self, count: int) -> None:
        """Place at least this number of benches, if the dragon has as many."""
        for k in range(self.bench + len(self.deltas), min(self.bench + count, self.chain.count)):
            self.deltas.append(delta(self.thetas[-1], self.chain.needed[k]))
            self.thetas.append(self.thetas[-1] + self.deltas[-1])
            self.rotations.append(self.rotations[-1] + self.deltas[-1])
            sine, cosine = self.rotations[-1].sin_cos()
            radius = self.chain.growth * self.thetas[-1]
            self.points.append(acb(radius * cosine, radius * sine))
            self.centres.append((self.points[-1] + self.points[-2]) / 2)
            self.along.append((self.points[-2] - self.points[-1]) / self.chain.sizes[k].chord)


class SpiralStretch:
    """A bench and those behind it while its front handle goes through [low, high] rad: at both ends and between.

    thetas, rates: of the handles, and their derivatives by the front handle's theta, enclosed over the stretch
    placed: of the benches, grown one by one: centre, direction, and their derivatives, enclosed over the stretch
    rising: 3. holds for the first link; last: one more than the last bench that counts
    """

    def __init__(self, chain: Chain, bench: int, low: float, high: float, last: int) -> None:
        self.chain, self.bench, self.low, self.high, self.last = chain, bench, low, high, last
        self.ends = chain.pose(bench, low), chain.pose(bench, high)
        self.width = arb(high) - arb(low)
        self.thetas, self.rates = [arb(low).union(arb(high))], [arb(1)]
        self.points, self.moves = [acb(chain.growth * self.thetas[0])], [acb(chain.growth)]
        self.placed: list[tuple[acb, acb, acb, acb]] = []
        self.rising = self._hull = True
        self.grow()

    def grow(self) -> None:
        """Place the next bench: between the ends by 3., or by the mean value once a handle may reverse."""
        k = len(self.placed)
        size, theta = self.chain.sizes[self.bench + k], self.thetas[k]
        before, after = self.ends
        before.grow_to(k + 1)
        after.grow_to(k + 1)
        needed = self.chain.needed[self.bench + k]
        if self._hull:
            deltas = after.deltas[k].union(before.deltas[k])
        else:
            deltas = delta(theta.upper(), needed).union(delta(theta.lower(), needed))
        by_theta, by_delta = slopes(theta, deltas)
        if not by_delta > 0:
            raise Unproven("handle {handle} is not enclosed", handle=self.bench + k + 1)
        rise = 1 - by_theta / by_delta
        self.rates.append(self.rates[k] * rise)
        self._hull = self._hull and bool(rise > 0)
        if self._hull:
            self.thetas.append(before.thetas[k + 1].union(after.thetas[k + 1]))
            rotation = before.rotations[k + 1].union(after.rotations[k + 1])
        else:
            self.rising = self.rising and k > 0
            passed = arb(0).union(self.width)
            self.thetas.append(before.thetas[k + 1] + self.rates[-1] * passed)
            rotation = before.rotations[k + 1] + (self.rates[-1] - 1) * passed
        theta, rate, chord = self.thetas[-1], self.rates[-1], size.chord
        sine, cosine = rotation.sin_cos()
        outwards = self.chain.growth * acb(cosine, sine)
        self.points.append(outwards * theta)
        self.moves.append(outwards * acb(rate, theta * (rate - 1)))
        front, rear, front_move, rear_move = *self.points[-2:], *self.moves[-2:]
        moving = (front_move + rear_move) / 2, (front_move - rear_move) / chord
        self.placed.append(((front + rear) / 2, (front - rear) / chord, *moving))

    @property
    def complete(self) -> bool:
        """Whether every bench that is not placed is either far (5.) or not needed in this stretch (6.)."""
        count = len(self.placed)
        needed = self.bench + count < self.last
        return not needed or (count >= 2 and self.chain.far(self.bench, self.thetas[1], self.thetas[-1]))

    @property
    def rear(self) -> tuple[float, float]:
        """Lower and upper bound of the next handle's theta [rad]; if it rises, to the last digit of a double."""
        first, last = (pose.thetas[1] for pose in self.ends) if self.rising else (self.thetas[1], self.thetas[1])
        return below(first), above(last)

    def within_circles(self, partner: int) -> bool:
        """Spirals need no 10.: beyond the next ring or two 5. covers all benches."""
        return False

    def apart(self, partner: int, face: str, direction: float) -> bool:
        """Whether one of the two is more than the margin beyond this line of the other, over the whole stretch (4.).

        partner: counted from bench; face, direction: see TouchingLine
        """
        first, second = (self.chain.sizes[self.bench + k] for k in (0, partner))
        return self._beyond(partner, TouchingLine(face, direction, first, second))

    def grounds(self, partner: int) -> tuple[BenchGround, BenchGround]:
        """Grounds of the first bench and of `partner`."""
        first, second = (self.chain.grounds[self.chain.sizes[self.bench + k]] for k in (0, partner))
        return first, second

    def grounds_apart(self, partner: int, sides: Sequence[int]) -> bool:
        """Whether the grounds of the two are apart over the whole stretch, by these sides (16.).

        sides: one that has the other ground beyond it, or one for each two of their polygons
        """
        hulls = AT_ONCE if len(sides) == 1 else ONE_BY_ONE
        both = self.grounds(partner)
        return all(
            self._beyond(partner, PolygonSide(number, pair, *both)) for number, pair in zip(sides, hulls, strict=True)
        )

    def _beyond(self, partner: int, line: TouchingLine) -> bool:
        """Whether one of the two is more than the margin beyond a line of the other, over the whole stretch (4.)."""
        a, b = (partner, 0) if line.by_partner else (0, partner)
        centre_a, along_a, centre_move_a, along_move_a = self.placed[a]
        centre_b, along_b, centre_move_b, along_move_b = self.placed[b]
        back, back_move = line.rotation * along_a.conjugate(), line.rotation * along_move_a.conjugate()
        to_move = back * (centre_move_b - centre_move_a) + back_move * (centre_b - centre_a)
        axis_move = back * along_move_b + back_move * along_b
        ends = (pose.seen(a, b) for pose in self.ends)
        return line.clears(back * along_b, (to_move, axis_move), ends, self.width, self.chain.margin)
