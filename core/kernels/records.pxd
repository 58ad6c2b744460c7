# The records of records.py as the C compiler sees them.

cdef struct Rectangle:
    double x
    double y
    double ux
    double uy
    double half_length
    double half_width

cdef struct Seen:
    double along
    double left
    double c
    double s
    double hl
    double hw
    double other_hl
    double other_hw

cdef struct Link:
    double cos_front
    double cos_rear
    double sine
    double rate
    double rate_low
    double omega
    double omega_low
    double swing_front
    double swing_rear

cdef struct Stretch:
    double chord
    double low
    double high
    double slope
    double widened
    double sine
    double blur

cdef struct Cosines:
    double front_low
    double front_high
    double rear_low
    double rear_high

cdef struct Pair:
    Py_ssize_t first
    Py_ssize_t second

cdef struct Closest:
    double gap
    Py_ssize_t first
    Py_ssize_t second

cdef struct Laid:
    Py_ssize_t last
    Py_ssize_t leading

cdef struct Nearest:
    double least
    double gap_curvature
    Py_ssize_t first
    Py_ssize_t second
    double room
    double error
    Py_ssize_t tried

cdef struct Rounding:
    double point
    double gap

cdef struct Curvatures:
    double low
    double high
    double across

cdef struct Corner:
    double x
    double y

cdef struct Axis:
    Py_ssize_t k
    double gap

cdef struct Hulls:
    Py_ssize_t first
    Py_ssize_t second
    double half_length
    double other_half_length

cdef struct View:
    double along
    double left
    double c
    double s
    Py_ssize_t shift

cdef struct Views:
    View low_start
    View low_end
    View high_start
    View high_end

cdef struct Faced:
    Py_ssize_t k
    Py_ssize_t own
    Py_ssize_t other
    bint swapped
    double gap
