cimport cython
from core.kernels.arrays cimport Pieces, Rows
from core.kernels.constants cimport *
from core.kernels.double_double cimport quotient, two_product, two_sum

cdef double LAST_TERM

cpdef (double, double) clothoid_way(double p, double q) noexcept nogil
cdef (double, double, double, double, double) clothoid_point(Pieces pieces, Py_ssize_t p, double u) noexcept nogil
@cython.locals(k=cython.Py_ssize_t)
cpdef void clothoid_joints(
    double x, double y, double heading, double first, double last, double length, const double[::1] places, Rows out
) noexcept
