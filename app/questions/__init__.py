"""The questions, each with its request and its answer."""
