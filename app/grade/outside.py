"""Handles that are not yet on the spiral, and what a student wrote for them: zeros, nothing, or places on a line.

Input: the judgement of a sheet of result1. Output: a finding, and the cells that it explains; or none. State: none.
Argument: the spiral goes on outside its beginning, so a handle further from the centre has a right place too. Zeros are
no place of the spiral, and places on one line are none beyond two of them, so these show themselves.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from app.grade.expected import Workbook, of_dance
from app.grade.handles import Mask
from app.grade.judged import JudgedSheet
from app.grade.labels import SPEED
from app.grade.layout import TableKind
from app.grade.shortcuts import Finding
from app.grade.words import note

# Least share of the handles outside that are written so, and of the cells written so that are outside [1]. A student
# may take a handle for one outside, or not, where it is near the beginning.
SHARE = 0.95
# Fewest handles outside, over all instants, that show what was done with them.
OUTSIDE_LEAST = 10
# Largest distance of the places from a line [m].
ON_LINE = 1e-3


@dataclass(frozen=True)
class Outside:
    """What stands in the cells of handles outside. way: "zero", "blank" or "line"; cells: (T, H)"""

    way: str
    cells: Mask
    finding: Finding


def outside_of(one: JudgedSheet) -> Outside | None:
    """What a student wrote for the handles that are not yet on the spiral; None for the right numbers, and others."""
    if one.workbook is not Workbook.RESULT1 or one.table.kind is TableKind.CONTACT:
        return None
    missing: Mask = np.asarray(np.isnan(one.values).all(axis=-1))
    graded = ~np.isnan(one.wanted).all(axis=-1)
    beyond = _beyond(one) & graded
    if beyond.sum() < OUTSIDE_LEAST:
        return None
    zero: Mask = (one.values == 0.0).all(axis=-1)
    for way, written in (("zero", zero), ("blank", missing & graded)):
        if written.any() and float(written[beyond].mean()) >= SHARE and float(beyond[written].mean()) >= SHARE:
            return Outside(way, written | (beyond & (zero | missing)), _finding(one, way, written & beyond, beyond))
    if one.table.kind is TableKind.POSITION and _are_on_line(one, beyond):
        return Outside("line", beyond, _finding(one, "line", beyond, beyond))
    return None


def without(one: JudgedSheet, cells: Mask) -> JudgedSheet:
    """The sheet without some cells (T, H)."""
    return replace(one, values=np.where(cells[..., None], np.nan, one.values))


def same_cells(outside: Outside, one: JudgedSheet, other: JudgedSheet) -> Mask:
    """The cells (T, H) of another sheet that have the handles and instants of those outside on the first one."""
    cells = np.zeros(other.values.shape[:2], dtype=bool)
    _, t, other_t = np.intersect1d(one.times, other.times, return_indices=True)
    _, h, other_h = np.intersect1d(one.handles, other.handles, return_indices=True)
    cells[np.ix_(other_t, other_h)] = outside.cells[np.ix_(t, h)]
    return cells


def _beyond(one: JudgedSheet) -> Mask:
    """Handles (T, H) that are further out than the beginning of the spiral."""
    spiral = one.dance.path.spiral
    assert spiral is not None
    radius = np.linalg.norm(of_dance(one.dance)(np.nan_to_num(one.times))[..., :2], axis=-1)
    beyond = np.zeros(one.values.shape[:2], dtype=bool)
    beyond[:, one.known] = radius[:, one.handles[one.known]] > spiral.pitch * spiral.start_turns + ON_LINE
    return beyond


def _are_on_line(one: JudgedSheet, beyond: Mask) -> bool:
    """True if the places of the handles outside are wrong, and all on one line."""
    points = one.values[beyond]
    points = points[np.isfinite(points).all(axis=-1)]
    if len(points) < OUTSIDE_LEAST or np.nanmedian(one.off[beyond]) <= 10.0 * ON_LINE:
        return False
    away = points - np.median(points, axis=0)
    _, _, directions = np.linalg.svd(away[:: max(1, len(away) // 1000)], full_matrices=False)
    across = away @ directions[1]
    return bool((np.abs(across - np.median(across)) <= ON_LINE).mean() >= SHARE)


def _finding(one: JudgedSheet, way: str, written: Mask, beyond: Mask) -> Finding:
    t, h = np.argwhere(written)[0].tolist()
    values = {
        "sheet": one.title,
        "count": f"{int(written.sum()):,}",
        "outside": f"{int(beyond.sum()):,}",
        "time": f"{one.times[t]:g}",
        "handle": int(one.handles[h]),
    }
    of_speed = one.components == (SPEED,)
    return Finding(f"outside_{way}", note(f"error_outside_{way}"), note(f"evidence_outside{'_v' * of_speed}", **values))
