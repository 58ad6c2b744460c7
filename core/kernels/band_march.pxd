cimport cython
from core.kernels.constants cimport *
from core.kernels.chain cimport extend_chain, start_chain
from core.kernels.spiral cimport spiral_arc, spiral_theta
from core.kernels.rings cimport leaders_reach, radius_beyond
from core.kernels.pairs cimport BAND_ROUNDING
from core.kernels.nearest cimport band_least
from core.kernels.clearance cimport row_gap
from core.kernels.records cimport Nearest
from core.kernels.scene cimport Band, Found, Scene

cdef double BACKWARDS_WITHIN
cdef double CHAIN_WORK
cdef double WIDTH_ROUNDING
cdef double ACROSS

@cython.locals(k=cython.Py_ssize_t)
cdef bint shift_bounds(
    double low, double high, Py_ssize_t benches, double[:, ::1] sizes, double[:, ::1] inner, double[:, ::1] outer,
    double[:, ::1] shifts
) noexcept nogil

@cython.final
cdef class BandMarch(Found):
    cdef Band band
    cdef Py_ssize_t leaders
    cdef Py_ssize_t placed
    cdef double radius
    cdef double place
    cdef double h
    cdef double rounding
    cdef bint bounded

    cpdef object run(
        self, double outer, double inner, Py_ssize_t leaders, double rounding, double least_step, double most_work
    )

    cdef Step march(
        self, Scene scene, Band band, double inner, double least_step, double most_work
    ) noexcept nogil

    @cython.locals(nearest=Nearest)
    cdef Step try_step(self, Band band, double inner) noexcept nogil

    @cython.locals(room=cython.Py_ssize_t, handles=cython.Py_ssize_t)
    cdef Step lay_out(self, Band band, double next_radius) noexcept nogil
