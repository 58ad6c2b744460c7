"""Where the head stands at first contact against the pitch: a staircase with jumps."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from core import plots
from core.contact.first_contact import Outcome, first_contact
from core.dance import Dance
from core.design.minimum_pitch import MinimumPitch, minimum_pitch
from core.dragon import Dragon
from core.errors import InvalidValue
from core.motion.trajectory import trajectory
from core.paths.spiral import Spiral
from core.shown import Shown, counted, extent
from core.tables import data_frame
from core.values import SIZE_MIN, Floats, checked_size, checked_type

if TYPE_CHECKING:
    import pandas
    from matplotlib.axes import Axes

# A fall of the first-contact radius [m] between two pitches closer than JUMP_WIDTH [m] is a jump.
JUMP = 0.02
JUMP_WIDTH = 1e-6
# The scanned pitches, in minimum pitches.
SCAN_FROM, SCAN_TO = 0.8, 1.35


@dataclass(frozen=True, slots=True, repr=False)
class PitchScan(Shown):
    """Head radius at first contact against pitch.

    pitch, radius: (N,) [m], ascending; a run without contact has no entry
    pieces: (start, end) indices of the continuous stretches: the radius jumps between two, or there is no contact
    """

    pitch: Floats
    radius: Floats
    pieces: tuple[tuple[int, int], ...]

    def _line(self) -> str:
        if not self.pitch.size:
            return "no contact at any pitch"
        radius = f"contact with the head at {extent(self.radius, 'm')}"
        pieces = counted(len(self.pieces), "piece")
        return f"{self.pitch.size} pitches from {extent(self.pitch, 'm')}, {radius}, in {pieces}"

    def to_dataframe(self) -> pandas.DataFrame:
        """One row for each pitch: pitch, radius [m], and the number of its piece.

        raises: ImportError without pandas, naming the extra
        """
        piece = np.repeat(np.arange(len(self.pieces)), [end - start for start, end in self.pieces])
        columns = {"pitch": self.pitch, "radius": self.radius, "piece": piece}
        return data_frame("PitchScan.to_dataframe()", columns, {})

    def plot(self, ax: Axes | None = None) -> Axes:
        """The radius against the pitch: a staircase, its jumps dotted.

        returns: the axes given, or those of a new figure, in metres
        raises: ImportError without matplotlib, naming the extra
        """
        axes = plots.wanted_axes(ax, "PitchScan.plot()")
        points = np.stack([self.pitch, self.radius], axis=-1)
        plots.draw_scan(axes, points, self.pieces, JUMP_WIDTH, "first contact")
        axes.set(xlabel="pitch [m]", ylabel="radius of the head at first contact [m]")
        axes.autoscale_view()
        axes.legend(fontsize=9)
        return axes


def stop_radius(dragon: Dragon, path: Spiral, *, margin: float = 0.0) -> float | None:
    """Where the head stands at first contact [m]; None when nothing touches.

    A search that ends undecided has met a graze too close to the margin to tell: then, where it met it.
    """
    found = first_contact(Dance(dragon, path), margin=margin)
    if found.outcome is Outcome.CLEAR:
        return None
    if found.head is not None:
        return found.head.radius
    time = found.time_bracket[0] if found.time_bracket else 0.0
    return float(np.hypot(*trajectory(Dance(Dragon(benches=1), path), [time]).position[0, 0]))


def pitch_scan(
    dragon: Dragon,
    pitches: Floats | Sequence[float],
    *,
    start_turns: float = 16.0,
    margin: float = 0.0,
    progress: Callable[[float], None] = lambda share: None,
) -> PitchScan:
    """First-contact radius at every pitch, and between samples wherever it falls by more than JUMP.

    Such an interval is halved until the fall is gone, then the curve is continuous there, or until it is narrower
    than JUMP_WIDTH, then it is a jump. A jump smaller than JUMP between two samples is not found.

    pitches: (N,) [m], ascending; progress: called with the share of the samples that is done
    raises: InvalidValue
    """
    checked_type("dragon", dragon, Dragon)
    pitches = _checked_pitches(pitches)

    def radius(pitch: float) -> float | None:
        return stop_radius(dragon, Spiral(pitch, start_turns), margin=margin)

    known: dict[float, float | None] = {}
    jumps: list[float] = []
    for k, pitch in enumerate(pitches.tolist()):
        known[pitch] = radius(pitch)
        intervals = [(float(pitches[k - 1]), pitch)] if k else []
        while intervals:
            low, high = intervals.pop()
            before, after = known[low], known[high]
            if before is None or after is None or abs(before - after) <= JUMP:
                continue
            if high - low <= JUMP_WIDTH:
                jumps.append(high)
                continue
            middle = 0.5 * (low + high)
            known[middle] = radius(middle)
            intervals += [(low, middle), (middle, high)]
        progress((k + 1) / len(pitches))
    return _scan(known, jumps)


def _checked_pitches(pitches: object) -> Floats:
    words = "pitches must be a list of numbers in metres, ascending"
    try:
        column = np.asarray(pitches)
    except ValueError as error:
        raise InvalidValue("pitches", words) from error
    if column.dtype.kind not in "iuf" or column.ndim != 1:
        raise InvalidValue("pitches", f"{words}, got {pitches!r:.60}")
    wrong = np.flatnonzero(~(np.diff(column) >= 0.0))
    if wrong.size:
        k = int(wrong[0]) + 1
        rule = f"must be at least {column[k - 1]:g} m, the one before it"
        raise InvalidValue.of(f"pitches.{k}", rule, float(column[k]), "m")
    return np.array([checked_size(f"pitches.{k}", float(pitch)) for k, pitch in enumerate(column)])


def _scan(known: dict[float, float | None], jumps: list[float]) -> PitchScan:
    pitches = sorted(known)
    found = [pitch for pitch in pitches if known[pitch] is not None]
    # A stretch ends at a jump and at a pitch without contact.
    breaks = jumps + [pitch for pitch in pitches if known[pitch] is None]
    cuts = np.unique([0, *np.searchsorted(found, breaks), len(found)]).tolist()
    return PitchScan(np.array(found), np.array([known[pitch] for pitch in found]), tuple(pairwise(cuts)))


def scan_near_minimum(
    dragon: Dragon,
    *,
    turning_radius: float,
    start_turns: float,
    margin: float,
    samples: int,
    progress: Callable[[float], None] = lambda share: None,
) -> tuple[PitchScan, MinimumPitch]:
    """The scan from SCAN_FROM to SCAN_TO times the minimum pitch at so many samples, and that minimum.

    raises: InvalidValue as minimum_pitch()
    """
    least = minimum_pitch(dragon, turning_radius=turning_radius, start_turns=start_turns, margin=margin)
    if SCAN_FROM * least.pitch < SIZE_MIN:
        rule = f"must allow pitches of {SIZE_MIN / SCAN_FROM:g} m and more"
        raise InvalidValue.of("turning_radius", rule, turning_radius, "m")
    pitches = np.linspace(SCAN_FROM * least.pitch, SCAN_TO * least.pitch, samples)
    pitches = np.sort(np.append(pitches, least.pitch_bracket))
    return pitch_scan(dragon, pitches, start_turns=start_turns, margin=margin, progress=progress), least
