cimport cython
from core.kernels.arrays cimport Rows
from core.kernels.constants cimport *
from core.kernels.spiral cimport spiral_curvature
from core.kernels.stretches cimport blur_of, steepest_curvature
from core.kernels.route cimport extend_route
from core.kernels.chain cimport Curve, extend, extend_chain, start
from core.kernels.bounds cimport LOOSEN, SPIRAL_SWAY, followed_error, link_cosines
from core.kernels.rings cimport drift
from core.kernels.scene cimport Interval, Scene

cdef double BOUND_ROUNDING

cdef Py_ssize_t lively_chain(
    Curve curve, double place, Py_ssize_t last, double calm, Rows sizes, Rows chain
) noexcept nogil

cdef Py_ssize_t fastest(Py_ssize_t benches, Rows chain) noexcept nogil
@cython.locals(i=cython.Py_ssize_t)
cpdef void climbs(Curve curve, Py_ssize_t last, Rows sizes, Rows chain) noexcept nogil
@cython.locals(k=cython.Py_ssize_t)
cdef void spiral_jerks(double growth, Interval interval) noexcept nogil

@cython.locals(k=cython.Py_ssize_t)
cpdef void spiral_errors(
    double growth, Py_ssize_t handles, Rows sizes, Rows before, Rows after, Rows motion
) noexcept nogil

cdef double smooth_bound(
    double start, double start_slope, double end, double end_slope, double jerk, double h, bint kink
) noexcept nogil

@cython.locals(handles=cython.Py_ssize_t)
cdef double rate_bound(Scene scene, Interval interval, double calm) noexcept nogil
@cython.locals(kink=cython.bint)
cdef double handle_bound(Scene scene, Interval interval, Py_ssize_t k, double enough) noexcept nogil
@cython.locals(k=cython.Py_ssize_t)
cdef (double, Py_ssize_t) certain_rate(Interval interval, double rounding) noexcept nogil
cdef Py_ssize_t lay_ahead(Scene scene, Interval interval, double calm, Py_ssize_t placed, double place) noexcept nogil
