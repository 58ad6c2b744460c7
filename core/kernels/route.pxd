cimport cython
from core.kernels.constants cimport *
from core.kernels.spiral cimport next_arc, spiral_arc, spiral_curvature, spiral_theta

cdef double cubic_speed(const double[:, ::1] pieces, Py_ssize_t p, double t) noexcept nogil
cdef double cubic_arc(const double[:, ::1] pieces, Py_ssize_t p, double t) noexcept nogil

@cython.locals(p=cython.Py_ssize_t)
cpdef void cubic_arcs(const double[:, ::1] pieces, double[::1] out) noexcept nogil

@cython.locals(low=cython.Py_ssize_t, high=cython.Py_ssize_t, middle=cython.Py_ssize_t, step=cython.Py_ssize_t)
cdef Py_ssize_t piece_of(const double[:, ::1] pieces, double s, Py_ssize_t near) noexcept nogil

@cython.locals(kind=cython.int, i=cython.int)
cdef (double, double, double, double, double) route_point(
    const double[:, ::1] pieces, Py_ssize_t p, double s
) noexcept nogil

cdef (double, double, double, double, double) spiral_point(
    const double[:, ::1] pieces, Py_ssize_t p, double theta
) noexcept nogil

@cython.locals(i=cython.Py_ssize_t, p=cython.Py_ssize_t)
cpdef void route_points(const double[:, ::1] pieces, const double[::1] s, double[:, ::1] out) noexcept

cdef void set_piece_theta(const double[:, ::1] pieces, Py_ssize_t p, Py_ssize_t k, double[:, ::1] chain) noexcept nogil

cdef (double, double, double, double, double) cubic_point(
    const double[:, ::1] pieces, Py_ssize_t p, double a
) noexcept nogil
cdef double theta_at(const double[:, ::1] pieces, Py_ssize_t p, double s) noexcept nogil

cdef double first_place(const double[:, ::1] pieces) noexcept nogil
cdef bint stands_first(const double[:, ::1] pieces, Py_ssize_t k, double[:, ::1] chain) noexcept nogil

@cython.locals(p=cython.Py_ssize_t)
cdef void start_route(const double[:, ::1] pieces, double s, double[:, ::1] chain) noexcept nogil

@cython.locals(k=cython.Py_ssize_t, p=cython.Py_ssize_t, alike=cython.Py_ssize_t, same=cython.bint)
cdef Py_ssize_t extend_route(
    const double[:, ::1] pieces, Py_ssize_t first, Py_ssize_t last, double until, double[:, ::1] sizes,
    double[:, ::1] chain
) noexcept nogil

cdef void put_handle(
    Py_ssize_t k, (double, double, double, double, double) point, double[:, ::1] chain
) noexcept nogil

@cython.locals(i=cython.int)
cdef void seek_rear(
    const double[:, ::1] pieces, Py_ssize_t k, Py_ssize_t p, double step, double chord, double[:, ::1] chain
) noexcept nogil

cdef void finish_link(Py_ssize_t k, double chord, double[:, ::1] chain) noexcept nogil
