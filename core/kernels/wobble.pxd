cimport cython
from core.kernels.clearance cimport BLOCK, block_boxes, boxes_apart
from core.kernels.constants cimport *
from core.kernels.budget cimport Budget
from core.kernels.rectangles cimport bench_gap_within

cdef Py_ssize_t FRONT_X
cdef Py_ssize_t FRONT_Y
cdef Py_ssize_t REAR_X
cdef Py_ssize_t REAR_Y
cdef double APART
cdef double ROOM_ROUNDING

@cython.final
cdef class Wobbler:
    cdef double[:, ::1] sizes
    cdef public double lateral
    cdef public double forward
    cdef public double along
    cdef Budget budget
    cdef readonly double[:, ::1] chain
    cdef double[:, ::1] boxes
    cdef signed char[::1] loud
    cdef Py_ssize_t benches
    cdef readonly Py_ssize_t first
    cdef readonly Py_ssize_t second
    cdef public double furthest

    @cython.locals(t=cython.Py_ssize_t)
    cpdef Py_ssize_t dance(
        self, double[::1] memory, double[:, :, ::1] numbers, double[:, ::1] play, double[:, :, ::1] places,
        double[:, :, ::1] tangents, double[:, ::1] rooms, double[:, ::1] state
    ) noexcept

    @cython.locals(k=cython.Py_ssize_t)
    cdef void stand(
        self, Py_ssize_t t, double memory, double[:, :, ::1] numbers, double[:, :, ::1] places,
        double[:, :, ::1] tangents, double[:, ::1] state
    ) noexcept nogil

    @cython.locals(k=cython.Py_ssize_t, some=cython.bint)
    cdef bint hang(
        self, Py_ssize_t t, double[:, ::1] play, double[:, :, ::1] places, double[:, ::1] rooms
    ) noexcept nogil

    @cython.locals(a=cython.Py_ssize_t, b=cython.Py_ssize_t, i=cython.Py_ssize_t, blocks=cython.Py_ssize_t)
    cdef bint touching(self) noexcept nogil

    @cython.locals(i=cython.Py_ssize_t, j=cython.Py_ssize_t)
    cdef bint blocks_touch(self, Py_ssize_t a, Py_ssize_t b) noexcept nogil

    @cython.locals(
        t=cython.Py_ssize_t, k=cython.Py_ssize_t, a=cython.Py_ssize_t, b=cython.Py_ssize_t, i=cython.Py_ssize_t,
        j=cython.Py_ssize_t, blocks=cython.Py_ssize_t
    )
    cpdef void measure(self, double most, double[::1] gains, double[:, :, ::1] places, double[:, ::1] rooms) noexcept

    cdef void part(
        self, Py_ssize_t t, Py_ssize_t i, Py_ssize_t j, double most, double[::1] gains, double[:, ::1] rooms
    ) noexcept nogil
