"""Tolerance to strays of people."""
