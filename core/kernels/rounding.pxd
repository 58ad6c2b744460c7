cimport cython
from core.kernels.arrays cimport Pieces, Rows
from core.kernels.constants cimport *
from core.kernels.corners cimport CORNER_NEAR, sided_cosines
from core.kernels.route cimport cubic_point, cubic_speed, route_point, theta_at

cdef double slipped(double slip, double ratio, double slope, double local, double spots, double inverse) noexcept nogil
cdef double swayed(Py_ssize_t k, Rows chain, double ratio, double local, double spread, double inverse) noexcept nogil
@cython.locals(k=cython.Py_ssize_t)
cpdef void spiral_rounding(double growth, Py_ssize_t last, Rows sizes, Rows chain) noexcept nogil
cdef double spiral_error(double growth, Py_ssize_t last, double longest, Rows chain) noexcept nogil
cdef double cubic_size(Pieces pieces, Py_ssize_t p) noexcept nogil
cdef double spot_error(Pieces pieces, Py_ssize_t p, double s, double theta, double x, double y) noexcept nogil
cdef double slide_error(Pieces pieces, Py_ssize_t p, double s) noexcept nogil
cdef (double, double, double, double, double) piece_end(
    Pieces pieces, Py_ssize_t p, double s, double low
) noexcept nogil
@cython.locals(p=cython.Py_ssize_t, q=cython.Py_ssize_t)
cpdef void joint_misses(Pieces pieces, Rows out) noexcept
cpdef void piece_slides(Pieces pieces, double[::1] out) noexcept
@cython.locals(k=cython.Py_ssize_t, cornered=cython.bint)
cpdef void route_rounding(Pieces pieces, Py_ssize_t last, Rows sizes, Rows chain) noexcept nogil
cdef double chain_spot(Pieces pieces, Py_ssize_t k, Rows chain) noexcept nogil
