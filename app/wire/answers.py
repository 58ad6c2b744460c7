"""Answers on the wire: small ones are checked against these models before they leave; tables are documented by them.

A trajectory has 200,000 numbers, so tables leave as columns of numpy through orjson, not cell by cell.
"""

from __future__ import annotations

from typing import Any, Self

import numpy as np
import orjson
from pydantic import BaseModel, ConfigDict, Field

import core
from app.wire.requests import CheckRequest, CollisionQuery, MinimumPitchQuery
from core import Dragon, Engine, Outcome, Route, Spiral

Pair = tuple[int, int]
Point = tuple[float, float]


class Answer(BaseModel):
    """What goes out: finite numbers only, so that a mistake of ours is an error and never a NaN."""

    model_config = ConfigDict(allow_inf_nan=False, from_attributes=True)

    def to_json(self) -> bytes:
        return self.model_dump_json().encode()

    @classmethod
    def known(cls, found: Any, **own: Any) -> Self:
        """This answer from a result of core, by the names of its fields, but for those that are given."""
        return cls(**{name: getattr(found, name) for name in cls.model_fields if name not in own}, **own)


class TrajectoryTable(Answer):
    """Columns: one row per instant, one entry per handle, handle 0 leading (H = benches + 1)."""

    time: list[float] = Field(description="Instants, T of them [s]")
    x: list[list[float]] = Field(description="T rows of H [m]")
    y: list[list[float]] = Field(description="T rows of H [m]")
    speed: list[list[float]] = Field(description="T rows of H [m/s]")


class Head(Answer):
    """Handle 0 at first contact."""

    theta: float | None = Field(description="Polar angle on a spiral, unwrapped; null on any other path [rad]")
    radius: float = Field(description="Distance from the origin, where a spiral has its centre [m]")
    x: float = Field(description="[m]")
    y: float = Field(description="[m]")


class Feature(Answer):
    """A corner or an edge of one bench."""

    bench: int = Field(description="Bench, 0 is the head")
    name: str = Field(
        description="Made of front, rear (towards the lower, higher handle), outer, inner (from the centre)"
    )


class End(Answer):
    """Where a run ends on which nothing comes nearer than the margin, or touches if it is 0."""

    reason: core.EndReason = Field(
        description="fold: a bench cannot follow any more; centre: the head arrived; end: the path ends; stop: the "
        "time asked for is over"
    )
    time: float = Field(description="[s]")
    theta: float | None = Field(description="Polar angle of the head then, on a spiral that folds or ends [rad]")
    bench: int | None = Field(description="The bench that folds; null if none does")


class Graze(Answer):
    """A local minimum of the clearance over time."""

    time: float = Field(description="[s]")
    clearance: float = Field(description="[m]")
    benches: Pair = Field(description="The pair")


class ClearanceTable(Answer):
    """Columns: one entry per instant; and what lies between them."""

    time: list[float] = Field(description="Instants, T of them [s]")
    clearance: list[float] = Field(description="Smallest separation of two benches that are no neighbours [m]")
    benches: list[Pair] = Field(description="The pair that is so near")
    grazes: list[Graze] = Field(description="Local minima between the first and the last instant, refined")


class PitchScanTable(Answer):
    """Columns: one entry per pitch at which two benches come nearer than the margin, or touch, and where the radius
    jumps."""

    pitch: list[float] = Field(description="Ascending [m]")
    radius: list[float] = Field(description="Distance of the head from the centre at first contact [m]")
    pieces: list[Pair] = Field(description="Continuous stretches, as indices [from, to) into pitch and radius")
    minimum_pitch: float = Field(description="The minimum pitch, around which the pitches lie [m]")


class Certificate(Answer):
    """How the answer is known."""

    method: str = Field(description="The whole claim, and how it is proven, in sentences")
    steps: int = Field(description="Proven steps taken")
    clear_until: float | None = Field(
        description="Nothing comes nearer than the margin, or touches if it is 0, from the start to here; null where "
        "no time is proven clear: benches touch, or are nearer, at the start, or it is not decided from there on [s]"
    )
    bound: float = Field(description="Largest bound on the second derivative of a gap that a step used [1/m]")
    least_clearance: Graze | None = Field(description="Narrowest graze before the contact, or over the whole run")


class Verdict(Answer):
    """What an engine finds among the benches judged, neighbours aside."""

    before: bool | None = Field(
        description="Does it find any two overlapping, or nearer than the margin, just before? null for a contact "
        "at the start, before which there is nothing"
    )
    after: bool = Field(
        description="Does it find the reported pair overlapping, or nearer than the margin, just after, and no other "
        "but those of together? At the start others may be so too"
    )


class PairCheck(Answer):
    """Independent engines on the dance just before and just after; nearer than the margin counts as overlapping."""

    agree: bool = Field(description="Every engine asked finds nothing before, and after the reported pair alone")
    judged: list[int] = Field(
        description="The benches judged: all; of more than 2,000, or very crowded ones, those near the pair, or the "
        "pair; with cross_check=pair the pair"
    )
    engines: dict[Engine, Verdict] = Field(
        description="Each engine's verdict; angle_sum knows no margin, so it is asked only where that is 0"
    )
    together: list[Pair] = Field(
        description="Other pairs that come nearer than the margin, or touch if it is 0, with the reported one, as "
        "where a corner meets two benches of a straight row at once: apart just before, and hardly within the margin "
        "just after"
    )
    left_out: list[Engine] = Field(
        description="Engines that were not asked, as they cannot judge this: the angle sum looks at corners alone, so "
        "it knows no margin, and at the start no benches that cross with no corner of one inside the other"
    )


class CollisionTime(Answer):
    """When two benches that share no handle first come nearer than the margin, or touch if it is 0."""

    outcome: Outcome = Field(
        description="How the search ended; contact is the first time at which two benches are nearer than the margin, "
        "or touch if it is 0"
    )
    margin: float = Field(description="Clearance that was asked for; 0 asks for a touch [m]")
    time: float | None = Field(
        description="When first nearer than the margin, or touching if it is 0; null when clear or undecided [s]"
    )
    time_bracket: Point | None = Field(
        description="Proven not to be so up to, nearer than the margin, or overlapping if it is 0, at [s]"
    )
    head: Head | None = Field(description="The head at that time")
    benches: Pair | None = Field(description="The pair that is so near")
    gap: float | None = Field(
        description="Between the two then: the margin, or less where they are nearer from the start on [m]"
    )
    corner: Feature | None = Field(description="The corner that is nearest, or touches")
    edge: Feature | None = Field(description="The edge that it is nearest to, or touches")
    point: Point | None = Field(description="Where that corner is, x and y [m]")
    end: End | None = Field(description="Where the run ends, when clear")
    certificate: Certificate = Field(description="How the answer is known")
    cross_check: PairCheck | None = Field(
        description="Engines on the dance 1e-6 m of travel before and after, at the start at once and after; null "
        "without a contact, and when not asked for"
    )

    @classmethod
    def of(
        cls, contact: core.FirstContact, dragon: Dragon, path: Spiral | Route, wanted: CollisionQuery | CheckRequest
    ) -> Self:
        check = None
        if wanted.cross_check != "none":
            whole, speed = wanted.cross_check == "dragon", wanted.head_speed
            check = core.contact_check(contact, core.Dance(dragon, path, speed), margin=wanted.margin, whole=whole)
        return cls.known(contact, margin=wanted.margin, cross_check=check)


class MinimumPitch(Answer):
    """The smallest pitch such that every larger one lets the head reach the turning circle with no two benches nearer
    than the margin, or touching if it is 0."""

    pitch: float = Field(description="[m]")
    pitch_bracket: Point = Field(
        description="Infeasible, feasible; twice the same where smaller pitches would begin inside the circle [m]"
    )
    limited_by: core.LimitedBy = Field(
        description="Just below: a graze on the way; contact on the circle; the start: contact there or, where benches "
        "is null, a start inside the circle (contact: nearer than the margin, or a touch if it is 0); or a "
        "fold: a bench cannot follow the head as far as the circle"
    )
    benches: Pair | None = Field(
        description="The pair that touches, or is nearer than the margin, just below; null at a fold or without one"
    )
    head_radius: float | None = Field(description="Where the head is then [m]")
    other_feasible_intervals: list[Point] = Field(description="Feasible islands below [m]")
    justified_by: str = Field(
        description="How larger pitches are known to be feasible. bound: proven for all; scan: below proven_from "
        "single ones are proven, at most scan_step apart: a narrower range of infeasible ones is not excluded there"
    )
    proven_from: float = Field(
        description="From here on every pitch is proven feasible; pitch itself without a scan [m]"
    )
    proven_up_to: float | None = Field(description="Up to here; null: every larger pitch, without end [m]")
    scan_step: float | None = Field(description="How far apart the pitches of a scan are at most; null: no scan [m]")
    evaluations: int = Field(description="Ways to the circle, and strips of pitches at once, that were marched")
    cross_check: PairCheck | None = Field(
        description="Engines on the dance at a pitch 1e-6 m larger and smaller, the head where the pair is nearer than "
        "the margin, or touches; null without a pair, and when not asked for"
    )

    @classmethod
    def of(cls, found: core.MinimumPitch, dragon: Dragon, wanted: MinimumPitchQuery) -> Self:
        check = None
        if wanted.cross_check != "none":
            check = core.pitch_check(found, dragon, margin=wanted.margin, whole=wanted.cross_check == "dragon")
        return cls.known(found, cross_check=check)


class Overlap(Answer):
    """Two benches nearer than the margin, or overlapping if it is 0. witness_b - witness_a = separation * normal."""

    benches: Pair = Field(description="The pair a, b")
    separation: float = Field(description="Signed: minus the penetration depth when they overlap [m]")
    witness_a: Point = Field(description="Point of a that realises the separation, x and y [m]")
    witness_b: Point = Field(description="Point of b that realises the separation, x and y [m]")
    normal: Point = Field(description="Unit vector from a to b")


class OverlapsCheck(Answer):
    """Independent engines side by side."""

    agree: bool = Field(description="All engines asked found the same pairs")
    engines: dict[Engine, list[Pair]] = Field(description="The pairs that each engine found")
    left_out: list[Engine] = Field(
        description="Engines that were not asked, as they cannot judge this: the angle sum looks at corners alone, so "
        "it knows no margin, and at the start no benches that cross with no corner of one inside the other"
    )


class OverlapsAnswer(Answer):
    """All pairs with separation <= margin."""

    overlaps: list[Overlap] = Field(description="The pairs, sorted")
    cross_check: OverlapsCheck = Field(description="Independent engines side by side")

    @classmethod
    def of(cls, found: core.Overlaps, check: core.CrossCheck) -> Self:
        contact = found.contact
        columns = (contact.separation, contact.witness_a, contact.witness_b, contact.normal)
        # Adding 0.0 turns -0.0 into 0.0.
        rows = zip(found.pairs.tolist(), *((column + 0.0).tolist() for column in columns), strict=True)
        names = tuple(Overlap.model_fields)
        return cls(
            overlaps=[Overlap(**dict(zip(names, row, strict=True))) for row in rows],
            cross_check=OverlapsCheck(
                agree=check.agree,
                engines={engine: pairs.tolist() for engine, pairs in check.pairs.items()},
                left_out=check.left_out,
            ),
        )


class Evidence(Answer):
    """One computation that bears on a difference."""

    what: str = Field(description="What was computed")
    value: float = Field(description="In the unit given beside it")
    unit: str = Field(description="Unit of the value")


class PaperNumber(Answer):
    """One number that the paper reports, beside ours."""

    quantity: str = Field(description="What it measures")
    unit: str = Field(description="Unit of paper, ours and difference")
    source: str = Field(description="Where it stands in the paper")
    paper: float = Field(description="As the paper reports it, in the unit given beside it")
    ours: float = Field(description="As computed here, in the unit given beside it")
    difference: float = Field(description="Ours minus the paper's, in the unit given beside it")
    reason: str = Field(description="Why the two differ, as far as a computation shows it")
    evidence: list[Evidence] = Field(description="The computations")


class PaperTable(Answer):
    """The paper's reported numbers beside ours."""

    rows: list[PaperNumber] = Field(description="One for each number that the paper reports")


class State(Answer):
    """Is the service alive, and is it ready?"""

    status: str = Field(description="ok or ready")


def columns_json(columns: dict[str, Any], decimals: int | None = None) -> bytes:
    """Columns of numpy as one JSON object; what is no array goes in as it is.

    decimals: of every column but time; None writes the shortest text that reads back as the same double
    """
    for name, column in columns.items():
        if not isinstance(column, np.ndarray):
            continue
        # orjson writes null for NaN; a mistake of ours must be an error instead.
        assert np.isfinite(column).all(), f"{name} must be finite"
        if decimals is not None and name != "time":
            column = np.round(column, decimals) + 0.0
        columns[name] = np.ascontiguousarray(column)
    return orjson.dumps(columns, option=orjson.OPT_SERIALIZE_NUMPY)
