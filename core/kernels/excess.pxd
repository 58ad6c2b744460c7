cimport cython
from core.kernels.constants cimport *
from core.kernels.chain cimport extend
from core.kernels.speed cimport certain_rate, lively_chain, rate_bound

@cython.locals(placed=cython.Py_ssize_t, handles=cython.Py_ssize_t, links=cython.Py_ssize_t, k=cython.Py_ssize_t,
    opened=cython.bint
)
cpdef void first_excess(
    double growth, const double[:, ::1] pieces, double place, double start, double stop, double step, double limit,
    double kept, double width, double rounding, Py_ssize_t budget, Py_ssize_t benches, double calm, double[:, ::1] sizes,
    double[:, :, ::1] rows, double[:, ::1] motion, double[::1] out
) noexcept
