cimport cython
from core.kernels.constants cimport *

cdef double PARALLEL_SINE

cdef double side_of(double x) noexcept nogil
cdef int corner_at(double along, double left) noexcept nogil

cdef double face_gap(
    double along, double left, double c, double s, double hl, double hw, double other_hl, double other_hw
) noexcept nogil

cdef double point_gap_squared(double x, double y, double hl, double hw) noexcept nogil

cdef double corners_gap_squared(
    double along, double left, double c, double s, double hl, double hw, double other_hl, double other_hw
) noexcept nogil

cpdef double pair_gap(
    double ax, double ay, double aux, double auy, double ahl, double ahw, double bx, double by, double bux,
    double buy, double bhl, double bhw
) noexcept nogil

cpdef double pair_gap_within(
    double ax, double ay, double aux, double auy, double ahl, double ahw, double bx, double by, double bux,
    double buy, double bhl, double bhw, double limit
) noexcept nogil

cpdef void pair_separation(
    double ax, double ay, double aux, double auy, double ahl, double ahw, double bx, double by, double bux,
    double buy, double bhl, double bhw, double[::1] out
) noexcept nogil

@cython.locals(edge=cython.int, other_feature=cython.int)
cdef bint edge_witness(
    double x, double y, double ux, double uy, double hl, double hw, double along, double left, double c, double s,
    double other_hl, double other_hw, double[::1] out
) noexcept nogil

@cython.locals(corner=cython.int, k=cython.int, feature=cython.int)
cdef void corner_witness(
    double x, double y, double ux, double uy, double hl, double hw, double along, double left, double c, double s,
    double other_hl, double other_hw, double[::1] out
) noexcept nogil

@cython.locals(features=cython.int)
cdef void reverse_pair(double[::1] out) noexcept nogil

@cython.locals(i=cython.Py_ssize_t)
cpdef void pair_separations(double[:, ::1] a, double[:, ::1] b, double[:, ::1] out) noexcept
