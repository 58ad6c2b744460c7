"""Answers on the wire: small ones are checked against these models before they leave; tables are documented by them.

A trajectory has 200,000 numbers, so tables leave as columns of numpy through orjson, not cell by cell.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Self

import numpy as np
import orjson
from pydantic import BaseModel, ConfigDict, Field

import core
from core import Dragon, Engine, Outcome, Route, Spiral
from core.dragon import Floats
from core.kinematics import earliest_time

# How far the head travels from first contact to the poses that the four engines judge [m]: far above the
# rounding of positions (1e-13 m), far below a bench.
CHECK_TRAVEL = 1e-6
# The same for a pitch [m].
CHECK_PITCH = 1e-6

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
    """Where a run ends on which nothing touches."""

    reason: core.EndReason = Field(
        description="fold: a bench cannot follow any more; centre: the head arrived; end: the path ends; stop: the "
        "time asked for is over"
    )
    time: float = Field(description="[s]")


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
    """Columns: one entry per pitch at which two benches touch, and where the radius jumps."""

    pitch: list[float] = Field(description="Ascending [m]")
    radius: list[float] = Field(description="Distance of the head from the centre at first contact [m]")
    pieces: list[Pair] = Field(description="Continuous stretches, as indices [from, to) into pitch and radius")
    minimum_pitch: float = Field(description="The minimum pitch, around which the pitches lie [m]")


class Certificate(Answer):
    """How the answer is known."""

    method: str = Field(description="The whole claim, and how it is proven, in sentences")
    steps: int = Field(description="Proven steps taken")
    clear_until: float = Field(description="Nothing touches from 0 to here [s]")
    bound: float = Field(description="Largest bound on the second derivative of a gap that a step used [1/m]")
    least_clearance: Graze | None = Field(description="Narrowest graze before the contact, or over the whole run")


class Verdict(Answer):
    """Does an engine find the pair overlapping?"""

    before: bool = Field(description="Just before first contact")
    after: bool = Field(description="Just after first contact")


class PairCheck(Answer):
    """Independent engines on the touching pair, just before and just after."""

    agree: bool = Field(description="All engines asked say the same")
    engines: dict[Engine, Verdict] = Field(
        description="Each engine's verdict; angle_sum knows no margin, so it is asked only where that is 0"
    )

    @classmethod
    def of(cls, before: Floats, after: Floats, dragon: Dragon, benches: Pair, margin: float) -> Self:
        """before, after: (2, 3) poses of the pair"""
        pair = list(benches)
        found = core.verdicts(before, after, dragon.lengths[pair], dragon.widths[pair], margin=margin)
        words = {(verdict.before, verdict.after) for verdict in found.values()}
        return cls(agree=len(words) == 1, engines=found)


def _pair_poses(
    dragon: Dragon, path: Spiral | Route, times: Sequence[float], head_speed: float, benches: Pair
) -> Floats:
    """Poses (T, 2, 3) of two benches at some instants, or at the nearest ones that the run has."""
    front = dragon.leading(benches[1] + 1)  # No bench moves one in front of it.
    first, last = earliest_time(front, path, head_speed), core.run_end(front, path, head_speed=head_speed).time
    held = [min(max(time, first), last) for time in times]
    position = core.trajectory(front, path, held, head_speed=head_speed).position
    return core.bench_poses(position)[:, list(benches)]


class CollisionTime(Answer):
    """When two benches that share no handle first touch."""

    outcome: Outcome = Field(description="How the search ended")
    time: float | None = Field(description="First contact; null when clear or undecided [s]")
    time_bracket: Point | None = Field(description="Proven clear up to, overlapping at [s]")
    head: Head | None = Field(description="The head at that time")
    benches: Pair | None = Field(description="The pair that touches")
    corner: Feature | None = Field(description="The corner that touches")
    edge: Feature | None = Field(description="The edge that it touches")
    point: Point | None = Field(description="Where, x and y [m]")
    end: End | None = Field(description="Where the run ends, when clear")
    certificate: Certificate = Field(description="How the answer is known")
    cross_check: PairCheck | None = Field(description="Engines on the pair 1e-6 m of travel before and after")

    @classmethod
    def of(
        cls, contact: core.FirstContact, dragon: Dragon, path: Spiral | Route, head_speed: float, margin: float
    ) -> Self:
        check = None
        if contact.time is not None and contact.benches is not None:
            times = [contact.time + travel / head_speed for travel in (-CHECK_TRAVEL, CHECK_TRAVEL)]
            before, after = _pair_poses(dragon, path, times, head_speed, contact.benches)
            check = PairCheck.of(before, after, dragon, contact.benches, margin)
        return cls.known(contact, cross_check=check)


class MinimumPitch(Answer):
    """The smallest pitch such that every larger one lets the head reach the turning circle without contact."""

    pitch: float = Field(description="[m]")
    pitch_bracket: Point = Field(description="Infeasible, feasible [m]")
    limited_by: core.LimitedBy = Field(description="A graze on the way, contact on the circle, or the start radius")
    benches: Pair | None = Field(description="The pair that touches just below")
    head_radius: float | None = Field(description="Where the head is then [m]")
    other_feasible_intervals: list[Point] = Field(description="Feasible islands below [m]")
    justified_by: str = Field(description="How it is known that every larger pitch is feasible: bound or scan")
    evaluations: int = Field(description="Ways to the circle, and strips of pitches at once, that were marched")
    cross_check: PairCheck | None = Field(description="Engines on the pair at a pitch 1e-6 m larger and smaller")

    @classmethod
    def of(cls, found: core.MinimumPitch, dragon: Dragon, margin: float) -> Self:
        check = None
        if found.benches is not None and found.head_radius is not None:
            # A spiral that starts at that radius has its head there at time 0.
            pitches = (found.pitch + CHECK_PITCH, found.pitch - CHECK_PITCH)
            spirals = (Spiral(pitch, found.head_radius / pitch) for pitch in pitches)
            before, after = (_pair_poses(dragon, spiral, [0.0], 1.0, found.benches)[0] for spiral in spirals)
            check = PairCheck.of(before, after, dragon, found.benches, margin)
        return cls.known(found, cross_check=check)


class Overlap(Answer):
    """Two benches that overlap. witness_b - witness_a = separation * normal."""

    benches: Pair = Field(description="The pair a, b")
    separation: float = Field(description="Signed: minus the penetration depth when they overlap [m]")
    witness_a: Point = Field(description="Point of a that realises the separation, x and y [m]")
    witness_b: Point = Field(description="Point of b that realises the separation, x and y [m]")
    normal: Point = Field(description="Unit vector from a to b")


class OverlapsCheck(Answer):
    """Independent engines side by side."""

    agree: bool = Field(description="All engines asked found the same pairs")
    engines: dict[Engine, list[Pair]] = Field(description="The pairs that each engine found")
    left_out: list[Engine] = Field(description="Engines that cannot judge this margin, and were not asked")


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
