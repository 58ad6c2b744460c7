"""Overlaps of rectangles, found by several engines."""
