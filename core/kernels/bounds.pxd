cimport cython
from core.kernels.constants cimport *
from core.kernels.records cimport Cosines, Link, Stretch
from core.kernels.spiral cimport spiral_curvature
from core.kernels.stretches cimport blur_of, link_stretch, parts_between
from core.kernels.rounding cimport spiral_rounding

cdef double TRIAL
cdef double RATIO_FOLLOWED
cdef double SPIRAL_SWAY
cdef double LOOSEN
cdef double TIGHTEN
cdef double ROUTE_SINE_ROUNDED

cdef void stand_between(
    Py_ssize_t k, double[:, ::1] before, double[:, ::1] after, double widened, double[:, ::1] motion
) noexcept nogil

cdef void bench_bounds(
    Py_ssize_t k, double rate_a, double rate_b, double omega, double spin, double pull, double[:, ::1] sizes,
    double[:, ::1] motion
) noexcept nogil

cdef double summed_widening(
    double growth, Py_ssize_t benches, double[:, ::1] sizes, double[:, ::1] before, double[:, ::1] after
) noexcept nogil

cdef Link curved_link(double chord, double k_low, double k_high, double rate_a, double rate_low) noexcept nogil

cdef Link followed_link(
    Py_ssize_t k, double h, double k_high, double rate_a, double[:, ::1] sizes, double[:, ::1] before,
    double[:, ::1] after
) noexcept nogil

@cython.locals(k=cython.Py_ssize_t, followed=cython.bint, filled=cython.bint, link=Link)
cpdef bint motion_bounds(
    double growth, double h, Py_ssize_t benches, double[:, ::1] sizes, double[:, ::1] before, double[:, ::1] after,
    double[:, ::1] motion
) noexcept nogil

cdef (double, double) link_cosines(Py_ssize_t k, double[:, ::1] chain) noexcept nogil

cdef double swing_bound(
    double low, double high, double rate, double rate_low, double ratio, double ratio_low
) noexcept nogil

cdef Cosines route_cosines(
    Py_ssize_t k, double h, Stretch stretch, double rate_a, double rate_low, double[:, ::1] before,
    double[:, ::1] after
) noexcept nogil

cdef void bound_climb(
    Py_ssize_t k, double h, Stretch stretch, Cosines cosines, double[:, ::1] before, double[:, ::1] after,
    double[:, ::1] motion
) noexcept nogil

@cython.locals(k=cython.Py_ssize_t, stretch=Stretch, cosines=Cosines)
cpdef bint route_bounds(
    const double[:, ::1] pieces, double h, Py_ssize_t benches, double[:, ::1] sizes, double[:, ::1] before,
    double[:, ::1] after, bint climbing, double[:, ::1] motion
) noexcept nogil

cdef double followed_error(
    Py_ssize_t k, double error, double[:, ::1] sizes, double[:, ::1] before, double[:, ::1] after
) noexcept nogil
