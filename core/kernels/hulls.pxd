cimport cython
from core.kernels.constants cimport *
from core.kernels.records cimport Axis, Corner, Faced, Hulls, View
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

cdef Py_ssize_t first_corner(Kinds kinds, Py_ssize_t i, Py_ssize_t hull) noexcept nogil
cdef Py_ssize_t sector(double y, double x) noexcept nogil
cdef Py_ssize_t wrapped(Py_ssize_t k) noexcept nogil
@cython.locals(forward=cython.bint)
cdef Corner corner(Kinds kinds, Py_ssize_t first, Py_ssize_t k, double half_length) noexcept nogil

@cython.locals(first=cython.Py_ssize_t)
cdef Hulls hulls_in(
    Kinds kinds, Py_ssize_t i, Py_ssize_t j, Py_ssize_t own, Py_ssize_t other, double[:, ::1] sizes
) noexcept nogil

@cython.locals(shift=cython.Py_ssize_t)
cdef View view_of(Py_ssize_t i, Py_ssize_t j, double[:, ::1] chain) noexcept nogil

@cython.locals(shift=cython.Py_ssize_t)
cdef View view_back(View view) noexcept nogil

cdef Py_ssize_t facing(View view, Py_ssize_t i, Py_ssize_t j, double[:, ::1] sizes) noexcept nogil

@cython.locals(own=Corner, other=Corner)
cdef double gap_beyond(Kinds kinds, View view, Hulls hulls, Py_ssize_t k) noexcept nogil

@cython.locals(side=cython.Py_ssize_t, step=cython.Py_ssize_t, ahead=cython.Py_ssize_t)
cdef Axis uphill(Kinds kinds, View view, Hulls hulls, Py_ssize_t k, double enough) noexcept nogil

@cython.locals(found=cython.Py_ssize_t, k=cython.Py_ssize_t)
cdef Axis best_beyond(Kinds kinds, View view, Hulls hulls) noexcept nogil

@cython.locals(
    best=Faced, view=View, back=View, start=cython.Py_ssize_t, start_back=cython.Py_ssize_t, own=cython.Py_ssize_t,
    n=cython.Py_ssize_t, other=cython.Py_ssize_t, hulls=Hulls, hulls_back=Hulls, axis=Axis, axis_back=Axis
)
cdef Faced nearest_hulls(
    Kinds kinds, Py_ssize_t i, Py_ssize_t j, bint edge, double limit, double[:, ::1] sizes, double[:, ::1] chain
) noexcept nogil

@cython.locals(shift=cython.Py_ssize_t, at=Corner, found=Corner)
cdef Corner nearest_corner(Kinds kinds, View view, Hulls hulls, Py_ssize_t k) noexcept nogil

@cython.locals(faced=Faced, a=cython.Py_ssize_t, b=cython.Py_ssize_t, hulls=Hulls, at=Corner)
cdef void hulls_met(
    Kinds kinds, Py_ssize_t i, Py_ssize_t j, bint edge, double[:, ::1] sizes, double[:, ::1] chain, Witnesses out
) noexcept nogil

@cython.locals(k=cython.Py_ssize_t, own=Corner)
cdef double corner_beyond(Kinds kinds, View view, Hulls hulls, Corner at) noexcept nogil

@cython.locals(m=cython.Py_ssize_t, k=cython.Py_ssize_t)
cpdef void largest_supports(
    double chord, double overhang, double half_width, double stray, double[:, ::1] samples, double[:, ::1] directions,
    double[:, ::1] found
) noexcept nogil
