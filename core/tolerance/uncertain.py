"""How far people may stray where the benches and the spiral are known only to within an error.

Errors of chords add up along the chain: after a turn nobody knows any more which bench stands beside which. So the
bound must hold whatever the phase of a turn against the next one. The ring bound does (core/kernels/rings.py): it asks
how long and how short chords can be, not where they begin, and it holds for a range of growths. With L its value for
all chords l within the error of theirs, two benches that share no handle are L apart at least while the head is
outside the circle, each in its place.

No point of a bench moves further than A stray, A its gain (core/tolerance/reach.py), which falls as its chord grows.
Two benches cannot touch while 2 A stray < L, A the largest of all.
"""

from __future__ import annotations

import math

from core import kernels
from core.contact.search import Search
from core.dragon import Dragon
from core.paths.spiral import Spiral
from core.tolerance.reach import gain
from core.values import asked_of, checked_number, checked_size

# Taken off the bound, for the rounding of A and of chords [1].
ROUNDING = 1e-12


@asked_of("dragon", Dragon)
def uncertain_tolerance(
    dragon: Dragon,
    pitch: float,
    *,
    length_error: float = 0.0,
    pitch_error: float = 0.0,
    turning_radius: float = 4.5,
) -> float:
    """How far people may stray until the head is on the turning circle, whatever the errors of sizes are [m].

    length_error: the chord of every bench is within it of that of the dragon [m], its overhangs and width are as given;
        pitch_error: the pitch of the whole spiral is within it of the pitch given [m]; turning_radius: [m]
    returns: proven safe, less than tolerance() knows for sizes without errors; 0 where the bound proves nothing
    raises: InvalidValue

    >>> round(uncertain_tolerance(Dragon(), 0.7, length_error=0.01, pitch_error=0.005), 4)
    0.0765
    """
    radius, spiral = checked_size("turning_radius", turning_radius), Spiral(pitch)
    shortest = float(dragon.chords.min())
    error = checked_number("length_error", length_error, "m", 0.0, 0.5 * shortest)
    spread = checked_number("pitch_error", pitch_error, "m", 0.0, 0.5 * spiral.pitch)
    longer = Dragon.of(dragon.lengths + error, dragon.widths, dragon.overhangs)
    search = Search(longer, spiral, 0.0)
    search.rings.between_shortest -= 2.0 * error
    low, high = ((spiral.pitch + off) / (2.0 * math.pi) for off in (-spread, spread))
    least = float(kernels.ring_least(low, high, radius, search.rings)) - search.ring_rounding(radius, high)
    most = float(gain(dragon.chords - error, dragon.overhangs, 0.5 * dragon.widths).max())
    stray = (1.0 - ROUNDING) * least / (2.0 * most)
    return min(max(stray, 0.0), 0.5 * (shortest - error))
