# The records of records.py as the C compiler sees them.

cdef struct Rectangle:
    double x, y, ux, uy, half_length, half_width

cdef struct Relative:
    double along, left, c, s, hl, hw, other_hl, other_hw

cdef struct LinkBounds:
    double cos_front, cos_rear, sine, rate, rate_low, omega, omega_low, swing_front, swing_rear
    bint followed, bounded

cdef struct Stretch:
    double chord, low, high, slope, widened, sine, blur

cdef struct Cosines:
    double front_low, front_high, rear_low, rear_high

cdef struct Pair:
    Py_ssize_t first, second

cdef struct Closest:
    double gap
    Py_ssize_t first, second

cdef struct Laid:
    Py_ssize_t last, leading

cdef struct PairBounds:
    double least, gap_curvature
    Py_ssize_t first, second
    double width, error
    Py_ssize_t tried

cdef struct Rounding:
    double point, gap

cdef struct Curvatures:
    double low, high, across

cdef struct Corner:
    double x, y

cdef struct Axis:
    Py_ssize_t k
    double gap

cdef struct Hulls:
    Py_ssize_t first, second
    double half_length, other_half_length

cdef struct View:
    double along, left, c, s
    Py_ssize_t shift

cdef struct Views:
    View low_start, low_end, high_start, high_end

cdef struct Faced:
    Py_ssize_t k, own, other
    bint swapped
    double gap
