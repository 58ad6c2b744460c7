cimport cython
from core.kernels.constants cimport *
from core.kernels.rectangles cimport pair_gap
from core.kernels.chain cimport place_chain
from core.kernels.pairs cimport row_separation

cdef Py_ssize_t BLOCK

cdef double row_gap(Py_ssize_t i, Py_ssize_t j, double[:, ::1] sizes, double[:, ::1] chain) noexcept nogil

@cython.locals(block=cython.Py_ssize_t, k=cython.Py_ssize_t, blocks=cython.Py_ssize_t)
cdef Py_ssize_t block_boxes(
    Py_ssize_t benches, double[:, ::1] sizes, double[:, ::1] chain, double[:, ::1] boxes
) noexcept nogil

@cython.locals(j=cython.Py_ssize_t)
cdef double least_with(
    Py_ssize_t i, Py_ssize_t first, Py_ssize_t end, double best, double[:, ::1] sizes, double[:, ::1] chain,
    Py_ssize_t[::1] pair
) noexcept nogil

@cython.locals(
    i=cython.Py_ssize_t, a=cython.Py_ssize_t, b=cython.Py_ssize_t, blocks=cython.Py_ssize_t, first=cython.Py_ssize_t
)
cdef double row_clearance(
    double growth, Py_ssize_t active, Py_ssize_t handles, Py_ssize_t statics, double[:, ::1] sizes, double[:, ::1] chain,
    double[:, ::1] boxes, Py_ssize_t[::1] pair
) noexcept nogil

@cython.locals(i=cython.Py_ssize_t, j=cython.Py_ssize_t)
cpdef double clearance_left(
    Py_ssize_t leaders, Py_ssize_t benches, double[:, ::1] sizes, double[:, ::1] chain, double[::1] moved
) noexcept nogil

cpdef double clearance_at(
    double growth, const double[:, ::1] pieces, double place, Py_ssize_t benches, Py_ssize_t leaders,
    Py_ssize_t statics, double[:, ::1] sizes, double[:, ::1] chain, double[:, ::1] boxes, Py_ssize_t[::1] pair
) noexcept nogil

cpdef double gap_at(
    double growth, const double[:, ::1] pieces, double place, Py_ssize_t benches, Py_ssize_t a, Py_ssize_t b,
    double[:, ::1] sizes, double[:, ::1] chain
) noexcept nogil

@cython.locals(k=cython.Py_ssize_t, side=cython.int)
cpdef double gap_rate_at(
    double growth, const double[:, ::1] pieces, double place, Py_ssize_t benches, Py_ssize_t a, Py_ssize_t b,
    double[:, ::1] sizes, double[:, ::1] chain, double[::1] out
) noexcept nogil

@cython.locals(last=cython.int, i=cython.int)
cpdef double crossing(
    double growth, const double[:, ::1] pieces, double place, Py_ssize_t benches, double low, double high,
    Py_ssize_t a, Py_ssize_t b, double margin, double tolerance, bint of_rate, double[:, ::1] sizes,
    double[:, ::1] chain, double[::1] out
) noexcept nogil
