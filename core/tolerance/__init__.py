"""How far people may stray."""
