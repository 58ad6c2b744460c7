cimport cython
from core.kernels.arrays cimport Pairs, Rows, Tables
from core.kernels.constants cimport *
from core.kernels.budget cimport Budget
from core.kernels.fold cimport first_root

cdef double HALLEY_STEP, SERIES_LIMIT
cdef Py_ssize_t LANES

cpdef double spiral_arc(double theta) noexcept nogil
@cython.locals(i=cython.int)
cpdef double spiral_theta(double arc) noexcept nogil
cdef double half_sine(double half) noexcept nogil
cdef double half_cosine(double half) noexcept nogil
cdef (double, double, double) halley_step(double theta, double chord2, double delta, double s, double c) noexcept nogil
@cython.locals(i=cython.int)
cdef (double, double, double) next_handle(double theta, double chord2, double guess) noexcept nogil
cdef (double, double) next_arc(double theta, double chord2, double guess) noexcept nogil
cdef double arc_between(double a, double b, double delta) noexcept nogil
cdef double theta_ratio(double theta, double delta, double s, double c) noexcept nogil
cdef double first_guess(double theta, double chord2) noexcept nogil

@cython.final
cdef class Block:
    cdef double growth
    cdef Py_ssize_t standing
    cdef double[8] theta, x, y, rate, guess, d1, d2, d3, delta, sine, cosine

    @cython.locals(lane=cython.Py_ssize_t)
    cdef Py_ssize_t start(self, Py_ssize_t row, Pairs thetas, double head_speed) noexcept nogil
    cdef void expect(self, double chord2, bint alike) noexcept nogil
    cdef void solve(self, double chord2) noexcept nogil
    cdef void advance(self) noexcept nogil

@cython.locals(lane=cython.Py_ssize_t)
cdef void write_handles(
    Block block, Py_ssize_t row, Py_ssize_t k, Tables position, Tables velocity, Rows speed
) noexcept nogil

@cython.locals(
    row=cython.Py_ssize_t, k=cython.Py_ssize_t, lanes=cython.Py_ssize_t, alike=cython.Py_ssize_t, block=Block
)
cpdef Py_ssize_t spiral_trajectory(
    double growth, Pairs thetas, const double[::1] chords, double head_speed, Tables position, Tables velocity,
    Rows speed, Budget budget
) noexcept

cpdef double spiral_curvature(double theta) noexcept nogil
