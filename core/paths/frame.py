"""Frame: the place of a spiral in the world. Everything is computed in its own frame; places are then moved once."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from core.values import Floats, Point


# A point p of the own frame is at centre + R p in the world. R is the rotation, after a reflection across the x axis if
# the dance goes counter-clockwise. R keeps distances, so only places depend on it. Differences from the centre are
# taken before a rotation, so the error of a place that is moved back is a few roundings of its distance from the
# centre, at any distance from the origin.
@dataclass(frozen=True, slots=True)
class Frame:
    """The own frame of a spiral in the world.

    centre: (x, y) [m]; rotation: about it [rad]; clockwise: False for the mirror image, which is reflected first
    """

    centre: Point = (0.0, 0.0)
    rotation: float = 0.0
    clockwise: bool = True

    def vectors(self, own: Floats) -> Floats:
        """Directions (..., 2) in the world from those in the own frame."""
        if self == WORLD:
            return own
        cos, sin = math.cos(self.rotation), math.sin(self.rotation)
        x, y = own[..., 0], own[..., 1] if self.clockwise else -own[..., 1]
        return np.stack([x * cos - y * sin, x * sin + y * cos], axis=-1)

    def points(self, own: Floats) -> Floats:
        """Points (..., 2) in the world from those in the own frame [m]."""
        return own if self == WORLD else self.vectors(own) + np.array(self.centre)

    def point(self, x: float, y: float) -> Point:
        """Point in the world from one in the own frame [m]."""
        if self == WORLD:
            return x, y
        cos, sin, y = math.cos(self.rotation), math.sin(self.rotation), y if self.clockwise else -y
        return x * cos - y * sin + self.centre[0], x * sin + y * cos + self.centre[1]

    def back(self, world: Floats) -> Floats:
        """Points (..., 2) in the own frame from those in the world [m]."""
        if self == WORLD:
            return world
        cos, sin = math.cos(self.rotation), math.sin(self.rotation)
        x, y = world[..., 0] - self.centre[0], world[..., 1] - self.centre[1]
        left = y * cos - x * sin
        return np.stack([x * cos + y * sin, left if self.clockwise else -left], axis=-1)


# The frame of a path whose own frame is that of the world: no number changes.
WORLD = Frame()
