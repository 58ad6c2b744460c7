cimport cython
from core.kernels.constants cimport *
from core.kernels.gap_curvature cimport band_curvatures, band_between, curvature_along, least_between
from core.kernels.hulls cimport STEP, Kinds, best_beyond, corner_beyond, facing, gap_beyond, hulls_in
from core.kernels.hulls cimport nearest_corner, nearest_hulls, uphill, view_of
from core.kernels.records cimport Curvatures, Hulls, View, Views
from core.kernels.scene cimport Band, Interval, Scene

@cython.locals(edge=cython.bint, n=cython.Py_ssize_t)
cdef double hulls_least(
    Scene scene, Interval interval, Py_ssize_t i, Py_ssize_t j, double enough, double curvature, double curvature_back
) noexcept nogil

cdef double swapped_least(
    Scene scene, Interval interval, Py_ssize_t i, Py_ssize_t j, Hulls hulls, double curvature, double enough
) noexcept nogil

cdef double face_along(
    Kinds kinds, View start, View end, Hulls hulls, Py_ssize_t k, double curvature, double h
) noexcept nogil

cdef double face_least(
    Kinds kinds, View start, View end, Hulls hulls, Py_ssize_t k, double curvature, double h, double enough
) noexcept nogil

@cython.locals(i=cython.Py_ssize_t, j=cython.Py_ssize_t)
cdef double hulls_most(Scene scene, Interval interval, Py_ssize_t a, Py_ssize_t b, double distance) noexcept nogil
cdef Views views_of(Py_ssize_t i, Py_ssize_t j, Band band) noexcept nogil

@cython.locals(n=cython.Py_ssize_t)
cdef double band_hulls(
    Scene scene, Band band, Py_ssize_t i, Py_ssize_t j, double enough, double distance
) noexcept nogil

cdef double band_swapped(
    Scene scene, Band band, Py_ssize_t i, Py_ssize_t j, Hulls hulls, Curvatures curvatures, double enough
) noexcept nogil

cdef double band_face(
    Scene scene, Band band, Views views, Hulls hulls, Py_ssize_t k, Curvatures curvatures, double enough
) noexcept nogil

cdef double band_beyond(
    Kinds kinds, Band band, Views views, Hulls hulls, Py_ssize_t k, Curvatures curvatures
) noexcept nogil
