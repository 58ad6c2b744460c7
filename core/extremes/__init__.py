"""Where the dragon comes nearest to its limits: highest speed of a handle, sharpest bend of a joint."""
