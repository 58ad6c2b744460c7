cimport cython
from core.kernels.constants cimport *
from core.kernels.spiral cimport extend_chain, spiral_curvature, spiral_theta, start_chain
from core.kernels.bounds cimport followed_error
from core.kernels.chain cimport chain_rounding, extend
from core.kernels.rings cimport coil_place, coil_radius, coil_reach, drift, leaders_reach, radius_beyond
from core.kernels.route cimport extend_route, stands_first, start_route
from core.kernels.pairs cimport interval_least, pair_most
from core.kernels.clearance cimport crossing, gap_at, row_clearance, row_gap

cdef double DIP_WIDTH
cdef double LEAST_STEP
cdef double LEAST_WAY
cdef double ALLOWANCE
cdef double CROSSING_WIDTH
cdef double WIDTH_ROUNDING
cdef double PASSED_BY
cdef double PEEK

@cython.locals(k=cython.Py_ssize_t)
cdef Py_ssize_t chain_between(
    double growth, const double[:, ::1] pieces, double place, Py_ssize_t leaders, Py_ssize_t benches, double margin,
    double allowance, bint turning, double[::1] ring, double[:, ::1] sizes, double[:, ::1] chain,
    Py_ssize_t[::1] found
) noexcept nogil

@cython.locals(k=cython.Py_ssize_t)
cdef Py_ssize_t route_between(
    const double[:, ::1] pieces, double place, Py_ssize_t leaders, Py_ssize_t benches, double margin,
    double allowance, double[::1] ring, double[:, ::1] sizes, double[:, ::1] chain, Py_ssize_t[::1] found
) noexcept nogil

@cython.locals(i=cython.Py_ssize_t)
cdef bint passed(
    double growth, const double[:, ::1] pieces, Py_ssize_t first, Py_ssize_t last, Py_ssize_t placed,
    double[:, ::1] sizes, double[:, ::1] opening, double[:, ::1] chain
) noexcept nogil

cdef bint turns_back(
    Py_ssize_t k, double h, double error, double[:, ::1] before, double[:, ::1] after, double[:, ::1] motion
) noexcept nogil

@cython.locals(i=cython.Py_ssize_t)
cdef bint may_turn(
    Py_ssize_t k, double h, double[:, ::1] sizes, double[:, ::1] before, double[:, ::1] after, double[:, ::1] motion
) noexcept nogil

@cython.locals(k=cython.Py_ssize_t)
cdef bint slid_back(
    double growth, Py_ssize_t first, Py_ssize_t last, Py_ssize_t placed, double h, double[::1] ring,
    double[:, ::1] sizes, double[:, ::1] opening, double[:, ::1] before, double[:, ::1] after, double[:, ::1] motion
) noexcept nogil

@cython.locals(
    edges=cython.Py_ssize_t, cap=cython.Py_ssize_t, first=cython.Py_ssize_t, followers=cython.Py_ssize_t,
    placed=cython.Py_ssize_t, opened=cython.Py_ssize_t, handles=cython.Py_ssize_t, active=cython.Py_ssize_t,
    turning=cython.bint, opens=cython.bint, last_a=cython.Py_ssize_t, last_b=cython.Py_ssize_t, a=cython.Py_ssize_t, b=cython.Py_ssize_t
)
cpdef int march(
    double growth, const double[:, ::1] pieces, double place, double start, double stop, Py_ssize_t leaders,
    bint at_start, double margin, double tolerance, double rounding, double budget, Py_ssize_t benches,
    Py_ssize_t statics, double[::1] ring, double[:, ::1] sizes, double[:, :, ::1] rows, double[:, ::1] motion,
    Py_ssize_t[::1] pair, double[::1] out
) noexcept
