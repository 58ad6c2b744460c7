cimport cython
from core.kernels.arrays cimport Pieces
from core.kernels.constants cimport *
from core.kernels.corners cimport corners_between, cosines_past
from core.kernels.route cimport first_behind, piece_of, route_point

cdef double SPARE, SLAB, SLAB_LEAST, AHEAD, AHEAD_LEAST

cdef double sharpest_between(Pieces pieces, double low, double high, Py_ssize_t p) noexcept nogil

@cython.final
cdef class Follower:
    cdef Pieces pieces
    cdef double chord, least, spare
    cdef readonly double reached, rear, rear_cosine, front_cosine, longest, work
    cdef Py_ssize_t p, q
    cdef bint cornered

    cpdef object follow(self, double start, double stop, double beyond, double most_work)
    @cython.locals(ended=cython.int, failed=cython.int)
    cdef int prove(self, double start, double stop, double beyond, double most_work) noexcept nogil
    cdef double rear_of(self, double s) noexcept nogil
    cdef int stands(self) noexcept nogil
    cdef (double, double) cosines(self, double s, double r) noexcept nogil
    cdef int slab(self, double h) noexcept nogil
    @cython.locals(first=cython.Py_ssize_t, last=cython.Py_ssize_t)
    cdef double past(self, double cosine, double low, double high, double s, double r) noexcept nogil
    @cython.locals(p=cython.Py_ssize_t)
    cdef bint nearer_are_near(self, double middle, double half, double near) noexcept nogil
