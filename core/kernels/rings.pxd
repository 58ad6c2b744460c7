cimport cython
from core.kernels.constants cimport *
from core.kernels.route cimport first_place
from core.kernels.spiral cimport spiral_arc

cdef double RING_ROUNDING
cdef double DISCERNED
cdef double LEAST_ROUNDING
cdef double CLEAR_WIDTH
cdef double CLEAR_MOST
cdef Py_ssize_t RING_FURTHER
cdef Py_ssize_t RING_ASIDE

@cython.final
cdef class Rings:
    cdef public double chord
    cdef public double shortest
    cdef public double overhang
    cdef public double half_width
    cdef public double all_chord
    cdef public double all_shortest
    cdef public double all_overhang
    cdef public double all_half_width
    cdef public double all_length
    cdef public double all_radius
    cdef public double between_shortest
    cdef public double middle_half_width
    cdef public double within
    cdef public bint hulls
    cdef double[:, ::1] corners
    cdef public double clear_radius
    cdef public double clear_place
    cdef public double end_place

    @cython.locals(k=cython.Py_ssize_t)
    cpdef void measure(
        self, const double[::1] chords, const double[::1] overhangs, const double[::1] widths,
        const double[::1] lengths, Py_ssize_t alike, Py_ssize_t outer
    ) noexcept
    cpdef void lay(self, double[:, ::1] corners, double middle_half_width, double within)

cdef bint settled(double growth, double radius, Rings rings) noexcept nogil
cpdef double radius_beyond(double growth, double radius, Rings rings) noexcept nogil
cpdef double leaders_reach(double growth, double lead, double rear, Rings rings) noexcept nogil

@cython.locals(k=cython.Py_ssize_t)
cdef double outward_bow(double q, double slope, Rings rings) noexcept nogil
cdef double inward_bow(double q, double slope, Rings rings) noexcept nogil

@cython.locals(end=cython.int)
cpdef double ring_least(double growth_low, double growth, double radius, Rings rings, double total=*) noexcept nogil

cpdef double ring_rounding(double growth, double radius, Rings rings) noexcept nogil
cpdef bint ring_clears(
    double growth_low, double growth, double radius, double margin, Rings rings, double total=*
) noexcept nogil
cpdef double clear_radius(double growth, double margin, Rings rings) noexcept nogil

cdef double coil_radius(const double[:, ::1] pieces, double x, double y) noexcept nogil
cdef double coil_place(const double[:, ::1] pieces, double radius) noexcept nogil

@cython.locals(i=cython.Py_ssize_t)
cdef double coil_reach(
    const double[:, ::1] pieces, Py_ssize_t leaders, double[:, ::1] sizes, double[:, ::1] chain
) noexcept nogil

cdef double drift(double rate, double h, double growth, double radius) noexcept nogil
