"""A scene, which is a dragon on a path; an interval of head travel in it; and the results of proven steps."""

import cython
from cython.cimports.libc.math import cos, fabs, sin

import core.kernels.constants as of_python  # only for results: compiled enums are plain numbers
from core.kernels.results import Marched

if not cython.compiled:  # the .pxd imports the same names for the compiler
    from core.kernels.bounds import motion_bounds, route_bounds
    from core.kernels.budget import Budget
    from core.kernels.chain import chain_rounding, place_chain
    from core.kernels.constants import *
    from core.kernels.hulls import Kinds
    from core.kernels.rectangles import Witnesses


# Largest error of a turned vector, as a part of the sum of its coordinates [1].
TURNED_ROUNDING = 6.0 * ULP
# The same of a vector turned for a copy of the dragon [1].
COPIED = 32.0 * ULP
# Part by which the width of an interval is widened, for the rounding of numbers that a step computes only once [1].
WIDTH_ROUNDING = 1e-12


class Scene:
    """A dragon on a path, and the obstacles of its benches.

    curve: the path; place: of the head at travel 0, see chain.py [m]; rings: extremes of the benches, and bounds
    sizes: (room + 1 + edges, SIZE_COLUMNS), a row for every bench, an empty one, then a row for every edge at rest;
        chains have the same rows
    benches: number in the dragon; room: number of these that have a row
    edges: number of edges at rest; where there are any, benches meet these alone, else each other
    walls: centres [m] and directions of these in the own frame of the path, (edges, FRAME_COLUMNS); wall_error: largest
        error of a centre [m]
    budget: ends the loops before they are done
    kinds: the hulls of benches that are not rectangles; sizes then hold the rectangles around them
    margin: the clearance required [m]; left_out, left_out_too: a pair of benches that does not count, or NO_BENCH
    between: least number of benches between the two of a pair that counts, 1 at least
    copies: dragons in all; 1: benches meet those of their own dragon, see lay_copies()
    """

    def __init__(self, curve, place, rings, sizes, benches, edges):
        self.curve = curve
        self.wall_error = 0.0
        self.kinds = Kinds()
        self.place = place
        self.rings = rings
        self.sizes = sizes
        self.benches = benches
        self.edges = edges
        self.room = min(benches, sizes.shape[0] - 1 - edges)
        self.margin = 0.0
        self.left_out = self.left_out_too = NO_BENCH
        self.between = 1
        self.budget = Budget()
        self.met = Witnesses()
        self.copies = 1
        self.stride = sizes.shape[0]

    # Copies. Copy k is the dragon turned by 2 pi k / copies about the spiral's centre. Its rows follow those of the
    # dragon itself, k times `stride` further on. What a turn leaves as it is is equal: lengths, radii, speeds and their
    # bounds. The angle is good to 16 u, its sin and cos to 2 u more, and each coordinate is the sum of two products: to
    # (16 + 4) u (|x| + |y|). COPIED exceeds both coordinates' errors together.
    def lay_copies(self, turns):
        """Let benches meet those of copies of the dragon, and none of its own.

        turns: (copies, 2) cos and sin of their angles, the dragon itself first; sizes then has that many times the rows
        """
        self.turns = turns
        self.copies = turns.shape[0]
        self.stride = self.sizes.shape[0] // self.copies
        self.room = min(self.benches, self.stride - 1)

    def copy_chain(self, last, chain):
        """Fill in the copies of a chain up to handle `last`, with their errors."""
        for k in range(1, self.copies):
            c = self.turns[k, X]
            s = self.turns[k, Y]
            for i in range(last + 1):
                row = k * self.stride + i
                chain[row, RATE] = chain[i, RATE]
                chain[row, TX] = c * chain[i, TX] - s * chain[i, TY]
                chain[row, TY] = s * chain[i, TX] + c * chain[i, TY]
                if i < last:
                    chain[row, MX] = c * chain[i, MX] - s * chain[i, MY]
                    chain[row, MY] = s * chain[i, MX] + c * chain[i, MY]
                    chain[row, UX] = c * chain[i, UX] - s * chain[i, UY]
                    chain[row, UY] = s * chain[i, UX] + c * chain[i, UY]
                    chain[row, ERROR] = chain[i, ERROR] + COPIED * (fabs(chain[i, MX]) + fabs(chain[i, MY]))
                    chain[row, SWAY] = chain[i, SWAY] + COPIED * (fabs(chain[i, UX]) + fabs(chain[i, UY]))

    def copy_bounds(self, last, rows):
        """Fill in the copies of bounds on the motion of the first handles."""
        for k in range(1, self.copies):
            for i in range(last + 1):
                rows[k * self.stride + i] = rows[i]

    def lay_walls(self, walls):
        """Set the edges at rest."""
        self.walls = walls
        for e in range(self.edges):
            error = TURNED_ROUNDING * (fabs(walls[e, FRAME_X]) + fabs(walls[e, FRAME_Y]))
            self.wall_error = max(self.wall_error, error)

    # The frame of a chain on a spiral has its head at polar angle 0, and turns with it by exactly the head's double
    # theta (rounding.py). So an edge at rest turns back by theta there. sin and cos are good to 2 u of themselves, and
    # each coordinate is the sum of two products: |x| and |y| together times 4 u. On a route the frame is at rest.
    def turn_edges(self, chain):
        """Fill in the edges at rest in a chain on a spiral whose head is placed, with their errors."""
        if self.edges == 0 or not self.curve.is_spiral:
            return
        c = cos(chain[0, THETA])
        s = sin(chain[0, THETA])
        for e in range(self.edges):
            x = self.walls[e, FRAME_X]
            y = self.walls[e, FRAME_Y]
            ux = self.walls[e, FRAME_UX]
            uy = self.walls[e, FRAME_UY]
            j = self.room + 1 + e
            chain[j, MX] = x * c + y * s
            chain[j, MY] = y * c - x * s
            chain[j, UX] = ux * c + uy * s
            chain[j, UY] = uy * c - ux * s
            chain[j, ERROR] = TURNED_ROUNDING * (fabs(x) + fabs(y))
            chain[j, SWAY] = TURNED_ROUNDING * (fabs(ux) + fabs(uy))


class Interval:
    """An interval of head travel: the chains at both of its ends, and bounds on the motion between them.

    before, after: rows of handles, (room + 1 + edges, CHAIN_COLUMNS); motion: (the same, MOTION_COLUMNS)
    h: upper bound of the head's travel [m]; handles: the last handle that both chains have
    """

    def __init__(self, scene, before, after, motion):
        self.scene = scene
        self.before = before
        self.after = after
        self.motion = motion
        self.h = 0.0
        self.handles = 0

    def swap(self):
        """Continue at the end of this interval."""
        self.before, self.after = self.after, self.before

    def widen(self, h, rounding):
        """Set the upper bound of the head's travel: the way computed plus the errors of both ends [m]."""
        self.h = h * (1.0 + WIDTH_ROUNDING) + 2.0 * rounding

    def round(self):
        """Fill in the largest errors of both chains."""
        chain_rounding(self.scene.curve, self.handles, self.scene.sizes, self.before)
        chain_rounding(self.scene.curve, self.handles, self.scene.sizes, self.after)

    def copy(self):
        """Fill in the copies of both chains and of the bounds on their motion."""
        if self.scene.copies > 1:
            self.scene.copy_chain(self.handles, self.before)
            self.scene.copy_chain(self.handles, self.after)
            self.scene.copy_bounds(self.handles, self.motion)

    def bound(self, climbing):
        """Bound the motion; False where no bound is known. climbing: see route_bounds(), which alone uses it."""
        if self.scene.curve.is_spiral:
            return motion_bounds(
                self.scene.curve.growth, self.h, self.handles, self.scene.sizes, self.before, self.after, self.motion
            )
        self.round()
        return route_bounds(
            self.scene.curve.pieces, self.h, self.handles, self.scene.sizes, self.before, self.after, climbing,
            self.motion,
        )  # fmt: skip

    def lay_out(self, place, h, last):
        """Lay out the chains up to handle `last` with the head at a place and h further on, and bound the motion.

        returns: False where no bound is known
        """
        self.h = h
        self.handles = last
        if place_chain(self.scene.curve, place, last, self.scene.sizes, self.before) == FOLDED:
            return False
        if place_chain(self.scene.curve, place - h, last, self.scene.sizes, self.after) == FOLDED:
            return False
        self.scene.turn_edges(self.before)
        self.scene.turn_edges(self.after)
        self.round()
        bounded = self.bound(False)
        self.copy()
        return bounded


class MarchState:
    """Progress of proven steps.

    ended: how they ended; meets: whether a pair of benches comes within the margin; first, second: that pair
    work: spent so far
    proven, touching, steps: see Marched in results.py
    """

    def __init__(self):
        self.ended = Ended.REACHED
        self.proven = self.touching = self.work = 0.0
        self.meets = False
        self.first = self.second = self.steps = 0

    def begin(self, start):
        """Discard earlier results; the way begins here [m]."""
        self.proven = start
        self.meets = False
        self.steps = 0
        self.work = 0.0

    def meet(self, touching):
        """Record that the pair `first`, `second` is within the margin here [m]."""
        self.meets = True
        self.touching = touching

    def end(self, ended):
        """Note how the steps end."""
        self.ended = ended
        return Step.ENDED

    def result(self, curvature=0.0, graze=None):
        """What the steps found, see Marched in results.py."""
        ended, touching = of_python.Ended(self.ended), float(self.touching) if self.meets else None
        spent = self.steps, float(self.work), float(curvature)
        return Marched(ended, float(self.proven), touching, (self.first, self.second), 0.0, *spent, graze)


class Band:
    """A band of growths over a step of head radii: its interval at the lowest and at the highest growth.

    low, high: this interval at either growth; shifts: (room + 1, SHIFT_COLUMNS) bounds on the shift of benches with the
        growth
    width: upper bound of the difference of the growths [m/rad]; slack: errors of the travels at its corners [m]
    """

    def __init__(self, low, high, shifts):
        self.low = low
        self.high = high
        self.shifts = shifts
        self.width = self.slack = 0.0

    def copy(self):
        """Fill in the copies of all four chains and of all bounds."""
        if self.low.scene.copies > 1:
            self.low.copy()
            self.high.copy()
            self.low.scene.copy_bounds(self.low.handles, self.shifts)
