"""Types of the compiled loops, for type checkers."""

from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from core.kernels.constants import *
from core.kernels.results import Marched

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Flags = NDArray[np.int8]

COMPILED: Final[bool]
LANES_PER_BLOCK: Final[int]
BOXES_PER_LEAF: Final[int]
BENCHES_PER_BLOCK: Final[int]

# -- budget --

class Budget:
    left: float
    work: float
    stopped: bool
    brief: bool
    limited: bool
    part: Budget | None
    then: Any
    def __init__(self, work: float | None = None, *, brief: bool = False) -> None: ...
    def within(self, work: float) -> Budget: ...
    def stop(self, then: object = "before it was stopped") -> None: ...
    def spend(self, work: float) -> None: ...
    def uses_up(self, work: float) -> bool: ...
    def take_time(self) -> None: ...
    def look(self) -> None: ...
    def afford(self, work: float = 0.0) -> None: ...

class Halted(Exception):
    budget: Budget
    def __init__(self, budget: Budget) -> None: ...

# -- on a spiral, in units of its growth --

def spiral_arc(theta: float) -> float: ...
def spiral_theta(arc: float) -> float: ...
def growth_pair(pitch: float) -> tuple[float, float]: ...
def coil_arc(pitch: float, turns: float) -> tuple[float, float]: ...
def coil_theta(
    growth: float, growth_low: float, arc: float, arc_low: float, way: float, way_low: float
) -> tuple[float, float]: ...
def spiral_thetas(
    growth: float, growth_low: float, length: float, length_low: float, s: Floats, thetas: Floats
) -> None: ...
def spiral_curvature(theta: float) -> float: ...
def steepest_curvature(theta: float) -> float: ...
def first_crest(theta: float) -> float: ...
def first_root(theta: float, chord2: float) -> float: ...
def fold_theta(chord2: float) -> float: ...
def previous_theta(theta: float, chord2: float) -> float: ...
def start_chain(theta: float, chain: Floats) -> None: ...
def extend_chain(growth: float, first: int, last: int, radius: float, sizes: Floats, chain: Floats) -> int: ...
def spiral_trajectory(
    growth: float,
    thetas: Floats,
    chords: Floats,
    head_speed: float,
    position: Floats,
    velocity: Floats,
    speed: Floats,
    budget: Budget,
) -> int: ...

# -- on a route --

def clothoid_joints(
    x: float, y: float, heading: float, first: float, last: float, length: float, places: Floats, out: Floats
) -> None: ...
def cubic_arcs(pieces: Floats, out: Floats) -> None: ...
def joint_misses(pieces: Floats, out: Floats) -> None: ...
def piece_slides(pieces: Floats, out: Floats) -> None: ...
def route_points(pieces: Floats, s: Floats, out: Floats) -> None: ...
def route_trajectory(
    pieces: Floats,
    s: Floats,
    head_speed: float,
    sizes: Floats,
    chain: Floats,
    position: Floats,
    velocity: Floats,
    speed: Floats,
) -> None: ...

class Follower:
    reached: float
    rear: float
    rear_cosine: float
    front_cosine: float
    longest: float
    work: float
    def __init__(self, pieces: Floats, chord: float, least: float) -> None: ...
    def follow(self, start: float, stop: float, beyond: float, most_work: float) -> Follows: ...

# -- boxes of turns --

class TurnBox:
    work: float
    def __init__(self, growth: float, least: float) -> None: ...
    def take(self, rows: Floats, n: int) -> None: ...
    def turned_over(self, first: float, last: float) -> float: ...
    def moved_over(self, first: float, last: float) -> float: ...

def refuse_turns(boxes: Floats, chords: Floats, benches: Floats, hints: Floats, box: TurnBox) -> None: ...

# -- on either --

class Curve:
    is_spiral: bool
    growth: float

def spiral_curve(growth: float, growth_low: float = 0.0, place_low: float = 0.0) -> Curve: ...
def head_theta(curve: Curve, place: float) -> float: ...
def route_curve(pieces: Floats) -> Curve: ...
def place_chain(curve: Curve, place: float, last: int, sizes: Floats, chain: Floats) -> int: ...
def chain_rounding(curve: Curve, last: int, sizes: Floats, chain: Floats) -> None: ...
def climbs(curve: Curve, last: int, sizes: Floats, chain: Floats) -> None: ...
def spiral_errors(
    growth: float, handles: int, sizes: Floats, before: Floats, after: Floats, motion: Floats
) -> None: ...

# -- rectangles --

class Witnesses:
    separation: float
    ax: float
    ay: float
    bx: float
    by: float
    nx: float
    ny: float
    feature_a: int
    feature_b: int

def bench_separation(a: int, b: int, sizes: Floats, chain: Floats) -> Witnesses: ...
def pair_separations(a: Floats, b: Floats, out: Floats) -> None: ...
def pair_gaps(a: Floats, b: Floats, limit: float, out: Floats) -> None: ...
def grow_tree(boxes: Floats, tree: Floats) -> None: ...

class Meetings:
    count: int
    met: int
    def __init__(self, frames: Floats, boxes: Floats, tree: Floats, order: Ints, budget: Budget) -> None: ...
    def find(self, margin: float, exact: bool, chained: bool, most_pairs: int, most_met: int, pairs: Ints) -> None: ...

# -- scenes --

class Rings:
    chord: float
    shortest: float
    overhang: float
    half_width: float
    all_chord: float
    all_shortest: float
    all_overhang: float
    all_half_width: float
    all_length: float
    all_radius: float
    between_shortest: float
    middle_half_width: float
    within: float
    hulls: bool
    clear_radius: float
    clear_place: float
    end_place: float
    def measure(
        self, chords: Floats, overhangs: Floats, widths: Floats, lengths: Floats, alike: int, outer: int
    ) -> None: ...
    def lay(self, corners: Floats, middle_half_width: float, within: float) -> None: ...

def radius_beyond(growth: float, radius: float, rings: Rings) -> float: ...
def leaders_reach(growth: float, lead: float, rear: float, rings: Rings) -> float: ...
def ring_least(growth_low: float, growth: float, radius: float, rings: Rings, total: float = ...) -> float: ...
def spirals_least(growth: float, angle: float, radius: float, rings: Rings, growth_low: float = ...) -> float: ...
def ring_rounding(growth: float, radius: float, rings: Rings) -> float: ...
def ring_clears(
    growth_low: float, growth: float, radius: float, margin: float, rings: Rings, total: float = ...
) -> bool: ...
def clear_radius(growth: float, margin: float, rings: Rings, angle: float = ...) -> float: ...

class Kinds:
    some: bool
    def lay(self, hulls: Floats, of: Ints, directions: Floats) -> None: ...

def hulls_near(
    kinds: Kinds, edge: bool, limit: float, sizes: Floats, chain: Floats, near: NDArray[np.uint8]
) -> None: ...
def largest_supports(
    chord: float, overhang: float, half_width: float, stray: float, samples: Floats, directions: Floats, largest: Floats
) -> None: ...

class Scene:
    curve: Curve
    place: float
    rings: Rings
    benches: int
    room: int
    edges: int
    budget: Budget
    margin: float
    left_out: int
    between: int
    left_out_too: int
    kinds: Kinds
    met: Witnesses
    wall_error: float
    copies: int
    stride: int
    def __init__(self, curve: Curve, place: float, rings: Rings, sizes: Floats, benches: int, edges: int) -> None: ...
    def lay_walls(self, walls: Floats) -> None: ...
    def lay_copies(self, turns: Floats) -> None: ...

class Interval:
    scene: Scene
    h: float
    handles: int
    def __init__(self, scene: Scene, before: Floats, after: Floats, motion: Floats) -> None: ...
    def bound(self, climbing: bool) -> bool: ...
    def lay_out(self, place: float, h: float, last: int) -> bool: ...

def clearance_at(
    scene: Scene, place: float, benches: int, leaders: int, chain: Floats, boxes: Floats
) -> tuple[float, int, int]: ...
def clearance_left(scene: Scene, leaders: int, benches: int, chain: Floats, moved: Floats) -> float: ...
def gap_at(scene: Scene, place: float, a: int, b: int, chain: Floats) -> float: ...
def meet(scene: Scene, i: int, j: int, chain: Floats) -> None: ...
def gap_rate_at(scene: Scene, place: float, a: int, b: int, chain: Floats) -> float: ...
def bottom_between(scene: Scene, low: float, high: float, a: int, b: int, width: float, chain: Floats) -> float: ...
def axis_curvature(growth: float, i: int, j: int, distance: float, sizes: Floats, motion: Floats) -> float: ...
def shift_curvature(i: int, j: int, distance: float, sizes: Floats, shifts: Floats) -> float: ...
def pair_rounding(i: int, j: int, distance: float, sizes: Floats, before: Floats, after: Floats) -> float: ...
def pair_curvatures(
    scene: Scene, interval: Interval, place: float, h: float, a: int, b: int
) -> tuple[float, float]: ...
def pair_least(
    scene: Scene, interval: Interval, i: int, j: int, enough: float, distance: float
) -> tuple[float, float]: ...
def pair_most(scene: Scene, interval: Interval, place: float, h: float, a: int, b: int) -> float: ...

# -- searches --

class March:
    def __init__(self, interval: Interval, probe: Interval, opening: Floats) -> None: ...
    def run(
        self,
        start: float,
        stop: float,
        leaders: int,
        at_start: bool,
        half_bracket: float,
        grazes: bool,
        rounding: float,
        most_work: float,
    ) -> Marched: ...

class Member:
    def __init__(
        self,
        interval: Interval,
        probed: Floats,
        first: int,
        benches: int,
        place: tuple[float, float, float, float, float],
        turns: bool,
    ) -> None: ...

class Ensemble:
    least: float
    curvature: float
    width: float
    gap: float
    first: int
    second: int
    tried: int
    def __init__(
        self,
        interval: Interval,
        probed: Floats,
        members: list[Member],
        blocks: Ints,
        scratch: tuple[Floats, Floats],
        clear: Floats,
    ) -> None: ...
    def stand(self, k: int, which: int, place: float, slip: float, speed: float, last: int) -> bool: ...
    def rest(self, k: int) -> None: ...
    def move(self, k: int, h: float, speed: float) -> bool: ...
    def advance(self) -> None: ...
    def bound(self, h: float) -> None: ...
    def nearest(self, which: int, a: int, b: int) -> None: ...
    def separation(self, which: int, a: int, b: int) -> float: ...
    def rounding(self, which: int, a: int, b: int) -> float: ...
    def rate(self, which: int, a: int, b: int) -> float: ...
    def left(self, moved: Floats) -> float: ...

class BandMarch:
    def __init__(self, low: Interval, high: Interval, shifts: Floats) -> None: ...
    def run(
        self, outer: float, inner: float, leaders: int, rounding: float, least_step: float, most_work: float
    ) -> Marched: ...

class Peak:
    rate: float
    upper: float
    travel: float
    intervals: int
    def __init__(
        self, interval: Interval, spare: Floats, calm: float, alike: int, start: float, stop: float, rounding: float
    ) -> None: ...
    def sample(self, step: float) -> None: ...
    def prove(self, step: float, slack: float, loosest: float, most_links: int) -> None: ...

class Excess:
    proven: float
    exceeded: float
    handle: int
    rate: float
    def __init__(self, interval: Interval, calm: float) -> None: ...
    def run(
        self,
        start: float,
        stop: float,
        step: float,
        limit: float,
        kept: float,
        width: float,
        rounding: float,
        most_links: int,
    ) -> Judged: ...

# -- chance --

class Wobbler:
    lateral: float
    forward: float
    along: float
    chain: Floats
    first: int
    second: int
    furthest: float
    def __init__(
        self, sizes: Floats, budget: Budget, chain: Floats, boxes: Floats, loud: Flags, loud_blocks: Flags
    ) -> None: ...
    def dance(
        self,
        memory: Floats,
        numbers: Floats,
        play: Floats,
        places: Floats,
        tangents: Floats,
        safe: Floats,
        state: Floats,
    ) -> int: ...
    def measure(self, most: float, gains: Floats, places: Floats, safe: Floats) -> None: ...

# -- pictures --

def fill_rectangles(plane: NDArray[np.uint8], rectangles: Floats, line: float, inks: Floats) -> None: ...
