cimport cython
from core.kernels.constants cimport *
from core.kernels.spiral cimport first_root, half_slope

cdef double CREST_DELTA
cdef double FOLDING_CHORD2
cdef double ARRIVAL

cdef double theta_of_delta(double delta, double chord2) noexcept nogil

@cython.locals(i=cython.int)
cpdef double fold_theta(double chord2) noexcept nogil

@cython.locals(i=cython.int)
cpdef double previous_theta(double theta, double chord2) noexcept nogil
