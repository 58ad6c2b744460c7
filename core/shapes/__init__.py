"""Rectangles that overlap, judged by several engines."""
