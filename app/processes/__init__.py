"""Child processes: one that ends with its parent, the messages between them, and a pool that replaces dead ones."""
