cimport cython
from core.kernels.arrays cimport Rows
from core.kernels.constants cimport *
from core.kernels.chain cimport chain_rounding, place_chain
from core.kernels.clearance cimport beyond_box, boxes_apart, least_with, meet, row_gap, speed_along
from core.kernels.pairs cimport pair_rounding, proven_gap
from core.kernels.records cimport Closest
from core.kernels.scene cimport Interval, Scene

cdef double TURNED, MOVED, SCALED, LEAST_CURVATURE
cdef Py_ssize_t BLOCK_FIRST, BLOCK_END, BLOCK_MEMBER, BLOCK_NEXT, BOX_INNER
cdef int BEFORE, AFTER

@cython.final
cdef class Member:
    cdef Interval interval
    cdef Rows probed
    cdef readonly Py_ssize_t first, benches
    cdef double x, y, ux, uy, side
    cdef bint turns

    cdef Rows own(self, int which) noexcept nogil
    cdef bint lay(self, Scene scene, double place, double slip, Py_ssize_t last, Rows own) noexcept nogil
    @cython.locals(k=cython.Py_ssize_t, row=cython.Py_ssize_t)
    cdef void put(self, double speed, Py_ssize_t last, Rows own, Rows rows) noexcept nogil
    @cython.locals(k=cython.Py_ssize_t)
    cdef void still(self, double growth, Rows own, Rows motion) noexcept nogil
    @cython.locals(k=cython.Py_ssize_t, row=cython.Py_ssize_t)
    cdef void scale(self, double growth, double speed, Rows motion) noexcept nogil

@cython.final
cdef class Ensemble:
    cdef readonly Interval interval
    cdef Rows probed, boxes, spans, clear
    cdef list members
    cdef long long[:, ::1] blocks
    cdef readonly double least, curvature, width, gap
    cdef readonly Py_ssize_t first, second, tried

    cdef Rows rows(self, int which) noexcept nogil
    @cython.locals(member=Member, laid=cython.bint)
    cpdef bint stand(self, Py_ssize_t k, int which, double place, double slip, double speed, Py_ssize_t last)
    @cython.locals(member=Member, end=cython.Py_ssize_t)
    cpdef void rest(self, Py_ssize_t k)
    @cython.locals(member=Member, bounded=cython.bint)
    cpdef bint move(self, Py_ssize_t k, double h, double speed)
    cpdef void advance(self)
    cpdef void bound(self, double h)
    @cython.locals(a=cython.Py_ssize_t, b=cython.Py_ssize_t, i=cython.Py_ssize_t, j=cython.Py_ssize_t)
    cdef void bound_pairs(self, Scene scene) noexcept nogil
    cdef void bound_pair(self, Scene scene, Py_ssize_t i, Py_ssize_t j) noexcept nogil
    cdef double centres_apart(self, Scene scene, Py_ssize_t i, Py_ssize_t j) noexcept nogil
    @cython.locals(b=cython.Py_ssize_t, i=cython.Py_ssize_t)
    cdef void lay_boxes(self, Rows before, Rows after, Rows motion, Rows spans, Rows boxes) noexcept nogil
    cdef bint rings_clear(self, Py_ssize_t a, Py_ssize_t b) noexcept nogil
    cpdef void nearest(self, int which, Py_ssize_t a, Py_ssize_t b)
    @cython.locals(
        block=cython.Py_ssize_t, other=cython.Py_ssize_t, i=cython.Py_ssize_t, first=cython.Py_ssize_t,
        end=cython.Py_ssize_t
    )
    cdef void find_nearest(self, Scene scene, Py_ssize_t a, Py_ssize_t b, Rows rows) noexcept nogil
    cpdef double separation(self, int which, Py_ssize_t a, Py_ssize_t b) noexcept nogil
    cpdef double rounding(self, int which, Py_ssize_t a, Py_ssize_t b) noexcept nogil
    cpdef double rate(self, int which, Py_ssize_t a, Py_ssize_t b)
    cdef double parting(self, Scene scene, Py_ssize_t a, Py_ssize_t b, Rows rows) noexcept nogil
    cpdef double left(self, double[::1] moved)
    @cython.locals(a=cython.Py_ssize_t, b=cython.Py_ssize_t, i=cython.Py_ssize_t, j=cython.Py_ssize_t)
    cdef double least_left(self, Scene scene, double[::1] moved) noexcept nogil

cdef bint spans_apart(Py_ssize_t a, Rows boxes, Py_ssize_t b, Rows other, double within) noexcept nogil

cdef bint stay_apart(
    Scene scene, Py_ssize_t i, Py_ssize_t j, double h, Rows before, Rows after, Rows motion
) noexcept nogil

cdef void empty_box(Py_ssize_t b, Rows boxes) noexcept nogil
cdef void hold(Py_ssize_t b, double x, double y, double spare, Rows boxes) noexcept nogil
