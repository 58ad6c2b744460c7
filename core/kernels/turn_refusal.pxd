cimport cython
from core.kernels.arrays cimport Pieces, Rows
from core.kernels.constants cimport *
from core.kernels.spiral cimport spiral_arc, spiral_curvature, spiral_theta

cdef double COIL_SLOPE, COIL_MOST, SPARE, LAST_STEP, ENCLOSED, BEYOND, FURTHEST, MOVES_MOST, AGAIN, AHEAD, UNTIL, DEEP
cdef Py_ssize_t STEPS, PLACES, BETWEEN, HALVINGS, PARTS, NO_PROOF, BLOCKED, LEAPS, MEETS

@cython.final
cdef class TurnBox:
    cdef readonly double growth, least, work
    cdef double scale
    cdef double[2] radius, begin, bend, low, high, longer, coil, inner, sharpest, curved, spread, unlike, past, end, theta, arc
    cdef double[2] cosine, sine, x, y

    @cython.locals(k=cython.Py_ssize_t)
    cpdef void take(self, Pieces rows, Py_ssize_t n) noexcept nogil
    cdef (double, double, double, double) half(self, Py_ssize_t k, double way) noexcept nogil
    cdef (double, double, double, double) place(self, double s) noexcept nogil
    cdef double turned(self, double s) noexcept nogil
    cdef double moved(self, double s) noexcept nogil
    cdef double bent(self, Py_ssize_t k, double way) noexcept nogil
    @cython.locals(k=cython.Py_ssize_t)
    cdef double turned_whole(self, double s) noexcept nogil
    cdef double carried(self, Py_ssize_t k, double way, double turned) noexcept nogil
    @cython.locals(k=cython.Py_ssize_t)
    cdef double moved_whole(self, double s) noexcept nogil
    @cython.locals(near=double, far=double)
    cdef double joint(self, Py_ssize_t k, double first, double last) noexcept nogil
    @cython.locals(k=cython.Py_ssize_t)
    cpdef double turned_over(self, double first, double last) noexcept nogil
    @cython.locals(k=cython.Py_ssize_t)
    cpdef double moved_over(self, double first, double last) noexcept nogil
    @cython.locals(i=cython.Py_ssize_t)
    cdef double near_until(self, double s, double chord, double sign) noexcept nogil
    cdef double far_from(self, double s, double r, double chord, double sign) noexcept nogil
    @cython.locals(i=cython.Py_ssize_t, k=cython.Py_ssize_t)
    cdef double stuck(self, double s, double chord) noexcept nogil
    @cython.locals(i=cython.Py_ssize_t)
    cdef double jump(self, double r, double chord) noexcept nogil
    @cython.locals(i=cython.Py_ssize_t, sign=cython.int)
    cdef double furthest(self, double s, double r, double end) noexcept nogil
    @cython.locals(i=cython.Py_ssize_t, k=cython.Py_ssize_t)
    cdef double meets(self, double at, double over, double sign, const double[::1] benches) noexcept nogil
    @cython.locals(i=cython.Py_ssize_t, own=cython.Py_ssize_t, other=cython.Py_ssize_t)
    cdef (double, double) meeting(self, double sign, const double[::1] benches) noexcept nogil
    cdef double between(self, double s, double r) noexcept nogil
    @cython.locals(i=cython.Py_ssize_t, sign=cython.int)
    cdef (double, double) nearest(self, double s, double r, double step) noexcept nogil

@cython.locals(n=cython.Py_ssize_t, is_found=cython.bint)
cpdef void refuse_turns(
    Pieces boxes, const double[::1] chords, const double[::1] benches, Rows hints, TurnBox box
) noexcept
@cython.locals(kind=cython.Py_ssize_t)
cdef bint holds(
    TurnBox box, const double[::1] chords, const double[::1] benches, Rows hints, Py_ssize_t n
) noexcept nogil
@cython.locals(k=cython.Py_ssize_t, i=cython.Py_ssize_t, sign=cython.int)
cdef bint search(
    TurnBox box, const double[::1] chords, const double[::1] benches, Rows hints, Py_ssize_t n
) noexcept nogil
@cython.locals(i=cython.Py_ssize_t, sign=cython.int)
cdef (double, double) least_stuck(TurnBox box, double chord) noexcept nogil
