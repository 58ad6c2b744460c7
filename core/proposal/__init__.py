"""Dances that fit into a venue: from a square, a dragon and gates to certified proposals."""
