"""The question pitch_scan: radius of the head at first contact, against the pitch."""

from __future__ import annotations

import numpy as np
from pydantic import Field

import core
from app.questions.minimum_pitch import checked_pitch
from app.wire.answers import Columns
from app.wire.dances import DragonFields
from app.wire.fields import Answer, UniformDragon, Whole
from app.wire.paths import Circle
from app.wire.question import UNKNOWN_COST, Question, Terms
from core.design.pitch_scan import pitches_near, scan_near_minimum
from core.values import Pair, Point

# Time of a first contact near the minimum pitch, measured 2026-11-22 [s].
SECONDS_PER_SAMPLE = 1.5e-3


class ScanFields(Circle):
    """Pitches around the minimum pitch."""

    samples: Whole = Field(101, ge=2, le=401, description="Number of evenly spaced pitches in the answer")


class Located(ScanFields):
    """A scan, with or without the jumps."""

    locate: bool = Field(True, description="Locate the jumps between the samples; false: a first look, much faster")


class PitchScanQuery(Located, UniformDragon):
    """First contact against the pitch."""


class PitchScanRequest(Located, DragonFields, strict=True):
    """First contact against the pitch, of any dragon."""


class Jump(Answer):
    """Two pitches so near to one another that the radius jumps between them.

    pitch: just before and just after the jump [m]
    radius: radius at these two pitches [m]
    """

    pitch: Point
    radius: Point


class PitchScanTable(Answer, of=core.PitchScan):
    """Columns with one entry per sampled pitch at which two benches come within the margin, or touch if it is 0,
    and the jumps of the radius besides.

    minimum_pitch: minimum pitch, around which the scanned pitches lie [m]
    """

    pitch: list[float]
    radius: list[float]
    pieces: list[Pair]
    jumps: list[Jump] = Field(description="Jumps of the radius, ascending; empty if jumps are not located")
    minimum_pitch: float


def pitch_scan(request: PitchScanQuery | PitchScanRequest, terms: Terms) -> Columns:
    """Radius of the head at first contact, against the pitch, around the minimum pitch."""
    dragon = request.to_dragon(min(terms.settings.scanned_benches_max, request.most_benches(terms.settings)))
    scan, least = scan_near_minimum(
        dragon,
        samples=request.samples,
        locate=request.locate,
        progress=terms.progress,
        budget=terms.budget,
        **request.to_circle(),
    )
    # The answer has only the samples, not the other pitches computed on the way to the jumps.
    sampled = np.isin(scan.pitch, pitches_near(least, request.samples))
    before = np.concatenate([[0], np.cumsum(sampled)])
    pieces = [(int(before[a]), int(before[b])) for a, b in scan.pieces if before[a] < before[b]]
    sides = [list(jump) for jump in scan.jumps] if request.locate else []
    jumps = [{"pitch": scan.pitch[two].tolist(), "radius": scan.radius[two].tolist()} for two in sides]
    table = {"pitch": scan.pitch[sampled], "radius": scan.radius[sampled], "pieces": pieces, "jumps": jumps}
    return Columns(table | {"minimum_pitch": checked_pitch(least, request, dragon).pitch})


def _cost(request: PitchScanQuery | PitchScanRequest) -> float:
    return UNKNOWN_COST if request.locate else SECONDS_PER_SAMPLE * request.samples


QUESTION = Question(pitch_scan, PitchScanTable, flat=PitchScanQuery, body=PitchScanRequest, cost=_cost)
