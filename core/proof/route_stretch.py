"""A dragon on a route over a stretch of places: motion of every bench as seen from the first one."""

from __future__ import annotations

from collections.abc import Sequence
from functools import reduce

from flint import acb, arb

from core.proof.pairs import TouchingLine, Unproven, above, below
from core.proof.route import REAR_COSINE_LEAST, BallCoil, Piece, RouteChain

# Number of times that q of 9. is enclosed again from its own derivative: each time the excess is multiplied by the
# angle of rotation in half a stretch.
ROUNDS = 3
TO_LEFT = acb(0, 1)


class RouteStretch:
    """A bench and those behind it while its front handle goes from the place high to low [m]: at both ends and between.

    speeds: of the handles, relative to the front handle; placed: of the benches, grown one by one: velocity of the
    centre in the bench's own frame, and rate of rotation [rad/m]; all enclosed over the stretch (8.)
    last: one more than the last bench that counts
    """

    rising = True

    def __init__(self, chain: RouteChain, bench: int, low: float, high: float, last: int) -> None:
        self.chain, self.bench, self.low, self.high, self.last = chain, bench, low, high, last
        self.ends = chain.pose(bench, low), chain.pose(bench, high)
        self.width = arb(high) - arb(low)
        self.speeds = [arb(1)]
        self.placed: list[tuple[acb, arb]] = []
        self._relative: tuple[int, acb, acb] | None = None
        self.grow()
        self._outermost = self._circle()

    def grow(self) -> None:
        """Place the next bench."""
        k = len(self.placed)
        for pose in self.ends:
            pose.grow_to(k + 1)
        after, before = self.ends
        chord, front, rear, speed = after.sizes[k].chord, after.handles[k], before.handles[k + 1], self.speeds[k]
        gentle = self.chain.path.gentle(front, rear, chord)
        if gentle and front[0] is rear[0] and not isinstance(front[0], BallCoil):
            curvature = front[0].curvature
            self.placed.append((acb(speed * (1 - (curvature * chord / 2) ** 2).sqrt()), speed * curvature))
            self.speeds.append(speed)
            return
        if gentle:
            low, high = self.chain.path.curvature(front, rear)
            wide, bend = half_angle(low, high, chord), low.union(high)
            alpha, beta = self._from_ends(k, (wide, -wide), (bend, bend))
        else:
            alpha, beta = self._from_ends(k, *self._over(k))
        (sine, cosine), (rear_sine, rear_cosine) = alpha.sin_cos(), beta.sin_cos()
        if not (cosine > 0 and rear_cosine > (0 if gentle else arb(REAR_COSINE_LEAST))):
            raise Unproven("handle {handle} is not enclosed", handle=self.bench + k + 1)
        ratio = cosine / rear_cosine
        across = ratio * rear_sine
        self.placed.append((speed * acb(cosine, (sine + across) / 2), speed * (sine - across) / chord))
        self.speeds.append(speed * ratio)

    def _over(self, k: int) -> tuple[tuple[arb, arb], tuple[arb | None, arb | None]]:
        """alpha and beta of bench k by 18., and the curvatures at its handles [1/m]; None where one passes a corner."""
        path, (after, before), chord = self.chain.path, self.ends, self.ends[0].sizes[k].chord
        passed = [path.between(after.handles[i], before.handles[i]) for i in (k, k + 1)]
        front, rear = (reduce(acb.union, [piece.point(t) for piece, t in parts]) for parts in passed)
        back = (front - rear).conjugate()
        tangents = [[back * piece.tangent(t) for piece, t in parts] for parts in passed]
        if not (
            before.places[k + 1] >= after.places[k + 1]
            and all(tangent.real > 0 for tangent in tangents[0] + tangents[1])
            and path.all_near(front, path.between(after.handles[k], after.handles[k + 1]), chord)
        ):
            raise Unproven("handle {handle} is not shown to follow", handle=self.bench + k + 1)
        alpha, beta = (reduce(arb.union, [tangent.arg() for tangent in these]) for these in tangents)
        return (alpha, beta), (bend_of(passed[0]), bend_of(passed[1]))

    def _from_ends(self, k: int, wides: tuple[arb, arb], bends: tuple[arb | None, arb | None]) -> tuple[arb, arb]:
        """alpha and beta of bench k, also enclosed from their values at both ends (8.)."""
        after, before = self.ends
        half_way = (before.places[k] - after.places[k]) / 2
        alpha, beta = wides
        cosine, rear_cosine = alpha.cos(), beta.cos()
        if not (cosine > 0 and rear_cosine > 0):
            raise Unproven("handle {handle} is not enclosed", handle=self.bench + k + 1)
        ratio = cosine / rear_cosine
        rotating = (alpha.sin() - ratio * beta.sin()) / after.sizes[k].chord

        def nearer(first: arb, last: arb, wide: arb, factor: arb, bend: arb | None) -> arb:
            if bend is None:
                return wide
            rate = abs(factor * bend - rotating).upper()
            return (first.union(last) + arb(0, 1) * rate * half_way).intersection(wide)

        ends = zip(before.angles(k), after.angles(k), wides, (arb(1), ratio), bends, strict=True)
        front, rear = (nearer(*of_handle) for of_handle in ends)
        return front, rear

    def _circle(self) -> arb | None:
        """Radius around the first piece's centre within which the first bench stays [m], if a tail may be beyond."""
        centre = self.chain.centre
        if centre is None:
            return None
        after, before = self.ends

        def radius(k: int) -> arb:
            piece, t = before.handles[k]
            if piece.index == after.handles[k][0].index == 0 and isinstance(piece, BallCoil):
                return piece.growth * t
            distances = abs(before.points[k] - centre) + abs(after.points[k] - centre)
            return (distances + before.places[k] - after.places[k]) / 2

        return radius(0).max(radius(1)) + after.sizes[0].reach

    @property
    def complete(self) -> bool:
        """Whether every bench that is not placed is either far (11.) or not needed in this stretch (6.)."""
        count = len(self.placed)
        if self.bench + count >= self.last:
            return True
        if count < 2 or self._outermost is None:
            return False
        inner = self.chain.inner_circle(self.ends[0].handles[count])
        return inner is not None and bool(inner > self._outermost + self.chain.margin)

    @property
    def rear(self) -> tuple[float, float]:
        """Lower and upper bound of the next handle's place [m], to the last digit of a double."""
        first, last = (pose.places[1] for pose in self.ends)
        return below(first), above(last)

    def within_circles(self, partner: int) -> bool:
        """Whether the circles around both benches are more than the margin apart over the whole stretch (10.)."""
        sizes = self.ends[0].sizes
        (before, _), (after, _) = self.ends[1].seen(0, partner), self.ends[0].seen(0, partner)
        passed = abs(self.relative(partner)[1]) * self.width
        needed = sizes[0].diagonal + sizes[partner].diagonal + self.chain.margin
        return bool(abs(before) + abs(after) - passed > 2 * needed)

    def relative(self, partner: int) -> tuple[acb, acb]:
        """e and v of 9.: partner's direction and velocity seen from the first bench, without its rotation."""
        if self._relative is None or self._relative[0] != partner:
            (velocity, rate), (velocity_b, rate_b) = self.placed[0], self.placed[partner]
            rotation = (TO_LEFT * (rate_b - rate) * arb(0).union(self.width / 2)).exp()
            (_, after), (_, before) = (pose.seen(0, partner) for pose in self.ends)
            along = (before * rotation).union(after * rotation.conjugate())
            self._relative = partner, along, along * velocity_b - velocity
        return self._relative[1:]

    def between(self, partner: int, along: acb, velocity: acb) -> acb:
        """q of 9.: partner's centre seen from the first bench."""
        (after, _), (before, _) = (pose.seen(0, partner) for pose in self.ends)
        half = arb(0).union(self.width / 2)
        most = abs(before).max(abs(after)) + abs(velocity) * self.width / 2
        place = acb(arb(0, 1) * most, arb(0, 1) * most)
        for _ in range(ROUNDS):
            move = velocity - TO_LEFT * self.placed[0][1] * place
            place = (before + move * half).union(after - move * half)
        return place

    def apart(self, partner: int, face: str, direction: float) -> bool:
        """Whether one of the two is more than the margin beyond this line of the other, all over the stretch (4., 9.).

        partner: counted from bench; face, direction: see TouchingLine
        """
        sizes = self.ends[0].sizes
        limit = TouchingLine(face, direction, sizes[0], sizes[partner])
        along, velocity = self.relative(partner)
        place = self.between(partner, along, velocity)
        (velocity_a, rate_a), (velocity_b, rate_b) = self.placed[0], self.placed[partner]
        a, b = 0, partner
        if limit.by_partner:
            a, b = b, a
            place, along = -along.conjugate() * place, along.conjugate()
            velocity = along * velocity_a - velocity_b
            rate_a, rate_b = rate_b, rate_a
        to_move = limit.rotation * (velocity - TO_LEFT * rate_a * place)
        axis_move = limit.rotation * TO_LEFT * (rate_b - rate_a) * along
        ends = (pose.seen(a, b) for pose in reversed(self.ends))
        return limit.clears(limit.rotation * along, (to_move, axis_move), ends, self.width, self.chain.margin)


def bend_of(parts: Sequence[tuple[Piece, arb]]) -> arb | None:
    """All curvatures of these parts of a path [1/m]; None if there is a corner between them."""
    if any(piece.turn != 1 for piece, _ in parts[:-1]):
        return None
    return reduce(arb.union, [piece.curvature_at(t) for piece, t in parts])


def half_angle(low: arb, high: arb, chord: arb) -> arb:
    """Lower and upper bound of alpha and -beta of 8., for a curvature between low and high [1/m]. chord: [m]"""
    gentlest = abs(low).min(abs(high)) if low > 0 or high < 0 else arb(0)
    sharpest = abs(low).max(abs(high))
    length = _arc(gentlest, chord).union(_arc(sharpest, chord))
    return low.union(high) * length / 2


def _arc(curvature: arb, chord: arb) -> arb:
    """Arc length over a chord [m] on a circle of this curvature [1/m]."""
    return 2 * (curvature * chord / 2).asin() / curvature if curvature > 0 else chord
