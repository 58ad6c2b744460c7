"""The printed plan: a dance true to scale, the points to paint, and the places of people over time."""
