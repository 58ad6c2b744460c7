cimport cython
from core.kernels.arrays cimport Rows
from core.kernels.constants cimport *
from core.kernels.records cimport Laid
from core.kernels.spiral cimport spiral_curvature
from core.kernels.route cimport extend_route, stands_first, start_route
from core.kernels.chain cimport chain_rounding, extend_chain, head_theta, start_chain
from core.kernels.bounds cimport followed_error
from core.kernels.rings cimport coil_place, coil_radius, coil_reach, drift, leaders_reach, radius_beyond
from core.kernels.scene cimport Interval, Scene

cdef double PASSED_BY

cdef Laid chain_between(
    Scene scene, double place, Py_ssize_t leaders, double allowance, bint reversing, Rows chain
) noexcept nogil

@cython.locals(k=cython.Py_ssize_t, leading=cython.Py_ssize_t)
cdef Laid route_between(Scene scene, double place, Py_ssize_t leaders, double allowance, Rows chain) noexcept nogil

@cython.locals(i=cython.Py_ssize_t)
cdef bint passed(
    Scene scene, Py_ssize_t first, Py_ssize_t last, Py_ssize_t placed, Rows opening, Rows chain
) noexcept nogil

cdef bint may_reverse(Interval interval, Py_ssize_t k, double error) noexcept nogil
cdef bint leader_may_reverse(Interval interval, Py_ssize_t k) noexcept nogil
@cython.locals(k=cython.Py_ssize_t, placed=cython.Py_ssize_t, followed=cython.bint)
cdef bint slid_back(Scene scene, Interval interval, Py_ssize_t first, Py_ssize_t last, Rows opening) noexcept nogil
