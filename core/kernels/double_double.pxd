cimport cython
from core.kernels.arrays cimport Pairs, Rows
from core.kernels.constants cimport *
from core.kernels.spiral cimport spiral_arc

cdef double SPLITTER, TWO_PI_LOW, NEWTON_STEP, GUESSED

cdef (double, double) two_sum(double a, double b) noexcept nogil
cdef (double, double) two_product(double a, double b) noexcept nogil
cdef (double, double) quotient(double a, double a_low, double b, double b_low) noexcept nogil
cdef (double, double) arc_pair(double theta, double low) noexcept nogil
@cython.locals(i=cython.int)
cdef (double, double) theta_pair(double arc, double low) noexcept nogil
cpdef (double, double) growth_pair(double pitch) noexcept nogil
cpdef (double, double) coil_arc(double pitch, double turns) noexcept nogil
cpdef (double, double) coil_theta(
    double growth, double growth_low, double arc, double arc_low, double way, double way_low
) noexcept nogil
cpdef void spiral_thetas(
    double growth, double growth_low, double length, double length_low, Pairs s, Rows thetas
) noexcept
