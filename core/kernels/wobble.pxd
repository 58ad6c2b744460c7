cimport cython
from core.kernels.arrays cimport Rows, Tables
from core.kernels.clearance cimport BLOCK, block_boxes, boxes_apart
from core.kernels.constants cimport *
from core.kernels.budget cimport Budget
from core.kernels.rectangles cimport bench_gap_within

cdef Py_ssize_t FRONT_X, FRONT_Y, REAR_X, REAR_Y, LATERAL, FORWARD
cdef double APART, STRAY_ROUNDING

@cython.final
cdef class Wobbler:
    cdef Rows sizes
    cdef public double lateral, forward, along
    cdef Budget budget
    cdef readonly Rows chain
    cdef Rows boxes
    cdef signed char[::1] loud, loud_blocks
    cdef Py_ssize_t benches
    cdef readonly Py_ssize_t first, second
    cdef public double furthest

    cpdef Py_ssize_t dance(
        self, double[::1] memory, Tables numbers, Rows play, Tables places, Tables tangents, Rows safe, Rows state
    ) noexcept

    @cython.locals(k=cython.Py_ssize_t)
    cdef void stand(
        self, Py_ssize_t t, double memory, Tables numbers, Tables places, Tables tangents, Rows state
    ) noexcept nogil

    @cython.locals(k=cython.Py_ssize_t, some=cython.bint)
    cdef bint hang(self, Py_ssize_t t, Rows play, Tables places, Rows safe) noexcept nogil
    @cython.locals(a=cython.Py_ssize_t, b=cython.Py_ssize_t)
    cdef bint touching(self) noexcept nogil
    @cython.locals(i=cython.Py_ssize_t)
    cdef bint blocks_touch(self, Py_ssize_t a, Py_ssize_t b) noexcept nogil
    @cython.locals(k=cython.Py_ssize_t, a=cython.Py_ssize_t, b=cython.Py_ssize_t, i=cython.Py_ssize_t)
    cpdef void measure(self, double most, double[::1] gains, Tables places, Rows safe) noexcept

    cdef void part(
        self, Py_ssize_t t, Py_ssize_t i, Py_ssize_t j, double most, double[::1] gains, Rows safe
    ) noexcept nogil
