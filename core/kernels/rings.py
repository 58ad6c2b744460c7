"""Rings: which benches of a spiral are too far out to touch, by bounds that need no chain."""

import cython
from cython.cimports.libc.math import asin, sin, sqrt

if not cython.compiled:  # the .pxd imports the same names for the compiler
    from core.kernels.constants import *
    from core.kernels.route import first_place
    from core.kernels.spiral import spiral_arc


# A point at distance x along the extended centre line of a bench from the foot of the perpendicular from the
# spiral's centre has radius^2 = d^2 + x^2. With handles at radii r_a < r_b and x0 = (r_b^2 - r_a^2) / (2 c) they
# stand at x0 -+ c / 2. Where 0 <= x0 <= c: d^2 >= r_a^2 - c^2 / 4, and no point of the bench is further out than
# sqrt(r_b^2 + o (c + 2 x0) + o^2) + w / 2. A chord is at least (2 / pi) delta sqrt(r_a r_b), so
# x0 <= (pi / 4) growth (q + 1 / q), q^2 = r_b / r_a = 1 + delta / theta, which is below 1.67 growth once
# delta <= theta. Otherwise the triangle inequality serves.


# Columns of a corner of a hull that is o beyond the hole: o (o + c) / 2 [m^2], and its distance aside [m].
RING_FURTHER = 0
RING_ASIDE = 1


# Rounding. The two bounds below are sums, products and roots of terms >= 0, good to 10 u together; RING_ROUNDING makes
# up for these. The errors of the radii of handles are added where radii are compared.
RING_ROUNDING = 1e-12  # [1]


class Rings:
    """Lengths of a dragon's benches that the bounds of this module need [m].

    chord, shortest, overhang, half_width: the longest and the shortest chord, the longest overhang and the largest half
        width of the benches that can be the outer one of a pair
    all_chord, all_shortest, all_overhang, all_half_width, all_length, all_radius: the same, and the largest length and
        half diagonal, of all benches
    between_shortest: shortest chord of the benches that can lie between two others
    hulls: whether benches are unions of hulls. Then also corners: of all hulls, see RING_FURTHER; middle_half_width,
        within: of the benches that can be the outer one of a pair, the largest half width of a middle, and the largest
        reach of an end in front of its hole
    clear_radius: radius from which outwards no pair can touch whose inner bench has its front handle there
    clear_place: on a route, place from which backwards no two benches can touch if the leading one has its front handle
        there; FREE if there is no such place
    end_place: on a route, place of the head from which forwards nothing touches once only repeated benches follow;
        -FREE if there is no such place
    """

    def __init__(self):
        self.chord = self.shortest = self.overhang = self.half_width = 0.0
        self.all_chord = self.all_shortest = self.all_overhang = self.all_half_width = self.all_radius = 0.0
        self.all_length = self.between_shortest = self.clear_radius = self.middle_half_width = self.within = 0.0
        self.hulls = False
        self.clear_place = FREE
        self.end_place = -FREE

    def measure(self, chords, overhangs, widths, lengths, alike, outer):
        """Set the lengths of rectangles, (n,) each, but all_radius.

        alike, outer: the first bench of the equal ones, and the first that can be the outer one of a pair
        """
        self.chord = self.overhang = self.all_chord = self.all_overhang = self.all_length = 0.0
        self.shortest = self.all_shortest = self.between_shortest = FREE
        widest = outer_widest = 0.0
        for k in range(alike + 1):
            self.all_chord = max(self.all_chord, chords[k])
            self.all_shortest = min(self.all_shortest, chords[k])
            self.all_overhang = max(self.all_overhang, overhangs[k])
            self.all_length = max(self.all_length, lengths[k])
            widest = max(widest, widths[k])
            if k >= min(outer, alike):
                self.chord = max(self.chord, chords[k])
                self.shortest = min(self.shortest, chords[k])
                self.overhang = max(self.overhang, overhangs[k])
                outer_widest = max(outer_widest, widths[k])
            if k >= min(1, alike):  # the head lies between no two others
                self.between_shortest = min(self.between_shortest, chords[k])
        self.all_half_width = 0.5 * widest
        self.half_width = 0.5 * outer_widest

    def lay(self, corners, middle_half_width, within):
        """Set the lengths of hulls."""
        self.corners = corners
        self.middle_half_width = middle_half_width
        self.within = within
        self.hulls = True


def settled(growth, radius, rings):
    """Whether all benches led from this radius outwards have 0 <= x0 <= 1.67 growth <= c."""
    return (
        rings.shortest >= 1.67 * growth
        and radius * radius >= 1.5708 * rings.chord * growth
        and radius >= 0.5 * rings.chord
    )


def radius_beyond(growth, radius, rings):
    """A radius such that every bench whose front handle is there or further out lies wholly outside `radius` [m]."""
    target = radius + rings.half_width
    beyond = sqrt(target * target + 0.25 * rings.chord * rings.chord)
    if settled(growth, beyond, rings):
        return beyond * (1.0 + RING_ROUNDING)
    beyond = 0.5 * rings.chord
    return (target + (beyond if beyond > rings.overhang else rings.overhang)) * (1.0 + RING_ROUNDING)


def leaders_reach(growth, lead, rear, rings):
    """Largest radius of benches with front handles at radius `lead` or more and rear handles at `rear` or less [m]."""
    chord = rings.all_chord
    overhang = rings.all_overhang
    if lead >= 0.5 * chord and lead * lead >= 1.5708 * chord * growth:
        return sqrt(rear * rear + overhang * (chord + 3.34 * growth + overhang)) + rings.all_half_width
    return rear + overhang + rings.all_half_width


# Rings. A foot is at most max(c / 2, 1.67 growth) from the front handle of its chord, so d^2 >= r_a^2 - max(...)^2 also
# where it lies beyond that handle. Let E = |X| - growth psi for a point X of a bench at unwrapped polar angle psi: how
# far it lies outside the curve itself. Along the centre line e(x) = sqrt(d^2 + x^2) - growth (psi_foot + atan(x / d))
# vanishes at both handles and 0 <= e'' = d^2 / rho^3 + 2 growth d x / rho^4 <= q = 1 / d + 2 growth x_max / d^3 (for
# d > 2 growth), so between the handles e >= -q c^2 / 8 and on an overhang o e <= q o (o + c) / 2. Sideways
# |dE / dy| <= sqrt(1 + (growth / rho)^2).
# Hence -I <= E <= O with the bows O and I below, both falling as 1 / r. Points X, Y of two benches whose polar angles
# differ by 2 pi m + x, m >= 1, |x| <= pi, are apart radially by at least G + growth x, G = pitch - O - I, and sideways
# by at least 2 rho |x| / pi; both together keep them apart by L = G / sqrt(1 + (pi growth / 2 rho)^2), if G > 0 (proof
# below). With m = 0 at least one bench lies between them. Their angle x is at least that bench's angle less the angles
# of the two overhangs: each overhang takes at most (o + x_b w / 2 d) / (d - w / 2), a chord spans at least
# c / sqrt(growth^2 + r_b^2), and at an angle x they are at least 2 rho sin(x / 2) apart. No angle is larger than that
# of the whole dragon, overhangs included, where a chord spans at most 2 asin(c / 2 r): while that is less than 2 pi,
# 2 rho sin(x / 2) at that angle replaces the bound with m >= 1. Every term grows with r, so the bound holds from r
# outwards.
#
# Why both together. Let Y be the outer point, |Y| - |X| = u >= U = G + growth x, and V = 2 rho |x| / pi. As |X|, |Y| >=
# rho and sin(|x| / 2) >= |x| / pi,
#     |X - Y|^2 = u^2 + 4 |X| |Y| sin^2(x / 2) >= u^2 + V^2.
# (U, V) lies on one of the lines U -+ (pi growth / 2 rho) V = G, according to the sign of x. Their distance from the
# origin is L. Where U >= 0, u^2 >= U^2, so |X - Y| >= L. Where U < 0 nothing is known of u. But then x < -G / growth,
# so V > 2 rho G / (pi growth). This is the V of the point of the line with U = 0, whose distance from the origin is at
# least L and equals this V. So |X - Y| >= V > L.


# Hulls. The middle of a bench that is a union of hulls is narrower than its ends, and the ends have no sharp corners.
# So O is the largest value over the corners of the ends, which are o = `further` beyond the hole and y aside. I is the
# larger value of the middle and of the ends, which reach `within` in front of the hole: e >= -q within (c - within) / 2
# there.


def outward_bow(q, slope, rings):
    """O of benches that are unions of hulls [m]."""
    most = -FREE
    for k in range(rings.corners.shape[0]):
        most = max(most, q * rings.corners[k, RING_FURTHER] + slope * rings.corners[k, RING_ASIDE])
    return most


def inward_bow(q, slope, rings):
    """I of benches that are unions of hulls [m]."""
    ends = 0.5 * q * rings.within * rings.chord + rings.half_width * slope
    return max(0.125 * q * rings.chord * rings.chord + rings.middle_half_width * slope, ends)


# Least d^2 at which the bound is used, relative to radius^2 [1]: d^2 is a difference, and its rounding must stay small.
DISCERNED = 1e-3

# Over a range of growths G is concave in growth (its only curved terms are -growth^2 and -sqrt(1 + growth^2 / rho^2)),
# so it is at least the smaller of its values at both ends; all other terms fall with growth.


def ring_foot(growth, radius, rings):
    """Square of the least distance of centre lines from the centre [m^2], and least distance of points from it [m], for
    benches led from `radius` outwards; 0, 0 where the bound does not hold."""
    foot = 0.5 * rings.all_chord if 0.5 * rings.all_chord > 1.67 * growth else 1.67 * growth
    d2 = radius * radius - foot * foot
    if d2 <= DISCERNED * radius * radius or radius * radius < 1.5708 * rings.all_chord * growth:
        return 0.0, 0.0
    d = sqrt(d2)
    rho = d - (rings.all_half_width if rings.all_half_width > rings.half_width else rings.half_width)
    if d <= 2.0 * growth or rho <= 0.0:
        return 0.0, 0.0
    return d2, rho


def ring_gap(growth, angle, d2, rho, rings):
    """G of two curves of this growth that are an angle apart about their centre [m]: growth angle - O - I."""
    d = sqrt(d2)
    overhang = rings.all_overhang
    q = 1.0 / d + 2.0 * growth * (0.5 * rings.all_chord + 1.67 * growth + overhang) / (d * d2)
    slope = sqrt(1.0 + growth * growth / (rho * rho))
    bows = 0.5 * q * overhang * (overhang + rings.all_chord) + 0.125 * q * rings.chord * rings.chord
    bows += (rings.all_half_width + rings.half_width) * slope
    if rings.hulls:
        bows = outward_bow(q, slope, rings) + inward_bow(q, slope, rings)
    return angle * growth - bows


# Input:  the extremes of the benches (Rings), a range of growths, and the radius of the inner bench's front handle.
# State:  `gap`, the bound for benches a turn or more apart, the lesser of its values at both growths; `same_turn`, the
#         bound for benches with another one between them, from their least angle and the largest, of the whole dragon.
# Output: the lesser of the two, or NO_BOUND.
def ring_least(growth_low, growth, radius, rings, total=FREE):
    """Lower bound of the separation of two non-neighbours, the inner one's front handle at `radius` or further out [m].

    It holds for every growth in [growth_low, growth] [m/rad]. total: an upper bound of the sum of all chords, where
    that may help [m]; returns NO_BOUND where nothing is known
    """
    chord = rings.all_chord
    d2, rho = ring_foot(growth, radius, rings)
    if rho <= 0.0:
        return NO_BOUND
    gap = min(ring_gap(growth_low, TWO_PI, d2, rho, rings), ring_gap(growth, TWO_PI, d2, rho, rings))
    gap /= sqrt(1.0 + PI * PI * growth * growth / (4.0 * rho * rho))
    x_rear = 0.5 * chord + 1.67 * growth
    rear = radius + PI * growth * chord / radius
    overhangs = 2.0 * (rings.all_overhang + x_rear * rings.all_half_width / sqrt(d2)) / rho
    least = rings.between_shortest * rho / sqrt(growth * growth + rear * rear) / rho - overhangs
    if least <= 0.0:
        return NO_BOUND
    same_turn = 2.0 * rho * sin(0.5 * least) if least < PI else 2.0 * rho
    whole = overhangs + total * asin(0.5 * chord / radius) / (0.5 * chord)
    if whole < TWO_PI:
        gap = max(gap, 2.0 * rho * sin(0.5 * whole) if whole > PI else 2.0 * rho)
    if gap <= 0.0:
        return NO_BOUND
    return gap if gap < same_turn else same_turn


# Two spirals. The bound for benches a turn or more apart also holds for those of two dragons on spirals of one growth,
# centre and sense, of which one is turned by an angle against the other: radii are growth psi + E and growth (psi' +
# angle + 2 pi m) + E', at polar angles psi and psi' whose difference is x up to whole turns. No benches of one turn
# count here.
def spirals_least(growth, angle, radius, rings, growth_low=FREE):
    """Lower bound of the separation of benches of two dragons on such spirals, all with their front handles at `radius`
    or further out [m]; NO_BOUND where nothing is known.

    It holds for every growth from the lesser of growth_low and growth up to growth [m/rad].
    angle: least difference of the turn between both spirals from a whole number of turns [rad]
    rings: of the benches of both, each of which can be the outer one
    """
    d2, rho = ring_foot(growth, radius, rings)
    if rho <= 0.0:
        return NO_BOUND
    gap = min(ring_gap(growth, angle, d2, rho, rings), ring_gap(min(growth_low, growth), angle, d2, rho, rings))
    gap /= sqrt(1.0 + PI * PI * growth * growth / (4.0 * rho * rho))
    return gap if gap > 0.0 else NO_BOUND


# Largest error of ring_least(), relative to the lengths in it [1]: at most 64 sums, products and roots. d^2 =
# radius^2 - foot^2 is at least DISCERNED radius^2, so the relative error of d is at most 2,000 u.
LEAST_ROUNDING = 1e-11
# Relative width to which the clear radius is bisected [1], and the largest one [m].
CLEAR_WIDTH = 1e-3
CLEAR_MOST = 1e9


def ring_rounding(growth, radius, rings):
    """Largest error of ring_least() for growths up to this one [m]."""
    return LEAST_ROUNDING * (radius + TWO_PI * growth + rings.all_length)


def ring_clears(growth_low, growth, radius, margin, rings, total=FREE):
    """Whether ring_least() certainly exceeds the margin."""
    return ring_least(growth_low, growth, radius, rings, total) > margin + ring_rounding(growth, radius, rings)


def apart_from(growth, radius, margin, rings, angle):
    """Whether the bound of ring_least(), or with an angle that of spirals_least(), certainly exceeds the margin."""
    if angle == 0.0:
        return ring_clears(growth, growth, radius, margin, rings)
    return spirals_least(growth, angle, radius, rings) > margin + ring_rounding(growth, radius, rings)


def clear_radius(growth, margin, rings, angle=0.0):
    """The least radius, within CLEAR_WIDTH, from which the ring bound exceeds the margin, and CLEAR_SPARE more, so that
    a handle computed there is truly beyond it [m]; FREE if none.

    angle: for benches of two dragons, see spirals_least() [rad]; 0 for those of one
    """
    low = 0.0
    high = 1.0
    while not apart_from(growth, high, margin, rings, angle):
        high *= 4.0
        if high > CLEAR_MOST:
            return FREE
    while high - low > CLEAR_WIDTH * high:
        middle = 0.5 * (low + high)
        if apart_from(growth, middle, margin, rings, angle):
            high = middle
        else:
            low = middle
    return high * (1.0 + CLEAR_SPARE)


# Routes that begin with a coil inwards, which continues outwards behind its beginning. On a route handles only go
# forward (route.py), so a bench whose front handle stands on this coil has always been on it, and so have all benches
# behind it: they stand on one spiral (as long as they keep away from the joint, where the path leaves the coil to meet
# the next piece, see stands_first()), and all bounds above hold for them, around the coil's centre. Hence two benches
# do not touch if the front handle of the leading one stands at clear_place or further back, where ring_least() exceeds
# the margin; and a bench on the coil with its front handle at radius_beyond(X) or further out touches no bench within X
# of the centre. So only benches before clear_place lead pairs, and the chain is laid out only beyond the reach of
# these.


def coil_radius(pieces, x, y):
    """Distance of a point from the centre of the coil that a route begins with [m]."""
    x -= pieces[0, CENTRE_X]
    y -= pieces[0, CENTRE_Y]
    return sqrt(x * x + y * y)


def coil_place(pieces, radius):
    """Place from which backwards all handles are on the first coil itself and at least `radius` from its centre [m]."""
    growth = pieces[0, COIL_GROWTH]
    return max(first_place(pieces), growth * spiral_arc(radius / growth) - pieces[0, COIL_ARC] - pieces[0, S_START])


def coil_reach(pieces, leaders, sizes, chain):
    """Largest distance of any point of the first `leaders` benches of a chain from the centre of the first coil [m]."""
    reach = 0.0
    for i in range(leaders):
        far = coil_radius(pieces, chain[i, MX], chain[i, MY]) + sizes[i, RADIUS]
        if far > reach:
            reach = far
    return reach


def drift(rate, h, growth, radius):
    """Change of a handle's radius while it travels rate * h along the spiral [m]."""
    radial = 2.0 * rate * h * growth / radius if radius > 0.0 else FREE
    return radial if radial <= 0.5 * radius else rate * h
