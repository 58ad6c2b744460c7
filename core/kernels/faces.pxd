cimport cython
from core.kernels.constants cimport *
from core.kernels.bends cimport band_bends, band_between, bend_along, least_between
from core.kernels.hulls cimport best_face, face_gap_along, hulls_of
from core.kernels.records cimport Axis, Bends, Turned
from core.kernels.scene cimport Band, Interval, Scene

@cython.locals(edge=cython.bint, own=cython.Py_ssize_t, other=cython.Py_ssize_t)
cdef double hulls_least(
    Scene scene, Interval interval, Py_ssize_t i, Py_ssize_t j, double enough, double distance
) noexcept nogil

@cython.locals(faced=Axis)
cdef double face_least(
    Scene scene, Interval interval, Py_ssize_t i, Py_ssize_t j, Turned pair, double enough
) noexcept nogil

@cython.locals(bends=Bends, bends_back=Bends, own=cython.Py_ssize_t, other=cython.Py_ssize_t)
cdef double band_hulls(
    Scene scene, Band band, Py_ssize_t i, Py_ssize_t j, double enough, double distance
) noexcept nogil

@cython.locals(faced=Axis)
cdef double band_face(
    Scene scene, Band band, Py_ssize_t i, Py_ssize_t j, Turned pair, double enough, Bends bends
) noexcept nogil

cdef double band_face_along(
    Scene scene, Band band, Py_ssize_t i, Py_ssize_t j, Axis axis, Bends bends
) noexcept nogil
