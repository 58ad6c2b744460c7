# The numbers of constants.py as the C compiler sees them: literals, so that columns cost nothing in inner loops.

cdef extern from *:
    const double PI "3.141592653589793"
    const double TWO_PI "6.283185307179586"
    const double ULP "1.1102230246251565e-16"
    const double SMALL "1e-4"
    const double NO_LIMIT "1e154"
    const double SINE_LIMIT "0.97"
    const double ROUTE_SINE_LIMIT "0.999"
    const double FREE "1e150"
    const double NO_BOUND "-1e+150"
    const double NO_BRACKET "0.0"
    const Py_ssize_t AT_REST "-1"
    const double NO_ROOT "-1.0"
    const Py_ssize_t FOLDED "-1"
    const Py_ssize_t NO_BENCH "-1"
    const double BLEND "1.0"
    const double CLEAR_SPARE "1e-09"
    const double PLACE_SPARE "1e-06"
    const double STEP_WORK "5.0"
    const double EDGES_PER_WORK "64.0"
    const double SPIRAL_CURVATURE_MOST "1.0887"

cdef enum:
    COS = 0, SIN = 1, PX = 0, PY = 1, TX = 2, TY = 3, LAG = 4, THETA = 4, PLACE = 4, RATE = 5, REST = 18, PLACE_REST = 19
    MX = 6, MY = 7, UX = 8, UY = 9
    CURVATURE = 10, PIECE = 11, PIECE_THETA = 12, CLIMB = 13, SLIP = 14, ERROR = 15, SWAY = 16, FILLED = 17
    CENTRE_SPEED = 0, CORNER_SPEED = 1, CENTRE_PULL = 2, CORNER_PULL = 3, OMEGA = 4, OMEGA_PULL = 5, HANDLE_SPEED = 6
    OMEGA_LOW = 7, OMEGA_RATE = 8
    RATE_HIGH = 9, RATE_LOW = 10, RATE_RATE = 11, THETA_HIGH = 12, THETA_LOW = 13, RATE_JERK = 14
    CURVATURE_LOW = 15, CURVATURE_HIGH = 16, CROSSED = 17, RATE_ERROR = 18, CLIMB_ERROR = 19
    CHORD = 0, HALF_LENGTH = 1, HALF_WIDTH = 2, RADIUS = 3
    FRAME_X = 0, FRAME_Y = 1, FRAME_UX = 2, FRAME_UY = 3, FRAME_HALF_LENGTH = 4, FRAME_HALF_WIDTH = 5
    SEPARATION = 0, WITNESS_AX = 1, WITNESS_AY = 2, WITNESS_BX = 3, WITNESS_BY = 4, NORMAL_X = 5, NORMAL_Y = 6
    FEATURE_A = 7, FEATURE_B = 8
    DIRECTIONS = 64, HULLS = 3, X = 0, Y = 1, HIGH = 0, LOW = 1, PAIR_A = 0, PAIR_B = 1, SINE = 0, COSINE = 1, FRONT_END = 0, MIDDLE = 1
    FRONT_LEFT = 0, FRONT_RIGHT = 1, REAR_RIGHT = 2, REAR_LEFT = 3, FRONT = 4, RIGHT = 5, REAR = 6, LEFT = 7
    X_LOW = 0, Y_LOW = 1, X_HIGH = 2, Y_HIGH = 3
    PIECE_KIND = 0, S_START = 1, S_END = 2, K_START = 3, K_END = 4, K_SLOPE = 14, PART = 15, LOOSE = 16, CURVATURE_SLACK = 17
    S_START_LOW = 18, S_END_LOW = 19, COIL_ARC_LOW = 20, COIL_GROWTH_LOW = 21
    LINE_X = 5, LINE_Y = 6, LINE_DX = 7, LINE_DY = 8, K_RATE = 9, CENTRE_X = 5, CENTRE_Y = 6, ARC_RADIUS = 7, ARC_ANGLE = 8, SIGN = 9
    COIL_GROWTH = 7, COIL_ROTATION = 8, COIL_ARC = 10
    X0 = 5, X1 = 6, X2 = 7, X3 = 8, Y0 = 9, Y1 = 10, Y2 = 11, Y3 = 12, T_END = 13
    POINT_CURVATURE = 4, MISS_ACROSS = 0, MISS_ALONG = 1, MISS_KINK = 2, MISS_STEP = 3
    LINE = 0, ARC = 1, SPIRAL = 2, CLOTHOID = 3, CUBIC = 4, CREST = 5
    SHIFT_CENTRE = 0, SHIFT_CORNER = 1, SHIFT_PULL = 2, SHIFT_OMEGA = 3

cdef enum Ended:
    REACHED = 0, TOUCHED = 1, TOUCHED_AT_START = 2, STUCK = 3, CAPACITY = 4, UNBOUNDED = 5, BENCH_FOLDED = 6

cdef enum Step:
    ADVANCED = 0, REFUSED = 1, ENDED = 2

cdef enum Judged:
    KEPT = 0, EXCEEDED = 1, UNDECIDED = 2

# The loops' arrays: rows of the columns above; a table of pieces; instants, handles, and x and y.
ctypedef double[:, ::1] Rows
ctypedef const double[:, ::1] Pieces
ctypedef const double[:, ::1] Pairs
ctypedef double[:, :, ::1] Tables
