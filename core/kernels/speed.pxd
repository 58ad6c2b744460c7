cimport cython
from core.kernels.arrays cimport Pieces, Rows
from core.kernels.constants cimport *
from core.kernels.rates cimport BOUND_ROUNDING, climbs, fastest, lay_ahead, lively_chain, rate_bound
from core.kernels.scene cimport Interval, Scene
from core.kernels.spiral cimport spiral_curvature

cdef double APPROACH, LAST_SAMPLE, NOISE, PEAK_WIDTH
cdef Py_ssize_t INTERVAL_LINKS
cdef double LEAVING_STEP, LEAVING_AGAIN

@cython.locals(b=cython.Py_ssize_t)
cdef bint peaks_between(Py_ssize_t placed, Py_ssize_t handles, Rows before, Rows after) noexcept nogil
@cython.locals(k=cython.Py_ssize_t)
cdef double way_out(Pieces pieces, Py_ssize_t alike, Rows sizes, Rows chain) noexcept nogil

@cython.final
cdef class Peak:
    cdef Interval interval
    cdef Rows spare
    cdef double calm
    cdef Py_ssize_t alike
    cdef double start, stop, rounding
    cdef Py_ssize_t at, laid
    cdef double ratio, tried, left, most
    cdef readonly double rate, upper, travel
    cdef readonly Py_ssize_t intervals

    @cython.locals(scene=Scene)
    cpdef void sample(self, double step) noexcept
    @cython.locals(scene=Scene, links=cython.Py_ssize_t)
    cpdef void prove(self, double step, double slack, double loosest, Py_ssize_t most_links) noexcept
    cdef bint leaves(self, Scene scene, double upper, double slack) noexcept nogil
    cdef bint gone(self, Scene scene) noexcept nogil
    cdef double top_rate(self, Scene scene, double travel) noexcept nogil
    cdef void refine(self, Scene scene, double low, double high, double noise) noexcept nogil
    cdef void keep(self, double rate, double travel, double noise) noexcept nogil
