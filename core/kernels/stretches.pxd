cimport cython
from core.kernels.constants cimport *
from core.kernels.records cimport Stretch

cdef double ROUTE_TURN

cpdef double steepest_curvature(double theta) noexcept nogil

cdef double blur_of(Py_ssize_t k, double turned, double[:, ::1] before, double[:, ::1] after) noexcept nogil

@cython.locals(p=cython.Py_ssize_t)
cdef (double, double) stretch_curvature(
    const double[:, ::1] pieces, Py_ssize_t rear, double k_rear, Py_ssize_t front, double k_front
) noexcept nogil

@cython.locals(p=cython.Py_ssize_t)
cdef Py_ssize_t reached_piece(
    const double[:, ::1] pieces, Py_ssize_t k, double way, double[:, ::1] chain
) noexcept nogil

@cython.locals(p=cython.Py_ssize_t)
cdef double stretch_slope(
    const double[:, ::1] pieces, Py_ssize_t k, Py_ssize_t rear, Py_ssize_t front, double[:, ::1] before,
    double[:, ::1] after
) noexcept nogil

@cython.locals(rear=cython.Py_ssize_t, front=cython.Py_ssize_t)
cdef double parts_between(
    const double[:, ::1] pieces, Py_ssize_t k, double[:, ::1] before, double[:, ::1] after
) noexcept nogil

@cython.locals(p=cython.Py_ssize_t, q=cython.Py_ssize_t)
cdef Stretch link_stretch(
    const double[:, ::1] pieces, Py_ssize_t k, Py_ssize_t benches, double[:, ::1] sizes, double[:, ::1] before,
    double[:, ::1] after
) noexcept nogil
