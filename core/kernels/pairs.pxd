cimport cython
from core.kernels.arrays cimport Rows
from core.kernels.constants cimport *
from core.kernels.gap_curvature cimport band_curvatures, band_between, curvature_along, centres_apart, least_between
from core.kernels.faces cimport band_hulls, hulls_least, hulls_most
from core.kernels.records cimport Curvatures
from core.kernels.rings cimport Rings
from core.kernels.clearance cimport last_handle, meet
from core.kernels.scene cimport Band, Interval, Scene

cdef double BAND_ROUNDING

cdef double gap_along(Py_ssize_t i, Py_ssize_t j, double along, double left, Rows sizes, Rows chain) noexcept nogil
cdef (double, double, double) best_axis(Py_ssize_t i, Py_ssize_t j, Rows sizes, Rows chain) noexcept nogil
@cython.locals(corner=cython.int)
cdef double corner_most(Interval interval, Py_ssize_t i, Py_ssize_t j, double curvature) noexcept nogil
cdef (double, double) corner_in(Py_ssize_t i, Py_ssize_t j, double length, double width, Rows chain) noexcept nogil

cpdef double pair_most(
    Scene scene, Interval interval, double place, double h, Py_ssize_t a, Py_ssize_t b
) noexcept nogil

cpdef double pair_rounding(
    Py_ssize_t i, Py_ssize_t j, double distance, Rows sizes, Rows before, Rows after
) noexcept nogil

cdef double any_rounding(double error, Py_ssize_t handles, double h, double margin, Rings rings) noexcept nogil

cdef double axis_least(
    Scene scene, Interval interval, Py_ssize_t i, Py_ssize_t j, bint after_decides, double curvature
) noexcept nogil

cpdef (double, double) pair_least(
    Scene scene, Interval interval, Py_ssize_t i, Py_ssize_t j, double enough, double distance
) noexcept nogil

cdef (double, double) corner_axis(Scene scene, Py_ssize_t i, Py_ssize_t j, Rows chain) noexcept nogil

cdef (double, double) proven_gap(
    Scene scene, Interval interval, Py_ssize_t i, Py_ssize_t j, double distance, double rounding
) noexcept nogil

cdef double band_along(
    Scene scene, Band band, Py_ssize_t i, Py_ssize_t j, double along, double left, Curvatures curvatures
) noexcept nogil

@cython.locals(trial=cython.int)
cdef (double, double) band_pair(
    Scene scene, Band band, Py_ssize_t i, Py_ssize_t j, double enough, double distance
) noexcept nogil

cdef double band_pair_rounding(Scene scene, Band band, Py_ssize_t i, Py_ssize_t j, double distance) noexcept nogil

cdef (double, double) proven_band_gap(
    Scene scene, Band band, Py_ssize_t i, Py_ssize_t j, double distance, double rounding
) noexcept nogil
