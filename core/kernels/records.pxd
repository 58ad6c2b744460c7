# The records of records.py as the C compiler sees them.

cdef struct Link:
    double cos_front
    double cos_rear
    double sine
    double rate
    double rate_low
    double omega
    double omega_low
    double swing_front
    double swing_rear

cdef struct Stretch:
    double chord
    double low
    double high
    double slope
    double widened
    double sine
    double blur

cdef struct Cosines:
    double front_low
    double front_high
    double rear_low
    double rear_high
