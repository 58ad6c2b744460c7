"""Path: the common interface of spirals and routes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, Protocol, Self

from core import kernels
from core.display import Readable
from core.paths.frame import Frame
from core.values import Floats, Interval

Columns = tuple[Floats, Floats, Floats]


@dataclass(frozen=True, slots=True, repr=False)
class HeadState(Readable):
    """Handle 0 at one instant.

    theta: polar angle on a spiral in its own frame, unwrapped; None on any other path [rad]
    radius: distance from the centre of a spiral, or from the origin [m]
    x: x of the handle [m]
    y: y of the handle [m]

    >>> from core import Dance, Dragon, Spiral, first_contact
    >>> head = first_contact(Dance(Dragon(), Spiral())).head
    >>> round(head.radius, 6), round(head.x, 6), round(head.y, 6)
    (2.288743, 1.209931, 1.942784)
    """

    theta: float | None
    radius: float
    x: float
    y: float


@dataclass(frozen=True, slots=True, repr=False)
class PathSummary(Readable):
    """A path by all that matters for a claim.

    kind: spiral, or route: any other path
    begin: smallest arc length of the head; 0 is its place at time 0 [m]
    end: largest arc length of the head [m]
    pitch: pitch of a spiral; None on a route [m]
    start_turns: turns from the centre to the start of a spiral; None on a route [turns]
    pieces: kinds of the pieces of a route, in order; of more than six pieces only the different kinds

    >>> from core import Dance, Dragon, Spiral, first_contact
    >>> first_contact(Dance(Dragon(), Spiral())).certificate.claim.dance.path.pitch
    0.55
    """

    kind: Literal["spiral", "route"]
    begin: float
    end: float
    pitch: float | None = None
    start_turns: float | None = None
    pieces: tuple[str, ...] = ()


class Path(Protocol):
    """A curve by its arc length s [m], which is 0 at the head's place at time 0 and grows in the direction of travel.

    begin, end: smallest and largest s of the head [m]; tail_begin: smallest s of the last handle [m], None if the path
        continues without end behind its beginning
    limit: largest s of the head in a search [m], infinity if a search may pass the end a little
    growth: radial advance [m/rad], 1 on a route
    curve, place: the path in the form of the kernels, and their place for s = 0 [m]: the arc length from the centre of
        a spiral, 0 on a route. A place falls in the direction of travel, by 1 m for each metre
    A lag says how far back a handle stands, as its column LAG in a chain: the polar angle on a spiral in its own frame
        [rad], minus s on a route [m]
    slide: largest distance along the path between a point and its s, in addition to the rounding of s [m]
    block: number of places of the head that handles() computes together: it is quick for multiples of it
    frame: the own frame, in which everything is computed; standard: the path in that frame
    spiral: the path itself if it is a Spiral, which alone has a pitch, one centre and a fold; None on a route
    knots: s of the points that define the path, empty for other paths [m]
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
    def block(self) -> int: ...
    @property
    def frame(self) -> Frame: ...
    @property
    def standard(self) -> Self: ...
    @property
    def spiral(self) -> Self | None: ...
    @property
    def knots(self) -> Floats: ...

    def position(self, s: Floats | float) -> Floats:
        """Points at arc length s. s: (...) [m]; returns (..., 2) x, y [m]."""

    def tangent(self, s: Floats | float) -> Floats:
        """Unit tangents in the direction of travel. s: (...) [m]; returns (..., 2)."""

    def curvature(self, s: Floats | float) -> Floats:
        """Curvature, counter-clockwise positive. s: (...) [m]; returns (...) [1/m]."""

    def head(self, s: float) -> HeadState:
        """The head at arc length s [m]."""

    def handles(
        self, s: Floats, last: float, chords: Floats, head_speed: float, columns: Columns, budget: kernels.Budget
    ) -> int:
        """Fill in all handles in the own frame; returns the number of places before a fold.

        s: (T, 2) of the head, in double-double [m]; last: least polar angle of the head on a spiral [rad]
        chords: (n,) [m]
        columns: to fill: position (T, n + 1, 2) [m]; velocity (T, n + 1, 2), speed (T, n + 1) [m/s]
        budget: ends it before it is done; the caller looks at it afterwards
        """

    def lags(self, s: Floats, last: float) -> Floats:
        """Column LAG of the head's row in a chain, at arc lengths s (T,) [m]; last: as for handles()."""

    def follow(self, lag: float, last: int, sizes: Floats, chain: Floats) -> None:
        """Fill in a chain up to handle `last`, with the head at a lag."""

    def along(self, lags: Floats) -> Floats:
        """Arc lengths [m] of lags (...)."""

    def piece_at(self, row: Floats) -> int:
        """Number of the piece of a handle, from its row of a chain."""

    def calm(self, curvature: float) -> float:
        """Lag from which backwards handles are no faster than their leaders; FREE if there is none.

        curvature: largest curvature at which handles follow without moving backwards [1/m]
        """

    def gentle_lag(self, curvature: float) -> float:
        """Lag from which backwards no handle reverses, where the |curvature| is at most this [1/m]."""

    def sharpest_before(self, s: float) -> float:
        """Upper bound of the |curvature| under a dragon whose head is at s or before it [1/m]."""

    def tighter(self, radius: float) -> list[tuple[float, float, float]]:
        """Stretches that may bend more tightly than a radius [m]: their ends s [m] and largest |curvature| [1/m].

        None on a spiral, where a dance ends in a fold.
        """

    def last_lag(self, chord: float) -> float:
        """Lag of the front handle just before a lone bench folds; 0 if it never does. chord: [m]"""

    def rear_way(self, s: float, way: float, chord: float, last: float) -> float:
        """Upper bound of the way of a lone bench's rear handle while its front one goes a way from s [m].

        last: last_lag(chord); returns: FREE where no bound is known
        """

    def as_route(self, stop: float) -> Path:
        """The path in its own frame as a route, at least up to s = stop if it goes on so far [m]."""

    def drawn_between(self, low: float, high: float) -> Interval:
        """Ends s of a drawing that shows the places from low to high [m]."""

    def drawn_begin(self, points: Floats) -> float:
        """s at which a drawing of the path begins whose points are (N, 2) [m]."""

    def drawn(self, reached: Floats) -> Floats:
        """Points (N, 2) [m] for a picture; on a spiral as far out as the given points (..., 2)."""

    def summary(self) -> PathSummary:
        """The path by all that matters for a claim."""
