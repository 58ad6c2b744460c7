"""Ways from the start of a spiral to the turning circle, and the pitches at which they are free of contact."""

from __future__ import annotations

import math

from core import kernels
from core.checks import SIZE_MIN
from core.contact.fold import THETA_ROUNDING, ended_at_fold
from core.contact.search import ContactSearch, SearchInput, before_fold
from core.design.pitch_bands import Bands
from core.dragon import Dragon
from core.errors import TooMuchWork
from core.kernels import NO_BRACKET, Budget, Ended
from core.kernels.results import Marched
from core.paths.spiral import Spiral, end_theta
from core.quantities import Quantity, quantities
from core.questions import too_much

# Half width of the bracket around a contact [m of head travel].
CONTACT_WIDTH = 2e-11
# Largest work of all ways and bands together [1], see core/kernels/constants.py: about 5 s. The default case takes
# about 150,000.
PITCH_WORK = 4e7
# Largest work of one way, and of its second march in finer steps if the first one leaves it undecided [1].
WAY_WORK = 5e6
FINER_WORK = 1e6
# A way that ends nearer to a fold than this, where handles are fast, is marched in finer steps [m of head travel].
FINE_NEAR_FOLD = 0.1
# The bound for wide spirals is used if the march can then begin at this part, or less, of the radius of the ring bound;
# radii are tried in steps of this factor [1].
NEARER = 0.8
# Number of leading benches whose pairs are examined at both ends of a way before it is marched.
LOOKED_AT = 2


class Ways:
    """The ways of one dragon from the start to the circle, one for each pitch.

    dragons: with several, each turned by a part of a turn, only benches of different dragons count
    lowest: the pitch whose way begins on the circle, or SIZE_MIN [m]; marched: number of marched ways; tried: the pitch
        of the last way [m]; bands: proofs for whole intervals of pitches
    """

    def __init__(
        self,
        dragon: Dragon,
        radius: float,
        start_turns: float,
        margin: float,
        stray: float,
        budget: Budget | None,
        dragons: int = 1,
    ) -> None:
        self.radius, self.start_turns, self.margin = radius, start_turns, margin
        self.lowest = max(radius / start_turns, SIZE_MIN)
        path, budget = Spiral(self.lowest, start_turns), (budget or Budget()).within(PITCH_WORK)
        sought = SearchInput(dragon, path, margin, copies=dragons, stray=stray)
        self.search = ContactSearch(sought, work=WAY_WORK, budget=budget)
        self.bands = Bands(self.search, radius, start_turns, margin)
        self.marched, self.tried = 0, self.lowest

    def march(self, pitch: float, width: float = NO_BRACKET, work: float = WAY_WORK) -> Marched:
        """March from the start to the circle; REACHED proves that every clearance on the way exceeds the margin.

        width: half width of the bracket around a contact [m of travel]; NO_BRACKET: any instant of it is enough
        work: largest work of this march
        raises: Halted if the budget of all ways and bands together is spent or stopped
        """
        search, self.tried = self.search, pitch
        search.budget.afford()
        path = Spiral(pitch, self.start_turns)
        search.use(path, self.margin, work)
        self.marched += 1
        self._start_nearer(path)
        circle = self.radius / path.growth
        stop = max(search.travel_at(circle), 0.0)
        if width != NO_BRACKET:
            width = max(width, 2.0 * search.travel_rounding(0.0, stop))
        fold, bench = (0.0, None) if self.bands.curved_little else end_theta(search.dragon, path)
        if fold > circle * (1.0 - THETA_ROUNDING):
            return Marched(Ended.BENCH_FOLDED if fold > circle * (1.0 + THETA_ROUNDING) else Ended.STUCK, 0.0)
        for ended, travel in () if width != NO_BRACKET else ((Ended.TOUCHED_AT_START, 0.0), (Ended.TOUCHED, stop)):
            # Most ways with a contact show it at one of their ends, which needs no long dragon.
            gap, pair = search.clearance(travel, min(LOOKED_AT, search.room))
            if gap <= self.margin and search.surely_within(travel, pair):
                return Marched(ended, 0.0, travel, pair)
        if bench is None or search.copies > 1 or search.travel_at(fold) - stop > FINE_NEAR_FOLD:
            return search.march(stop, width)
        last = min(stop, before_fold(search.travel_at(fold)))
        result = search.march(last, CONTACT_WIDTH if width == NO_BRACKET else width)
        passed = result.ended is Ended.REACHED and last == stop
        return result if passed else ended_at_fold(search, result, last, fold)

    def is_clear(self, pitch: float) -> bool | None:
        """True if the whole way is free of contact; None if rounding of a graze hides it."""
        for width, work in ((NO_BRACKET, WAY_WORK), (CONTACT_WIDTH, FINER_WORK)):
            result = self.march(pitch, width, work)
            if not result.hidden:
                return result.ended is Ended.REACHED
        return None

    def grazes(self, pitch: float) -> bool:
        """True if the pair whose graze ended the bands is within the margin in the followed part of its dip."""
        if not self.bands.graze:
            return False
        pair, radius = self.bands.graze
        gap, radius = self.bands.dip(pitch, radius, pair)
        if gap > self.margin or radius > pitch * self.start_turns:
            return False
        return self.search.surely_within(self.search.travel_at(radius / self.search.growth), pair)

    def still_touches(self, pitch: float, radius: float, a: int, b: int) -> bool:
        """True if benches a and b are within the margin at this pitch too, with the head at this radius on the way;
        False if that radius is not on the way."""
        growth, search = pitch / (2.0 * math.pi), self.search
        search.budget.look()
        if radius > pitch * self.start_turns:
            return False
        place, curve = growth * kernels.spiral_arc(radius / growth), kernels.spiral_curve(growth)
        scene = kernels.Scene(curve, place, search.rings, search.sizes, search.dragon.benches, 0)
        scene.kinds = search.kinds
        search.copy(scene)
        return float(kernels.gap_at(scene, place, a, b, search.placed)) <= self.margin

    def _start_nearer(self, path: Spiral) -> None:
        """Begin the march at the radius beyond which the bound for wide spirals excludes a contact.

        It is used only if that is at most NEARER of the radius of the ring bound: for short benches on wide spirals.
        """
        search, clears = self.search, self.bands.straight.clears
        radius = min(search.clear_radius, path.growth * path.start_theta)
        if NEARER * radius <= self.radius or not clears(path.growth, NEARER * radius, self.margin):
            return
        while radius > self.radius and clears(path.growth, NEARER * radius, self.margin):
            radius *= NEARER
        search.clear_beyond(max(radius, self.radius))

    def too_much(self) -> TooMuchWork:
        """The error if the budget ends before the pitch is found."""
        dragon = self.search.dragon
        k = int(dragon.chords[: dragon.uniform_from + 1].argmin())
        field = f"dragon.lengths.{k}"
        if all((column[1:] == column[1:2]).all() for column in (dragon.lengths, dragon.widths, dragon.overhangs)):
            field = "dragon.head_length" if k == 0 and dragon.uniform_from else "dragon.body_length"
        rule = (
            "must be larger, or benches fewer: the minimum pitch was not found {then}; the shortest of {benches} "
            "chords is {chord} long, the turning circle {diameter} across, and the last pitch tried was {pitch}"
        )
        sizes = quantities("m", 6, chord=dragon.chords[k], diameter=2.0 * self.radius, pitch=self.tried)
        values, got = {"benches": dragon.benches, **sizes}, Quantity(float(dragon.lengths[k]), "m")
        return too_much(self.search.budget, field, rule, got, **values)
