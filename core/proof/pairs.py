"""Two benches in balls: how far one is beyond a line of the other, their separation, and a line between them."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

from flint import acb, arb

from core.errors import ProofRefused
from core.quantities import Parameter, Value, fill_template


class Unfinished(Exception):
    """What keeps a proof from its end. template, values: as of BenchDragonError"""

    def __init__(self, template: str, /, **values: Value) -> None:
        super().__init__(template)
        self.template, self.values = template, values

    def __str__(self) -> str:
        return fill_template(self.template, self.values)


class Unproven(Unfinished):
    """The balls are too wide to decide; over a shorter stretch they may be narrow enough."""


def malformed(name: str, rule: str, got: Value | None = None, **values: Value) -> ProofRefused:
    """The error for a member, or for the certificate itself if the name is empty. rule: template of what is wrong"""
    subject = Parameter(name or "it")
    words = f"the certificate is malformed: {{field}} {rule}"
    return ProofRefused.in_words(name, words, got=got, **{"field": subject, **values})


# Rotations that bring the faces +x, +y, -x, -y of a bench's own frame to +x.
FACES = (acb(1), acb(0, -1), acb(-1), acb(0, 1))
# Proof that a pair is apart, one letter each: a face of the first bench (0 to 3) or of the second (4 to 7), a direction
# fixed in the first bench (7.), or the circles around both (10.).
DIRECTION, CIRCLES = "8", "9"
ALL_FACES = "01234567"


def below(ball: arb) -> float:
    """A double below the whole ball."""
    return math.nextafter(float(ball.lower()), -math.inf)


def above(ball: arb) -> float:
    """A double above the whole ball."""
    return math.nextafter(float(ball.upper()), math.inf)


class Size:
    """One kind of bench [m]: chord, halves, reach = h of 5., diagonal: half of it, corners in its own frame."""

    def __init__(self, length: float, width: float, overhang: float) -> None:
        x, y = arb(length) / 2, arb(width) / 2
        self.half_length, self.half_width = x, y
        self.chord = arb(length) - 2 * arb(overhang)
        self.reach = (arb(overhang) ** 2 + y**2).sqrt()
        self.diagonal = (x**2 + y**2).sqrt()
        self.corners = (acb(x, y), acb(x, -y), acb(-x, -y), acb(-x, y))


class TouchingLine:
    """A line fixed in one of two benches a, b, that touches it; the other bench is beyond if all its corners are.

    face: of ALL_FACES or DIRECTION; direction: the angle of the line's normal in the first bench [rad]
    by_partner: whether it is fixed in the second bench; rotation: brings its normal to +x; support: distance from that
    bench's centre [m]
    """

    def __init__(self, face: str, direction: float, first: Size, second: Size) -> None:
        if face == DIRECTION:
            sine, cosine = arb(direction).sin_cos()
            self.by_partner, self.rotation, other = False, acb(cosine, -sine), second
            self.support = first.half_length * abs(cosine) + first.half_width * abs(sine)
        else:
            self.by_partner, side = int(face) >= 4, int(face) % 4
            own, other = (second, first) if self.by_partner else (first, second)
            self.rotation = FACES[side]
            self.support = own.half_width if side % 2 else own.half_length
        self._corners: Sequence[acb] = other.corners

    def corners(self, axis: acb) -> Sequence[acb]:
        """The corners that may be nearest to the line, in the other bench's frame: all, wherever its axis points."""
        return self._corners

    def clears(
        self, axis: acb, moves: tuple[acb, acb], ends: Iterable[tuple[acb, acb]], width: arb, margin: arb
    ) -> bool:
        """Whether the other bench is more than the margin beyond the line over a whole stretch (4.).

        axis, moves: its direction, and how its centre and direction move, over the stretch, as seen with the normal
            along +x; ends: its centre and direction at both ends, in the frame of this one
        """
        first, last = ((self.rotation * to, self.rotation * along) for to, along in ends)

        def gap(to: acb, along: acb, corner: acb) -> arb:
            return (to + along * corner).real - self.support - margin

        return all(
            stays_positive(gap(*first, corner), gap(*last, corner), (moves[0] + moves[1] * corner).real, width)
            for corner in self.corners(axis)
        )


def stays_positive(first: arb, last: arb, slope: arb, width: arb) -> bool:
    """Whether g > 0 over a stretch, from g at its ends and an enclosure of g' (4.)."""
    if not (first > 0 and last > 0):
        return False
    if slope >= 0 or slope <= 0:
        return True
    least, most = slope.lower(), slope.upper()
    return bool(most * first - least * last + least * most * width > 0)


class Benches:
    """Benches at one instant, placed one after the other: their centres and directions, in any common frame.

    sizes: of these benches, in order
    """

    def __init__(self, sizes: Sequence[Size]) -> None:
        self.sizes = sizes
        self.centres: list[acb] = []
        self.along: list[acb] = []
        self._gaps: dict[int, list[arb]] = {}

    def seen(self, owner: int, other: int) -> tuple[acb, acb]:
        """Centre and direction of one bench in the frame of another."""
        back = self.along[owner].conjugate()
        return back * (self.centres[other] - self.centres[owner]), back * self.along[other]

    def gaps(self, partner: int) -> list[arb]:
        """Distance of each bench beyond each face of the other: four faces of the first, four of partner [m]."""
        if partner not in self._gaps:
            self._gaps[partner] = [gap for pair in ((0, partner), (partner, 0)) for gap in self._beyond(*pair)]
        return self._gaps[partner]

    def _beyond(self, a: int, b: int) -> list[arb]:
        own, other = self.sizes[a], self.sizes[b]
        to, axis = self.seen(a, b)
        cosine, sine = abs(axis.real), abs(axis.imag)
        x = own.half_length + other.half_length * cosine + other.half_width * sine
        y = own.half_width + other.half_length * sine + other.half_width * cosine
        return [to.real - x, to.imag - y, -to.real - x, -to.imag - y]

    def overlapping(self, partner: int) -> bool:
        """Whether bench and partner strictly overlap: no face of either separates them."""
        return all(gap < 0 for gap in self.gaps(partner))

    def within(self, partner: int, margin: arb) -> bool:
        """Whether they are strictly nearer than the margin, or strictly overlapping if it is 0 (7.). margin: [m]"""
        around = self.sizes[0].diagonal + self.sizes[partner].diagonal + margin
        if abs(self.centres[partner] - self.centres[0]) > around or not all(gap < margin for gap in self.gaps(partner)):
            return False
        return self.overlapping(partner) or any(
            x.nonnegative_part() ** 2 + y.nonnegative_part() ** 2 < margin**2
            for a, b in ((0, partner), (partner, 0))
            for x, y in self._outside(a, b)
        )

    def _outside(self, a: int, b: int) -> list[tuple[arb, arb]]:
        """Distance of each corner of b beyond the nearer of two opposite faces of a, along and across it [m]."""
        own, (to, axis) = self.sizes[a], self.seen(a, b)
        corners = [to + axis * corner for corner in self.sizes[b].corners]
        return [(abs(z.real) - own.half_length, abs(z.imag) - own.half_width) for z in corners]

    def nearest(self, partner: int) -> tuple[float, float]:
        """Approximate separation [m], and direction from the first to the partner, in the first's frame [rad]."""
        best = (math.inf, 0.0)
        for a, b in ((0, partner), (partner, 0)):
            own, (to, axis) = self.sizes[a], self.seen(a, b)
            x_most, y_most = float(own.half_length), float(own.half_width)
            back = -complex(axis.conjugate())
            for corner in self.sizes[b].corners:
                z = complex(to + axis * corner)
                beyond = z - complex(min(max(z.real, -x_most), x_most), min(max(z.imag, -y_most), y_most))
                way = beyond if a == 0 else beyond * back
                best = min(best, (abs(beyond), math.atan2(way.imag, way.real)))
        return best
