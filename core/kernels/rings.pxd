cimport cython
from core.kernels.arrays cimport Pieces, Rows
from core.kernels.constants cimport *
from core.kernels.route cimport first_place
from core.kernels.spiral cimport spiral_arc

cdef double RING_ROUNDING, DISCERNED, LEAST_ROUNDING, CLEAR_WIDTH, CLEAR_MOST
cdef Py_ssize_t RING_FURTHER, RING_ASIDE

@cython.final
cdef class Rings:
    cdef public double chord, shortest, overhang, half_width, all_chord, all_shortest, all_overhang, all_half_width
    cdef public double all_length, all_radius, between_shortest, middle_half_width, within
    cdef public bint hulls
    cdef Rows corners
    cdef public double clear_radius, clear_place, end_place

    cpdef void measure(
        self, const double[::1] chords, const double[::1] overhangs, const double[::1] widths,
        const double[::1] lengths, Py_ssize_t alike, Py_ssize_t outer
    ) noexcept

    cpdef void lay(self, Rows corners, double middle_half_width, double within)

cdef bint settled(double growth, double radius, Rings rings) noexcept nogil
cpdef double radius_beyond(double growth, double radius, Rings rings) noexcept nogil
cpdef double leaders_reach(double growth, double lead, double rear, Rings rings) noexcept nogil
@cython.locals(k=cython.Py_ssize_t)
cdef double outward_bow(double q, double slope, Rings rings) noexcept nogil
cdef double inward_bow(double q, double slope, Rings rings) noexcept nogil
cdef (double, double) ring_foot(double growth, double radius, Rings rings) noexcept nogil
cdef double ring_gap(double growth, double angle, double d2, double rho, Rings rings) noexcept nogil
cpdef double ring_least(double growth_low, double growth, double radius, Rings rings, double total=*) noexcept nogil

cpdef double spirals_least(
    double growth, double angle, double radius, Rings rings, double growth_low=*
) noexcept nogil

cpdef double ring_rounding(double growth, double radius, Rings rings) noexcept nogil

cpdef bint ring_clears(
    double growth_low, double growth, double radius, double margin, Rings rings, double total=*
) noexcept nogil

cdef bint apart_from(double growth, double radius, double margin, Rings rings, double angle) noexcept nogil
cpdef double clear_radius(double growth, double margin, Rings rings, double angle=*) noexcept nogil
cdef double coil_radius(Pieces pieces, double x, double y) noexcept nogil
cdef double coil_place(Pieces pieces, double radius) noexcept nogil
cdef double coil_reach(Pieces pieces, Py_ssize_t leaders, Rows sizes, Rows chain) noexcept nogil
cdef double drift(double rate, double h, double growth, double radius) noexcept nogil
