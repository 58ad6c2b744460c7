"""When benches come near each other, and how near."""
