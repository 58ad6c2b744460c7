"""The compiled loops, in Cython's pure-Python mode."""
