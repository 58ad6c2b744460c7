cimport cython
from core.kernels.constants cimport *
from core.kernels.records cimport Closest, Laid, Nearest
from core.kernels.spiral cimport extend_chain, spiral_curvature, spiral_theta, start_chain
from core.kernels.bounds cimport followed_error
from core.kernels.chain cimport chain_rounding, extend
from core.kernels.rings cimport coil_place, coil_radius, coil_reach, drift, leaders_reach, radius_beyond
from core.kernels.route cimport extend_route, stands_first, start_route
from core.kernels.scene cimport Interval, Scene
from core.kernels.pairs cimport interval_least, pair_most
from core.kernels.clearance cimport bottom_between, contact_between, gap_at, row_clearance, row_gap

cdef double DIP_WIDTH
cdef double LEAST_STEP
cdef double LEAST_WAY
cdef double ALLOWANCE
cdef double CROSSING_WIDTH
cdef double PASSED_BY
cdef double PEEK

@cython.locals(k=cython.Py_ssize_t)
cdef Laid chain_between(
    Scene scene, double place, Py_ssize_t leaders, double allowance, bint turning, double[:, ::1] chain
) noexcept nogil

@cython.locals(k=cython.Py_ssize_t, leading=cython.Py_ssize_t)
cdef Laid route_between(
    Scene scene, double place, Py_ssize_t leaders, double allowance, double[:, ::1] chain
) noexcept nogil

@cython.locals(i=cython.Py_ssize_t)
cdef bint passed(
    Scene scene, Py_ssize_t first, Py_ssize_t last, Py_ssize_t placed, double[:, ::1] opening, double[:, ::1] chain
) noexcept nogil

cdef bint turns_back(
    Py_ssize_t k, double h, double error, double[:, ::1] before, double[:, ::1] after, double[:, ::1] motion
) noexcept nogil

@cython.locals(i=cython.Py_ssize_t)
cdef bint may_turn(
    Py_ssize_t k, double h, double[:, ::1] sizes, double[:, ::1] before, double[:, ::1] after, double[:, ::1] motion
) noexcept nogil

@cython.locals(k=cython.Py_ssize_t, placed=cython.Py_ssize_t, followed=cython.bint)
cdef bint slid_back(
    Scene scene, Interval interval, Py_ssize_t first, Py_ssize_t last, double[:, ::1] opening
) noexcept nogil

@cython.final
cdef class March:
    cdef Interval interval
    cdef Interval probe
    cdef double[:, ::1] opening
    cdef double start
    cdef double stop
    cdef Py_ssize_t leaders
    cdef bint at_start
    cdef double tolerance
    cdef double rounding
    cdef double budget
    cdef Py_ssize_t followers
    cdef Py_ssize_t active
    cdef Py_ssize_t placed
    cdef Py_ssize_t opened
    cdef bint opens
    cdef bint grazes
    cdef bint turning
    cdef double travel
    cdef double h
    cdef double target
    cdef double allowed
    cdef double floor
    cdef double older_clearance
    cdef double older_travel
    cdef double last_travel
    cdef Closest last
    cdef readonly double proven
    cdef readonly double touching
    cdef readonly Py_ssize_t first
    cdef readonly Py_ssize_t second
    cdef readonly Py_ssize_t steps
    cdef readonly double work
    cdef readonly double bend
    cdef readonly double graze_gap
    cdef readonly double graze_travel
    cdef readonly Py_ssize_t graze_first
    cdef readonly Py_ssize_t graze_second

    @cython.locals(state=cython.int)
    cpdef int run(
        self, double start, double stop, Py_ssize_t leaders, bint at_start, double tolerance, bint grazes,
        double rounding, double budget
    ) noexcept
    cdef bint repeats_ahead(self, Scene scene) noexcept nogil
    cdef double least_step(self) noexcept nogil
    @cython.locals(laid=Laid)
    cdef int open(self, Scene scene) noexcept nogil
    cdef bint surely_within(self, Scene scene, double place) noexcept nogil
    cdef int refuse(self, double part) noexcept nogil
    @cython.locals(laid=Laid, nearest=Nearest)
    cdef int try_step(self, Scene scene, Interval interval) noexcept nogil
    @cython.locals(k=cython.Py_ssize_t)
    cdef bint must_follow(self, Scene scene, Interval interval) noexcept nogil
    cdef int narrow(self, Scene scene, Interval interval, Nearest nearest) noexcept nogil
    cdef double peek(self, Scene scene, Py_ssize_t a, Py_ssize_t b) noexcept nogil
    @cython.locals(here=Closest, dips=cython.bint)
    cdef void note_graze(self, Scene scene, Interval interval, double least) noexcept nogil
