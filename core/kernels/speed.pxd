cimport cython
from core.kernels.constants cimport *
from core.kernels.spiral cimport extend_chain, spiral_curvature, spiral_theta, start_chain, steepest_bend
from core.kernels.route cimport extend_route, first_place, start_route
from core.kernels.chain cimport chain_rounding, extend
from core.kernels.bounds cimport LOOSEN, SPIRAL_TURN, blur_of, followed_error, link_cosines, motion_bounds, route_bounds
from core.kernels.rings cimport drift

cdef double APPROACH
cdef double LAST_SAMPLE
cdef double NOISE
cdef double PEAK_WIDTH
cdef Py_ssize_t INTERVAL_LINKS
cdef double BOUND_ROUNDING
cdef double WIDTH_ROUNDING

cdef Py_ssize_t lively_chain(
    double growth, const double[:, ::1] pieces, double place, Py_ssize_t last, double calm, double[:, ::1] sizes,
    double[:, ::1] chain
) noexcept nogil

@cython.locals(k=cython.Py_ssize_t, best=cython.Py_ssize_t)
cdef Py_ssize_t fastest(Py_ssize_t benches, double[:, ::1] chain) noexcept nogil

@cython.locals(k=cython.Py_ssize_t)
cdef (double, Py_ssize_t) top_rate(
    double growth, const double[:, ::1] pieces, double place, Py_ssize_t benches, double calm, double[:, ::1] sizes,
    double[:, ::1] chain
) noexcept nogil

@cython.locals(i=cython.Py_ssize_t)
cpdef void climbs(
    double growth, const double[:, ::1] pieces, Py_ssize_t last, double[:, ::1] sizes, double[:, ::1] chain
) noexcept nogil

@cython.locals(k=cython.Py_ssize_t)
cdef double refined_peak(
    double growth, const double[:, ::1] pieces, double place, double low, double high, Py_ssize_t benches,
    double calm, double[:, ::1] sizes, double[:, ::1] chain
) noexcept nogil

@cython.locals(k=cython.Py_ssize_t)
cdef void spiral_jerks(
    double growth, double h, Py_ssize_t handles, double[:, ::1] sizes, double[:, ::1] before, double[:, ::1] after,
    double[:, ::1] motion
) noexcept nogil

@cython.locals(k=cython.Py_ssize_t)
cpdef void spiral_errors(
    double growth, Py_ssize_t handles, double[:, ::1] sizes, double[:, ::1] before, double[:, ::1] after,
    double[:, ::1] motion
) noexcept nogil

cdef double smooth_bound(
    double start, double start_slope, double end, double end_slope, double jerk, double h, bint kink
) noexcept nogil

@cython.locals(k=cython.Py_ssize_t)
cdef double rate_bound(
    double growth, const double[:, ::1] pieces, double h, double rounding, Py_ssize_t handles, Py_ssize_t benches,
    double calm, double[:, ::1] sizes, double[:, ::1] before, double[:, ::1] after, double[:, ::1] motion
) noexcept nogil

@cython.locals(k=cython.Py_ssize_t, at=cython.Py_ssize_t)
cdef (double, Py_ssize_t) certain_rate(
    const double[:, ::1] pieces, double rounding, Py_ssize_t handles, double[:, ::1] chain, double[:, ::1] motion
) noexcept nogil

@cython.locals(a=cython.Py_ssize_t, b=cython.Py_ssize_t)
cdef bint peaks_between(
    Py_ssize_t placed, Py_ssize_t handles, double[:, ::1] before, double[:, ::1] after
) noexcept nogil

@cython.locals(placed=cython.Py_ssize_t, handles=cython.Py_ssize_t, links=cython.Py_ssize_t)
cpdef void peak_rate(
    double growth, const double[:, ::1] pieces, double place, double start, double stop, double step,
    double tolerance, double loosest, double rounding, Py_ssize_t budget, Py_ssize_t benches, double calm, double[:, ::1] sizes,
    double[:, :, ::1] rows, double[:, ::1] motion, double[::1] out
) noexcept
