cimport cython
from core.kernels.arrays cimport Pieces, Rows
from core.kernels.constants cimport *
from core.kernels.records cimport LinkBounds, Stretch

cdef double CORNER_NEAR, TRIAL_CORNER, LOOSEN_CORNER

@cython.locals(p=cython.Py_ssize_t)
cdef (Py_ssize_t, Py_ssize_t) sided_pieces(Pieces pieces, Py_ssize_t k, double spare, Rows chain) noexcept nogil
cdef double displaced_by(Py_ssize_t k, Rows chain) noexcept nogil
cdef (Py_ssize_t, Py_ssize_t) passed_pieces(Pieces pieces, Py_ssize_t k, Rows before, Rows after) noexcept nogil

@cython.locals(p=cython.Py_ssize_t)
cdef double corners_between(Pieces pieces, Py_ssize_t first, Py_ssize_t last) noexcept nogil

@cython.locals(p=cython.Py_ssize_t, side=cython.Py_ssize_t)
cdef (double, double) cosines_past(
    Pieces pieces, Py_ssize_t first, Py_ssize_t last, double tx, double ty, double ux, double uy
) noexcept nogil

cdef (double, double) sided_cosines(Pieces pieces, Py_ssize_t k, Py_ssize_t i, Rows chain) noexcept nogil
@cython.locals(first=cython.Py_ssize_t, last=cython.Py_ssize_t)
cdef bint bench_has_corner(Pieces pieces, Py_ssize_t k, Rows before, Rows after) noexcept nogil

@cython.locals(first=cython.Py_ssize_t, last=cython.Py_ssize_t)
cdef LinkBounds cornered_link(
    Pieces pieces, Py_ssize_t k, double h, Stretch stretch, double rate_a, Rows before, Rows after
) noexcept nogil

@cython.locals(first=cython.Py_ssize_t, last=cython.Py_ssize_t)
cdef bint passes_corner(Pieces pieces, Py_ssize_t k, Rows before, Rows after, Rows motion) noexcept nogil

@cython.locals(first=cython.Py_ssize_t, last=cython.Py_ssize_t)
cdef double jumped(
    Pieces pieces, Py_ssize_t k, double rate_a, double rate_b, Rows before, Rows after
) noexcept nogil
