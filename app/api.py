"""The calls that answer in numbers: to core, call, from core."""

from __future__ import annotations

from collections.abc import Callable
from importlib.util import find_spec
from typing import Annotated, Any

from fastapi import APIRouter, Body, Query, Response

import core
from app import paper, tables
from app.answers import (
    ClearanceTable,
    CollisionTime,
    MinimumPitch,
    OverlapsAnswer,
    PaperTable,
    PitchScanTable,
    TrajectoryTable,
    columns_json,
)
from app.examples import EXAMPLES
from app.problems import PROBLEM_TYPE
from app.reply import JSON, BodyReply, QueryReply
from app.report import MaximumHeadSpeed, Report, ShortestTurn, Turn
from app.schemas import (
    CheckRequest,
    ClearanceQuery,
    ClearanceRequest,
    CollisionQuery,
    MaximumHeadSpeedQuery,
    MinimumPitchQuery,
    Nothing,
    OverlapsRequest,
    PitchScanQuery,
    ShortestTurnQuery,
    TrajectoryRequest,
    TurnQuery,
)
from app.settings import check_limit
from core.design.pitch_scan import scan_near_minimum

router = APIRouter()

PROBLEM_REF = {PROBLEM_TYPE: {"schema": {"$ref": "#/components/schemas/Problem"}}}
FILE = {"schema": {"type": "string", "format": "binary"}}
PROBLEMS = {
    400: "The body is not JSON",
    404: "There is no such format",
    406: "Accept asks for a form that this call does not answer in",
    413: "The body is too long",
    415: "The body is not of type application/json",
    422: "A value is outside its limits, a name is unknown, or an instant lies after the end of the run",
    500: "The service failed",
    503: "As many computations run as may run at once",
}
DEFAULT_TRAJECTORY = TrajectoryRequest()
DEFAULT_CLEARANCE = ClearanceRequest()
DEFAULT_CHECK = CheckRequest()
QUERY_STATUSES = (406, 422, 500, 503)
BODY_STATUSES = (400, 406, 413, 415, 422, 500, 503)


def documented(call: str, model: Any, statuses: tuple[int, ...], **content: Any) -> dict[str, Any]:
    """What OpenAPI says of a call, "GET /path": its answer, in JSON with an example or as a file, and its problems."""
    path = call.split()[1]
    if model is not None:
        content[JSON] = {"example": EXAMPLES[call].answer}
    answer = {"description": "The answer", "content": content, "model": model}
    unchanged = {304: {"description": "The client has this answer already (If-None-Match)"}}
    problems = {status: {"description": PROBLEMS[status], "content": PROBLEM_REF} for status in statuses}
    return {
        "path": path,
        "tags": ["Questions" if model is not None else "Figures"],
        "response_class": Response,
        "responses": {200: answer, **unchanged, **problems},
    }


def _trajectory_json(found: core.Trajectory, decimals: int | None) -> bytes:
    x, y = found.position[..., 0], found.position[..., 1]
    return columns_json({"time": found.time, "x": x, "y": y, "speed": found.speed}, decimals)


def _workbook(found: core.Trajectory, decimals: int | None) -> bytes:
    return tables.trajectory_xlsx(found, decimals=tables.XLSX_DECIMALS if decimals is None else decimals)


TABLES: dict[str, Callable[[core.Trajectory, int | None], bytes]] = {
    JSON: _trajectory_json,
    tables.CSV_TYPE: lambda found, decimals: tables.trajectory_csv(found, decimals=decimals),
    tables.XLSX_TYPE: _workbook,
}
if find_spec("pyarrow"):
    TABLES[tables.ARROW_TYPE] = lambda found, decimals: tables.trajectory_arrow(found, decimals=decimals)


@router.post(
    **documented(
        "POST /trajectory",
        TrajectoryTable,
        BODY_STATUSES,
        **{kind: FILE for kind in TABLES if kind != JSON},
    )
)
def trajectory(
    reply: BodyReply,
    wanted: Annotated[TrajectoryRequest, Body(examples=[EXAMPLES["POST /trajectory"].body])] = DEFAULT_TRAJECTORY,
) -> Response:
    """Position and speed of every handle at every instant."""
    media_type = reply.media_type(tuple(TABLES))

    def compute() -> bytes:
        limits = reply.settings
        cells_max = limits.workbook_cells_max if media_type == tables.XLSX_TYPE else limits.cells_max
        dragon = wanted.dragon.to_dragon(limits.benches_max)
        path = wanted.path.to_path()
        times = wanted.to_times(dragon, path, cells_max)
        found = core.trajectory(core.Dance(dragon, path, wanted.head_speed), times)
        return TABLES[media_type](found, wanted.decimals)

    return reply(wanted, compute, media_type)


@router.get(**documented("GET /collision-time", CollisionTime, QUERY_STATUSES))
def collision_time(reply: QueryReply, wanted: Annotated[CollisionQuery, Query()]) -> Response:
    """When two benches that share no handle first touch or come nearer than a margin, and how that is known."""

    def compute() -> bytes:
        dragon, path = wanted.to_dragon(reply.settings.benches_max), wanted.to_path()
        found = core.first_contact(core.Dance(dragon, path, wanted.head_speed), margin=wanted.margin)
        return CollisionTime.of(found, dragon, path, wanted).to_json()

    return reply(wanted, compute)


@router.get(**documented("GET /minimum-pitch", MinimumPitch, QUERY_STATUSES))
def minimum_pitch(reply: QueryReply, wanted: Annotated[MinimumPitchQuery, Query()]) -> Response:
    """The smallest pitch such that every larger one reaches the circle with no touch, or no two within a margin."""

    def compute() -> bytes:
        dragon, radius = wanted.to_dragon(reply.settings.benches_max), wanted.turning_diameter / 2
        found = core.minimum_pitch(dragon, turning_radius=radius, start_turns=wanted.start_turns, margin=wanted.margin)
        return MinimumPitch.of(found, dragon, wanted).to_json()

    return reply(wanted, compute)


@router.get(**documented("GET /pitch-scan", PitchScanTable, QUERY_STATUSES))
def pitch_scan(reply: QueryReply, wanted: Annotated[PitchScanQuery, Query()]) -> Response:
    """Where the head stands at first contact, against the pitch, around the minimum pitch."""

    def compute() -> bytes:
        scan, least = scan_near_minimum(
            wanted.to_dragon(reply.settings.scanned_benches_max),
            turning_radius=wanted.turning_diameter / 2,
            start_turns=wanted.start_turns,
            margin=wanted.margin,
            samples=wanted.samples,
            progress=reply.progress,
        )
        table = {"pitch": scan.pitch, "radius": scan.radius, "pieces": scan.pieces}
        return columns_json(table | {"minimum_pitch": least.pitch})

    return reply(wanted, compute)


def _clearance_json(found: core.ClearanceProfile) -> bytes:
    columns = {"time": found.time, "clearance": found.clearance, "benches": found.benches}
    return columns_json(columns | {"grazes": found.grazes})


@router.get(**documented("GET /clearance", ClearanceTable, QUERY_STATUSES))
def clearance(reply: QueryReply, wanted: Annotated[ClearanceQuery, Query()]) -> Response:
    """Smallest separation of two benches that are no neighbours, and whose, at every instant, on a spiral."""

    def compute() -> bytes:
        dragon = wanted.to_dragon(reply.settings.benches_max)
        times = wanted.to_times(dragon.benches + 1, reply.settings.cells_max)
        return _clearance_json(core.clearance_profile(core.Dance(dragon, wanted.to_path(), wanted.head_speed), times))

    return reply(wanted, compute)


@router.post(**documented("POST /clearance", ClearanceTable, BODY_STATUSES))
def path_clearance(
    reply: BodyReply,
    wanted: Annotated[ClearanceRequest, Body(examples=[EXAMPLES["POST /clearance"].body])] = DEFAULT_CLEARANCE,
) -> Response:
    """Smallest separation of two benches that are no neighbours, and whose, at every instant, on any path."""

    def compute() -> bytes:
        dragon = wanted.dragon.to_dragon(reply.settings.checked_benches_max)
        path = wanted.path.to_path()
        times = wanted.to_times(dragon, path, reply.settings.cells_max)
        return _clearance_json(core.clearance_profile(core.Dance(dragon, path, wanted.head_speed), times))

    return reply(wanted, compute)


@router.get(**documented("GET /turn", Turn, QUERY_STATUSES))
def turn(reply: QueryReply, wanted: Annotated[TurnQuery, Query()]) -> Response:
    """Two tangent arcs that lead from a spiral inwards to the same one outwards."""
    return reply(wanted, lambda: Turn.of(wanted.to_turn()).to_json())


@router.get(**documented("GET /shortest-turn", ShortestTurn, QUERY_STATUSES))
def shortest_turn(reply: QueryReply, wanted: Annotated[ShortestTurnQuery, Query()]) -> Response:
    """The turn that begins as deep inside its circle as the dragon can dance, and what keeps it from going deeper."""

    def compute() -> bytes:
        return ShortestTurn.of_shortest(wanted.to_shortest_turn(reply.settings.checked_benches_max)).to_json()

    return reply(wanted, compute)


@router.get(**documented("GET /maximum-head-speed", MaximumHeadSpeed, QUERY_STATUSES))
def maximum_head_speed(reply: QueryReply, wanted: Annotated[MaximumHeadSpeedQuery, Query()]) -> Response:
    """The largest constant head speed at which no handle ever exceeds the limit on the way through a turn."""

    def compute() -> bytes:
        dragon, path = wanted.to_dragon(reply.settings.checked_benches_max), wanted.to_turn()
        return MaximumHeadSpeed.model_validate(
            core.maximum_head_speed(core.Dance(dragon, path), wanted.speed_limit)
        ).to_json()

    return reply(wanted, compute)


@router.post(**documented("POST /check", Report, BODY_STATUSES))
def check(
    reply: BodyReply, wanted: Annotated[CheckRequest, Body(examples=[EXAMPLES["POST /check"].body])] = DEFAULT_CHECK
) -> Response:
    """Can the dragon dance this path here: first contact, least clearance, venue, speed, sharpest bend."""

    def compute() -> bytes:
        dragon, path = wanted.dragon.to_dragon(reply.settings.checked_benches_max), wanted.path.to_path()
        place = wanted.to_place(dragon)
        found = wanted.to_report(dragon, path, place)
        return Report.of(found, dragon, path, wanted, place.origin).to_json()

    return reply(wanted, compute)


@router.post(**documented("POST /overlaps", OverlapsAnswer, BODY_STATUSES))
def overlaps(
    reply: BodyReply, wanted: Annotated[OverlapsRequest, Body(examples=[EXAMPLES["POST /overlaps"].body])]
) -> Response:
    """Which benches overlap, or are nearer than a margin, how deep and where, by each of four engines."""

    def compute() -> bytes:
        poses, lengths, widths = wanted.to_poses(reply.settings.poses_max)
        found = core.overlaps(poses, lengths, widths, margin=wanted.margin, chained=wanted.chained)
        check_limit("benches", "overlapping pairs", len(found.pairs), reply.settings.pairs_max, "move them apart")
        check = core.cross_check(poses, lengths, widths, margin=wanted.margin, chained=wanted.chained)
        return OverlapsAnswer.of(found, check).to_json()

    return reply(wanted, compute)


@router.get(**documented("GET /paper", PaperTable, QUERY_STATUSES), name="paper")
def paper_numbers(reply: QueryReply, wanted: Annotated[Nothing, Query()]) -> Response:
    """The paper's reported numbers beside ours, with the reason for each difference."""
    return reply(wanted, lambda: PaperTable.model_validate({"rows": paper.comparison()}).to_json())
