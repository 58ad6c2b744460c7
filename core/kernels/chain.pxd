cimport cython
from core.kernels.arrays cimport Pairs, Pieces, Rows, Tables
from core.kernels.constants cimport *
from core.kernels.double_double cimport coil_theta
from core.kernels.spiral cimport first_guess, next_handle
from core.kernels.route cimport extend_route, start_route
from core.kernels.rounding cimport route_rounding, spiral_rounding

@cython.final
cdef class Curve:
    cdef readonly bint is_spiral
    cdef readonly double growth
    cdef double growth_low, place_low
    cdef Pieces pieces

cpdef Curve spiral_curve(double growth, double growth_low=*, double place_low=*)
cpdef Curve route_curve(Pieces pieces)
cpdef double head_theta(Curve curve, double place) noexcept nogil
cpdef void start_chain(double theta, Rows chain) noexcept nogil

@cython.locals(k=cython.Py_ssize_t, alike=cython.Py_ssize_t)
cpdef Py_ssize_t extend_chain(
    double growth, Py_ssize_t first, Py_ssize_t last, double radius, Rows sizes, Rows chain
) noexcept nogil

cdef Py_ssize_t extend(Curve curve, Py_ssize_t first, Py_ssize_t last, Rows sizes, Rows chain) noexcept nogil
cdef void start(Curve curve, double place, Rows chain) noexcept nogil
cpdef Py_ssize_t place_chain(Curve curve, double place, Py_ssize_t last, Rows sizes, Rows chain) noexcept nogil
cpdef void chain_rounding(Curve curve, Py_ssize_t last, Rows sizes, Rows chain) noexcept nogil

@cython.locals(last=cython.Py_ssize_t)
cpdef void route_trajectory(
    Pieces pieces, Pairs s, double head_speed, Rows sizes, Rows chain, Tables position, Tables velocity,
    Rows speed
) noexcept
