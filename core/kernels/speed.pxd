cimport cython
from core.kernels.constants cimport *
from core.kernels.spiral cimport extend_chain, spiral_curvature, spiral_theta, start_chain, steepest_bend
from core.kernels.route cimport extend_route, first_place, start_route
from core.kernels.chain cimport Curve, extend
from core.kernels.bounds cimport LOOSEN, SPIRAL_TURN, blur_of, followed_error, link_cosines
from core.kernels.rings cimport drift
from core.kernels.scene cimport Interval, Scene

cdef double APPROACH
cdef double LAST_SAMPLE
cdef double NOISE
cdef double PEAK_WIDTH
cdef Py_ssize_t INTERVAL_LINKS
cdef double BOUND_ROUNDING

cdef Py_ssize_t lively_chain(
    Curve curve, double place, Py_ssize_t last, double calm, double[:, ::1] sizes, double[:, ::1] chain
) noexcept nogil

@cython.locals(k=cython.Py_ssize_t, best=cython.Py_ssize_t)
cdef Py_ssize_t fastest(Py_ssize_t benches, double[:, ::1] chain) noexcept nogil

@cython.locals(i=cython.Py_ssize_t)
cpdef void climbs(Curve curve, Py_ssize_t last, double[:, ::1] sizes, double[:, ::1] chain) noexcept nogil

@cython.locals(k=cython.Py_ssize_t)
cdef void spiral_jerks(
    double growth, double h, Py_ssize_t handles, double[:, ::1] sizes, double[:, ::1] before, double[:, ::1] after,
    double[:, ::1] motion
) noexcept nogil

@cython.locals(k=cython.Py_ssize_t)
cpdef void spiral_errors(
    double growth, Py_ssize_t handles, double[:, ::1] sizes, double[:, ::1] before, double[:, ::1] after,
    double[:, ::1] motion
) noexcept nogil

cdef double smooth_bound(
    double start, double start_slope, double end, double end_slope, double jerk, double h, bint kink
) noexcept nogil

@cython.locals(k=cython.Py_ssize_t, handles=cython.Py_ssize_t)
cdef double rate_bound(Scene scene, Interval interval, double calm) noexcept nogil

@cython.locals(kink=cython.bint)
cdef double handle_bound(Scene scene, Interval interval, Py_ssize_t k, double enough) noexcept nogil

@cython.locals(k=cython.Py_ssize_t, at=cython.Py_ssize_t)
cdef (double, Py_ssize_t) certain_rate(Curve curve, Interval interval, double rounding) noexcept nogil

@cython.locals(a=cython.Py_ssize_t, b=cython.Py_ssize_t)
cdef bint peaks_between(
    Py_ssize_t placed, Py_ssize_t handles, double[:, ::1] before, double[:, ::1] after
) noexcept nogil

cdef Py_ssize_t lay_ahead(
    Scene scene, Interval interval, double calm, Py_ssize_t placed, double place
) noexcept nogil

@cython.final
cdef class Peak:
    cdef Interval interval
    cdef double[:, ::1] spare
    cdef double calm
    cdef double start
    cdef double stop
    cdef double rounding
    cdef Py_ssize_t at
    cdef readonly double rate
    cdef readonly double upper
    cdef readonly double travel
    cdef readonly Py_ssize_t intervals

    @cython.locals(scene=Scene)
    cpdef void sample(self, double step) noexcept
    @cython.locals(scene=Scene, links=cython.Py_ssize_t, placed=cython.Py_ssize_t, handles=cython.Py_ssize_t)
    cpdef void prove(self, double step, double tolerance, double loosest, Py_ssize_t budget) noexcept
    @cython.locals(last=cython.Py_ssize_t)
    cdef double top_rate(self, Scene scene, double travel) noexcept nogil
    cdef void refine(self, Scene scene, double low, double high, double noise) noexcept nogil
    cdef void keep(self, double rate, double travel, double noise) noexcept nogil
