"""Columns of the loops' arrays, and a few numbers that the loops share.

Compiled, the same names are literals of the C code, from constants.pxd; a test holds the two lists together.
"""

PI = 3.141592653589793
TWO_PI = 6.283185307179586

# Unit of rounding of a double: the error of one operation is at most this part of its result [1].
ULP = 1.1102230246251565e-16
# The rounding of so many links, times their number, is small in the sense of rounding.py if it is at most this part of
# the shortest chord [1].
SMALL = 1e-4

# Beyond every distance: the squares of two coordinates would overflow [m].
NO_LIMIT = 1e154

# Columns of a chain row, one for each handle. On a spiral the frame is one in which the head stands at polar angle 0.
COS = 0  # of the polar angle; on a route
SIN = 1
PX = 0  # the position instead [m]
PY = 1
TX = 2  # unit tangent in the direction of travel
TY = 3
THETA = 4  # on a route
PLACE = 4  # minus the arc length s instead [m]: both fall in the direction of travel
RATE = 5  # d s / d sigma
REST = 10  # what THETA lacks to the sum of all delta
# and, for the bench behind that handle, its centre and direction
MX = 6
MY = 7
UX = 8
UY = 9
# and on a route the handle's curvature [1/m], piece, and theta if that is a spiral
CURVATURE = 10
PIECE = 11
PIECE_THETA = 12
CLIMB = 13  # d rate / d sigma [1/m], where climbs() filled it in
# Rounding, where chain_rounding() filled it in: how far along the path from its true place the handle may be,
SLIP = 14
# and how far from its true point any of the two handles of the bench behind it [m]
ERROR = 15
SWAY = 16  # and how far its direction from the true one [1]
FILLED = 17  # in row 0: up to which handle
CHAIN_COLUMNS = 18

# Columns of a motion row, one for each bench: bounds over an interval.
CENTRE_SPEED = 0
CORNER_SPEED = 1
CENTRE_PULL = 2
CORNER_PULL = 3
TURN = 4
TURN_PULL = 5  # omega^2 + omega'
HANDLE_SPEED = 6  # of the faster of its two handles
TURN_LOW = 7
TURN_RATE = 8  # |omega'|
# and of the handle in front of it
RATE_HIGH = 9
RATE_LOW = 10
RATE_RATE = 11  # |s''|
THETA_HIGH = 12
THETA_LOW = 13
RATE_JERK = 14  # |s'''| on a route, where no handle up to it crosses into another part
CURVATURE_LOW = 15  # on a spiral, times its growth
CURVATURE_HIGH = 16
CROSSED = 17  # how many joints between the parts of a route the handles up to it cross, all told
# Rounding of RATE [1] and of CLIMB [1/m] at either end of the interval, on a route where climbs() was asked.
RATE_ERROR = 18
CLIMB_ERROR = 19
MOTION_COLUMNS = 20

# Columns of a size row, one for each bench.
CHORD = 0
HALF_LENGTH = 1
HALF_WIDTH = 2
RADIUS = 3
SIZE_COLUMNS = 4

# Columns of a frame, which is a rectangle in the plane: its centre [m], the unit vector along it, half its size [m].
FRAME_X = 0
FRAME_Y = 1
FRAME_UX = 2
FRAME_UY = 3
FRAME_HALF_LENGTH = 4
FRAME_HALF_WIDTH = 5
FRAME_COLUMNS = 6

# Columns of the separation of two rectangles a and b [m]: with its witnesses, the normal from a to b, and features.
SEPARATION = 0
WITNESS_AX = 1
WITNESS_AY = 2
WITNESS_BX = 3
WITNESS_BY = 4
NORMAL_X = 5
NORMAL_Y = 6
FEATURE_A = 7
FEATURE_B = 8
SEPARATION_COLUMNS = 9

# Even directions of the half planes of a hull, the hulls of a bench, and the columns of their corners [m].
DIRECTIONS = 64
HULLS = 3
HULL_X = 0
HULL_Y = 1

# Features of a rectangle: its corners, then its edges.
FRONT_LEFT = 0
FRONT_RIGHT = 1
REAR_RIGHT = 2
REAR_LEFT = 3
FRONT = 4
RIGHT = 5
REAR = 6
LEFT = 7

# Columns of an upright box [m].
X_LOW = 0
Y_LOW = 1
X_HIGH = 2
Y_HIGH = 3
BOX_COLUMNS = 4

# The chord lemma serves up to this curvature chord / 2; beyond it the angles are followed [1].
BEND_LIMIT = 0.97
# The same on a route, where the cosines of the angles are followed too: at 1 a chord is the diameter of its bend and
# its rear handle can be infinitely faster than its front one, here 22 times.
ROUTE_BEND_LIMIT = 0.999

# Larger than any step or distance, with a square that does not overflow [m]. As a radius or a place, nothing is beyond
# it; as a lower bound of a gap it means that there is no pair, and -FREE that nothing is known.
FREE = 1e150

# In place of a root: there is none. In place of the last handle of a chain: a bench before it folds. In place of a
# bench: none.
NO_ROOT = -1.0
FOLDED = -1
NO_BENCH = -1

# A route is a table of pieces joined by arc length s. One row a piece, curvature counter-clockwise positive.
# The first piece also serves before S_START and the last one after S_END.
PIECE_KIND = 0
S_START = 1
S_END = 2
K_START = 3
K_END = 4  # on a crest K_START and K_END are a lower and an upper bound instead
# and, on a line, its point at S_START [m] and its unit direction,
LINE_X = 5
LINE_Y = 6
LINE_DX = 7
LINE_DY = 8
# on an arc and on a spiral its centre [m]
CENTRE_X = 5
CENTRE_Y = 6
ARC_RADIUS = 7  # [m]
ARC_ANGLE = 8  # at S_START [rad]
SIGN = 9  # 1 for an arc that runs counter-clockwise and a spiral that runs outwards, else -1
COIL_GROWTH = 7  # [m/rad]
COIL_ROTATION = 8  # of the whole spiral [rad]
COIL_ARC = 10  # arc length from its centre at S_START [m]
# and on a cubic the coefficients of r(t) = sum of c_k t^k for t in [0, T_END] [m]. A cubic has a monotonic curvature,
# a crest is a cubic with a crest of curvature in it.
X0 = 5
X1 = 6
X2 = 7
X3 = 8
Y0 = 9
Y1 = 10
Y2 = 11
Y3 = 12
T_END = 13
K_SLOPE = 14  # bound on |d curvature / d s| [1/m^2]
PART = 15  # within a part of the route curvature has no jump
# Pieces that miss each other are led together within so much of their joint [m].
BLEND = 1.0
LOOSE = 16  # the pieces join to a path with a continuous tangent that is nowhere further from them than this [m]
BENT = 17  # nor its curvature from theirs [1/m]
PIECE_COLUMNS = 18
LINE = 0
ARC = 1
SPIRAL = 2
CREST = 4
PIECE_KINDS = ("line", "arc", "spiral", "cubic", "crest")

# Columns of a point of a route besides PX to TY: its curvature [1/m].
POINT_CURVATURE = 4
POINT_COLUMNS = 5
# Gap between a piece and the one before it: across and along the path [m], in direction [rad], in curvature [1/m].
MISS_ACROSS = 0
MISS_ALONG = 1
MISS_KINK = 2
MISS_STEP = 3
MISS_COLUMNS = 4

# Kind of a path.
ON_SPIRAL = 0
ON_ROUTE = 1

# The benches of a scene are kept apart from each other, or from edges at rest.
BENCHES = 0
EDGES = 1

# How a march ended.
REACHED = 0
TOUCHED = 1
TOUCHED_AT_START = 2
STUCK = 3
CAPACITY = 4
TURNED = 5
MARCH_STATES = ("reached", "touched", "touched_at_start", "stuck", "capacity", "turned")
# Results of one step, if the march goes on.
ADVANCED = 6
REFUSED = 7

# How a search for the first excess ended.
KEPT = 0
EXCEEDED = 1
GIVEN_UP = 2

# A bound that holds from a radius or a place outwards is used only this much further out, relative to the radius [1] or
# along a route [m]. That is more than the error of a handle, which is checked at each use.
CLEAR_SPARE = 1e-9
PLACE_SPARE = 1e-6

# Work is counted in handles placed and pairs tried [1]. A step of a march takes 0.5 us besides 0.14 us a handle and
# 0.10 us a pair, on routes up to 0.4 us (2026-11-21): so much work. Of so many edges at rest that are far one is tried
# in 0.14 us.
STEP_WORK = 5.0
EDGES_PER_WORK = 64.0

# Columns of a shift row, one for each bench: bounds per growth.
SHIFT_CENTRE = 0  # |M'|
SHIFT_CORNER = 1  # |X'|
SHIFT_PULL = 2  # |X''| [rad/m]
SHIFT_TURN = 3  # |u'| [rad/m]
SHIFT_COLUMNS = 4

# Above the largest curvature of any spiral at a radius, times that radius: 2 / 1.5^(3/2) = 1.08866 [1].
SPIRAL_CURVATURE_MOST = 1.0887
