cimport cython
from core.kernels.constants cimport *

cdef double CREST_DELTA, FOLDING_CHORD2, ARRIVAL

ctypedef bint (*Claim)(double angle, double theta, double chord2) noexcept nogil

@cython.locals(i=cython.int)
cdef (double, double) halved(Claim holds, double low, double high, double theta, double chord2) noexcept nogil
cdef double half_slope(double theta, double delta) noexcept nogil
cdef bint slope_falls(double delta, double theta, double chord2) noexcept nogil
cdef bint half_slope_falls(double delta, double theta, double chord2) noexcept nogil
cdef bint chord_grows(double delta, double theta, double chord2) noexcept nogil
cdef bint chord_is_short(double delta, double theta, double chord2) noexcept nogil
cpdef double first_crest(double theta) noexcept nogil
cpdef double first_root(double theta, double chord2) noexcept nogil
cdef double theta_of_delta(double delta, double chord2) noexcept nogil
cdef bint chord_unfolds(double delta, double theta, double chord2) noexcept nogil
cpdef double fold_theta(double chord2) noexcept nogil
cdef bint arrives_later(double leader, double theta, double chord2) noexcept nogil
cpdef double previous_theta(double theta, double chord2) noexcept nogil
