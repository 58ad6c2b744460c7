cimport cython
from core.kernels.arrays cimport Rows
from core.kernels.constants cimport *
from core.kernels.records cimport Axis, Corner, Faced, Hulls, View
from core.kernels.rectangles cimport Witnesses

cdef double STEP

@cython.final
cdef class Kinds:
    cdef Rows hulls
    cdef long long[::1] of
    cdef Rows directions
    cdef readonly Py_ssize_t alike
    cdef readonly bint some

    cpdef void lay(self, Rows hulls, long long[::1] of, Rows directions)

cdef Py_ssize_t first_corner(Kinds kinds, Py_ssize_t i, Py_ssize_t hull) noexcept nogil
cdef Py_ssize_t sector(double y, double x) noexcept nogil
cdef Py_ssize_t wrapped(Py_ssize_t k) noexcept nogil
@cython.locals(forward=cython.bint)
cdef Corner corner(Kinds kinds, Py_ssize_t first, Py_ssize_t k, double half_length) noexcept nogil

cdef Hulls hulls_in(
    Kinds kinds, Py_ssize_t i, Py_ssize_t j, Py_ssize_t own, Py_ssize_t other, Rows sizes
) noexcept nogil

@cython.locals(shift=cython.Py_ssize_t)
cdef View view_of(Py_ssize_t i, Py_ssize_t j, Rows chain) noexcept nogil
@cython.locals(shift=cython.Py_ssize_t)
cdef View view_back(View view) noexcept nogil
cdef Py_ssize_t facing(View view, Py_ssize_t i, Py_ssize_t j, Rows sizes) noexcept nogil
cdef double gap_beyond(Kinds kinds, View view, Hulls hulls, Py_ssize_t k) noexcept nogil
@cython.locals(side=cython.Py_ssize_t, step=cython.Py_ssize_t)
cdef Axis uphill(Kinds kinds, View view, Hulls hulls, Py_ssize_t k, double enough) noexcept nogil
@cython.locals(k=cython.Py_ssize_t)
cdef Axis best_beyond(Kinds kinds, View view, Hulls hulls) noexcept nogil

@cython.locals(n=cython.Py_ssize_t)
cdef Faced nearest_hulls(
    Kinds kinds, Py_ssize_t i, Py_ssize_t j, bint edge, double limit, Rows sizes, Rows chain
) noexcept nogil

@cython.locals(k=cython.Py_ssize_t)
cpdef void hulls_near(
    Kinds kinds, bint edge, double limit, Rows sizes, Rows chain, unsigned char[::1] near
) noexcept nogil

@cython.locals(shift=cython.Py_ssize_t)
cdef Corner nearest_corner(Kinds kinds, View view, Hulls hulls, Py_ssize_t k) noexcept nogil

cdef void hulls_met(
    Kinds kinds, Py_ssize_t i, Py_ssize_t j, bint edge, Rows sizes, Rows chain, Witnesses out
) noexcept nogil

@cython.locals(k=cython.Py_ssize_t)
cdef double corner_beyond(Kinds kinds, View view, Hulls hulls, Corner at) noexcept nogil

@cython.locals(m=cython.Py_ssize_t)
cpdef void largest_supports(
    double chord, double overhang, double half_width, double stray, Rows samples, Rows directions, Rows largest
) noexcept nogil
