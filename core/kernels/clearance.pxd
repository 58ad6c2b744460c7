cimport cython
from core.kernels.arrays cimport Rows
from core.kernels.constants cimport *
from core.kernels.records cimport Closest, Pair
from core.kernels.rectangles cimport bench_gap_within, row_separation
from core.kernels.hulls cimport hulls_met, nearest_hulls
from core.kernels.chain cimport place_chain
from core.kernels.scene cimport Scene

cdef Py_ssize_t BLOCK
cdef double LIMIT_ROUNDING

cdef bint at_rest(Scene scene, Py_ssize_t j) noexcept nogil
cdef double row_gap(Scene scene, Py_ssize_t i, Py_ssize_t j, Rows chain) noexcept nogil
cdef double row_gap_within(Scene scene, Py_ssize_t i, Py_ssize_t j, double limit, Rows chain) noexcept nogil
cpdef void meet(Scene scene, Py_ssize_t i, Py_ssize_t j, Rows chain) noexcept nogil
@cython.locals(block=cython.Py_ssize_t)
cdef Py_ssize_t block_boxes(Py_ssize_t benches, Rows sizes, Rows chain, Rows boxes) noexcept nogil
cdef bint boxes_apart(Py_ssize_t a, Py_ssize_t b, double within, Rows boxes) noexcept nogil
cdef bint beyond_box(Py_ssize_t i, Py_ssize_t b, double within, Rows boxes, Rows chain) noexcept nogil

cdef Closest least_with(
    Scene scene, Py_ssize_t i, Py_ssize_t first, Py_ssize_t end, Closest best, Rows chain
) noexcept nogil

@cython.locals(i=cython.Py_ssize_t, row=cython.Py_ssize_t)
cdef Closest clearance_between(
    Scene scene, Py_ssize_t active, Py_ssize_t handles, Closest best, Rows chain
) noexcept nogil

@cython.locals(i=cython.Py_ssize_t, a=cython.Py_ssize_t, b=cython.Py_ssize_t)
cdef Closest row_clearance(
    Scene scene, Py_ssize_t active, Py_ssize_t handles, Closest best, Rows chain, Rows boxes
) noexcept nogil

@cython.locals(i=cython.Py_ssize_t, j=cython.Py_ssize_t, first=cython.Py_ssize_t, end=cython.Py_ssize_t)
cpdef double clearance_left(
    Scene scene, Py_ssize_t leaders, Py_ssize_t benches, Rows chain, double[::1] moved
) noexcept nogil

cpdef (double, Py_ssize_t, Py_ssize_t) clearance_at(
    Scene scene, double place, Py_ssize_t benches, Py_ssize_t leaders, Rows chain, Rows boxes
) noexcept nogil

cdef Py_ssize_t last_handle(Scene scene, Py_ssize_t a, Py_ssize_t b) noexcept nogil
cpdef double gap_at(Scene scene, double place, Py_ssize_t a, Py_ssize_t b, Rows chain) noexcept nogil
cpdef double gap_rate_at(Scene scene, double place, Py_ssize_t a, Py_ssize_t b, Rows chain) noexcept nogil
cdef double speed_along(Scene scene, Py_ssize_t k, double x, double y, Rows chain) noexcept nogil

cdef double contact_between(
    Scene scene, double low, double high, Py_ssize_t a, Py_ssize_t b, double width, Rows chain
) noexcept nogil

cpdef double bottom_between(
    Scene scene, double low, double high, Py_ssize_t a, Py_ssize_t b, double width, Rows chain
) noexcept nogil

@cython.locals(last=cython.int, i=cython.int)
cdef double crossing(
    Scene scene, double low, double high, Pair pair, double width, bint of_rate, Rows chain
) noexcept nogil
