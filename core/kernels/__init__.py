"""The compiled loops, in Cython's pure-Python mode: the same files run uncompiled, slower, to the same digits.

Only loops live here; everything around them is NumPy. The .pxd beside each module gives the C types of functions, of
integer locals with which they calculate, and of names from other modules; `setup.py` writes those of constants and
records. The compiler infers the types of all other locals, and it refuses Python objects inside loops. `setup.py`
compiles all modules or none.

rates, speed and excess as one file, with types beside the code instead of in a .pxd, have the same digits and more
lines (714 for 699), and the highest speed of the default dance takes 1.15 times as long (measured 2026-11-27).

Bisections share halved() of fold.py. clear_radius(), Peak.refine(), crossing() and seek_rear() halve in loops of their
own, because their tests take more than two numbers and keep a state between the halvings: clear_radius() through
bisect() of core/sampling.py takes 3.8 us instead of 0.7 us (measured 2026-11-23).

Some functions take seven or eight parameters, because arrays go to them one by one. Scene and Interval, which hold
these arrays, import the modules up to hulls, which therefore cannot take them; and records are structs in C, which
cannot hold an array.

Angles are in radians, lengths on a spiral in units of its growth unless a name says otherwise; no function allocates.

constants    columns of the arrays, shared numbers        records        values with names that inner loops hand on
budget       limit of the work, and the flag to stop      results        what a march hands to its caller
fold         bisection; the end of a run                  spiral         arc length, next handle, trajectory
double_double  long arc lengths, to twice the digits of a double
rectangles   signed separation of two                     boxes          pairs that may touch
route        points and chain on a table of pieces        chain          of a spiral, and of either kind
clothoid     points on pieces whose curvature changes evenly
rounding     largest errors of all of these               scene          dragon, path, intervals of head travel
bounds       highest speeds of handles and benches        stretches      curvature of the path under a bench
corners      where tangents and speeds jump
hulls        benches as unions of hulls                   gap_curvature  the largest second derivative of a gap
faces        least gap of two unions of hulls             pairs          least gap of two benches
nearest      least gap of any two                         rings          benches too far out to touch
repeats      benches that repeat what others met          clearance      least gap at one instant
marching     to first contact                             band_march     all pitches between two at once
ensemble     several dragons in time                      rates          bounds on the speeds of handles
speed        the highest speed
excess       first time beyond a speed limit              wobble         contacts when people wobble
fills        rectangles in the bytes of a picture
follower     a bench on bends of any radius: no jump, no step back
turn_refusal  boxes of turns that cannot be danced
"""

from core.kernels.band_march import BandMarch
from core.kernels.boxes import BOXES_PER_LEAF, Meetings, grow_tree
from core.kernels.budget import Budget, Halted
from core.kernels.chain import (
    Curve,
    chain_rounding,
    extend_chain,
    head_theta,
    place_chain,
    route_curve,
    route_trajectory,
    spiral_curve,
    start_chain,
)
from core.kernels.clearance import bottom_between, clearance_at, clearance_left, gap_at, gap_rate_at, meet
from core.kernels.clothoid import clothoid_joints
from core.kernels.constants import *
from core.kernels.double_double import coil_arc, coil_theta, growth_pair, spiral_thetas
from core.kernels.ensemble import BENCHES_PER_BLOCK, Ensemble, Member
from core.kernels.excess import Excess
from core.kernels.fills import fill_rectangles
from core.kernels.fold import first_crest, first_root, fold_theta, previous_theta
from core.kernels.follower import Follower
from core.kernels.gap_curvature import axis_curvature, pair_curvatures, shift_curvature
from core.kernels.hulls import Kinds, hulls_near, largest_supports
from core.kernels.marching import March
from core.kernels.pairs import pair_least, pair_most, pair_rounding
from core.kernels.rates import climbs, spiral_errors
from core.kernels.rectangles import Witnesses, bench_separation, pair_gaps, pair_separations
from core.kernels.rings import (
    Rings,
    clear_radius,
    leaders_reach,
    radius_beyond,
    ring_clears,
    ring_least,
    ring_rounding,
    spirals_least,
)
from core.kernels.rounding import joint_misses, piece_slides
from core.kernels.route import cubic_arcs, route_points
from core.kernels.scene import Interval, Scene
from core.kernels.speed import Peak
from core.kernels.spiral import (
    COMPILED,
    LANES_PER_BLOCK,
    spiral_arc,
    spiral_curvature,
    spiral_theta,
    spiral_trajectory,
)
from core.kernels.stretches import steepest_curvature
from core.kernels.turn_refusal import TurnBox, refuse_turns
from core.kernels.wobble import Wobbler
