"""Grading of students' files: the right and wrong cells, and the known error that explains the wrong ones."""
