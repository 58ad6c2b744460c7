cimport cython
from core.kernels.arrays cimport Rows
from core.kernels.constants cimport *
from core.kernels.budget cimport Budget
from core.kernels.rectangles cimport rows_gap_within

cdef Py_ssize_t LEAF

cdef bint boxes_meet(Rows a, Py_ssize_t i, Rows b, Py_ssize_t j) noexcept nogil
@cython.locals(leaves=cython.Py_ssize_t, k=cython.Py_ssize_t, i=cython.Py_ssize_t)
cpdef void grow_tree(Rows boxes, Rows tree) noexcept
cdef void widen(Rows tree, Py_ssize_t k, Rows boxes, Py_ssize_t i) noexcept nogil

@cython.final
cdef class Meetings:
    cdef Rows frames, boxes, tree
    cdef long long[::1] order
    cdef long long[:, ::1] pairs
    cdef Budget budget
    cdef readonly long long count, met

    @cython.locals(leaves=cython.Py_ssize_t, i=cython.Py_ssize_t, k=cython.Py_ssize_t, first=cython.Py_ssize_t)
    cpdef void find(
        self, double margin, bint exact, bint chained, long long most_pairs, long long most_met, long long[:, ::1] pairs
    ) noexcept

    @cython.locals(a=cython.longlong, b=cython.longlong)
    cdef void note(self, Py_ssize_t i, Py_ssize_t j, double margin, bint exact, bint chained) noexcept nogil
