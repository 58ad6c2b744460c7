"""Several dragons on one clock: when benches of two of them meet, and the proof that none do before."""
