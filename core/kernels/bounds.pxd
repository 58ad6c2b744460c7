cimport cython
from core.kernels.arrays cimport Pieces, Rows
from core.kernels.constants cimport *
from core.kernels.corners cimport bench_has_corner, cornered_link, jumped, passes_corner
from core.kernels.records cimport Cosines, LinkBounds, Stretch
from core.kernels.spiral cimport spiral_curvature
from core.kernels.stretches cimport blur_of, link_stretch, parts_between
from core.kernels.rounding cimport spiral_rounding

cdef double TRIAL, RATIO_FOLLOWED, SPIRAL_SWAY, LOOSEN, TIGHTEN, ROUTE_SINE_ROUNDED, WIDTH_SPARE

cdef void stand_between(Py_ssize_t k, Rows before, Rows after, double widened, Rows motion) noexcept nogil

cdef void bench_bounds(
    Py_ssize_t k, double rate_a, double rate_b, double omega, double spin, double pull, Rows sizes, Rows motion
) noexcept nogil

cdef double summed_widening(double growth, Py_ssize_t benches, Rows sizes, Rows before, Rows after) noexcept nogil
cdef LinkBounds curved_link(double chord, double k_low, double k_high, double rate_a, double rate_low) noexcept nogil

cdef LinkBounds followed_link(
    Py_ssize_t k, double h, double k_high, double rate_a, double chord, double blur, Rows before, Rows after
) noexcept nogil

@cython.locals(k=cython.Py_ssize_t)
cpdef bint motion_bounds(
    double growth, double h, Py_ssize_t benches, Rows sizes, Rows before, Rows after, Rows motion
) noexcept nogil

cdef (double, double) link_cosines(Py_ssize_t k, Rows chain) noexcept nogil

cdef double swing_bound(
    double low, double high, double rate, double rate_low, double ratio, double ratio_low
) noexcept nogil

cdef Cosines route_cosines(
    Py_ssize_t k, double h, Stretch stretch, double rate_a, double rate_low, Rows before, Rows after
) noexcept nogil

cdef void bound_climb(
    Py_ssize_t k, double h, Stretch stretch, Cosines cosines, Rows before, Rows after, Rows motion
) noexcept nogil

@cython.locals(k=cython.Py_ssize_t, cornered=cython.bint, bends=cython.bint)
cpdef bint route_bounds(
    Pieces pieces, double h, Py_ssize_t benches, Rows sizes, Rows before, Rows after, bint climbing, Rows motion
) noexcept nogil

cdef double followed_error(Py_ssize_t k, double error, Rows sizes, Rows before, Rows after) noexcept nogil
