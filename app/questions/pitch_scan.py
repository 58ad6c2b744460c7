"""Where does the head stand at first contact, against the pitch?"""

from __future__ import annotations

from pydantic import Field

from app.questions.minimum_pitch import allowed
from app.questions.question import Question, Terms
from app.wire.answers import Columns, Pair
from app.wire.dances import Circle, DragonFields, UniformDragon
from app.wire.models import Answer, measure
from core.design.pitch_scan import scan_near_minimum


class ScanFields(Circle):
    """Pitches around the minimum pitch."""

    samples: int = Field(101, ge=2, le=401, description="Number of pitches to sample; jumps between them are located")


class PitchScanQuery(ScanFields, UniformDragon):
    """First contact against the pitch."""


class PitchScanRequest(ScanFields, DragonFields, strict=True):
    """First contact against the pitch, of any dragon."""


class PitchScanTable(Answer):
    """Columns with one entry per pitch at which two benches come nearer than the margin, or touch if it is 0, and with
    entries where the radius jumps."""

    pitch: list[float] = measure("m", "Ascending")
    radius: list[float] = measure("m", "Distance of the head from the centre at first contact")
    pieces: list[Pair] = Field(description="Continuous stretches, as indices [from, to) into pitch and radius")
    minimum_pitch: float = measure("m", "Minimum pitch, around which the scanned pitches lie")


def pitch_scan(asked: PitchScanQuery | PitchScanRequest, terms: Terms) -> Columns:
    """Where the head stands at first contact, against the pitch, around the minimum pitch."""
    dragon = asked.to_dragon(min(terms.settings.scanned_benches_max, asked.most_benches(terms.settings)))
    scan, least = scan_near_minimum(
        dragon, samples=asked.samples, progress=terms.progress, budget=terms.budget, **asked.to_circle()
    )
    table = {"pitch": scan.pitch, "radius": scan.radius, "pieces": scan.pieces}
    return Columns(table | {"minimum_pitch": allowed(least, asked, dragon).pitch})


QUESTION = Question(pitch_scan, PitchScanTable, flat=PitchScanQuery, body=PitchScanRequest)
