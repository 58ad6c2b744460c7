cimport cython
from core.kernels.constants cimport *
from core.kernels.budget cimport Budget
from core.kernels.rectangles cimport rows_gap_within

cdef Py_ssize_t LEAF

cdef bint boxes_meet(double[:, ::1] a, Py_ssize_t i, double[:, ::1] b, Py_ssize_t j) noexcept nogil

@cython.locals(leaves=cython.Py_ssize_t, k=cython.Py_ssize_t, i=cython.Py_ssize_t)
cpdef void grow_tree(double[:, ::1] boxes, double[:, ::1] tree) noexcept

cdef void widen(double[:, ::1] tree, Py_ssize_t k, double[:, ::1] boxes, Py_ssize_t i) noexcept nogil

@cython.final
cdef class Meetings:
    cdef double[:, ::1] frames
    cdef double[:, ::1] boxes
    cdef double[:, ::1] tree
    cdef long long[::1] order
    cdef long long[:, ::1] pairs
    cdef Budget budget
    cdef readonly long long found
    cdef readonly long long met

    @cython.locals(
        leaves=cython.Py_ssize_t, i=cython.Py_ssize_t, j=cython.Py_ssize_t, k=cython.Py_ssize_t,
        first=cython.Py_ssize_t, last=cython.Py_ssize_t
    )
    cpdef void find(
        self, double margin, bint exact, bint chained, long long most_found, long long most_met,
        long long[:, ::1] pairs
    ) noexcept
    @cython.locals(a=cython.longlong, b=cython.longlong)
    cdef void note(self, Py_ssize_t i, Py_ssize_t j, double margin, bint exact, bint chained) noexcept nogil
