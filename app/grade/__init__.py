"""Grading of what students hand in: which cells are right, and which known error explains those that are wrong."""
