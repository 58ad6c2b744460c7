cimport cython

# volatile: another thread writes it while a loop without Python's lock reads it
@cython.final
cdef class Budget:
    cdef public double left, work
    cdef public volatile bint stopped
    cdef public bint brief, limited
    cdef public Budget part
    cdef public object then

    cpdef void spend(self, double work) noexcept nogil
    cpdef bint uses_up(self, double work) noexcept nogil
