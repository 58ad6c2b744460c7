cimport cython
from core.kernels.arrays cimport Pieces, Rows
from core.kernels.constants cimport *
from core.kernels.records cimport Stretch

cdef double ROUTE_TURN

cpdef double steepest_curvature(double theta) noexcept nogil
cdef double blur_of(Py_ssize_t k, double turned, Rows before, Rows after) noexcept nogil

@cython.locals(p=cython.Py_ssize_t)
cdef (double, double) stretch_curvature(
    Pieces pieces, Py_ssize_t rear, double k_rear, Py_ssize_t front, double k_front
) noexcept nogil

@cython.locals(p=cython.Py_ssize_t)
cdef Py_ssize_t reached_piece(Pieces pieces, Py_ssize_t k, double way, Rows chain) noexcept nogil

@cython.locals(p=cython.Py_ssize_t)
cdef double stretch_slope(
    Pieces pieces, Py_ssize_t k, Py_ssize_t rear, Py_ssize_t front, Rows before, Rows after
) noexcept nogil

cdef double parts_between(Pieces pieces, Py_ssize_t k, Rows before, Rows after) noexcept nogil

cdef Stretch link_stretch(
    Pieces pieces, Py_ssize_t k, Py_ssize_t benches, Rows sizes, Rows before, Rows after
) noexcept nogil
