cimport cython
from core.kernels.arrays cimport Rows
from core.kernels.constants cimport *
from core.kernels.records cimport Closest, PairBounds
from core.kernels.chain cimport extend
from core.kernels.rings cimport drift
from core.kernels.scene cimport MarchState, Interval, Scene
from core.kernels.clearance cimport bottom_between, contact_between, gap_at, row_clearance, row_gap
from core.kernels.pairs cimport pair_most
from core.kernels.nearest cimport interval_least
from core.kernels.repeats cimport chain_between, leader_may_reverse, passed, slid_back

cdef double DIP_WIDTH, LEAST_STEP, LEAST_WAY, ALLOWANCE, CROSSING_WIDTH, PEEK

@cython.final
cdef class March(MarchState):
    cdef Interval interval, probe
    cdef Rows opening
    cdef double start, stop
    cdef Py_ssize_t leaders
    cdef bint at_start
    cdef double half_bracket, rounding, most_work
    cdef Py_ssize_t followers, active, placed, opened
    cdef bint opens, grazes, reversing
    cdef double travel, h
    cdef bint aims
    cdef double target, allowance, floor, older_clearance, older_travel, last_travel
    cdef Closest last
    cdef double gap_curvature
    cdef bint grazed
    cdef double graze_gap, graze_travel
    cdef Py_ssize_t graze_first, graze_second

    cpdef object run(
        self, double start, double stop, Py_ssize_t leaders, bint at_start, double half_bracket, bint grazes,
        double rounding, double most_work
    )

    cdef Step march(self, Scene scene) noexcept nogil
    cdef bint repeats_ahead(self, Scene scene) noexcept nogil
    cdef double least_step(self) noexcept nogil
    cdef Step open(self, Scene scene) noexcept nogil
    cdef bint surely_within(self, Scene scene, double place) noexcept nogil
    cdef Step refuse(self, double part) noexcept nogil
    cdef Step try_step(self, Scene scene, Interval interval) noexcept nogil
    @cython.locals(k=cython.Py_ssize_t)
    cdef bint must_follow(self, Scene scene, Interval interval) noexcept nogil
    cdef Step narrow(self, Scene scene, Interval interval, PairBounds nearest) noexcept nogil
    cdef double peek(self, Scene scene, Py_ssize_t a, Py_ssize_t b) noexcept nogil
    @cython.locals(dips=cython.bint)
    cdef void note_graze(self, Scene scene, Interval interval, double least) noexcept nogil
