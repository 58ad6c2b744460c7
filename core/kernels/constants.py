"""Columns of the loops' arrays, and a few numbers that the loops share.

In compiled code the same names are literals, which setup.py declares from this file.
"""

from enum import IntEnum

PI = 3.141592653589793
TWO_PI = 6.283185307179586

# Unit of rounding of a double: the error of one operation is at most this part of its result [1].
ULP = 1.1102230246251565e-16
# n E, the number of links times the error of the last one, counts as small in rounding.py up to this part of the
# shortest chord [1].
SMALL = 1e-4

# Larger than any distance [m]: the squares of coordinates so far apart would overflow.
NO_LIMIT = 1e154

# Columns of a chain row, one for each handle. On a spiral the frame has the head at polar angle 0.
# Columns 0, 1 and 4 say where the handle stands, in the terms of either kind of path; columns of their own gain no time
# (first contact takes 0.97 to 0.99 of the time, within the noise; measured 2026-11-23).
COS, SIN = range(2)  # on a spiral: cos and sin of the polar angle
PX, PY = range(2)  # on a route: the position [m]
TX, TY = range(2, 4)  # unit tangent in the direction of travel
LAG = 4  # for code that serves either kind: how far back it stands, THETA or PLACE; falls in the direction of travel
THETA = 4  # on a spiral: the polar angle [rad]
PLACE = 4  # on a route: minus the arc length s [m]
RATE = 5  # d s / d sigma [1]
# Centre [m] and direction of the bench behind the handle.
MX, MY, UX, UY = range(6, 10)
CURVATURE = 10  # [1/m]; on a spiral from climbs()
# On a route: the handle's piece, and its theta if that piece is a spiral [rad].
PIECE = 11
PIECE_THETA = 12
CLIMB = 13  # d rate / d sigma [1/m], from climbs()
# Rounding, from chain_rounding().
SLIP = 14  # largest distance of the handle along the path from its true place [m]
ERROR = 15  # largest distance of either handle of the bench behind it from its true point [m]
SWAY = 16  # largest error of that bench's direction [1]
FILLED = 17  # in row 0: the last handle whose rounding is filled in
# What THETA on a spiral, and PIECE_THETA on a route, has lost in rounding [rad]; the same of PLACE on a route [m].
REST = 18
PLACE_REST = 19
CHAIN_COLUMNS = 20

# Columns of a motion row, one for each bench: bounds over an interval.
CENTRE_SPEED, CORNER_SPEED, CENTRE_PULL, CORNER_PULL, OMEGA = range(5)
OMEGA_PULL = 5  # omega^2 + omega'
HANDLE_SPEED = 6  # of the faster of its two handles
OMEGA_LOW = 7
OMEGA_RATE = 8  # |omega'|
# Bounds on the handle in front of the bench.
RATE_HIGH = 9
RATE_LOW = 10
RATE_RATE = 11  # |s''|
THETA_HIGH = 12
THETA_LOW = 13
RATE_JERK = 14  # |s'''|; on a route only where no handle up to this one crosses into another part
CURVATURE_LOW = 15  # on a spiral, times its growth
CURVATURE_HIGH = 16
CROSSED = 17  # total number of joints between parts of a route that the handles up to this one cross; a corner counts
# as CORNER_PARTS
CORNER_PARTS = 1e3
# Rounding of RATE [1] and of CLIMB [1/m] at either end of the interval, where climbs() was called.
RATE_ERROR = 18
CLIMB_ERROR = 19
MOTION_COLUMNS = 20

# Columns of a size row, one for each bench.
CHORD, HALF_LENGTH, HALF_WIDTH, RADIUS = range(4)
SIZE_COLUMNS = 4

# Columns of a frame, which is a rectangle in the plane: its centre [m], the unit vector along it, half its size [m].
FRAME_X, FRAME_Y, FRAME_UX, FRAME_UY, FRAME_HALF_LENGTH, FRAME_HALF_WIDTH = range(6)
FRAME_COLUMNS = 6

# Columns of the separation of two rectangles a and b: separation [m], witnesses [m], normal from a to b, and features.
SEPARATION, WITNESS_AX, WITNESS_AY, WITNESS_BX, WITNESS_BY, NORMAL_X, NORMAL_Y, FEATURE_A, FEATURE_B = range(9)
SEPARATION_COLUMNS = 9

# Number of half planes of a hull, evenly spaced; number of hulls of a bench.
DIRECTIONS = 64
HULLS = 3
AT_REST = -1  # in place of the number of a hull, or of its first corner: an edge at rest, which has none

# Columns of a point [m] or a vector, and of the two benches of a pair. Rows of samples of an angle.
X, Y = range(2)
# Columns of a number in double-double (double_double.py).
HIGH, LOW = range(2)
PAIR_A, PAIR_B = range(2)
SINE, COSINE = range(2)
# Rows of the supports of a bench: of its front end and of its middle [m].
FRONT_END, MIDDLE = range(2)

# Features of a rectangle: its corners, then its edges.
FRONT_LEFT, FRONT_RIGHT, REAR_RIGHT, REAR_LEFT, FRONT, RIGHT, REAR, LEFT = range(8)

# Columns of an upright box [m].
X_LOW, Y_LOW, X_HIGH, Y_HIGH = range(4)
BOX_COLUMNS = 4

# Largest curvature chord / 2 at which the chord lemma serves on a spiral; beyond it the angles are followed [1].
SINE_LIMIT = 0.97
# The same on a route, where the cosines of the angles are followed too [1]. At 1 a chord is the diameter of its bend,
# and its rear handle can be infinitely faster than its front one; here it can be 22 times faster. A sharper bend can be
# followed if its dragon is proven to do so (follower.py).
ROUTE_SINE_LIMIT = 0.999
# Least u . T at the rear handle there: what ROUTE_SINE_LIMIT leaves, sqrt(1 - 0.999^2) [1].
REAR_COSINE_LEAST = 0.04471017781221601

# Larger than any step or distance, with a square that does not overflow [m]. As a radius or a place: nothing lies
# beyond it. As a lower bound of a gap it means that there is no pair.
FREE = 1e150
# A lower bound of a gap of which nothing is known [m].
NO_BOUND = -1e150
# The half width of no bracket: a march ends at any instant that is found to be within the margin [m].
NO_BRACKET = 0.0

# A root that does not exist; the last handle of a chain in which a bench before it folds; no bench.
NO_ROOT = -1.0
FOLDED = -1
NO_BENCH = -1

# Columns of a table of pieces, one row for each, joined by arc length s to a route. Curvature is positive
# counter-clockwise. The first piece also serves before its S_START, and the last one after its S_END.
PIECE_KIND, S_START, S_END, K_START = range(4)
K_END = 4  # on a crest K_START and K_END are a lower and an upper bound instead
# Of a line and of a clothoid: its point at S_START [m] and its unit direction there.
LINE_X, LINE_Y, LINE_DX, LINE_DY = range(5, 9)
K_RATE = 9  # of a clothoid: d curvature / d s [1/m^2]
# Of an arc and of a spiral: its centre [m].
CENTRE_X, CENTRE_Y = range(5, 7)
ARC_RADIUS = 7  # [m]
ARC_ANGLE = 8  # at S_START [rad]
SIGN = 9  # 1 for an arc that runs counter-clockwise and a spiral that runs outwards, else -1
COIL_GROWTH = 7  # [m/rad]
COIL_ROTATION = 8  # of the whole spiral [rad]
COIL_ARC = 10  # arc length from its centre at S_START [m]
# Of a cubic: the coefficients of r(t) = sum of c_k t^k for t in [0, T_END] [m]. The curvature of a cubic is monotonic;
# a crest is a cubic whose curvature has a maximum or a minimum inside.
X0, X1, X2, X3, Y0, Y1, Y2, Y3, T_END = range(5, 14)
K_SLOPE = 14  # bound on |d curvature / d s| [1/m^2]
PART = 15  # number of the part of the route; within a part curvature does not jump
# Largest distance from a joint at which the path leaves its pieces to close a gap between them [m].
BLEND = 1.0
LOOSE = 16  # largest distance of the piece from the path, whose tangent is continuous at the joints [m]
CURVATURE_SLACK = 17  # largest difference between its curvature and that of the path [1/m]
# What S_START, S_END and COIL_ARC [m], and COIL_GROWTH [m/rad], have lost in rounding.
S_START_LOW, S_END_LOW, COIL_ARC_LOW, COIL_GROWTH_LOW = range(18, 22)
SHARPEST = 22  # the largest |curvature| of all rows, the same in each [1/m]
# At the beginning of a line: |T' - T| of the tangents of both lines if there is a corner, else 0 [1]. Whether the route
# has corners, the same in each row: 1 or 0.
CORNER, CORNERED = 23, 24
PIECE_COLUMNS = 25
# Up to CLOTHOID a place follows from the arc length itself, on a cubic from a quadrature.
LINE, ARC, SPIRAL, CLOTHOID, CUBIC, CREST = range(6)
PIECE_KINDS = ("line", "arc", "spiral", "clothoid", "cubic", "crest")

# Column of a point of a route after PX to TY: its curvature [1/m].
POINT_CURVATURE = 4
POINT_COLUMNS = 5
# Columns of the gap between a piece and the one before it: across and along the path [m], in direction [rad], in
# curvature [1/m].
MISS_ACROSS, MISS_ALONG, MISS_KINK, MISS_STEP = range(4)
MISS_COLUMNS = 4


class Ended(IntEnum):
    """End of a march, or of a band of pitches: see marching.py and band_march.py."""

    REACHED = 0
    TOUCHED = 1
    TOUCHED_AT_START = 2
    STUCK = 3
    CAPACITY = 4
    UNBOUNDED = 5  # no bound on the motion is known: a handle may move backwards
    BENCH_FOLDED = 6


class Follows(IntEnum):
    """Reason why a bench is not shown to follow a route beyond a place: see follower.py."""

    PROVEN = 0
    SIDEWAYS = 1  # u . T at its rear handle falls to the least that counts as followable
    BACKWARDS = 2  # u . T at its front handle falls to zero, so that the rear one would walk backwards
    JUMPS = 3  # a nearer place of the route comes to the chord
    NOWHERE = 4  # no place behind is a chord away
    UNKNOWN = 5  # the work does not suffice


class Step(IntEnum):
    """Result of one step: proven; to be tried again, shorter or with more benches; or the last one."""

    ADVANCED = 0
    REFUSED = 1
    ENDED = 2


class Judged(IntEnum):
    """End of a search for the first excess over a limit: see excess.py."""

    KEPT = 0
    EXCEEDED = 1
    UNDECIDED = 2


# Spare distance beyond the radius or place from which a bound holds: relative to the radius [1], or along a route [m].
# Every use of the bound checks that the error of a handle is less than this.
CLEAR_SPARE = 1e-9
PLACE_SPARE = 1e-6

# The unit of work is one handle placed or one pair tried [1]. Measured on 2026-11-21: 0.14 us for a handle, 0.10 us for
# a pair, up to 0.4 us on routes, and 0.5 us for each step of a march, which therefore counts as STEP_WORK. In 0.14 us
# EDGES_PER_WORK distant edges at rest are tried.
STEP_WORK = 5.0
EDGES_PER_WORK = 64.0

# Columns of a shift row, one for each bench: bounds on derivatives by the growth.
SHIFT_CENTRE = 0  # |M'|
SHIFT_CORNER = 1  # |X'|
SHIFT_PULL = 2  # |X''| [rad/m]
SHIFT_OMEGA = 3  # |u'| [rad/m]
SHIFT_COLUMNS = 4

# Upper bound of curvature times radius on any spiral: 2 / 1.5^(3/2) = 1.08866 [1].
SPIRAL_CURVATURE_MOST = 1.0887

# Columns of a box of turns, see turn_refusal.py; each stands for the first arc, and beside it for the second: the
# nominal turn's radius [m] and angle [rad]; the most by which 1 / r differs from it [1/m]; least and greatest length
# [m]; the most by which it differs [m]; the nominal radius at which the coil begins, and the most by which it is less
# or more [m]; the greatest 1 / r [1/m]; the most by which radius [m] and angle [rad] differ.
TURN_RADIUS, TURN_ANGLE, TURN_BEND, TURN_LOW, TURN_HIGH, TURN_LONGER = range(0, 12, 2)
TURN_COIL, TURN_COIL_LESS, TURN_SHARPEST, TURN_WIDER, TURN_FURTHER = range(12, 22, 2)
TURN_BOX = 22

# Columns of what is remembered of a proof that a box of turns holds none to dance, see turn_refusal.py: its kind, the
# number of the chord, or -1 or 1 for the end of the dragon; place and other place of a handle [m]; calls until another
# one is looked for.
PROOF_KIND, PROOF_OF, PROOF_AT, PROOF_OVER, PROOF_WAIT, PROOF_COLUMNS = range(6)
