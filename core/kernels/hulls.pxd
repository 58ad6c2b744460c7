cimport cython
from core.kernels.constants cimport *
from core.kernels.records cimport Axis, Corner
from core.kernels.rectangles cimport Witnesses

cdef double STEP

@cython.final
cdef class Kinds:
    cdef double[:, ::1] hulls
    cdef long long[::1] of
    cdef double[:, ::1] directions
    cdef readonly Py_ssize_t alike
    cdef readonly bint some

    cpdef void lay(self, double[:, ::1] hulls, long long[::1] of, double[:, ::1] directions)

cdef Py_ssize_t hulls_of(Kinds kinds, bint edge) noexcept nogil
cdef Py_ssize_t first_corner(Kinds kinds, Py_ssize_t i, Py_ssize_t hull) noexcept nogil
cdef Py_ssize_t sector(double y, double x) noexcept nogil
cdef Py_ssize_t wrapped(Py_ssize_t k) noexcept nogil
@cython.locals(forward=cython.bint)
cdef Corner corner(Kinds kinds, Py_ssize_t first, Py_ssize_t k, double half_length) noexcept nogil

@cython.locals(first=cython.Py_ssize_t, second=cython.Py_ssize_t, shift=cython.Py_ssize_t, found=cython.Py_ssize_t, k=cython.Py_ssize_t,
               at=Corner)
cdef Axis best_face(
    Kinds kinds, Py_ssize_t i, Py_ssize_t j, Py_ssize_t own, Py_ssize_t other, Py_ssize_t edge, double[:, ::1] sizes, double[:, ::1] chain
) noexcept nogil

@cython.locals(second=cython.Py_ssize_t, nearest=cython.Py_ssize_t, shift=cython.Py_ssize_t, at=Corner, found=Corner)
cdef Corner face_witness(
    Kinds kinds, Py_ssize_t i, Py_ssize_t j, Axis axis, double[:, ::1] sizes, double[:, ::1] chain
) noexcept nogil

@cython.locals(at=Corner)
cdef double face_gap_along(
    Kinds kinds, Py_ssize_t i, Py_ssize_t j, Axis axis, double[:, ::1] sizes, double[:, ::1] chain
) noexcept nogil

@cython.locals(
    own=cython.Py_ssize_t, other=cython.Py_ssize_t, a=cython.Py_ssize_t, b=cython.Py_ssize_t, turned=cython.bint, faced=Axis,
    back=Axis, nearest=Axis, at=Corner
)
cdef double hulls_gap(
    Kinds kinds, Py_ssize_t i, Py_ssize_t j, bint edge, double[:, ::1] sizes, double[:, ::1] chain, Witnesses out
) noexcept nogil
