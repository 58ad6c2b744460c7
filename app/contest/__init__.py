"""The contest kit: all answers to problem A of CUMCM 2024, and the files that students hand in."""
