cimport cython
from core.kernels.constants cimport *
from core.kernels.records cimport PairBounds, Rounding
from core.kernels.rings cimport RING_ROUNDING, coil_radius, drift, leaders_reach, radius_beyond
from core.kernels.rounding cimport spiral_error
from core.kernels.route cimport stands_first
from core.kernels.pairs cimport BAND_ROUNDING, any_rounding, proven_band_gap, proven_gap
from core.kernels.scene cimport COPIED, Band, Interval, Scene

@cython.locals(
    i=cython.Py_ssize_t, j=cython.Py_ssize_t, first=cython.Py_ssize_t, tried=cython.Py_ssize_t, row=cython.Py_ssize_t,
    copy=cython.Py_ssize_t, others=cython.Py_ssize_t
)
cdef PairBounds interval_least(Scene scene, Interval interval, Py_ssize_t active) noexcept nogil
@cython.locals(fast=cython.bint)
cdef Rounding interval_rounding(Scene scene, Interval interval) noexcept nogil
cdef double copied_error(Scene scene, Interval interval) noexcept nogil
cdef double innermost(Scene scene, Interval interval, Py_ssize_t k, double rate) noexcept nogil
cdef double reach_of(Scene scene, Interval interval, Py_ssize_t i, double error) noexcept nogil
cdef bint stays_beyond(Scene scene, Interval interval, Py_ssize_t leaders, double error) noexcept nogil
@cython.locals(i=cython.Py_ssize_t)
cdef bint coil_stays_beyond(Scene scene, Interval interval, Py_ssize_t leaders, double error) noexcept nogil
@cython.locals(handles=cython.Py_ssize_t)
cdef Rounding band_rounding(Scene scene, Band band) noexcept nogil
@cython.locals(
    i=cython.Py_ssize_t, j=cython.Py_ssize_t, tried=cython.Py_ssize_t, row=cython.Py_ssize_t,
    copy=cython.Py_ssize_t, others=cython.Py_ssize_t
)
cdef PairBounds band_least(Scene scene, Band band, Py_ssize_t leaders) noexcept nogil
