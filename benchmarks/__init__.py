"""How long each answer takes, beside a plain SciPy and shapely program measured in the same run."""
