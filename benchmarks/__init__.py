"""Times of the answers, beside a plain SciPy and shapely program measured in the same run."""
