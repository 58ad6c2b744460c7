"""Poses with the smallest strays at which two benches overlap: the upper end of the bracket around a tolerance.

One bench turned by phi with its middle anywhere in its lens (core/shapes/reach.py) covers the sum of the lens and
the turned rectangle: a convex region with support lens(theta) + rectangle(theta) in each direction theta. Two benches
turned by phi_a and phi_b can therefore overlap exactly if the largest gap
    g(phi_a, phi_b) = max over theta of  n . (M_b - M_a) - support_a(n) - support_b(-n)
is at most 0, and both are in the lens's corner for that n when they begin to overlap. The least g over both rotations
falls as the stray grows; the stray at which it reaches 0 shows a contact. Grids that narrow around their best point
find it. If they miss a better one, the bracket is wider, but still true, because the overlap is then verified in the
pose itself.

The rest of the chain can always follow. In front of the pair and behind it each handle takes the place on its circle
that is nearest to its nominal one: the nominal place, moved along with the handle before it, is on this circle, so the
handle strays no further than that one. Between the two benches both ends are given: from each end to the middle the
handles take their nearest places too, and Newton steps of least length then restore the chord left over in the middle.
The result reports the largest stray, measured in the pose.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol, TypeVar

import numpy as np

from core.contact.between import DEPTH, touching_pose
from core.display import WithArrays, display
from core.dragon import Dragon
from core.language import say
from core.shapes.rectangles import bench_poses, frames, frames_separation
from core.values import Floats

# Points of a grid over each rotation and over the direction [1]; range of directions around the nominal normal [rad];
# width of the next grid relative to this one [1]; and number of grids [1], good to 1e-7 of the range of the rotations.
ROTATIONS, BEARINGS = 11, 11
BEARING_RANGE = 0.7
NARROWER, ROUNDS = 0.35, 16
# Error of restored chords [m], and the largest number of steps to restore them [1].
CHORD_WITHIN, CHORD_STEPS = 1e-13, 40
# Largest stray that is tried, and the smallest and the largest step to it, relative to the safe one [1].
TRIED_TO, TRIED_STEPS = 1.5, (0.001, 0.01)
# Three benches in a row of different sizes that are tried beside the given pair, 0.1 s each [1].
THREES_TRIED = 4


@dataclass(frozen=True, slots=True, repr=False, eq=False)
class Exhibit(WithArrays):
    """A pose of the whole dragon in which two benches overlap, every chord as long as it should be to rounding.

    handles: places of the handles, x and y, head first [m]
    time: time of the pose [s]
    benches: the pair, the second None for an edge of the venue
    depth: depth of the overlap [m]
    stray: largest distance of a handle from its place [m]

    >>> from core import Dance, Spiral, tolerance
    >>> shown = tolerance(Dance(Dragon(40), Spiral()), stop=300.0).exhibit
    >>> shown.benches, shown.depth > 0.0, shown.handles.shape
    ((0, 21), True, (41, 2))
    """

    time: float
    handles: Floats
    benches: tuple[int, int | None]
    depth: float
    stray: float

    def _line(self) -> str:
        a, b = self.benches
        one, other = (say("the venue") if k is None else say("bench {bench}", bench=k) for k in (a, b))
        depth, stray = display(self.depth, "m"), display(self.stray, "m")
        return say(
            "{one} and {other} overlap by {depth} with strays up to {stray}",
            one=one, other=other, depth=depth, stray=stray,
        )  # fmt: skip


class Shown(Protocol):
    """A pose, with the depth of the overlap that it shows [m]."""

    @property
    def depth(self) -> float: ...


Pose = TypeVar("Pose", bound=Shown)


@dataclass(frozen=True, slots=True)
class Body:
    """A bench in its nominal place, or an edge at rest (chord 0): centre, heading, chord, half length and width [m]."""

    x: float
    y: float
    heading: float
    chord: float
    half_length: float
    half_width: float

    def most_rotation(self, stray: float) -> float:
        """Largest rotation that a stray allows [rad]."""
        return 2.0 * math.asin(min(1.0, stray / self.chord)) if self.chord else 0.0

    def faces(self, rotation: Floats, bearing: float) -> Floats:
        """Direction of the turned body's normal that is nearest to a bearing [rad]."""
        square = 0.5 * math.pi
        return self.heading + rotation + square * np.round((bearing - self.heading - rotation) / square)

    def support(self, bearing: Floats, rotation: Floats, stray: float) -> Floats:
        """Support of all places at a rotation [rad] in a direction of the world [rad], from the nominal centre [m]."""
        facing = bearing - self.heading - rotation
        reached: Floats = self.half_length * np.abs(np.cos(facing)) + self.half_width * np.abs(np.sin(facing))
        if not self.chord:
            return reached
        q = np.minimum(np.abs(self.chord * np.sin(0.5 * rotation)), stray)
        leaning = bearing - self.heading - 0.5 * rotation
        sine, cosine = np.abs(np.sin(leaning)), np.abs(np.cos(leaning))
        tip = cosine * np.sqrt(np.maximum(stray * stray - q * q, 0.0))
        return reached + np.where(q <= stray * sine, stray - q * sine, tip)

    def strays(self, bearing: float, rotation: float, stray: float) -> Floats:
        """Strays (2, 2) of the front and the rear hole that move a bench as far as possible in a direction [m]."""
        q = min(max(self.chord * math.sin(0.5 * rotation), -stray), stray)
        axis = self.heading + 0.5 * rotation
        along, across = np.array([math.cos(axis), math.sin(axis)]), np.array([-math.sin(axis), math.cos(axis)])
        way = np.array([math.cos(bearing), math.sin(bearing)])
        sideways, forward = float(across @ way), float(along @ way)
        if abs(q) <= stray * abs(sideways):  # one disc alone: its furthest point
            middle = stray * way - math.copysign(abs(q), sideways) * across
        else:
            middle = math.copysign(math.sqrt(stray * stray - q * q), forward) * along
        return np.stack([middle + q * across, middle - q * across])


def nearest_rotated(a: Body, b: Body, bearing: float, stray: float) -> tuple[float, float, float, float]:
    """Least gap of two bodies over all rotations [m], the two rotations, and the direction that keeps them apart [rad].

    bearing: of the normal from a to b in their nominal places [rad]
    """
    centres = [0.0, 0.0, bearing]
    spans = [a.most_rotation(stray), b.most_rotation(stray), BEARING_RANGE]
    limits, gap = spans[:2], 0.0
    for _ in range(ROUNDS):
        grid = zip(centres, spans, (ROTATIONS, ROTATIONS, BEARINGS), strict=True)
        axes = [np.linspace(centre - span, centre + span, count if span else 1) for centre, span, count in grid]
        rotation_a = np.clip(axes[0], -limits[0], limits[0])[:, None, None]
        rotation_b = np.clip(axes[1], -limits[1], limits[1])[None, :, None]
        ways = np.broadcast_to(axes[2], (rotation_a.size, rotation_b.size, axes[2].size))
        faces = [a.faces(rotation_a, bearing), b.faces(rotation_b, bearing)]
        way = np.concatenate([ways, *(np.broadcast_to(face, (*ways.shape[:2], 1)) for face in faces)], axis=2)
        apart = (b.x - a.x) * np.cos(way) + (b.y - a.y) * np.sin(way)
        gaps = apart - a.support(way, rotation_a, stray) - b.support(way + math.pi, rotation_b, stray)
        most = gaps.max(axis=2)
        i, j = np.unravel_index(int(most.argmin()), most.shape)
        gap = float(most[i, j])
        centres = [float(rotation_a[i, 0, 0]), float(rotation_b[0, j, 0]), float(way[i, j, gaps[i, j].argmax()])]
        spans = [NARROWER * span for span in spans]
    return gap, centres[0], centres[1], centres[2]


def body(dragon: Dragon, handles: Floats, k: int) -> Body:
    """Bench k of a dragon with these handles."""
    x, y, heading = bench_poses(handles[k : k + 2])[0].tolist()
    half_length, half_width = 0.5 * float(dragon.lengths[k]), 0.5 * float(dragon.widths[k])
    return Body(x, y, heading, float(dragon.chords[k]), half_length, half_width)


def separation_of(a: Body, b: Body) -> tuple[float, float]:
    """Separation of two bodies [m], and the direction of its normal [rad]."""
    poses = np.array([[body.x, body.y, body.heading] for body in (a, b)])
    sizes = np.array([[2.0 * body.half_length, 2.0 * body.half_width] for body in (a, b)])
    one, two = frames(poses, sizes)
    apart = frames_separation(one[None], two[None])
    normal = apart.normal[0]
    return float(apart.separation[0]), math.atan2(normal[1], normal[0])


def exhibit(
    dragon: Dragon, handles: Floats, pair: tuple[int, int | None], edge: Body | None, safe: float, time: float
) -> Exhibit | None:
    """A pose of the whole dragon in which a pair overlaps, with strays little above the safe ones; None if not found.

    handles: (n + 1, 2) nominal places [m]; edge: in place of a second bench
    With one bench between the pair, the pose may show three other consecutive benches, if that takes smaller strays.
    """
    first, second = pair
    a = body(dragon, handles, first)
    other = edge if second is None else body(dragon, handles, second)
    assert other is not None
    if second == first + 2:  # the least strays that fold three may be those of others
        threes = {first, *range(min(dragon.uniform_from + 1, dragon.benches - 2, THREES_TRIED))}
        folds = [pose for k in sorted(threes) for pose in [_folded(dragon, handles, k, time)] if pose is not None]
        return min(folds, key=lambda pose: pose.stray, default=None)

    def posed(way: float, rotations: tuple[float, float], stray: float) -> Exhibit | None:
        wanted = {first: a.strays(way, rotations[0], stray)}
        if second is not None:
            wanted[second] = other.strays(way + math.pi, rotations[1], stray)
        return _pose_with(dragon, handles, wanted, (*pair, edge), time)

    bearing = separation_of(a, other)[1]
    return first_overlap(a, other, bearing, safe, 0.5 * float(dragon.chords.min()), posed)


def first_overlap(
    a: Body,
    b: Body,
    bearing: float,
    safe: float,
    most: float,
    posed: Callable[[float, tuple[float, float], float], Pose | None],
) -> Pose | None:
    """The pose with the least stray found, little above the safe one, in which two bodies overlap; None if none is.

    posed: the pose in which both go as far as they can towards each other, in a direction [rad], with rotations [rad]
        and a stray [m]; most: largest stray that is tried [m]
    """
    high = min(TRIED_TO * safe + 2.0 * DEPTH, most)
    # A stray larger by x lets the middle of each bench go x further in any direction, so the gap closes by as much.
    moving = 2 if b.chord else 1
    stray = safe + max(0.0, nearest_rotated(a, b, bearing, safe)[0] + DEPTH) / moving
    least, longest = (step * safe + DEPTH for step in TRIED_STEPS)
    while stray <= high:
        _, *rotations, way = nearest_rotated(a, b, bearing, stray)
        pose = posed(way, (rotations[0], rotations[1]), stray)
        if pose is not None and pose.depth > 0.0:
            return pose
        stray += longest if pose is None else min(max(least, -pose.depth / moving), longest)
    return None


def _folded(dragon: Dragon, handles: Floats, first: int, time: float) -> Exhibit | None:
    """A pose in which two benches with one between them overlap: that bench couples them (between.py)."""
    three = slice(first, first + 3)
    sizes = np.stack([dragon.chords[three], dragon.lengths[three], dragon.widths[three]], axis=1)
    folded = touching_pose(sizes, handles[first : first + 4])
    if folded is None:
        return None
    strays = folded - handles[first : first + 4]
    pose = _pose_with(dragon, handles, {first: strays[:2], first + 2: strays[2:]}, (first, first + 2, None), time)
    return pose if pose is not None and pose.depth > 0.0 else None


def _pose_with(
    dragon: Dragon, handles: Floats, wanted: dict[int, Floats], met: tuple[int, int | None, Body | None], time: float
) -> Exhibit | None:
    """The pose with strays as extended() takes them, None if it has none; it shows no contact if its depth is negative.

    met: the pair, and the edge in place of a second bench
    """
    moved = extended(dragon.chords, handles, wanted)
    if moved is None:
        return None
    first, second, edge = met
    other = edge if second is None else body(dragon, moved, second)
    assert other is not None
    depth = -separation_of(body(dragon, moved, first), other)[0]
    return Exhibit(time, moved, met[:2], depth, float(np.hypot(*(moved - handles).T).max()))


def extended(chords: Floats, handles: Floats, wanted: dict[int, Floats]) -> Floats | None:
    """All handles (n + 1, 2), with holes of some benches displaced as wanted and every chord kept; None if it fails.

    wanted: bench -> strays (2, 2) of its two holes, which keep its chord [m]; of two benches with one between them the
        four strays also keep the chord of that bench, which shares a hole with either
    """
    moved = handles.copy()

    def follow(places: range, joined: int) -> None:
        """Each handle at its chord from the one `joined` (1 or -1) further on, as near to its own place as possible."""
        for k in places:
            way = handles[k] - moved[k + joined]
            chord = float(chords[min(k, k + joined)])
            moved[k] = moved[k + joined] + way * (chord / math.hypot(*way.tolist()))

    for k, strays in wanted.items():
        moved[k : k + 2] = handles[k : k + 2] + strays
    first, last = min(wanted), max(wanted)
    between = slice(first + 2, last) if last > first + 2 else slice(first, last + 2)
    middle = (first + last + 3) // 2
    follow(range(first + 2, middle), -1)
    follow(range(last - 1, middle - 1, -1), 1)
    if last > first and not _restored(chords[first : last + 1], moved[first : last + 2], between, first):
        return None
    follow(range(first - 1, -1, -1), 1)
    follow(range(last + 2, len(handles)), -1)
    return moved


def _restored(chords: Floats, places: Floats, free: slice, first: int) -> bool:
    """Give these chords their lengths by moving handles `free` (numbered from `first`) as little as possible."""
    start, stop = free.start - first, free.stop - first
    for _ in range(CHORD_STEPS):
        link = places[:-1] - places[1:]
        length = np.hypot(*link.T)
        wrong = chords - length
        if np.abs(wrong).max() <= CHORD_WITHIN:
            return True
        slope = np.zeros((len(chords), len(places), 2))
        rows = np.arange(len(chords))
        slope[rows, rows] = link / length[:, None]
        slope[rows, rows + 1] = -slope[rows, rows]
        moving = slope[:, start:stop].reshape(len(chords), -1)
        places[start:stop] += np.linalg.lstsq(moving, wrong, rcond=None)[0].reshape(-1, 2)
    return False
