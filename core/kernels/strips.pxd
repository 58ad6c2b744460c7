cimport cython
from core.kernels.constants cimport *
from core.kernels.spiral cimport extend_chain, spiral_arc, spiral_theta, start_chain
from core.kernels.bounds cimport motion_bounds
from core.kernels.rings cimport leaders_reach, radius_beyond
from core.kernels.pairs cimport STRIP_ROUNDING, strip_least
from core.kernels.clearance cimport row_gap

cdef double TURNED_WITHIN
cdef double CHAIN_WORK
cdef double WIDTH_ROUNDING
cdef double ACROSS

@cython.locals(k=cython.Py_ssize_t)
cdef bint shift_bounds(
    double low, double high, Py_ssize_t benches, double[:, ::1] sizes, double[:, ::1] inner, double[:, ::1] outer,
    double[:, ::1] shifts
) noexcept nogil

@cython.locals(
    bounded=cython.bint, cap=cython.Py_ssize_t, placed=cython.Py_ssize_t, handles=cython.Py_ssize_t, a=cython.Py_ssize_t,
    b=cython.Py_ssize_t
)
cpdef int strip(
    double low, double high, double outer, double inner, Py_ssize_t leaders, double margin, double rounding,
    double least_step, double budget, Py_ssize_t benches, double[::1] ring, double[:, ::1] sizes,
    double[:, :, ::1] rows, double[:, :, ::1] motions, double[:, ::1] shifts, double[::1] out
) noexcept
