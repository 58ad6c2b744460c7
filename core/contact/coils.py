"""Two coils of one route: the radius beyond which nothing on them touches, so that a search may end there.

It serves a dance through the turn, and any other route that begins and ends with coils of the same centre and pitch.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from core import kernels
from core.dragon import Dragon
from core.kernels.constants import (
    ARC,
    ARC_RADIUS,
    CENTRE_X,
    CENTRE_Y,
    COIL_ARC,
    COIL_GROWTH,
    COIL_ROTATION,
    FREE,
    PIECE_KIND,
    S_END,
    S_START,
    SIGN,
    SPIRAL,
)
from core.paths.following import ARC_MOST, longest_arc
from core.paths.route import Route
from core.values import Floats

# Factor between the tried radii from which rings may be clear [1], and the largest one [m].
RADIUS_FACTOR = 1.1
RADIUS_MAX = 1e4
# Columns of the centre of an arc or a coil.
CENTRE = slice(CENTRE_X, CENTRE_Y + 1)
# Largest distance, in units of the growth, between the middle of a chord and the foot of the perpendicular from the
# centre, wherever ring_least() has a bound (core/kernels/rings.py) [1].
FOOT = 1.67
# Amount by which bounds must exceed the margin [m], far above their rounding. The lengths in their sums are together
# below 4 RADIUS_MAX (longer chords or a wider pitch are not handled). The error of ring_least() is at most 1e-11 of
# them (LEAST_ROUNDING of core/kernels/rings.py), 4e-7 m; where it has a bound, the relative error of d is at most 2,000
# u, so that of quotients by it 1e-12, 4e-8 m; all other terms are good to 50 u, 2e-10 m. Between the coils the path is
# at most 1e-8 m beside its pieces, because joints miss by at most 1e-9 m and rad (core/paths/route.py).
CLEARLY = 1e-6
# Largest relative error of an arc length from a centre: 10 u, with u = 2^-53 [1].
ARC_ROUNDING = 2e-15
# Largest distance between two centres that count as one [m]; CLEARLY includes it.
CENTRES_APART = 1e-9


@dataclass(frozen=True, slots=True)
class TwoCoils:
    """A coil inwards and one outwards around one centre, with other pieces between them.

    growth: of both [m/rad]; offset: angle between them at one radius, at most pi [rad]
    extent: largest distance from the centre [m] of the path between them, and of the last BLEND of either coil, where
        the coil may be blended into that path
    length: of the path between them [m]; radius: at the beginning of the coil outwards [m]
    """

    growth: float
    offset: float
    extent: float
    length: float
    radius: float

    def arc(self, radius: float) -> float:
        """Arc of the coil outwards from its beginning to a radius, rounded up by at most ARC_ROUNDING of it [m]."""
        end, begin = (float(kernels.spiral_arc(r / self.growth)) for r in (radius, self.radius))
        return self.growth * (end - begin + ARC_ROUNDING * end)


def two_coils(path: Route) -> TwoCoils | None:
    """The coils at the two ends of a route; None unless there are two with one centre and one pitch."""
    table = path.table
    first, last = table[0].tolist(), table[-1].tolist()
    spirals = [row[PIECE_KIND] == SPIRAL for row in (first, last)]
    if len(table) < 2 or not all(spirals) or (first[SIGN], last[SIGN]) != (-1.0, 1.0):
        return None
    growth, centre = first[COIL_GROWTH], np.array(first[CENTRE])
    if growth != last[COIL_GROWTH] or math.hypot(*(np.array(last[CENTRE]) - centre)) > CENTRES_APART:
        return None
    turned = (last[COIL_ROTATION] - first[COIL_ROTATION]) % (2.0 * math.pi)
    inner = first[COIL_ARC] - (first[S_END] - first[S_START])
    radii = [growth * float(kernels.spiral_theta(arc / growth)) for arc in (inner, last[COIL_ARC])]
    led = [growth * float(kernels.spiral_theta((arc + kernels.BLEND) / growth)) for arc in (inner, last[COIL_ARC])]
    extent = max([*led, *(_extent(path, row, centre) for row in table[1:-1])]) + CENTRES_APART
    return TwoCoils(growth, min(turned, 2.0 * math.pi - turned), extent, last[S_START] - first[S_END], radii[1])


def _extent(path: Route, row: Floats, centre: Floats) -> float:
    """Upper bound of the distance of a piece's points from a point [m].

    It is the distance to one of its ends plus half its length; for an arc also the furthest point of the circle.
    """
    ends = path.position(row[S_START : S_END + 1])
    extent = float(np.hypot(*(ends - centre).T).max() + 0.5 * (row[S_END] - row[S_START]))
    if row[PIECE_KIND] == ARC:
        extent = min(extent, float(math.hypot(*(row[CENTRE] - centre)) + row[ARC_RADIUS]))
    return extent


# Let `rings` >= extent be a radius from which the bounds of core/kernels/rings.py hold: two benches of one coil are
# apart by more than the margin (ring_least()), and so are two of different coils. For points of different coils in
# directions that differ by x, |x| <= pi, the polar angles on their own coils differ by offset + 2 pi m + x, in one
# order or the other. So growth offset takes the place of the pitch, and no bench lies beside another of its turn.
#
# A bench with a handle within `rings` has its other handle on a coil at most longest_arc() of arc further out. So no
# point of the bench is further out than that radius + o + w / 2. If the path between
# the coils is longer than that arc, no bench is on both coils. From beyond() of that radius and the margin outwards
# nothing comes near a bench on a coil. So once all handles of the leading benches, up to the first of the equal ones,
# are there on the coil outwards, these benches meet nothing any more. Every bench behind them repeats a meeting of one
# of them in the same place (core/kernels/repeats.py), or is there too. Hence nothing touches, for coils of any length.


def rings_clear(dragon: Dragon, coils: TwoCoils, margin: float) -> float | None:
    """A radius >= extent from which both coils are clear of themselves and of each other [m]; None if not known."""
    growth, chords = coils.growth, dragon.chords[: dragon.uniform_from + 1]
    longest, rings = float(chords.max()), _rings(dragon)
    overhang, half = _sideways(dragon)
    foot = max(0.5 * longest, FOOT * growth)
    if 2.0 * math.pi * growth + longest + 2.0 * (overhang + half) > RADIUS_MAX:
        return None
    radius = coils.extent
    while radius <= RADIUS_MAX:
        if kernels.ring_least(growth, growth, radius, rings) > margin + CLEARLY:
            d = math.sqrt(radius * radius - foot * foot)
            inner = d - half
            q = 1.0 / d + 2.0 * growth * (0.5 * longest + FOOT * growth + overhang) / d**3
            bows = 0.5 * q * overhang * (overhang + longest) + 0.125 * q * longest * longest
            bows += 2.0 * half * math.hypot(1.0, growth / inner) + CLEARLY
            if coils.offset * growth - bows > margin * math.hypot(1.0, 0.5 * math.pi * growth / inner):
                return radius
        radius *= RADIUS_FACTOR
    return None


def free_arc(dragon: Dragon, coils: TwoCoils, margin: float, arc: float) -> float | None:
    """Arc of the coil outwards to the head's place from which nothing can touch any more [m]; None if not known.

    arc: upper bound of the way along the path under a bench [m]
    """
    growth, leaders = coils.growth, dragon.chords[: dragon.uniform_from + 1]
    rings = rings_clear(dragon, coils, margin)
    if rings is None or arc >= coils.length:
        return None
    reach = growth * float(kernels.spiral_theta(kernels.spiral_arc(rings / growth) + arc / growth))
    return max(0.0, coils.arc(beyond(dragon, growth, reach, margin))) + ARC_MOST * float(leaders.sum())


def beyond(dragon: Dragon, growth: float, handles: float, margin: float) -> float:
    """Radius from which a bench on a coil is clear of all benches with handles within the radius `handles` [m]."""
    overhang, half = _sideways(dragon)
    return wholly_outside(dragon, growth, handles + overhang + half + margin + CLEARLY)


def wholly_outside(dragon: Dragon, growth: float, radius: float) -> float:
    """Least radius of both handles on a coil for which the whole bench is outside `radius` [m].

    sqrt((radius + w / 2)^2 + c^2 / 4) if the foot of the perpendicular from the centre is at most c / 2 from the inner
    handle; else by the triangle inequality, see core/kernels/rings.py.
    """
    return float(kernels.radius_beyond(growth, radius, _rings(dragon)))


def _rings(dragon: Dragon) -> kernels.Rings:
    """Input of the kernels' ring bounds for a dragon whose benches may all be the outer one of a pair."""
    rings = kernels.Rings()
    rings.measure(dragon.chords, dragon.overhangs, dragon.widths, dragon.lengths, dragon.uniform_from, 0)
    return rings


def _sideways(dragon: Dragon) -> tuple[float, float]:
    """The longest overhang and half the largest width [m]."""
    alike = dragon.uniform_from + 1
    return float(dragon.overhangs[:alike].max()), 0.5 * float(dragon.widths[:alike].max())


def clear_places(
    path: Route, dragon: Dragon, margin: float, radius: float, rounding: Callable[[float], float]
) -> tuple[float, float]:
    """Rings.clear_place and Rings.end_place of a route that begins (and ends) with a coil [m]; FREE and -FREE if not
    known.

    radius: clear_radius of the first coil [m], FREE if it is not known or the path begins otherwise; rounding: largest
        error of a travel [m]
    Both are PLACE_SPARE further than their bounds require, for the rounding of handles, and the latter also by the
    error of travels. The former is BLEND behind the end of the coil, where the coil may be blended into the next piece.
    """
    if radius >= FREE:
        return FREE, -FREE
    first = path.table[0].tolist()
    growth = first[COIL_GROWTH]
    arc = growth * float(kernels.spiral_arc(radius / growth)) * (1.0 + ARC_ROUNDING)
    clear = min(first[S_END] - kernels.BLEND, first[S_START] + first[COIL_ARC] - arc) - kernels.PLACE_SPARE
    clear -= rounding(clear)
    coils = two_coils(path)
    out = None if coils is None else free_arc(dragon, coils, margin, longest_arc(dragon, path))
    if out is None:
        return -clear, -FREE
    end = float(path.table[-1, S_START]) + out + kernels.PLACE_SPARE
    return -clear, -end - rounding(end)
