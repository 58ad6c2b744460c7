"""Handles on the wrong ring.

Input: the judgement of positions. Output: a finding, or none. State: none. Argument: a spiral and the turn never cross
themselves, so every handle on the path has one arc length. A right handle is one chord away from the one before it, and
a little more than a chord behind it along the path. One that is a chord away too, but in front of it or much further
behind, is another root of the chord equation.
"""

from __future__ import annotations

import cmath

import numpy as np

from app.grade.chains import spiral_arc
from app.grade.expected import right_turn
from app.grade.geometry import arcs_of
from app.grade.handles import HANDLES
from app.grade.judged import RIGHT, JudgedSheet
from app.grade.labels import X, Y
from app.grade.shortcuts import Finding
from app.grade.words import note
from core.paths.path import Path
from core.values import Floats

# Of the links that end at wrong handles, at least this share has the right length [1]; in exchanged rows fewer have it.
RING_SHARE = 0.995
# Tolerance for a handle on the path, and for the length of a chord [m].
ON_PATH = 1e-4
# A right handle is at most half a circle behind the one before it, pi / 2 chords along the path. The next root is
# further behind than this number of chords [1].
CHORDS_MOST = 2.0


def wrong_ring(one: JudgedSheet) -> Finding | None:
    """The first handle on another ring, and the number of them."""
    path, order = one.dance.path, np.argsort(one.handles)
    if not np.array_equal(one.handles[order], np.arange(HANDLES)):
        return None
    points, chords = one.values[:, order], one.dance.dragon.chords
    behind = -np.diff(places(path, points), axis=1)
    distances = np.linalg.norm(np.diff(points, axis=1), axis=-1)
    kept = (np.abs(distances - chords) < ON_PATH) & np.isfinite(behind)
    wrong = np.any(one.off[:, order] > RIGHT, axis=-1)[:, 1:]
    other = np.argwhere((behind < 0.0) | (behind > CHORDS_MOST * chords))
    if not wrong.any() or kept[wrong].mean() < RING_SHARE or not other.size:
        return None
    t, k = min((tuple(map(int, at)) for at in other), key=lambda at: (at[1], at[0]))
    right = places(path, one.wanted[t, order[k : k + 2]][:, [X, Y]])
    values = {
        "handle": k + 1,
        "time": f"{one.times[t]:g}",
        "chord": f"{distances[t, k]:.6f}",
        "way": f"{abs(behind[t, k]):.3f}",
        "right": f"{right[0] - right[1]:.3f}",
        "count": len(other),
    }
    words = "evidence_behind" if behind[t, k] > 0.0 else "evidence_in_front"
    return Finding("wrong_ring", note("error_wrong_ring"), note(words, **values))


def places(path: Path, points: Floats) -> Floats:
    """Arc lengths of points (..., 2) on a spiral or a turn, (...) [m], NaN for others."""
    arc_lengths = np.full(points.shape[:-1], np.nan)
    for s in _candidates(path, points):
        inside = np.clip(np.nan_to_num(s), *path.drawn_between(-np.inf, path.end))
        on_path = np.linalg.norm(path.position(inside) - points, axis=-1) < ON_PATH
        arc_lengths = np.where(on_path, inside, arc_lengths)
    return arc_lengths


def _candidates(path: Path, points: Floats) -> list[Floats]:
    """Arc lengths that points would have on each piece of a path [m]."""
    radius = np.linalg.norm(points, axis=-1)
    if path.spiral is not None:
        return [path.end - spiral_arc(radius, path.growth)]
    turn = right_turn()
    growth = turn.pitch / (2.0 * np.pi)
    outside = spiral_arc(radius, growth) - spiral_arc(turn.entry_radius, growth)
    candidates, begin = [-outside, turn.length + outside], 0.0
    for centre, size, start, turned in arcs_of(turn):
        away = points[..., 0] + 1j * points[..., 1] - centre
        angle = np.angle(away * cmath.exp(-1j * start)) * np.sign(turned)
        candidates.append(begin + size * (angle % (2.0 * np.pi)))
        begin += size * abs(turned)
    return candidates
