"""The command bench-dragon."""
