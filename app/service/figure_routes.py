"""The calls that draw: to core, call, from core."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import APIRouter, Query, Response

from app.files import figures
from app.files.drawing import Format
from app.service.reply import BodyReply, QueryReply
from app.service.routes import BODY_STATUSES, FILE, QUERY_STATUSES, documented
from app.wire.requests import (
    ContactFigureRequest,
    ContactQuery,
    PitchScanQuery,
    TrajectoryFigureQuery,
    TrajectoryFigureRequest,
)

router = APIRouter()

IMAGES = {Format.SVG: "image/svg+xml", Format.PNG: "image/png"}
DEFAULT_TRAJECTORY = TrajectoryFigureRequest()
DEFAULT_CONTACT = ContactFigureRequest()


def drawn(call: str, statuses: tuple[int, ...]) -> dict[str, Any]:
    """What OpenAPI says of a figure."""
    return documented(f"{call}.{{format}}", None, (404, *statuses), **dict.fromkeys(IMAGES.values(), FILE))


@router.get(**drawn("GET /figures/trajectory", QUERY_STATUSES))
def trajectory_figure(reply: QueryReply, format: Format, wanted: Annotated[TrajectoryFigureQuery, Query()]) -> Response:
    """Every handle at one instant, coloured by its speed."""

    def compute() -> bytes:
        dragon, path = wanted.to_dragon(reply.settings.drawn_benches_max), wanted.to_path()
        return figures.trajectory_figure(dragon, path, time=wanted.time, head_speed=wanted.head_speed, format=format)

    return reply(wanted, compute, reply.media_type([IMAGES[format]]))


@router.get(**drawn("GET /figures/contact", QUERY_STATUSES))
def contact_figure(reply: QueryReply, format: Format, wanted: Annotated[ContactQuery, Query()]) -> Response:
    """The dance at first contact, with the pair that touches or is too near marked and enlarged."""

    def compute() -> bytes:
        dragon, path = wanted.to_dragon(reply.settings.drawn_benches_max), wanted.to_path()
        return figures.contact_figure(dragon, path, head_speed=wanted.head_speed, margin=wanted.margin, format=format)

    return reply(wanted, compute, reply.media_type([IMAGES[format]]))


@router.get(**drawn("GET /figures/pitch-scan", QUERY_STATUSES))
def pitch_scan_figure(reply: QueryReply, format: Format, wanted: Annotated[PitchScanQuery, Query()]) -> Response:
    """Where the head stands at first contact, against the pitch: jumps as jumps, the minimum pitch marked."""

    def compute() -> bytes:
        return figures.pitch_scan_figure(
            wanted.to_dragon(reply.settings.drawn_benches_max),
            turning_radius=wanted.turning_diameter / 2,
            start_turns=wanted.start_turns,
            margin=wanted.margin,
            samples=wanted.samples,
            format=format,
        )

    return reply(wanted, compute, reply.media_type([IMAGES[format]]))


@router.post(**drawn("POST /figures/trajectory", BODY_STATUSES))
def path_trajectory_figure(
    reply: BodyReply, format: Format, wanted: TrajectoryFigureRequest = DEFAULT_TRAJECTORY
) -> Response:
    """Every handle at one instant, coloured by its speed, on any path and in any venue."""

    def compute() -> bytes:
        dragon, path = wanted.dragon.to_dragon(reply.settings.drawn_benches_max), wanted.path.to_path()
        return figures.trajectory_figure(
            dragon,
            path,
            venue=wanted.to_place(dragon).venue,
            time=wanted.to_time(dragon, path),
            head_speed=wanted.head_speed,
            format=format,
        )

    return reply(wanted, compute, reply.media_type([IMAGES[format]]))


@router.post(**drawn("POST /figures/contact", BODY_STATUSES))
def path_contact_figure(reply: BodyReply, format: Format, wanted: ContactFigureRequest = DEFAULT_CONTACT) -> Response:
    """The dance at first contact on any path and in any venue, the pair that touches or is too near enlarged."""

    def compute() -> bytes:
        dragon, path = wanted.dragon.to_dragon(reply.settings.checked_benches_max), wanted.path.to_path()
        return figures.contact_figure(
            dragon,
            path,
            venue=wanted.to_place(dragon).venue,
            head_speed=wanted.head_speed,
            margin=wanted.margin,
            start=wanted.to_start(dragon, path),
            stop=wanted.stop,
            format=format,
        )

    return reply(wanted, compute, reply.media_type([IMAGES[format]]))
