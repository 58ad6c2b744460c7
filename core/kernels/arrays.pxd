# The loops' arrays: rows of the columns of constants.py; a table of pieces; instants, handles, and x and y.
ctypedef double[:, ::1] Rows
ctypedef const double[:, ::1] Pieces
ctypedef const double[:, ::1] Pairs
ctypedef double[:, :, ::1] Tables
