"""The tightest path for a dragon: smallest pitch and shortest turn."""
