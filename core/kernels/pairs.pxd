cimport cython
from core.kernels.constants cimport *
from core.kernels.records cimport Bends, Nearest, Rounding
from core.kernels.rectangles cimport row_separation
from core.kernels.rings cimport RING_ROUNDING, Rings, coil_radius, drift, leaders_reach, radius_beyond
from core.kernels.route cimport stands_first
from core.kernels.clearance cimport last_handle
from core.kernels.scene cimport Band, Interval, Scene
from core.kernels.spiral cimport spiral_error

cdef double STRIP_ROUNDING

cdef double gap_along(
    Py_ssize_t i, Py_ssize_t j, double along, double left, double[:, ::1] sizes, double[:, ::1] chain
) noexcept nogil

cdef (double, double, double) best_axis(
    Py_ssize_t i, Py_ssize_t j, double[:, ::1] sizes, double[:, ::1] chain
) noexcept nogil

cdef double least_between(double start, double end, double bend, double h) noexcept nogil
cdef double apart(double a_low, double a_high, double b_low, double b_high) noexcept nogil

cdef (double, double) against_rotation(
    double growth, Py_ssize_t k, double turn_low, double turn_high, double[:, ::1] motion
) noexcept nogil

@cython.locals(side=cython.int)
cpdef double axis_bend(
    double growth, Py_ssize_t i, Py_ssize_t j, double distance, double[:, ::1] sizes, double[:, ::1] motion
) noexcept nogil

cdef double plain_bend(
    Py_ssize_t i, Py_ssize_t j, double distance, double[:, ::1] sizes, double[:, ::1] motion
) noexcept nogil

cdef double centres_apart(Interval interval, Py_ssize_t a, Py_ssize_t b) noexcept nogil

cdef double bend_along(
    Scene scene, Interval interval, Py_ssize_t i, Py_ssize_t j, double distance
) noexcept nogil

cpdef (double, double) pair_bends(
    Scene scene, Interval interval, double place, double h, Py_ssize_t a, Py_ssize_t b
) noexcept nogil

@cython.locals(corner=cython.int)
cdef double corner_most(
    Py_ssize_t i, Py_ssize_t j, double bend, double h, double[:, ::1] sizes, double[:, ::1] before,
    double[:, ::1] after
) noexcept nogil

cdef (double, double) corner_in(
    Py_ssize_t i, Py_ssize_t j, double length, double width, double[:, ::1] chain
) noexcept nogil

cpdef double pair_most(
    Scene scene, Interval interval, double place, double h, Py_ssize_t a, Py_ssize_t b
) noexcept nogil

cpdef double pair_rounding(
    Py_ssize_t i, Py_ssize_t j, double distance, double[:, ::1] sizes, double[:, ::1] before, double[:, ::1] after
) noexcept nogil

cdef double any_rounding(double error, Py_ssize_t handles, double h, double margin, Rings rings) noexcept nogil

cdef double axis_least(
    Scene scene, Interval interval, Py_ssize_t i, Py_ssize_t j, bint after_decides, double bend
) noexcept nogil

cpdef (double, double) pair_least(
    Scene scene, Interval interval, Py_ssize_t i, Py_ssize_t j, double enough, double distance
) noexcept nogil

cdef (double, double) corner_axis(Scene scene, Py_ssize_t i, Py_ssize_t j, double[:, ::1] chain) noexcept nogil

@cython.locals(
    i=cython.Py_ssize_t, j=cython.Py_ssize_t, a=cython.Py_ssize_t, b=cython.Py_ssize_t, first=cython.Py_ssize_t,
    end=cython.Py_ssize_t, tried=cython.Py_ssize_t, rounding=Rounding
)
cdef Nearest interval_least(Scene scene, Interval interval, Py_ssize_t active) noexcept nogil

cdef Rounding interval_rounding(Scene scene, Interval interval) noexcept nogil

cdef (double, double) proven_gap(
    Scene scene, Interval interval, Py_ssize_t i, Py_ssize_t j, double distance, double rounding
) noexcept nogil

cdef double innermost(Scene scene, Interval interval, Py_ssize_t k, double rate) noexcept nogil
cdef double reach_of(Scene scene, Interval interval, Py_ssize_t i, double error) noexcept nogil
cdef bint stays_beyond(Scene scene, Interval interval, Py_ssize_t leaders, double error) noexcept nogil

@cython.locals(i=cython.Py_ssize_t)
cdef bint coil_stays_beyond(Scene scene, Interval interval, Py_ssize_t leaders, double error) noexcept nogil

cdef double band_along(
    Scene scene, Band band, Py_ssize_t i, Py_ssize_t j, double along, double left, Bends bends
) noexcept nogil

cdef Bends band_bends(Scene scene, Band band, Py_ssize_t i, Py_ssize_t j, double distance) noexcept nogil

@cython.locals(a=cython.Py_ssize_t, b=cython.Py_ssize_t, trial=cython.int, bends=Bends)
cdef (double, double) band_pair(
    Scene scene, Band band, Py_ssize_t i, Py_ssize_t j, double enough, double distance
) noexcept nogil

@cython.locals(handles=cython.Py_ssize_t)
cdef Rounding band_rounding(Scene scene, Band band) noexcept nogil

cdef double band_pair_rounding(
    Scene scene, Band band, Py_ssize_t i, Py_ssize_t j, double distance
) noexcept nogil

cdef (double, double) proven_band_gap(
    Scene scene, Band band, Py_ssize_t i, Py_ssize_t j, double distance, double rounding
) noexcept nogil

@cython.locals(
    i=cython.Py_ssize_t, j=cython.Py_ssize_t, a=cython.Py_ssize_t, b=cython.Py_ssize_t, tried=cython.Py_ssize_t,
    rounding=Rounding
)
cdef Nearest band_least(Scene scene, Band band, Py_ssize_t leaders) noexcept nogil
