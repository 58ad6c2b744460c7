cimport cython
from core.kernels.arrays cimport Rows
from core.kernels.constants cimport *
from core.kernels.records cimport Curvatures
from core.kernels.scene cimport Band, Interval, Scene

cdef double least_between(double start, double end, double curvature, double h) noexcept nogil
cdef double apart(double a_low, double a_high, double b_low, double b_high) noexcept nogil

cdef (double, double) against_rotation(
    double growth, Py_ssize_t k, double omega_low, double omega_high, Rows motion
) noexcept nogil

@cython.locals(side=cython.int)
cpdef double axis_curvature(
    double growth, Py_ssize_t i, Py_ssize_t j, double distance, Rows sizes, Rows motion
) noexcept nogil

cdef double resting_curvature(Py_ssize_t i, Py_ssize_t j, double distance, Rows sizes, Rows motion) noexcept nogil
cdef double centres_apart(Interval interval, Py_ssize_t a, Py_ssize_t b) noexcept nogil
cdef double curvature_along(Scene scene, Interval interval, Py_ssize_t i, Py_ssize_t j, double distance) noexcept nogil

cpdef (double, double) pair_curvatures(
    Scene scene, Interval interval, double place, double h, Py_ssize_t a, Py_ssize_t b
) noexcept nogil

cpdef double shift_curvature(Py_ssize_t i, Py_ssize_t j, double distance, Rows sizes, Rows shifts) noexcept nogil
cdef Curvatures band_curvatures(Scene scene, Band band, Py_ssize_t i, Py_ssize_t j, double distance) noexcept nogil

cdef double band_between(
    Band band, double start, double end, double high_start, double high_end, Curvatures curvatures
) noexcept nogil
