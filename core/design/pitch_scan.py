"""Radius of the head at first contact against the pitch: a staircase with jumps."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from core import plots
from core.checks import SIZE_MIN, checked_number, checked_size
from core.contact.fold import ended_at_fold
from core.contact.search import MARGIN_MAX, WORK_BUDGET, ContactSearch, SearchInput, before_fold
from core.dance import Dance, EndReason
from core.design.minimum_pitch import MinimumPitch, minimum_pitch
from core.display import format_range
from core.dragon import Dragon, chord_values
from core.errors import InvalidValue, TooMuchWork
from core.kernels import Budget, Ended, Halted
from core.language import counted, say
from core.paths.spiral import Spiral
from core.quantities import Given, Quantity, quantities
from core.questions import question_about, too_much
from core.tables import Column, Table
from core.values import Floats, Progress, unheard

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# A fall of the first-contact radius [m] between two pitches closer than JUMP_WIDTH [m] is a jump.
JUMP = 0.02
JUMP_WIDTH = 1e-6
# Half width of the bracket around a contact, and so of its radius [m of head travel]; a picture shows 1e-3 m.
RADIUS_WIDTH = 1e-8
# Largest work of all pitches together, see core/kernels/constants.py: about 5 s. The default scan takes about
# 2,000,000 [1].
SCAN_WORK = 4e7
# Smallest and largest pitch scanned, in units of the minimum pitch.
SCAN_FROM, SCAN_TO = 0.8, 1.35


@dataclass(frozen=True, slots=True, repr=False, eq=False)
class PitchScan(Table):
    """Head radius at first contact against pitch.

    pitch: samples, ascending; a pitch without contact has no entry [m]
    radius: distance of the head from the centre at first contact [m]
    pieces: stretches without a jump, as indices [from, to) into pitch and radius; between two of them the radius jumps,
        or there is no contact

    >>> scan = pitch_scan(Dragon(), [0.45, 0.5, 0.55], locate=False)
    >>> scan.radius.round(4).tolist()
    [4.5823, 3.232, 2.2887]
    """

    pitch: Floats
    radius: Floats
    pieces: tuple[tuple[int, int], ...]

    @property
    def jumps(self) -> tuple[tuple[int, int], ...]:
        """Indices of the last pitch before each jump and of the first one after it, at most JUMP_WIDTH apart."""
        starts = [start for start, _ in self.pieces[1:]]
        return tuple((k - 1, k) for k in starts if self.pitch[k] - self.pitch[k - 1] <= JUMP_WIDTH)

    def _line(self) -> str:
        if not self.pitch.size:
            return say("no contact at any pitch")
        return say(
            "{samples} at pitches of {pitches}, contact with the head at {radii}, in {pieces}",
            samples=counted(self.pitch.size, "{count} sample", "{count} samples"),
            pitches=format_range(self.pitch, "m"),
            radii=format_range(self.radius, "m"),
            pieces=counted(len(self.pieces), "{count} piece", "{count} pieces"),
        )

    def columns(self) -> dict[str, Column]:
        """One row for each pitch: pitch, radius [m], and the number of its piece."""
        piece = np.repeat(np.arange(len(self.pieces)), [end - start for start, end in self.pieces])
        return {"pitch": self.pitch, "radius": self.radius, "piece": piece}

    def plot(self, ax: Axes | None = None) -> Axes:
        """Plot the radius against the pitch: a staircase with dotted jumps.

        returns: the given axes, or those of a new figure, in metres
        raises: ImportError without matplotlib, naming the extra
        """
        axes = plots.wanted_axes(ax, "PitchScan.plot()")
        points = np.stack([self.pitch, self.radius], axis=-1)
        plots.draw_scan(axes, points, self.pieces, JUMP_WIDTH, say("first contact"))
        axes.set(xlabel=say("pitch [m]"), ylabel=say("radius of the head at first contact [m]"))
        axes.autoscale_view()
        axes.legend(fontsize=9)
        return axes


class Stops:
    """Radius of the head at first contact, for one dragon on many spirals.

    The search is that of first_contact(), with the same proof that it misses no contact. Its bracket is RADIUS_WIDTH
    instead of 1e-10 m; a radius changes by less than the travel, so its error is smaller still.
    """

    def __init__(self, dragon: Dragon, margin: float, budget: Budget | None = None) -> None:
        self.dragon, self.budget = dragon, budget or Budget()
        self.margin = checked_number("margin", margin, "m", 0.0, MARGIN_MAX)
        self.search: ContactSearch | None = None

    def radius(self, path: Spiral) -> float | None:
        """The radius [m], None if nothing touches. raises: InvalidValue as Dance

        Its error is at most RADIUS_WIDTH. Near a graze, where rounding hides the beginning of the contact, the bracket
        is wider (BRACKETS_GRAZING in core/contact/brackets.py). A search is undecided if a graze is too close to the
        margin; then the radius is that of the graze.
        """
        end = Dance(self.dragon, path).end
        if self.search is None:
            self.search = ContactSearch(SearchInput(self.dragon, path, self.margin), budget=self.budget)
        else:
            self.search.use(path, self.margin, WORK_BUDGET)
        search, to_fold = self.search, end.reason is EndReason.FOLD
        last = before_fold(end.time) if to_fold else end.time
        result = search.march(last, max(RADIUS_WIDTH, 2.0 * search.travel_rounding(last)))
        if result.ended is Ended.STUCK and not result.hidden:
            result = search.approach(0.0, last, 1.0)
        if to_fold:
            assert end.theta is not None
            result = ended_at_fold(search, result, last, end.theta)
        if result.ended is Ended.REACHED:
            return None
        travels = {Ended.TOUCHED: (result.touching or 0.0) - result.half, Ended.STUCK: result.proven}
        travel = travels.get(result.ended, 0.0)
        return search.growth * search.theta_at(travel)


@question_about("dragon", Dragon)
def pitch_scan(
    dragon: Dragon,
    pitches: Floats | Sequence[float],
    *,
    start_turns: float = 16.0,
    margin: float = 0.0,
    locate: bool = True,
    progress: Progress | None = None,
    budget: Budget | None = None,
) -> PitchScan:
    """First-contact radius at every pitch, and at more pitches where it falls by more than JUMP between two samples.

    Such an interval is halved until the fall is gone, which shows a continuous curve, or until it is narrower than
    JUMP_WIDTH, which shows a jump. A jump smaller than JUMP between two samples is not found.

    pitches: (N,) [m], ascending; progress: called with the finished share of the samples
    locate: False computes only the samples, many times faster; then a fall of more than JUMP between two of them
        separates two pieces
    budget: default: SCAN_WORK
    raises: TooMuchWork if the budget ends before the scan does; InvalidValue

    >>> pitch_scan(Dragon(), [0.45, 0.5, 0.55], locate=False).radius.round(4).tolist()
    [4.5823, 3.232, 2.2887]
    """
    pitches = _checked_pitches(pitches)
    stops = Stops(dragon, margin, (budget or Budget()).within(SCAN_WORK))

    def radius(pitch: float) -> float | None:
        try:
            stops.budget.afford()
            return stops.radius(Spiral(pitch, start_turns))
        except Halted as halted:
            raise _too_much(stops.budget, dragon, pitches, pitch) from halted

    known: dict[float, float | None] = {}
    jumps: list[float] = []
    for k, pitch in enumerate(pitches.tolist()):
        known[pitch] = radius(pitch)
        intervals = [(float(pitches[k - 1]), pitch)] if k else []
        while intervals:  # both halves, because there may be more than one jump between two pitches
            low, high = intervals.pop()
            before, after = known[low], known[high]
            if before is None or after is None or abs(before - after) <= JUMP:
                continue
            if high - low <= JUMP_WIDTH or not locate:
                jumps.append(high)
                continue
            middle = 0.5 * (low + high)
            known[middle] = radius(middle)
            intervals += [(low, middle), (middle, high)]
        (progress or unheard)((k + 1) / len(pitches))
    return _scan(known, jumps)


def _too_much(budget: Budget, dragon: Dragon, pitches: Floats, pitch: float) -> TooMuchWork:
    """The error if the budget ends before the scan does; pitch: the next one [m]."""
    why = "the first contacts from a pitch of {pitch} on were not found {then}"
    rule = f"must be fewer, or benches: {why}; the {{benches}} chords are {{shortest}} to {{longest}} long"
    return too_much(budget, "pitches", rule, len(pitches), pitch=Quantity(pitch, "m", 6), **chord_values(dragon))


def _checked_pitches(pitches: object) -> Floats:
    words = "must be a list of numbers in metres, ascending"
    try:
        column = np.asarray(pitches)
    except ValueError as error:
        raise InvalidValue("pitches", words) from error
    if column.dtype.kind not in "iuf" or column.ndim != 1:
        raise InvalidValue("pitches", words, got=Given(pitches))
    wrong = np.flatnonzero(np.diff(column) < 0.0)
    if wrong.size:
        k = int(wrong[0]) + 1
        rule, got = "must be at least {before}, the one before it", Quantity(float(column[k]), "m")
        raise InvalidValue(f"pitches.{k}", rule, got=got, before=Quantity(float(column[k - 1]), "m", 6))
    return np.array([checked_size(f"pitches.{k}", float(pitch)) for k, pitch in enumerate(column)])


def _scan(known: dict[float, float | None], jumps: list[float]) -> PitchScan:
    pitches = sorted(known)
    touching = [pitch for pitch in pitches if known[pitch] is not None]
    # A piece ends at a jump, and at a pitch without contact.
    breaks = jumps + [pitch for pitch in pitches if known[pitch] is None]
    cuts = np.unique([0, *np.searchsorted(touching, breaks), len(touching)]).tolist()
    return PitchScan(np.array(touching), np.array([known[pitch] for pitch in touching]), tuple(pairwise(cuts)))


def pitches_near(least: MinimumPitch, samples: int) -> Floats:
    """Evenly spaced pitches from SCAN_FROM to SCAN_TO times the minimum pitch [m]."""
    return np.linspace(SCAN_FROM * least.pitch, SCAN_TO * least.pitch, samples)


def scan_near_minimum(
    dragon: Dragon,
    *,
    turning_radius: float,
    start_turns: float,
    margin: float,
    samples: int,
    locate: bool = True,
    progress: Progress | None = None,
    budget: Budget | None = None,
) -> tuple[PitchScan, MinimumPitch]:
    """The scan at pitches_near() the minimum pitch and at its bracket, and that minimum.

    locate: as in pitch_scan(); budget: of both together; without one, each uses its default
    raises: InvalidValue and TooMuchWork as minimum_pitch() and pitch_scan()
    """
    least = minimum_pitch(dragon, turning_radius=turning_radius, start_turns=start_turns, margin=margin, budget=budget)
    if SCAN_FROM * least.pitch < SIZE_MIN:
        values = quantities("m", 6, pitch=SIZE_MIN / SCAN_FROM) | quantities("m", got=turning_radius)
        raise InvalidValue("turning_radius", "must allow pitches of {pitch} and more", **values)
    pitches = np.sort(np.append(pitches_near(least, samples), least.pitch_bracket))
    terms = {"start_turns": start_turns, "margin": margin}
    try:
        return pitch_scan(dragon, pitches, locate=locate, progress=progress, budget=budget, **terms), least
    except TooMuchWork as error:
        raise error.with_field("samples", samples) from error
