cimport cython

cdef Py_ssize_t MIDDLE_X, MIDDLE_Y, ALONG_X, ALONG_Y, HALF_ALONG, HALF_ACROSS, FACE, EDGE
cdef double PARALLEL, OUTSIDE

cdef double held(double x) noexcept nogil
cdef double covered(double v, double w) noexcept nogil
cdef (double, double) stretch_of(double slope, double offset, double reach) noexcept nogil
cdef Py_ssize_t index_of(double x, Py_ssize_t most) noexcept nogil

@cython.locals(k=cython.Py_ssize_t, row=cython.Py_ssize_t, first=cython.Py_ssize_t, last=cython.Py_ssize_t)
cpdef void fill_rectangles(
    unsigned char[:, :, ::1] plane, const double[:, ::1] rectangles, double line, const double[:, ::1] inks
) noexcept

@cython.locals(
    columns=cython.Py_ssize_t, first=cython.Py_ssize_t, last=cython.Py_ssize_t, inner=cython.Py_ssize_t,
    after=cython.Py_ssize_t, channel=cython.Py_ssize_t
)
cdef void fill_row(
    unsigned char[:, :, ::1] plane, Py_ssize_t row, const double[:, ::1] rectangles, Py_ssize_t k, double line,
    const double[:, ::1] inks
) noexcept nogil

@cython.locals(column=cython.Py_ssize_t, channel=cython.Py_ssize_t)
cdef void mix_row(
    unsigned char[:, :, ::1] plane, Py_ssize_t row, Py_ssize_t first, Py_ssize_t last, const double[:, ::1] rectangles,
    Py_ssize_t k, double line, const double[:, ::1] inks
) noexcept nogil
