cimport cython
from core.kernels.constants cimport *
from core.kernels.rectangles cimport pair_separation
from core.kernels.chain cimport chain_rounding, place_chain
from core.kernels.bounds cimport motion_bounds, route_bounds
from core.kernels.rings cimport drift, leaders_reach, radius_beyond, stays_beyond
from core.kernels.spiral cimport spiral_error, spiral_rounding

cdef double STRIP_ROUNDING

cdef void row_separation(
    Py_ssize_t i, Py_ssize_t j, double[:, ::1] sizes, double[:, ::1] chain, double[::1] out
) noexcept nogil

cdef double gap_along(
    Py_ssize_t i, Py_ssize_t j, double along, double left, double[:, ::1] sizes, double[:, ::1] chain
) noexcept nogil

cdef (double, double, double) best_axis(
    Py_ssize_t i, Py_ssize_t j, double[:, ::1] sizes, double[:, ::1] chain
) noexcept nogil

cdef double least_between(double start, double end, double bend, double h) noexcept nogil
cdef double apart(double a_low, double a_high, double b_low, double b_high) noexcept nogil

cdef (double, double) against_rotation(
    double growth, Py_ssize_t k, double turn_low, double turn_high, double[:, ::1] motion
) noexcept nogil

@cython.locals(side=cython.int)
cpdef double axis_bend(
    double growth, Py_ssize_t i, Py_ssize_t j, double distance, double[:, ::1] sizes, double[:, ::1] motion
) noexcept nogil

cdef double plain_bend(
    Py_ssize_t i, Py_ssize_t j, double distance, double[:, ::1] sizes, double[:, ::1] motion
) noexcept nogil

cpdef bint pair_bends(
    double growth, const double[:, ::1] pieces, double place, double h, Py_ssize_t a, Py_ssize_t b,
    double[:, ::1] sizes, double[:, :, ::1] rows, double[:, ::1] motion, double[::1] out
) noexcept nogil

cdef bint lay_out(
    double growth, const double[:, ::1] pieces, double place, double h, Py_ssize_t last, double[:, ::1] sizes,
    double[:, ::1] before, double[:, ::1] after, double[:, ::1] motion
) noexcept nogil

@cython.locals(corner=cython.int)
cdef double corner_most(
    Py_ssize_t i, Py_ssize_t j, double bend, double h, double[:, ::1] sizes, double[:, ::1] before,
    double[:, ::1] after
) noexcept nogil

cdef (double, double) corner_in(
    Py_ssize_t i, Py_ssize_t j, double length, double width, double[:, ::1] chain
) noexcept nogil

@cython.locals(last=cython.Py_ssize_t)
cpdef double pair_most(
    double growth, const double[:, ::1] pieces, double place, double h, Py_ssize_t a, Py_ssize_t b,
    Py_ssize_t benches, double[:, ::1] sizes, double[:, ::1] before, double[:, ::1] after, double[:, ::1] motion,
    double[::1] out
) noexcept nogil

cpdef double pair_rounding(
    Py_ssize_t i, Py_ssize_t j, double distance, double[:, ::1] sizes, double[:, ::1] before, double[:, ::1] after
) noexcept nogil

cdef double any_rounding(double error, Py_ssize_t handles, double h, double margin, double[::1] ring) noexcept nogil

cdef double axis_least(
    Py_ssize_t i, Py_ssize_t j, bint after_decides, double bend, double h, double[:, ::1] sizes,
    double[:, ::1] before, double[:, ::1] after
) noexcept nogil

cpdef double pair_least(
    double growth, Py_ssize_t i, Py_ssize_t j, double margin, double enough, double distance, double h,
    double[:, ::1] sizes, double[:, ::1] before, double[:, ::1] after, double[:, ::1] motion, double[::1] out
) noexcept nogil

@cython.locals(
    edges=cython.Py_ssize_t, i=cython.Py_ssize_t, j=cython.Py_ssize_t, a=cython.Py_ssize_t, b=cython.Py_ssize_t,
    tried=cython.Py_ssize_t, roughly=cython.bint, filled=cython.bint
)
cdef double interval_least(
    double growth, const double[:, ::1] pieces, Py_ssize_t statics, double h, Py_ssize_t active, Py_ssize_t handles,
    Py_ssize_t benches, double margin, double[::1] ring, double[:, ::1] sizes, double[:, ::1] before,
    double[:, ::1] after, double[:, ::1] motion, double[::1] out
) noexcept nogil

cdef double strip_along(
    Py_ssize_t i, Py_ssize_t j, double along, double left, (double, double, double) bends,
    (double, double, double, double) widths, double[:, ::1] sizes, double[:, ::1] before, double[:, ::1] after,
    double[:, ::1] before_high, double[:, ::1] after_high
) noexcept nogil

@cython.locals(a=cython.Py_ssize_t, b=cython.Py_ssize_t, trial=cython.int)
cdef double strip_pair(
    double low, double high, Py_ssize_t i, Py_ssize_t j, double distance, double margin, double enough, double h_low,
    double h_high, double[:, ::1] sizes, double[:, ::1] before, double[:, ::1] after, double[:, ::1] before_high,
    double[:, ::1] after_high, double[:, ::1] motion, double[:, ::1] motion_high, double[:, ::1] shifts,
    double[::1] out
) noexcept nogil

cdef void strip_rounding(
    double low, double high, Py_ssize_t handles, double[:, ::1] sizes, double[:, ::1] before, double[:, ::1] after,
    double[:, ::1] before_high, double[:, ::1] after_high
) noexcept nogil

@cython.locals(
    i=cython.Py_ssize_t, j=cython.Py_ssize_t, a=cython.Py_ssize_t, b=cython.Py_ssize_t, tried=cython.Py_ssize_t,
    roughly=cython.bint, filled=cython.bint
)
cdef double strip_least(
    double low, double high, Py_ssize_t leaders, Py_ssize_t handles, double margin, double h_low, double h_high,
    double[::1] ring, double[:, ::1] sizes, double[:, ::1] before, double[:, ::1] after, double[:, ::1] before_high,
    double[:, ::1] after_high, double[:, ::1] motion, double[:, ::1] motion_high, double[:, ::1] shifts,
    double[::1] out
) noexcept nogil
