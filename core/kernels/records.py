"""Records: named values that inner loops pass to each other.

In compiled code the same names are C structs, which setup.py declares from this file.
"""

from typing import NamedTuple


class Rectangle(NamedTuple):
    """A rectangle in the plane."""

    x: float  # its centre [m]
    y: float
    ux: float  # the unit vector along its length
    uy: float
    half_length: float  # [m]
    half_width: float


class Relative(NamedTuple):
    """A rectangle in the frame of another one."""

    along: float  # its centre [m]
    left: float
    c: float  # its unit vector
    s: float
    hl: float  # half length and half width of the rectangle from which it is seen [m]
    hw: float
    other_hl: float  # its own half length and half width [m]
    other_hw: float


class LinkBounds(NamedTuple):
    """Bounds on a link over an interval, from the rate of its leader: see bounds.py."""

    cos_front: float  # upper bound of the cosine of the angle at its front handle [1]
    cos_rear: float  # lower bound of the cosine of the angle at its rear handle [1]
    sine: float  # upper bound of the sine of either angle [1]
    rate: float  # upper bound of the rear handle's rate [1]
    rate_low: float  # lower bound of that rate [1]
    omega: float  # upper bound of the rate at which its direction turns [1/m]
    omega_low: float  # lower bound of that [1/m]
    swing_front: float  # upper bound of |alpha'| at its front handle [1/m]
    swing_rear: float  # upper bound of |alpha'| at its rear handle [1/m]
    followed: bool  # whether its angles were followed, where the chord lemma does not serve
    bounded: bool  # whether these bounds are known


class Stretch(NamedTuple):
    """The stretch of a route that a bench sweeps over an interval."""

    chord: float  # of the bench [m]
    low: float  # range of its curvature, positive in the sense in which it bends [1/m]
    high: float
    slope: float  # bound on |d curvature / d s| [1/m^2]
    widened: float  # error of the curvature, which the range includes [1/m]
    sine: float  # high chord / 2; up to 1, by the chord lemma, that of the largest angle between path and bench [1]
    blur: float  # error of the cosines of these angles at either end [1]


class Cosines(NamedTuple):
    """Bounds on the cosines of the angles between a bench and the tangents at its handles over an interval [1]."""

    front_low: float
    front_high: float
    rear_low: float
    rear_high: float


class Pair(NamedTuple):
    """Two benches, or a bench and the row of an edge at rest."""

    first: int
    second: int


class Closest(NamedTuple):
    """The least separation at an instant [m], FREE without pairs, and its pair."""

    gap: float
    first: int
    second: int


class Laid(NamedTuple):
    """Extent of a chain that was laid out."""

    last: int  # its last handle, FOLDED at a fold
    leading: int  # number of benches that can be the inner one of a touching pair


class PairBounds(NamedTuple):
    """Proven bounds for all pairs over an interval."""

    least: float  # a lower bound of their separations [m], FREE without pairs, or NO_BOUND
    gap_curvature: float  # K of the pair with that bound [1/m]
    first: int  # that pair
    second: int
    width: float  # the widest interval for which the same pairs would have been proven [m]
    error: float  # largest error of points [m]
    tried: int  # number of pairs that were near enough to be tried


class Rounding(NamedTuple):
    """Largest errors of points and gaps over an interval."""

    point: float  # [m]
    gap: float  # of any pair that is not far apart [m]; FREE where each pair needs a bound of its own


class Curvatures(NamedTuple):
    """Bounds on the second derivatives of a gap over a band: along the path at its lowest and at its highest growth
    [1/m], and across the growths [rad^2/m]."""

    low: float
    high: float
    across: float


class Corner(NamedTuple):
    """A point [m]."""

    x: float
    y: float


class Axis(NamedTuple):
    """A half plane of a hull, and the gap beyond it to another hull [m]."""

    k: int
    gap: float


class Hulls(NamedTuple):
    """Two hulls, of which the first gives the half planes: their first rows, AT_REST for an edge at rest, and half
    lengths of such edges [m]."""

    first: int
    second: int
    half_length: float
    other_half_length: float


class View(NamedTuple):
    """A bench, or an edge at rest, as another one sees it."""

    along: float  # its centre [m]
    left: float
    c: float  # its unit vector
    s: float
    shift: int  # corner k + shift of its hull is the deepest against half plane k


class Views(NamedTuple):
    """View at the four corners of a band."""

    low_start: View
    low_end: View
    high_start: View
    high_end: View


class Faced(NamedTuple):
    """The nearest two hulls of benches a and b."""

    k: int  # the half plane of the first hull beyond which the second is furthest
    own: int  # the first hull
    other: int  # the second
    swapped: bool  # whether the first hull is that of b
    gap: float  # [m]
