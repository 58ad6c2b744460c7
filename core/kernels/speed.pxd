cimport cython
from core.kernels.constants cimport *
from core.kernels.rates cimport BOUND_ROUNDING, climbs, fastest, lay_ahead, lively_chain, rate_bound
from core.kernels.scene cimport Interval, Scene
from core.kernels.spiral cimport spiral_curvature

cdef double APPROACH
cdef double LAST_SAMPLE
cdef double NOISE
cdef double PEAK_WIDTH
cdef Py_ssize_t INTERVAL_LINKS
cdef double LEAVING_STEP
cdef double LEAVING_AGAIN

@cython.locals(a=cython.Py_ssize_t, b=cython.Py_ssize_t)
cdef bint peaks_between(
    Py_ssize_t placed, Py_ssize_t handles, double[:, ::1] before, double[:, ::1] after
) noexcept nogil

@cython.locals(p=cython.Py_ssize_t, k=cython.Py_ssize_t)
cdef double way_out(
    const double[:, ::1] pieces, Py_ssize_t alike, double[:, ::1] sizes, double[:, ::1] chain
) noexcept nogil

@cython.final
cdef class Peak:
    cdef Interval interval
    cdef double[:, ::1] spare
    cdef double calm
    cdef Py_ssize_t alike
    cdef double start
    cdef double stop
    cdef double rounding
    cdef Py_ssize_t at
    cdef Py_ssize_t laid
    cdef double ratio
    cdef double tried
    cdef double left
    cdef double most
    cdef readonly double rate
    cdef readonly double upper
    cdef readonly double travel
    cdef readonly Py_ssize_t intervals

    @cython.locals(scene=Scene)
    cpdef void sample(self, double step) noexcept
    @cython.locals(scene=Scene, links=cython.Py_ssize_t, placed=cython.Py_ssize_t, handles=cython.Py_ssize_t)
    cpdef void prove(self, double step, double tolerance, double loosest, Py_ssize_t most_links) noexcept
    @cython.locals(rear=cython.Py_ssize_t)
    cdef bint leaves(self, Scene scene, double upper, double tolerance) noexcept nogil
    cdef bint gone(self, Scene scene) noexcept nogil
    @cython.locals(last=cython.Py_ssize_t)
    cdef double top_rate(self, Scene scene, double travel) noexcept nogil
    cdef void refine(self, Scene scene, double low, double high, double noise) noexcept nogil
    cdef void keep(self, double rate, double travel, double noise) noexcept nogil
