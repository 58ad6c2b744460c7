cimport cython

# volatile: another thread writes it while a loop without Python's lock reads it
@cython.final
cdef class Halt:
    cdef public double left
    cdef public volatile bint stopped

    cpdef bint spend(self, double work) noexcept nogil
