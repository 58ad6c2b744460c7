cimport cython
from core.kernels.constants cimport *
from core.kernels.rates cimport certain_rate, lay_ahead, lively_chain, rate_bound
from core.kernels.scene cimport Interval, Scene

@cython.final
cdef class Excess:
    cdef Interval interval
    cdef double calm
    cdef readonly double proven, exceeded
    cdef readonly Py_ssize_t handle
    cdef readonly double rate

    @cython.locals(scene=Scene, links=cython.Py_ssize_t, opened=cython.bint)
    cpdef object run(
        self, double start, double stop, double step, double limit, double kept, double width, double rounding,
        Py_ssize_t most_links
    )
