cimport cython
from core.kernels.constants cimport *
from core.kernels.route cimport cubic_point, cubic_speed, route_point, theta_at

cdef double slipped(
    double slip, double ratio, double slope, double local, double spots, double inverse
) noexcept nogil

cdef double swayed(
    Py_ssize_t k, double[:, ::1] chain, double ratio, double local, double spread, double inverse
) noexcept nogil

@cython.locals(k=cython.Py_ssize_t, first=cython.Py_ssize_t)
cpdef void spiral_rounding(double growth, Py_ssize_t last, double[:, ::1] sizes, double[:, ::1] chain) noexcept nogil

cdef double spiral_error(double growth, Py_ssize_t last, double longest, double[:, ::1] chain) noexcept nogil

cdef double cubic_size(const double[:, ::1] pieces, Py_ssize_t p) noexcept nogil

@cython.locals(kind=cython.int)
cdef double spot_error(
    const double[:, ::1] pieces, Py_ssize_t p, double s, double theta, double x, double y
) noexcept nogil

@cython.locals(kind=cython.int)
cdef double slide_error(const double[:, ::1] pieces, Py_ssize_t p, double s) noexcept nogil

cdef (double, double, double, double, double) piece_end(
    const double[:, ::1] pieces, Py_ssize_t p, double s
) noexcept nogil

@cython.locals(p=cython.Py_ssize_t, q=cython.Py_ssize_t)
cpdef void joint_misses(const double[:, ::1] pieces, double[:, ::1] out) noexcept

@cython.locals(p=cython.Py_ssize_t)
cpdef void piece_slides(const double[:, ::1] pieces, double[::1] out) noexcept

@cython.locals(k=cython.Py_ssize_t, first=cython.Py_ssize_t)
cpdef void route_rounding(
    const double[:, ::1] pieces, Py_ssize_t last, double[:, ::1] sizes, double[:, ::1] chain
) noexcept nogil

@cython.locals(p=cython.Py_ssize_t)
cdef double chain_spot(const double[:, ::1] pieces, Py_ssize_t k, double[:, ::1] chain) noexcept nogil
