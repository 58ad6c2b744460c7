cimport cython
from core.kernels.constants cimport *
from core.kernels.route cimport first_place, stands_first
from core.kernels.spiral cimport spiral_arc

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

cdef double coil_radius(const double[:, ::1] pieces, double x, double y) noexcept nogil
cdef double coil_place(const double[:, ::1] pieces, double radius) noexcept nogil

@cython.locals(i=cython.Py_ssize_t)
cdef double coil_reach(
    const double[:, ::1] pieces, Py_ssize_t leaders, double[:, ::1] sizes, double[:, ::1] chain
) noexcept nogil

@cython.locals(i=cython.Py_ssize_t)
cdef bint stays_beyond(
    const double[:, ::1] pieces, Py_ssize_t leaders, Py_ssize_t handles, double h, double margin, double error,
    double[::1] ring, double[:, ::1] sizes, double[:, ::1] before, double[:, ::1] after, double[:, ::1] motion
) noexcept nogil

cdef double drift(double rate, double h, double growth, double radius) noexcept nogil
