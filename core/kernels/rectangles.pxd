cimport cython
from core.kernels.arrays cimport Rows
from core.kernels.constants cimport *
from core.kernels.records cimport Rectangle, Relative

cdef double PARALLEL_SINE

@cython.final
cdef class Witnesses:
    cdef readonly double separation, ax, ay, bx, by, nx, ny
    cdef readonly int feature_a, feature_b

    cdef void reverse(self) noexcept nogil

cdef double side_of(double x) noexcept nogil
cdef int corner_at(double along, double left) noexcept nogil
cdef Relative seen_from(Rectangle a, Rectangle b) noexcept nogil
cdef double face_gap(Relative seen) noexcept nogil
cdef double point_gap_squared(double x, double y, double hl, double hw) noexcept nogil
cdef double corners_gap_squared(Relative seen) noexcept nogil
cdef double pair_gap_within(Rectangle a, Rectangle b, double limit) noexcept nogil
cdef void pair_separation(Rectangle a, Rectangle b, Witnesses out) noexcept nogil
cdef bint edge_witness(Rectangle a, Relative seen, Witnesses out) noexcept nogil
@cython.locals(k=cython.int)
cdef void corner_witness(Rectangle a, Relative seen, Witnesses out) noexcept nogil
cdef Rectangle framed(Rows frames, Py_ssize_t i) noexcept nogil
cdef double rows_gap_within(Py_ssize_t i, Py_ssize_t j, double limit, Rows frames) noexcept nogil
cdef Rectangle bench_of(Py_ssize_t i, Rows sizes, Rows chain) noexcept nogil
cdef double bench_gap_within(Py_ssize_t i, Py_ssize_t j, double limit, Rows sizes, Rows chain) noexcept nogil
cdef void row_separation(Py_ssize_t i, Py_ssize_t j, Rows sizes, Rows chain, Witnesses out) noexcept nogil
cpdef Witnesses bench_separation(Py_ssize_t a, Py_ssize_t b, Rows sizes, Rows chain)
@cython.locals(met=Witnesses)
cpdef void pair_separations(Rows a, Rows b, Rows out)
cpdef void pair_gaps(Rows a, Rows b, double limit, double[::1] out) noexcept
