cimport cython
from core.kernels.arrays cimport Rows
from core.kernels.constants cimport *
from core.kernels.chain cimport extend_chain, start_chain
from core.kernels.spiral cimport spiral_arc, spiral_theta
from core.kernels.rings cimport leaders_reach, radius_beyond
from core.kernels.pairs cimport BAND_ROUNDING
from core.kernels.nearest cimport band_least
from core.kernels.clearance cimport row_gap
from core.kernels.scene cimport Band, MarchState, Scene

cdef double BACKWARDS_WITHIN, CHAIN_WORK, ACROSS

@cython.locals(k=cython.Py_ssize_t)
cdef bint shift_bounds(
    double low, double high, Py_ssize_t benches, Rows sizes, Rows inner, Rows outer, Rows shifts
) noexcept nogil

@cython.final
cdef class BandMarch(MarchState):
    cdef Band band
    cdef Py_ssize_t leaders, placed
    cdef double radius, place, h, rounding
    cdef bint bounded

    cpdef object run(
        self, double outer, double inner, Py_ssize_t leaders, double rounding, double least_step, double most_work
    )

    cdef Step march(self, Scene scene, Band band, double inner, double least_step, double most_work) noexcept nogil
    cdef Step try_step(self, Band band, double inner) noexcept nogil
    cdef Step lay_out(self, Band band, double next_radius) noexcept nogil
