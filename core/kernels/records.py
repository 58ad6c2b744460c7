"""Records: the values with names that inner loops hand on.

Compiled, the same names are structs of C, from records.pxd.
"""

from typing import NamedTuple


class Link(NamedTuple):
    """Bounds on a link over an interval, the leader's rate given: see bounds.py."""

    cos_front: float  # at most the cosine of the angle at its front handle [1]
    cos_rear: float  # at least that at its rear handle [1]
    sine: float  # at most the sine of either [1]
    rate: float  # at most the rear handle's rate [1]
    rate_low: float  # at least that [1]
    omega: float  # at most how fast its direction turns [1/m]
    omega_low: float  # at least that [1/m]
    swing_front: float  # at most |alpha'| at its front handle [1/m]
    swing_rear: float  # and at its rear handle [1/m]


class Stretch(NamedTuple):
    """The stretch of a route that a bench sweeps over an interval."""

    chord: float  # of the bench [m]
    low: float  # the range of its curvature, in the sense in which it bends [1/m]
    high: float
    slope: float  # bound on |d curvature / d s| [1/m^2]
    widened: float  # what the curvature may be off by, and the range has in it [1/m]
    sine: float  # of the largest angle between path and bench, by the chord lemma [1]
    blur: float  # what the cosines of these angles may be off by at either end [1]


class Cosines(NamedTuple):
    """Bounds on the cosines of the angles between a bench and the tangents at its handles over an interval [1]."""

    front_low: float
    front_high: float
    rear_low: float
    rear_high: float
