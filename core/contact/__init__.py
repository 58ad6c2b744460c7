"""Times and distances at which benches come near each other."""
