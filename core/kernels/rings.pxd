cimport cython
from core.kernels.constants cimport *

cdef double RING_ROUNDING
cdef double DISCERNED

cdef bint settled(double growth, double radius, double[::1] ring) noexcept nogil
cpdef double radius_beyond(double growth, double radius, double[::1] ring) noexcept nogil
cpdef double leaders_reach(double growth, double lead, double rear, double[::1] ring) noexcept nogil

@cython.locals(end=cython.int)
cpdef double ring_least(
    double growth_low, double growth, double radius, double chord, double shortest, double overhang,
    double half_width, double outer_chord, double outer_half_width, double total=*
) noexcept nogil

cdef double drift(double rate, double h, double growth, double radius) noexcept nogil
