"""Stray that is safe, as a function of the pitch of the spiral. The inverse is minimum_pitch(dragon, stray=...)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from core import plots
from core.checks import checked_size
from core.dance import Dance
from core.display import format_range
from core.dragon import Dragon
from core.errors import InvalidValue, TooMuchWork
from core.kernels import Budget
from core.language import say
from core.paths.spiral import Spiral
from core.quantities import Given, Quantity
from core.questions import question_about, too_much
from core.tables import Column, Table
from core.tolerance.tolerance import Tolerance, tolerance
from core.values import Floats, Progress, unheard

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# Largest number of pitches of a curve, each of which is a question of its own [1].
CURVE_MOST = 10_000


@dataclass(frozen=True, slots=True, repr=False, eq=False)
class ToleranceCurve(Table):
    """Stray that is safe at each of some pitches of a spiral, on the way to a turning circle.

    pitch: pitches, (N,), as given [m]
    stray: proven safe: while no hole is further from its place, nothing touches, (N,) [m]
    tolerances: the whole answers

    >>> tolerance_curve(Dragon(), [0.5, 0.55]).stray.round(4).tolist()
    [0.0232, 0.0466]
    """

    pitch: Floats
    stray: Floats
    tolerances: tuple[Tolerance, ...]

    def _line(self) -> str:
        strays, pitches = format_range(self.stray, "m"), format_range(self.pitch, "m")
        return say("strays of {strays} at pitches of {pitches}", strays=strays, pitches=pitches)

    def columns(self) -> dict[str, Column]:
        """One row for each pitch: pitch, stray [m], limited_by."""
        limits = np.array([one.limited_by.value for one in self.tolerances])
        return {"pitch": self.pitch, "stray": self.stray, "limited_by": limits}

    def plot(self, ax: Axes | None = None) -> Axes:
        """Plot the stray against the pitch.

        returns: the axes given, or those of a new figure, in metres
        raises: ImportError without matplotlib, naming the extra
        """
        axes = plots.wanted_axes(ax, "ToleranceCurve.plot()")
        axes.plot(self.pitch, self.stray, linewidth=1.2)
        axes.set(xlabel=say("pitch [m]"), ylabel=say("how far people may stray [m]"))
        axes.set_ylim(bottom=0.0)
        axes.grid(alpha=0.3)
        return axes


@question_about("dragon", Dragon)
def tolerance_curve(
    dragon: Dragon,
    pitches: Floats | Sequence[float],
    *,
    turning_radius: float = 4.5,
    start_turns: float = 16.0,
    progress: Progress | None = None,
    budget: Budget | None = None,
) -> ToleranceCurve:
    """Stray that is safe at each of some pitches, from the start until the head is on the turning circle.

    pitches: (N,) [m]; turning_radius: [m]; start_turns: turns from the centre to the start
    progress: called with the share of the pitches that is done
    The inverse, the smallest pitch for a stray, is minimum_pitch(dragon, stray=...).
    raises: InvalidValue, also for a pitch at which the dance begins inside the circle or folds before it; TooMuchWork

    >>> tolerance_curve(Dragon(), [0.5, 0.55]).tolerances[1].benches
    (0, 19)
    """
    radius = checked_size("turning_radius", turning_radius)
    rule = "must be a list of 1 to {most} numbers in metres"
    try:
        column = np.asarray(pitches, dtype=np.float64)
    except (TypeError, ValueError, OverflowError) as error:
        raise InvalidValue("pitches", rule, got=Given(pitches), most=CURVE_MOST) from error
    if column.ndim != 1 or not 1 <= column.size <= CURVE_MOST:
        raise InvalidValue("pitches", rule, got=f"an array of shape {column.shape}", most=CURVE_MOST)
    answers = []
    for k, pitch in enumerate(column.tolist()):
        dance = Dance(dragon, Spiral(pitch, start_turns))
        try:
            answers.append(tolerance(dance, stop=time_on_circle(dance, radius), budget=budget))
        except TooMuchWork:
            if k == 0 or budget is None:
                raise
            rule = "must be fewer: the tolerance was found for only {found} pitches {then}"
            raise too_much(budget, "pitches", rule, column.size, found=k) from None
        (progress or unheard)((k + 1) / column.size)
    return ToleranceCurve(column, np.array([one.stray for one in answers]), tuple(answers))


def time_on_circle(dance: Dance, radius: float) -> float:
    """Time at which the head of a dance on a spiral is on a circle around the centre [s].

    raises: InvalidValue (turning_radius) for a circle that the dance starts on or inside, or does not reach
    """
    spiral = dance.path.spiral
    assert spiral is not None
    first = spiral.pitch * spiral.start_turns
    if radius >= first:
        rule = "must be smaller: at a pitch of {pitch} the dance starts on that circle"
        if radius > first:
            rule = "must be smaller: at a pitch of {pitch} the dance starts inside that circle"
        raise InvalidValue("turning_radius", rule, got=Quantity(radius, "m"), pitch=Quantity(spiral.pitch, "m"))
    time = dance.clock.time(spiral.travel_to(radius))
    if time > dance.end.time:
        rule = "must be larger: the head is at the centre at {end}, before the head is on that circle"
        if dance.end.bench is not None:
            rule = "must be larger: bench {bench} folds at {end}, before the head is on that circle"
        values = {"got": Quantity(radius, "m"), "end": Quantity(round(dance.end.time, 6), "s"), **dance.end.values}
        raise InvalidValue("turning_radius", rule, **values)
    return time
