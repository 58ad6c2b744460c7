"""The calls about jobs, and jobs for clients that prefer them (Prefer: respond-async)."""

from __future__ import annotations

import asyncio
import difflib
import errno
import io
import math
import os
import re
import sqlite3
from collections.abc import AsyncIterator
from contextlib import suppress
from functools import partial
from pathlib import Path as FilePath
from time import monotonic
from typing import Annotated, Any

import orjson
from fastapi import APIRouter, Body, Depends, Header, Path, Request, Response
from fastapi.responses import FileResponse, JSONResponse, StreamingResponse
from pydantic import BaseModel, ValidationError
from starlette.concurrency import run_in_threadpool
from starlette.datastructures import Headers
from starlette.types import Receive, Scope, Send

from app.files.tables import PARQUET_TYPE
from app.jobs.job import (
    GAVE_WAY,
    ID_PATTERN,
    SWEEP,
    Full,
    FullForClient,
    FullOfBytes,
    Job,
    JobState,
    KeptByClient,
)
from app.jobs.keeper import Keeper
from app.jobs.task import Task, cost_of
from app.questions.registry import CALLS, QUESTIONS
from app.service import routes
from app.service.bodies import BodyRoute, refuse_query, reply_body
from app.service.clients import client_of
from app.service.job_bodies import (
    EVENTS_TYPE,
    SWEEP_EXAMPLE,
    SWEEP_FORMS,
    JobList,
    JobRequest,
    JobStatus,
    SweepRequest,
    pointer_in_sweep,
    status,
)
from app.service.negotiation import RESPOND_ASYNC, accepted, form_of
from app.service.problems import Refused, problem, response_of
from app.service.token import TOKEN, WITHOUT, guard
from app.settings import Settings
from app.sweeps.spec import Spec
from app.wire.faults import in_body, misfit_problem
from app.wire.fields import check_limit, short_json
from app.wire.problem import PROBLEM_TYPE, item_of
from app.wire.question import JSON, FileFormat
from core import BenchDragonError
from core.language import Listed, counted, phrase, say, spoken
from core.quantities import Given, Quantity

# Time between two checks for news, and between two signs of life while there are none [s].
LOOK_SECONDS, BEAT_SECONDS = 0.25, 15.0
# Time after which a client may ask again when there was no room [s].
COME_AGAIN = {"Retry-After": "60"}
MAKE_ROOM = phrase("remove jobs that you do not need, or make room.")
# Number of an event in a client's header; longer numbers are not ours, and SQLite cannot store them.
EVENT_ID = re.compile(r"[0-9]{1,18}")
# One range of bytes, from a first one on.
RANGE = re.compile(r"bytes=([0-9]{1,18})-([0-9]{0,18})")
NOT_KEPT = {"Cache-Control": "no-store"}
# Results up to this size are read before the answer begins, so that an expiry does not interrupt the answer [bytes].
READ_AT_ONCE = 1_000_000
# Every form that a result may have.
# Most cells of a table that is written in another form for each client who asks: 40 MB of JSON, a second.
CELLS_MOST = 2_000_000
RESULT_FORMS = sorted({*SWEEP_FORMS, *(form for one in QUESTIONS.values() for form in one.forms)})
RESULT = routes.ANY_FILE | {form: routes.SCHEMAS.get(form, routes.FILE) for form in RESULT_FORMS}
PROBLEMS = routes.PROBLEMS | {
    403: "This service lists no jobs",
    404: "There is no such job, or no such format",
    406: "The question has no answer in this form",
    409: "The job is not finished",
    410: "The result is removed, or there will be none",
    413: "The body is too long, or the table for this form",
    422: "A value is outside its limits, or a name is unknown",
    429: "This client has reached its limit of unfinished or kept jobs",
    503: "No more jobs are accepted now",
    507: "The data folder is full",
}


def keeper_of(request: Request) -> Keeper:
    """The keeper of the jobs. raises: Refused (503) if the service has none"""
    keeper: Keeper | str = request.app.state.jobs
    if isinstance(keeper, str):
        raise Refused(503, "This service takes no jobs: {why}.", None, COME_AGAIN, why=keeper)
    return keeper


def fault_of(jobs: Keeper | str) -> str:
    """Why no job can be kept, without the names of folders; empty: nothing is wrong. jobs: as in the app's state"""
    if isinstance(jobs, str):
        return "the data folder cannot be used"
    try:
        jobs.store.check()
        if jobs.store.is_full:
            return "the disk of the data folder is full"
    except OSError as error:
        return error.strerror or type(error).__name__
    except sqlite3.Error as error:
        return str(error)
    return ""


def take(request: Request, task: Task, cost: float) -> Response:
    """A new job. cost: estimated time of its run [s]; raises: Refused if there is no room"""
    keeper = keeper_of(request)
    try:
        job = keeper.store.create(task.call, task.to_bytes(), client_of(request), keeper.settings, cost)
    except Full as error:
        raise full(error, keeper.settings) from error
    except OSError as error:
        raise store_refusal(keeper, error) from error
    keeper.hurry()
    root = request.scope.get("root_path", "")
    headers = {**NOT_KEPT, "Location": f"{root}/jobs/{job.id}", "Preference-Applied": RESPOND_ASYNC}
    return Response(status(job, root), 202, headers, JSON)


def store_refusal(keeper: Keeper, error: OSError) -> Refused:
    """The refusal of a call while the store cannot be used, without the names of folders; the fault is logged."""
    if error.errno == errno.ENOSPC:
        return Refused(507, f"The disk of the data folder is full: {MAKE_ROOM}")
    keeper.faults.log(str(error))
    return Refused(503, "This service takes no jobs now: the store of the jobs failed.", None, COME_AGAIN)


def full(error: Full, limits: Settings) -> Refused:
    """The refusal of a job for which there is no room, with the time after which there will be some."""
    after, values, again = {}, dict[str, Any](), "."
    if math.isfinite(error.seconds):
        values["seconds"], again = Quantity(max(math.ceil(error.seconds), 1), "s"), ", or try again in {seconds}."
        after = {"Retry-After": str(values["seconds"].value)}
    values["reason"] = f"none gives way to yours yet; remove some{again}"
    match error:
        case FullForClient():
            count = counted(limits.jobs_client_max, "{count} unfinished job", "{count} unfinished jobs")
            values["most"] = Quantity(limits.jobs_client_max, "", text=count)
            values["reason"] = f"wait for one, or dismiss it{again}"
            return Refused(429, "Your limit of {most} is reached", None, after, **values)
        case KeptByClient():
            values |= {
                "most": _kept(limits.jobs_client_kept_max),
                "bytes": Quantity(limits.jobs_client_bytes_max, "bytes"),
            }
            return Refused(429, "Your limit of {most} and {bytes} is reached", None, after, **values)
        case FullOfBytes():
            return Refused(507, "The kept jobs take all the room that they may have", None, after, **values)
    values["most"] = _kept(limits.jobs_max)
    return Refused(503, "The limit of {most} is reached", None, after or COME_AGAIN, **values)


def _kept(most: int) -> Quantity:
    return Quantity(most, "", text=counted(most, "{count} kept job", "{count} kept jobs"))


def later(request: Request, task: Task, cost: float) -> Response:
    """A new job for a question whose client prefers a job. raises: Refused"""
    guard(request)
    return take(request, task, cost)


async def store_problem(request: Request, error: Exception) -> Response:
    """The answer if SQLite cannot write or read: the disk is full or fails."""
    if getattr(error, "sqlite_errorcode", None) == sqlite3.SQLITE_FULL:
        words = "removing a job needs some room too: free some." if request.method == "DELETE" else MAKE_ROOM
        return problem(507, "insufficient-storage", f"The disk of the data folder is full: {words}")
    keeper_of(request).faults.log(str(error))
    words = "The store of the jobs failed ({why}): try again."
    return problem(503, "service-unavailable", words, headers=COME_AGAIN, why=str(error))


REMOVED, NO_NEWS = "The job was finished and is removed", "The job is finished, and the client has its last event"
router = APIRouter(prefix="/jobs", tags=["Jobs"])
# The calls that make jobs: their bodies may be large.
asking = APIRouter(tags=["Jobs"], route_class=BodyRoute)


def description_of(
    name: str, *statuses: int, model: type[BaseModel] | None = None, content: Any = None, empty: str = ""
) -> dict[str, Any]:
    """OpenAPI description of a call: operation id, problems, media type if not JSON, reason of an empty answer."""
    answer: dict[int, Any] = {200: {"description": "The answer", "content": content}} if content else {}
    answer |= {204: {"description": empty}} if empty else {}
    return {
        "operation_id": name,
        "summary": name.replace("_", " ").capitalize(),
        "response_class": Response if model is None else JSONResponse,  # FastAPI writes no schema for a plain Response.
        "response_model": model,
        "responses": {**answer, **routes.refusals(statuses, PROBLEMS)},
        "openapi_extra": {"security": WITHOUT if 401 in statuses else []},
    }


JobId = Annotated[str, Path(description="Name of the job, the last part of its address", pattern=f"^{ID_PATTERN}$")]


def job_of(request: Request, job_id: JobId) -> Job:
    """The job with that name. raises: Refused (404) if there is none"""
    keeper = keeper_of(request)
    try:
        keeper.store.check_file()
    except OSError as error:
        raise store_refusal(keeper, error) from error
    job = keeper.store.get(job_id)
    if job is None:
        words = "There is no job {job}: it was removed, it has expired, or its ID is wrong."
        raise Refused(404, words, job=short_json(job_id))
    return job


KeptKeeper = Annotated[Keeper, Depends(keeper_of)]
RequestedJob = Annotated[Job, Depends(job_of)]
no_query = Depends(refuse_query)


@asking.post(
    "/jobs",
    status_code=202,
    dependencies=[TOKEN, Depends(guard), Depends(reply_body)],
    **description_of("ask_later", 400, 401, 404, 406, 413, 415, 422, 429, 500, 503, 507, model=JobStatus),
)
def ask_later(
    request: Request,
    inputs: Annotated[JobRequest, Body(examples=[{"question": "collision_time", "request": {"pitch": 0.5}}])],
) -> Response:
    """Asks a question to be answered later; Location is the address of its job."""
    if inputs.question not in CALLS:
        near = difflib.get_close_matches(inputs.question, CALLS, n=1)
        advice = "did you mean {near}?" if near else "it must be one of {known}"
        values: dict[str, Any] = {"near": near[0] if near else "", "known": Listed(sorted(CALLS))}
        values["question"] = short_json(inputs.question)
        raise Refused(422, "question {question} is unknown here", {"pointer": "/question"}, reason=advice, **values)
    call, values = CALLS[inputs.question], dict(inputs.request)
    accept = inputs.accept
    if call.question.formats and "format" in values:  # The format is part of the path of the call.
        accept = format_of(values.pop("format"), call.question.formats)
    form = form_of(accept, call.question.forms, {"pointer": "/accept"})
    try:
        checked = call.request_type.model_validate(values)
    except ValidationError as error:
        faults = [{**one, "loc": ("body", *one["loc"])} for one in error.errors()]
        return response_of(misfit_problem(faults, call.request_type, in_body(values, "/request")))
    return take(request, Task(call.name, values, form, spoken()), cost_of(call, checked, form))


@asking.post(
    "/sweeps",
    status_code=202,
    dependencies=[TOKEN, Depends(guard), Depends(reply_body)],
    **description_of(SWEEP, 400, 401, 406, 413, 415, 422, 429, 500, 503, 507, model=JobStatus),
)
def sweep(request: Request, inputs: Annotated[SweepRequest, Body(examples=[SWEEP_EXAMPLE])]) -> Response:
    """Asks one question for many designs; Location is the address of the job whose result is their table."""
    limits: Settings = request.app.state.settings
    form = form_of(inputs.accept, SWEEP_FORMS, {"pointer": "/accept"})
    try:
        spec = Spec.of(inputs.model_dump(exclude={"accept"}))
        check_limit(
            "over",
            "designs must be at most {most} here",
            spec.designs,
            limits.sweep_designs_max,
            "ask for fewer in one sweep",
        )
        check_limit(
            "shard_size",
            "shards must be at most {most} here",
            spec.shards,
            limits.sweep_shards_max,
            "give a larger shard_size",
        )
    except BenchDragonError as error:
        place = pointer_in_sweep(error.field, inputs)
        return problem(422, error.code, error, [item_of(error, pointer=place)])
    return take(request, Task(SWEEP, spec.model_dump(mode="json"), form), spec.designs * spec.asks.seconds)


def format_of(value: Any, formats: type[FileFormat]) -> str:
    """Media type of one of the formats. raises: Refused (422) for another value"""
    try:
        return formats(value).media_type
    except ValueError as error:
        values: dict[str, Any] = {"got": Given(value, short_json(value)), "formats": say(" or ").join(formats)}
        raise Refused(422, "format must be {formats}", {"pointer": "/request/format"}, **values) from error


@router.get(
    "",
    dependencies=[TOKEN, Depends(guard), no_query],
    **description_of("list_jobs", 401, 403, 422, 500, 503, model=JobList),
)
def list_jobs(request: Request, keeper: KeptKeeper) -> Response:
    """All jobs, for clients with the token; a service without a token lists none."""
    if not keeper.settings.token:
        raise Refused(403, "This service has no token, so it lists no jobs: keep the address that Location gave you.")
    root = request.scope.get("root_path", "")
    listed = b",".join(status(job, root) for job in keeper.store.all())
    return Response(b'{"jobs":[' + listed + b"]}", headers=NOT_KEPT, media_type=JSON)


@router.get("/{job_id}", dependencies=[no_query], **description_of("job_status", 404, 422, 500, 503, model=JobStatus))
def job_status(request: Request, job: RequestedJob) -> Response:
    """Status and progress of a job."""
    return Response(status(job, request.scope.get("root_path", "")), headers=NOT_KEPT, media_type=JSON)


@router.delete(
    "/{job_id}",
    dependencies=[no_query],
    **description_of("dismiss_job", 404, 422, 500, 503, 507, model=JobStatus, empty=REMOVED),
)
def dismiss(request: Request, keeper: KeptKeeper, job: RequestedJob) -> Response:
    """Dismisses an unfinished job, or removes a finished one with all its data (204)."""
    if keeper.store.dismiss(job.id):
        return job_status(request, keeper.store.get(job.id) or job)
    keeper.store.remove(job.id)
    return Response(status_code=204)


@router.get(
    "/{job_id}/result",
    dependencies=[no_query],
    **description_of("job_result", 404, 409, 410, 413, 422, 500, 503, content=RESULT),
)
def result(request: Request, keeper: KeptKeeper, job: RequestedJob) -> Response:
    """The answer of the call, with the same bytes as a direct answer; for a failed job its problem.

    The table of a sweep that is kept as Parquet is also there in the other forms of a sweep, by the header Accept.
    """
    if not job.is_finished:
        words = "The job is {state}, so it has no result yet: ask again, or follow its events."
        raise Refused(409, words, None, {"Retry-After": "1"}, state=str(job.state))
    if job.problem is not None:
        fields = orjson.loads(job.problem)
        return Response(job.problem, fields["status"], NOT_KEPT, PROBLEM_TYPE)
    file = keeper.store.result(job.id)
    if job.state is not JobState.DISMISSED and not job.expired:
        with suppress(FileNotFoundError):  # The file may be removed at any time.
            if job.question == SWEEP and job.media_type == PARQUET_TYPE:
                form = accepted(request.headers.get("accept"), SWEEP_FORMS) or PARQUET_TYPE
                if form != PARQUET_TYPE:
                    return Response(_rows_as(form, file), headers=NOT_KEPT | {"Vary": "Accept"}, media_type=form)
            # A player jumps to another time of a film by a range of its bytes.
            if file.stat().st_size > READ_AT_ONCE or str(job.media_type).startswith("video/"):
                return RangedResult(file, headers=NOT_KEPT, media_type=job.media_type)
            return Response(file.read_bytes(), headers=NOT_KEPT, media_type=job.media_type)
    why = "The job was dismissed" if job.state is JobState.DISMISSED else "The result has expired"
    why = "The result gave way to newer jobs" if job.expired == GAVE_WAY else why
    raise Refused(410, f"{why}: there is no result, ask the question again.")


def _rows_as(form: str, file: FilePath) -> bytes:
    """The table of a sweep in another form. raises: Refused (413) for a large one; FileNotFoundError"""
    from app.sweeps.table import cells_of, rows_of, write_rows  # The import takes 0.3 s, and no other call needs it.

    cells = cells_of(file)
    if cells > CELLS_MOST:
        words = "The table has {cells} cells, and other forms at most {most}: take it as Parquet."
        raise Refused(413, words, None, cells=cells, most=CELLS_MOST)
    sink = io.BytesIO()
    write_rows(sink, form, partial(rows_of, file), "")
    return sink.getvalue()


@router.get(
    "/{job_id}/events",
    dependencies=[no_query],
    **description_of(
        "job_events", 404, 422, 500, 503, content={EVENTS_TYPE: {"schema": {"type": "string"}}}, empty=NO_NEWS
    ),
)
async def events(
    keeper: KeptKeeper,
    job: RequestedJob,
    last_event_id: Annotated[str, Header(description="Number of the last event that the client has")] = "0",
) -> Response:
    """The status of a job at every change, as server-sent events, until it is finished."""
    after = int(last_event_id) if EVENT_ID.fullmatch(last_event_id) else 0
    if job.is_finished and not await run_in_threadpool(keeper.store.events, job.id, after):
        return Response(status_code=204)  # It tells a browser not to connect again.
    if not keeper.free.acquire(blocking=False):
        words = "{most} clients follow jobs, which is the limit: ask for the status."
        raise Refused(503, words, None, COME_AGAIN, most=keeper.settings.jobs_listeners_max)
    return EventStream(keeper, job.id, after)


class RangedResult(FileResponse):
    """A file, or one range of its bytes; any other Range is ignored, as HTTP allows: a refusal would have no words."""

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        span = RANGE.fullmatch(Headers(scope=scope).get("range", ""))
        size = os.stat(self.path).st_size
        if not (span and int(span[1]) < size and int(span[1]) <= int(span[2] or size)):
            scope = {**scope, "headers": [one for one in scope["headers"] if one[0] != b"range"]}
        await super().__call__(scope, receive, send)


class EventStream(StreamingResponse):
    """Events of a job after a given one, as they happen, until the job is finished or removed, or the service ends."""

    def __init__(self, keeper: Keeper, job: str, after: int) -> None:
        self.keeper, self.job, self.latest = keeper, job, after
        super().__init__(self.blocks(), headers={**NOT_KEPT, "X-Accel-Buffering": "no"}, media_type=EVENTS_TYPE)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        self.is_head = scope.get("is_head", False)
        try:
            await super().__call__(scope, receive, send)
        finally:
            self.keeper.free.release()

    async def blocks(self) -> AsyncIterator[bytes]:
        store, beat = self.keeper.store, monotonic()
        yield b"retry: 1000\n\n"
        while not self.is_head and not self.keeper.leaving.is_set():
            job = await run_in_threadpool(store.get, self.job)
            # Read after the status, so that no event of a finished job is missing.
            for number, data in await run_in_threadpool(store.events, self.job, self.latest):
                yield b"id: %d\ndata: %b\n\n" % (number, data)
                self.latest, beat = number, monotonic()
            if job is None or job.is_finished:
                return
            if monotonic() - beat >= BEAT_SECONDS:
                yield b": it goes on\n\n"
                beat = monotonic()
            await asyncio.sleep(LOOK_SECONDS)
