cimport cython
from core.kernels.constants cimport *
from core.kernels.records cimport Rectangle, Seen

cdef double PARALLEL_SINE

@cython.final
cdef class Witnesses:
    cdef readonly double separation
    cdef readonly double ax
    cdef readonly double ay
    cdef readonly double bx
    cdef readonly double by
    cdef readonly double nx
    cdef readonly double ny
    cdef readonly int feature_a
    cdef readonly int feature_b

    cdef void reverse(self) noexcept nogil

cdef double side_of(double x) noexcept nogil
cdef int corner_at(double along, double left) noexcept nogil
cdef Seen seen_from(Rectangle a, Rectangle b) noexcept nogil
cdef double face_gap(Seen seen) noexcept nogil
cdef double point_gap_squared(double x, double y, double hl, double hw) noexcept nogil
cdef double corners_gap_squared(Seen seen) noexcept nogil
@cython.locals(a_seen=Seen, b_seen=Seen)
cdef double pair_gap_within(Rectangle a, Rectangle b, double limit) noexcept nogil

@cython.locals(a_seen=Seen, b_seen=Seen)
cdef void pair_separation(Rectangle a, Rectangle b, Witnesses out) noexcept nogil

@cython.locals(edge=cython.int, other_feature=cython.int)
cdef bint edge_witness(Rectangle a, Seen seen, Witnesses out) noexcept nogil

@cython.locals(k=cython.int)
cdef void corner_witness(Rectangle a, Seen seen, Witnesses out) noexcept nogil

cdef Rectangle framed(double[:, ::1] frames, Py_ssize_t i) noexcept nogil
cdef double rows_gap_within(Py_ssize_t i, Py_ssize_t j, double limit, double[:, ::1] frames) noexcept nogil
cdef Rectangle bench_of(Py_ssize_t i, double[:, ::1] sizes, double[:, ::1] chain) noexcept nogil

cdef double bench_gap_within(
    Py_ssize_t i, Py_ssize_t j, double limit, double[:, ::1] sizes, double[:, ::1] chain
) noexcept nogil

cdef void row_separation(
    Py_ssize_t i, Py_ssize_t j, double[:, ::1] sizes, double[:, ::1] chain, Witnesses out
) noexcept nogil

cpdef Witnesses bench_separation(Py_ssize_t a, Py_ssize_t b, double[:, ::1] sizes, double[:, ::1] chain)

@cython.locals(i=cython.Py_ssize_t, found=Witnesses)
cpdef void pair_separations(double[:, ::1] a, double[:, ::1] b, double[:, ::1] out)

@cython.locals(i=cython.Py_ssize_t)
cpdef void pair_gaps(double[:, ::1] a, double[:, ::1] b, double limit, double[::1] out) noexcept
