"""How tight a path may be for a dragon."""
