cimport cython
from core.kernels.constants cimport *
from core.kernels.records cimport Closest, Laid, Nearest
from core.kernels.chain cimport extend
from core.kernels.rings cimport drift
from core.kernels.scene cimport Found, Interval, Scene
from core.kernels.clearance cimport bottom_between, contact_between, gap_at, row_clearance, row_gap
from core.kernels.pairs cimport pair_most
from core.kernels.nearest cimport interval_least
from core.kernels.repeats cimport chain_between, leader_may_reverse, passed, slid_back

cdef double DIP_WIDTH
cdef double LEAST_STEP
cdef double LEAST_WAY
cdef double ALLOWANCE
cdef double CROSSING_WIDTH
cdef double PEEK

@cython.final
cdef class March(Found):
    cdef Interval interval
    cdef Interval probe
    cdef double[:, ::1] opening
    cdef double start
    cdef double stop
    cdef Py_ssize_t leaders
    cdef bint at_start
    cdef double tolerance
    cdef double rounding
    cdef double most_work
    cdef Py_ssize_t followers
    cdef Py_ssize_t active
    cdef Py_ssize_t placed
    cdef Py_ssize_t opened
    cdef bint opens
    cdef bint grazes
    cdef bint reversing
    cdef double travel
    cdef double h
    cdef bint aims
    cdef double target
    cdef double allowance
    cdef double floor
    cdef double older_clearance
    cdef double older_travel
    cdef double last_travel
    cdef Closest last
    cdef double gap_curvature
    cdef bint grazed
    cdef double graze_gap
    cdef double graze_travel
    cdef Py_ssize_t graze_first
    cdef Py_ssize_t graze_second

    cpdef object run(
        self, double start, double stop, Py_ssize_t leaders, bint at_start, double tolerance, bint grazes,
        double rounding, double most_work
    )
    @cython.locals(step=Step)
    cdef Step march(self, Scene scene) noexcept nogil
    cdef bint repeats_ahead(self, Scene scene) noexcept nogil
    cdef double least_step(self) noexcept nogil
    @cython.locals(laid=Laid)
    cdef Step open(self, Scene scene) noexcept nogil
    cdef bint surely_within(self, Scene scene, double place) noexcept nogil
    cdef Step refuse(self, double part) noexcept nogil
    @cython.locals(laid=Laid, nearest=Nearest)
    cdef Step try_step(self, Scene scene, Interval interval) noexcept nogil
    @cython.locals(k=cython.Py_ssize_t)
    cdef bint must_follow(self, Scene scene, Interval interval) noexcept nogil
    cdef Step narrow(self, Scene scene, Interval interval, Nearest nearest) noexcept nogil
    cdef double peek(self, Scene scene, Py_ssize_t a, Py_ssize_t b) noexcept nogil
    @cython.locals(here=Closest, dips=cython.bint)
    cdef void note_graze(self, Scene scene, Interval interval, double least) noexcept nogil
