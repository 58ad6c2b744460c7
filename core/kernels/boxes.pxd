cimport cython
from core.kernels.constants cimport *
from core.kernels.rectangles cimport pair_gap_within

cdef Py_ssize_t LEAF

cdef bint boxes_meet(double[:, ::1] a, Py_ssize_t i, double[:, ::1] b, Py_ssize_t j) noexcept nogil

@cython.locals(leaves=cython.Py_ssize_t, k=cython.Py_ssize_t, i=cython.Py_ssize_t)
cpdef void grow_tree(double[:, ::1] boxes, double[:, ::1] tree) noexcept

@cython.locals(axis=cython.int)
cdef void widen(double[:, ::1] tree, Py_ssize_t k, double[:, ::1] boxes, Py_ssize_t i) noexcept nogil

@cython.locals(
    leaves=cython.Py_ssize_t, capacity=cython.Py_ssize_t, i=cython.Py_ssize_t, j=cython.Py_ssize_t,
    k=cython.Py_ssize_t, last=cython.Py_ssize_t, found=cython.longlong, met=cython.longlong, a=cython.longlong,
    b=cython.longlong
)
cpdef void meeting_pairs(
    double[:, ::1] frames, double[:, ::1] boxes, double[:, ::1] tree, long long[::1] order, double margin,
    bint exact, bint chained, long long[::1] limits, long long[:, ::1] pairs, long long[::1] counts
) noexcept

cdef double rows_gap(double[:, ::1] frames, Py_ssize_t i, Py_ssize_t j, double limit) noexcept nogil
