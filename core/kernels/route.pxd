cimport cython
from core.kernels.arrays cimport Pairs, Pieces, Rows
from core.kernels.clothoid cimport clothoid_point
from core.kernels.constants cimport *
from core.kernels.double_double cimport coil_theta, quotient
cdef (double, double) two_sum(double a, double b) noexcept nogil

cdef int FIRST_STEPS
cdef double PASSED_END
from core.kernels.spiral cimport next_arc

cdef double cubic_speed(Pieces pieces, Py_ssize_t p, double t) noexcept nogil
cdef double cubic_arc(Pieces pieces, Py_ssize_t p, double t) noexcept nogil
cpdef void cubic_arcs(Pieces pieces, double[::1] out) noexcept nogil
@cython.locals(low=cython.Py_ssize_t, high=cython.Py_ssize_t, middle=cython.Py_ssize_t, step=cython.Py_ssize_t)
cdef Py_ssize_t piece_of(Pieces pieces, double s, Py_ssize_t near) noexcept nogil
@cython.locals(i=cython.int)
cdef (double, double, double, double, double) route_point(
    Pieces pieces, Py_ssize_t p, double s, double low
) noexcept nogil
cdef (double, double) cos_sin(double angle, double low) noexcept nogil
cdef (double, double, double, double, double) arc_point(
    Pieces pieces, Py_ssize_t p, double u, double low
) noexcept nogil
cdef (double, double, double, double, double) spiral_point(
    Pieces pieces, Py_ssize_t p, double theta, double low
) noexcept nogil
cpdef void route_points(Pieces pieces, Pairs s, Rows out) noexcept
cdef void set_piece_theta(Pieces pieces, Py_ssize_t p, Py_ssize_t k, Rows chain) noexcept nogil
cdef (double, double, double, double, double) cubic_point(Pieces pieces, Py_ssize_t p, double a) noexcept nogil
cdef (double, double) theta_at(Pieces pieces, Py_ssize_t p, double s, double low) noexcept nogil
cdef double first_place(Pieces pieces) noexcept nogil
cdef bint stands_first(Pieces pieces, Py_ssize_t k, Rows chain) noexcept nogil
cdef void start_route(Pieces pieces, double s, double low, Rows chain) noexcept nogil

@cython.locals(k=cython.Py_ssize_t, alike=cython.Py_ssize_t, same=cython.bint, tight=cython.bint)
cdef Py_ssize_t extend_route(
    Pieces pieces, Py_ssize_t first, Py_ssize_t last, double until, Rows sizes, Rows chain
) noexcept nogil

cdef void put_place(Py_ssize_t k, double step, Rows chain) noexcept nogil
cdef void put_handle(Py_ssize_t k, (double, double, double, double, double) point, Rows chain) noexcept nogil
@cython.locals(i=cython.int)
cdef void seek_rear(Pieces pieces, Py_ssize_t k, Py_ssize_t p, double step, double chord, Rows chain) noexcept nogil
@cython.locals(i=cython.int)
cdef (double, Py_ssize_t) first_behind(
    Pieces pieces, Py_ssize_t p, double s, double low, double x, double y, double chord
) noexcept nogil
cdef void seek_first(Pieces pieces, Py_ssize_t k, Py_ssize_t p, double chord, Rows chain) noexcept nogil
cdef void finish_link(Py_ssize_t k, double chord, Rows chain) noexcept nogil
