cimport cython
from core.kernels.arrays cimport Rows
from core.kernels.constants cimport *
from core.kernels.bounds cimport motion_bounds, route_bounds
from core.kernels.budget cimport Budget
from core.kernels.chain cimport Curve, chain_rounding, place_chain
from core.kernels.rectangles cimport Witnesses
from core.kernels.rings cimport Rings
from core.kernels.hulls cimport Kinds

cdef double WIDTH_ROUNDING, TURNED_ROUNDING, COPIED

@cython.final
cdef class Scene:
    cdef public Curve curve
    cdef public double place
    cdef public Rings rings
    cdef Rows sizes, walls, turns
    cdef readonly double wall_error
    cdef readonly Py_ssize_t benches, room, edges, copies, stride
    cdef public Kinds kinds
    cdef public double margin
    cdef public Budget budget
    cdef public Py_ssize_t left_out, left_out_too, between
    cdef readonly Witnesses met

    @cython.locals(k=cython.Py_ssize_t, i=cython.Py_ssize_t, row=cython.Py_ssize_t)
    cdef void copy_chain(self, Py_ssize_t last, Rows chain) noexcept nogil
    @cython.locals(k=cython.Py_ssize_t, i=cython.Py_ssize_t)
    cdef void copy_bounds(self, Py_ssize_t last, Rows rows) noexcept nogil

    @cython.locals(e=cython.Py_ssize_t, j=cython.Py_ssize_t)
    cdef void turn_edges(self, Rows chain) noexcept nogil

@cython.final
cdef class Interval:
    cdef readonly Scene scene
    cdef Rows before, after, motion
    cdef public double h
    cdef public Py_ssize_t handles

    cdef void swap(self) noexcept nogil
    cdef void widen(self, double h, double rounding) noexcept nogil
    cdef void round(self) noexcept nogil
    cdef void copy(self) noexcept nogil
    cpdef bint bound(self, bint climbing) noexcept nogil
    cpdef bint lay_out(self, double place, double h, Py_ssize_t last) noexcept nogil

cdef class MarchState:
    cdef Ended ended
    cdef double proven
    cdef bint meets
    cdef double touching
    cdef Py_ssize_t first, second, steps
    cdef readonly double work

    cdef void begin(self, double start) noexcept nogil
    cdef void meet(self, double touching) noexcept nogil
    cdef Step end(self, Ended ended) noexcept nogil

@cython.final
cdef class Band:
    cdef readonly Interval low, high
    cdef Rows shifts
    cdef double width, slack

    cdef void copy(self) noexcept nogil
