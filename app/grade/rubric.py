"""The points that the contest's reviewers check, each with the evidence of a file.

Input: judgements and findings of one workbook. Output: criteria, met, not met, or not shown. State: none.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from app.grade.expected import Workbook
from app.grade.handles import HANDLES
from app.grade.judged import DECIMALS, JudgedSheet, Rating
from app.grade.layout import TableKind
from app.grade.shortcuts import Finding
from app.grade.words import Note, note

# Largest difference between the mean speed over a second and the speed at its middle, because handles turn [m/s].
MEAN_SPEED = 0.1
# Longest time between two instants that are compared [s], those of the contest.
SPAN_MOST = 1.0
# Share of the cells that agree at least where speeds belong to the positions, for those near the ends of the arcs of a
# turn differ more; and where they may belong: with an arc of 0.95 m only 65 % agree of right ones [1].
SHARE, SHARE_LEAST = 0.99, 0.5
GOOD = (Rating.RIGHT, Rating.ROUNDED, Rating.INCOMPLETE)
# Findings that show the method of the search for first contact.
STEPPED = {"time_steps", "time_steps_before"}
NO_OVERHANG = {"no_overhang", "length_for_chord", "overhang_once", "one_corner"}
NOT_OF_POSITIONS = {"equal_speeds", "speeds_negated", "other_speeds"}
NOT_SMOOTH = {"arcs_not_tangent", "wrong_centre"}


@dataclass(frozen=True)
class Criterion:
    """met: None if the file does not show it"""

    name: str
    met: bool | None
    sentence: Note


def rubric_of(judgements: Sequence[JudgedSheet], findings: Sequence[Finding]) -> list[Criterion]:
    """The five points, for one workbook."""
    return list(_criteria({one.table.kind: one for one in judgements}, {one.error for one in findings}))


def _criteria(by_kind: dict[TableKind, JudgedSheet], errors: set[str]) -> Iterator[Criterion]:
    position, speed, contact = (by_kind.get(kind) for kind in (TableKind.POSITION, TableKind.SPEED, TableKind.CONTACT))
    placed = position or contact
    branch = None if placed is None else "wrong_ring" not in errors if _is_good(placed) or errors else None
    yield _criterion("branch", branch)
    consistent = _share_consistent(position, speed) if position and speed else None
    has_both = bool(position and speed) or bool(
        contact and all(np.isfinite(contact.values[..., part]).any() for part in (slice(2), slice(2, 3)))
    )
    if errors & NOT_OF_POSITIONS and has_both:
        yield _criterion("speeds", False)
    elif contact is not None and _is_good(contact) and np.isfinite(contact.values).all(axis=-1).any():
        yield _criterion("speeds", True)
    elif consistent is None:
        lacks_sheet = contact is None and not (position and speed)
        yield Criterion("speeds", None, note("rubric_speeds_unknown" if lacks_sheet else "rubric_speeds_alone"))
    else:
        # Where arcs are tight, or begin, speeds change within a second: a part that differs shows nothing.
        met = True if consistent >= SHARE else False if consistent < SHARE_LEAST else None
        yield Criterion("speeds", met, note("rubric_speeds_share", share=f"{100 * consistent:.1f}"))
    # A rounded instant is refined or a step of a search: it does not show which.
    refined = _is_met(None if "rounded_instant" in errors else contact, errors & STEPPED)
    overhang = _is_met(contact, errors & NO_OVERHANG)
    yield _criterion("overhang", overhang)
    yield _criterion("refined", refined)
    turning = placed if placed and placed.workbook is Workbook.RESULT4 else None
    yield _criterion("tangents", _is_met(turning, errors & NOT_SMOOTH))


def _is_good(one: JudgedSheet) -> bool:
    """True if the numbers of a sheet are nearly right, to decimals enough for a point."""
    return one.verdict in GOOD and (one.decimals is None or one.decimals >= DECIMALS[-1])


def _is_met(one: JudgedSheet | None, against: set[str]) -> bool | None:
    """True if a point is met. An error against it counts more than numbers that are nearly right."""
    if one is None or against:
        return False if against else None
    return _is_good(one) or None


def _criterion(name: str, met: bool | None) -> Criterion:
    words = {True: "yes", False: "no", None: "unknown"}[met]
    return Criterion(name, met, note(f"rubric_{name}_{words}"))


def _share_consistent(position: JudgedSheet, speed: JudgedSheet) -> float | None:
    """Share of the speeds that agree with the motion of their handle between two instants."""
    times, p, v = np.intersect1d(position.times, speed.times, return_indices=True)
    if times.size < 2:
        return None
    handles, a, b = np.intersect1d(position.handles, speed.handles, return_indices=True)
    a, b = a[handles < HANDLES], b[handles < HANDLES]
    spans = np.diff(times)[:, None]
    ways = np.linalg.norm(np.diff(position.values[p][:, a], axis=0), axis=-1) / spans
    speeds = speed.values[v][:, b, 0]
    # Over more than a second a handle turns by too much: its way differs from the distance between both places.
    off = np.where(spans <= SPAN_MOST, np.abs(ways - 0.5 * (speeds[1:] + speeds[:-1])), np.nan)
    known = np.isfinite(off)
    return float((off[known] <= MEAN_SPEED).mean()) if known.any() else None
