"""Path: what every question may ask of a spiral and of a route alike."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol, Self

from core import kernels
from core.paths.frame import Frame
from core.shown import Shown
from core.values import Floats


@dataclass(frozen=True, slots=True, repr=False)
class HeadState(Shown):
    """Handle 0 at one instant: theta on a spiral, in its own frame [rad, unwrapped; None off one], radius from the
    centre of the spiral, or from the origin [m], x [m], y [m]."""

    theta: float | None
    radius: float
    x: float
    y: float


class Path(Protocol):
    """A curve by its arc length s [m], which is 0 where the head stands at time 0 and grows in the direction of travel.

    begin, end: s between which the head may be [m]; tail_begin: s of the first place for the last handle [m], None
        where the path goes on without end behind its begin
    limit: largest s of the head [m], infinity where a search may look a little past the end
    growth: radial advance [m/rad], 1 on a route
    curve, place: the path as the kernels take it, and the place that they give to s = 0: the arc length from the centre
        of a spiral, 0 on a route [m]
    slide: how far a point may be from its s along the path, besides the rounding of s [m]
    frame: of all that is computed, in the world; standard: the path in that frame
    """

    @property
    def begin(self) -> float: ...
    @property
    def end(self) -> float: ...
    @property
    def tail_begin(self) -> float | None: ...
    @property
    def limit(self) -> float: ...
    @property
    def growth(self) -> float: ...
    @property
    def curve(self) -> kernels.Curve: ...
    @property
    def place(self) -> float: ...
    @property
    def slide(self) -> float: ...
    @property
    def frame(self) -> Frame: ...
    @property
    def standard(self) -> Self: ...

    def position(self, s: Floats | float) -> Floats:
        """Points at arc length s. s: (...) [m]; returns (..., 2) x, y [m]."""

    def tangent(self, s: Floats | float) -> Floats:
        """Unit tangents in the direction of travel. s: (...) [m]; returns (..., 2)."""

    def curvature(self, s: Floats | float) -> Floats:
        """Curvature, counter-clockwise positive. s: (...) [m]; returns (...) [1/m]."""

    def head(self, s: float) -> HeadState:
        """The head at arc length s [m]."""

    def calm(self, curvature: float) -> float:
        """Where handles are no faster than their leaders, in the form that kernels.Peak takes.

        curvature: handles follow without turning back where the path bends no more than this [1/m]
        """

    def drawn(self, reached: Floats) -> Floats:
        """Points (N, 2) [m] for a picture, on a spiral as far out as the points (..., 2) reached."""

    def words(self) -> str:
        """The path in a sentence that names all that matters for a proof."""
