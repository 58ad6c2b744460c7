"""The plan on paper: a dance true to scale, the points to paint, and who is where when."""
