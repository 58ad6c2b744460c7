"""The curves that a dragon follows."""
