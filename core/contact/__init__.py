"""When and how near benches come to each other."""
