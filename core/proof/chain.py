"""The dragon on its spiral in balls: bends, the chain at one exact place, and whether two benches strictly overlap."""

from __future__ import annotations

import math

from flint import acb, arb

from core.dragon import Dragon

# A guess from doubles is within this of its root [rad]; an interval Newton step verifies it.
GUESS_RADIUS = 1e-8


class Unproven(Exception):
    """Balls do not decide the question here; over a shorter stretch they may."""


def below(ball: arb) -> float:
    """A double below the whole ball."""
    return math.nextafter(float(ball.lower()), -math.inf)


def above(ball: arb) -> float:
    """A double above the whole ball."""
    return math.nextafter(float(ball.upper()), math.inf)


class Size:
    """One kind of bench [m]: chord, halves, reach = h of 5., corners in its own frame; needed = (chord / b)^2."""

    def __init__(self, length: float, width: float, overhang: float, growth: arb) -> None:
        x, y = arb(length) / 2, arb(width) / 2
        self.half_length, self.half_width = x, y
        self.chord = arb(length) - 2 * arb(overhang)
        self.reach = (arb(overhang) ** 2 + y**2).sqrt()
        self.needed = (self.chord / growth) ** 2
        self.corners = (acb(x, y), acb(x, -y), acb(-x, -y), acb(-x, y))


class Chain:
    """A dragon on a spiral: growth b [m/rad], start [rad], the size of every bench.

    repeats_from: u of 6., from where one sweep does for all, at most the last bench that has a pair
    """

    def __init__(self, dragon: Dragon, pitch: arb, start_turns: float) -> None:
        self.growth = pitch / (2 * arb.pi())
        self.start = 2 * arb.pi() * start_turns
        table = list(zip(dragon.lengths.tolist(), dragon.widths.tolist(), dragon.overhangs.tolist(), strict=True))
        kinds = {sizes: Size(*sizes, self.growth) for sizes in set(table)}
        self.sizes = [kinds[sizes] for sizes in table]
        self.count = len(table)
        self.repeats_from = max(0, min(dragon.uniform_from, self.count - 3))
        self._longest = max(above(kind.chord) for kind in kinds.values())
        self._reach = max(above(kind.reach) for kind in kinds.values())

    def arc(self, theta: arb) -> arb:
        """Arc length from the centre [m]."""
        return self.growth / 2 * (theta * (1 + theta**2).sqrt() + theta.asinh())

    def theta_after(self, way: arb) -> arb:
        """Where the head is after this way from the start. way: [m], negative outside the start; returns [rad]."""
        left = self.arc(self.start) - way
        if not left > 0:
            raise Unproven("the claim reaches past the centre of the spiral")
        theta = (2 * left / self.growth).sqrt().mid()
        for _ in range(20):  # Newton's steps, quadratic from the first on: arc is convex
            theta = (theta - (self.arc(theta) - left) / (self.growth * (1 + theta**2).sqrt())).mid()
        around = theta + arb(0, GUESS_RADIUS)
        return _newton(theta, around, self.arc(theta) - left, self.growth * (1 + around**2).sqrt())

    def far(self, bench: int, rear: arb, theta: arb) -> bool:
        """Is every bench from a handle at theta on apart from this one, whose rear handle is at rear (5.)? [rad]"""
        inner = (self.growth * theta.lower()) ** 2 - arb(self._longest) ** 2 / 4
        outer = self.growth * rear.upper() + self.sizes[bench].reach
        return bool(inner > 0 and inner.sqrt() - self._reach > outer)

    def outermost(self, bench: int, highest: float) -> list[float]:
        """P[bench], ..., P[n - 3] of 6., rounded up. highest: P[bench] [rad]"""
        places, theta = [highest], arb(highest)
        for size in self.sizes[bench : self.count - 3]:
            theta += bend(theta, size.needed)
            places.append(above(theta))
        return places


def _newton(guess: arb, around: arb, value: arb, slope: arb) -> arb:
    """The one root in a ball around a guess, from the value at the guess and the slope over the ball."""
    if not slope > 0:
        raise Unproven("a function is not shown to rise")
    root = guess - value / slope
    if not around.contains(root):
        raise Unproven("a root is not where doubles see it")
    return root


def bend_guess(theta: float, needed: float) -> float:
    """The first root of F, unverified. A long chord starts at pi: Newton then comes from below, F is concave there."""
    chord = math.sqrt(needed)
    found = 2.0 * math.asin(min(1.0, chord / (2.0 * math.sqrt(theta * theta + chord))))
    for _ in range(40):
        rest, outer = 1.0 - math.cos(found), 2.0 * theta * (theta + found)
        slope = 2.0 * (found + theta * rest) + outer * math.sin(found)
        step = (found * found + outer * rest - needed) / slope if slope > 0.0 else math.inf
        if not abs(step) < 1.0:
            raise Unproven("no next handle: the chain folds")
        found -= step
        if abs(step) < 1e-14:
            break
    return found


def slopes(theta: arb, d: arb) -> tuple[arb, arb]:
    """F_theta and F_d."""
    sine, cosine = d.sin_cos()
    rest, outer = 2 * (1 - cosine), theta + d
    return (theta + outer) * rest, 2 * d + theta * (rest + 2 * outer * sine)


def bend(theta: arb, needed: arb) -> arb:
    """The first root d of F(theta, d) = needed (1.) [rad]."""
    guess = arb(bend_guess(float(theta), float(needed)))
    around = guess + arb(0, GUESS_RADIUS)
    value = guess**2 + 2 * theta * (theta + guess) * (1 - guess.cos()) - needed
    found = _newton(guess, around, value, slopes(theta, around)[1])
    if not found > 0:
        raise Unproven("a next handle is not behind")
    if not found < arb.pi():
        past = found.union(arb.pi())
        sine, cosine = past.sin_cos()
        # F_d > 0 at the root is what the Newton step has shown.
        if not 2 + 4 * theta * sine + 2 * theta * (theta + past) * cosine < 0:
            raise Unproven("a next handle is not shown to be the nearest behind")
    return found


class Pose:
    """The benches from one on when its front handle is at theta, in the frame that turns with that handle.

    thetas, turns [rad], points [m]: of the handles; bends, centres, along: of the benches, grown one by one
    """

    def __init__(self, chain: Chain, bench: int, theta: arb) -> None:
        self.chain, self.bench = chain, bench
        self.thetas, self.turns, self.points = [theta], [arb(0)], [acb(chain.growth * theta)]
        self.bends: list[arb] = []
        self.centres: list[acb] = []
        self.along: list[acb] = []

    def grow(self, benches: int = 1) -> None:
        """Add the next benches."""
        first = self.bench + len(self.bends)
        for size in self.chain.sizes[first : first + benches]:
            self.bends.append(bend(self.thetas[-1], size.needed))
            self.thetas.append(self.thetas[-1] + self.bends[-1])
            self.turns.append(self.turns[-1] + self.bends[-1])
            sine, cosine = self.turns[-1].sin_cos()
            radius = self.chain.growth * self.thetas[-1]
            self.points.append(acb(radius * cosine, radius * sine))
            self.centres.append((self.points[-1] + self.points[-2]) / 2)
            self.along.append((self.points[-2] - self.points[-1]) / size.chord)

    def gaps(self, partner: int) -> list[arb]:
        """How far each is beyond each face of the other: four of bench, four of partner (counted from bench) [m]."""
        found = []
        for a, b in ((0, partner), (partner, 0)):
            own, other = self.chain.sizes[self.bench + a], self.chain.sizes[self.bench + b]
            turn = self.along[a].conjugate()
            to, axis = turn * (self.centres[b] - self.centres[a]), turn * self.along[b]
            cosine, sine = abs(axis.real), abs(axis.imag)
            x = own.half_length + other.half_length * cosine + other.half_width * sine
            y = own.half_width + other.half_length * sine + other.half_width * cosine
            found += [to.real - x, to.imag - y, -to.real - x, -to.imag - y]
        return found

    def overlapping(self, partner: int) -> bool:
        """Do bench and partner strictly overlap? Two rectangles that do not lie apart along a face of one of them."""
        return all(gap < 0 for gap in self.gaps(partner))
