"""The calls about jobs, and `Prefer: respond-async` on every other call."""

from __future__ import annotations

import asyncio
import difflib
import logging
import sqlite3
from collections.abc import AsyncIterator
from hmac import compare_digest
from time import monotonic
from typing import Annotated, Any

import orjson
from fastapi import APIRouter, Body, Depends, Header, Path, Request, Response
from fastapi.responses import FileResponse, StreamingResponse
from starlette.concurrency import run_in_threadpool
from starlette.datastructures import Headers
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from app.jobs.call import Call, ask
from app.jobs.job import ID_PATTERN, Full, FullForClient, FullOfBytes, Job, Room, State
from app.jobs.keeper import Keeper
from app.jobs.questions import ROUTES, call_of
from app.jobs.wire import EVENTS_TYPE, JobList, JobRequest, JobStatus, status
from app.messages import shown
from app.problems import PROBLEM_TYPE, ErrorItem, Refused, http_problem, problem
from app.reply import JSON, LATER, refuse_query, reply_body

logger = logging.getLogger("uvicorn.error")

RESPOND_ASYNC = "respond-async"
# Between two looks for news, and between two signs of life while there are none [s].
LOOK_SECONDS, BEAT_SECONDS = 0.25, 15.0
# When to come again after a refusal for want of room [s].
COME_AGAIN = {"Retry-After": "60"}
NOT_KEPT = {"Cache-Control": "no-store"}
PROBLEM_REF = {PROBLEM_TYPE: {"schema": {"$ref": "#/components/schemas/Problem"}}}
PROBLEMS = {
    400: "The body is not JSON",
    401: "The token of this service is missing",
    403: "This service lists no jobs",
    404: "There is no such job, or no such format",
    406: "The question has no answer in this form",
    409: "The job is not finished",
    410: "The result is gone, or there will be none",
    413: "The body is too long",
    415: "The body is not of type application/json",
    422: "A value is outside its limits, or a name is unknown",
    429: "This client has as many unfinished jobs as it may",
    500: "The service failed",
    503: "No more jobs are taken now",
    507: "The data folder is full",
}


def keeper_of(request: Request) -> Keeper:
    """raises: Refused (503) where there are no jobs"""
    keeper: Keeper | str = request.app.state.jobs
    if isinstance(keeper, str):
        raise Refused(503, f"This service takes no jobs: {keeper}.", headers=COME_AGAIN)
    return keeper


def guard(request: Request) -> None:
    """raises: Refused (401) without the token of this service, if it has one"""
    token = request.app.state.settings.token
    kind, _, given = request.headers.get("authorization", "").partition(" ")
    if token and not (kind.lower() == "bearer" and compare_digest(given.strip().encode(), token.encode())):
        detail = "Jobs need the token of this service: send the header Authorization: Bearer TOKEN."
        challenge = {"WWW-Authenticate": 'Bearer realm="bench-dragon"'}
        raise Refused(401, detail, [ErrorItem(name="Authorization", detail=detail)], challenge)


def take(request: Request, call: Call, question: str) -> Response:
    """A new job for a call whose values are right. raises: Refused where there is no room"""
    keeper = keeper_of(request)
    limits = keeper.settings
    client = request.client.host if request.client else ""
    try:
        room = Room(limits.jobs_max, limits.jobs_client_max, limits.jobs_bytes_max)
        job = keeper.store.create(question, call.to_bytes(), client, room)
    except FullForClient as error:
        detail = f"{limits.jobs_client_max} of your jobs are not finished, as many as may: wait for one or dismiss one."
        raise Refused(429, detail, headers=COME_AGAIN) from error
    except FullOfBytes as error:
        detail = "The jobs that are kept take all the room that they may: remove those that you do not need."
        raise Refused(507, detail) from error
    except Full as error:
        detail = f"{limits.jobs_max} jobs are kept, as many as may: remove those that you do not need, or come later."
        raise Refused(503, detail, headers=COME_AGAIN) from error
    keeper.hurry()
    root = request.scope.get("root_path", "")
    headers = {**NOT_KEPT, "Location": f"{root}/jobs/{job.id}", "Preference-Applied": RESPOND_ASYNC}
    return Response(status(job, root), 202, headers, JSON)


class RespondAsync:
    """Makes a job of a question with `Prefer: respond-async`.

    Wrong values are refused at once, what the client has already is 304, and other calls are answered as ever.
    """

    def __init__(self, app: ASGIApp) -> None:
        self.app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http" or not prefers_later(Headers(scope=scope)):
            return await self.app(scope, receive, send)
        parts: list[bytes] = []
        later: list[str] = []

        async def noted() -> Message:
            message = await receive()
            parts.append(message.get("body", b""))
            return message

        async def unless_later(message: Message) -> None:
            if not later:
                await send(message)

        scope[LATER] = later
        await self.app(scope, noted, unless_later)
        if not later:
            return None
        request = Request(scope)
        try:
            guard(request)
            response = await run_in_threadpool(take, request, Call.of(scope, b"".join(parts)), later[0])
        except Refused as refused:
            response = await http_problem(request, refused)
        except sqlite3.Error as error:
            response = await store_problem(request, error)
        return await response(scope, receive, send)


def prefers_later(headers: Headers) -> bool:
    """Does the client prefer a job to a wait (RFC 7240)?"""
    wishes = ",".join(headers.getlist("prefer")).split(",")
    return any(wish.partition(";")[0].strip().lower() == RESPOND_ASYNC for wish in wishes)


async def store_problem(request: Request, error: Exception) -> Response:
    """The answer where SQLite cannot write or read: the disk is full, or it fails."""
    if getattr(error, "sqlite_errorcode", None) == sqlite3.SQLITE_FULL:
        detail = "The disk of the data folder is full: remove jobs that you do not need, or make room."
        return problem(507, "insufficient-storage", detail)
    logger.error("The store of the jobs failed: %s", error)
    detail = f"The store of the jobs failed ({error}): try again."
    return problem(503, "service-unavailable", detail, headers=COME_AGAIN)


router = APIRouter(prefix="/jobs", tags=["Jobs"])


def told(*statuses: int, **content: Any) -> dict[str, Any]:
    """What OpenAPI says of a call: its problems, and what it answers in place of JSON."""
    problems = {number: {"description": PROBLEMS[number], "content": PROBLEM_REF} for number in statuses}
    answer = {200: {"description": "The answer", "content": content}} if content else {}
    return {"response_class": Response, "responses": {**answer, **problems}}


JobId = Annotated[str, Path(description="Name of the job, the last part of its address", pattern=f"^{ID_PATTERN}$")]


def found(request: Request, job_id: JobId) -> Job:
    """raises: Refused (404) for a job that is not there"""
    job = keeper_of(request).store.get(job_id)
    if job is None:
        detail = f"There is no job {shown(job_id)}: it was removed, or it is too old, or its name is another."
        raise Refused(404, detail)
    return job


KeptKeeper = Annotated[Keeper, Depends(keeper_of)]
Found = Annotated[Job, Depends(found)]
no_query = Depends(refuse_query)


@router.post(
    "",
    status_code=202,
    dependencies=[Depends(guard), Depends(reply_body)],
    **told(400, 401, 404, 406, 413, 415, 422, 429, 500, 503, 507) | {"response_model": JobStatus},
)
async def ask_later(
    request: Request,
    wanted: Annotated[JobRequest, Body(examples=[{"question": "collision_time", "request": {"pitch": 0.5}}])],
) -> Response:
    """Asks a question whose answer is worked out later; Location is the address of its job."""
    if wanted.question not in ROUTES:
        near = difflib.get_close_matches(wanted.question, ROUTES, n=1)
        advice = f"did you mean {near[0]}?" if near else f"it must be one of {', '.join(sorted(ROUTES))}"
        detail = f"question {shown(wanted.question)} is unknown here: {advice}"
        raise Refused(422, detail, [ErrorItem(pointer="/question", detail=detail)])
    wishes = {"prefer": RESPOND_ASYNC, "authorization": request.headers.get("authorization", "")}
    try:
        call = call_of(wanted.question, wanted.request, wanted.accept)
        answer = await ask(
            request.app, call, wishes, {name: request.scope.get(name) for name in ("client", "root_path")}
        )
    except UnicodeEncodeError as error:
        detail = f"the request holds a character that no call takes: {error.reason}"
        raise Refused(422, detail, [ErrorItem(pointer="", detail=detail)]) from error
    if answer.status >= 400:
        answer.body = placed(answer.body)
    del answer.headers["content-length"]
    return Response(answer.body, answer.status, dict(answer.headers))


def placed(said: bytes) -> bytes:
    """A problem of the call as a problem of the request that holds it."""
    known = orjson.loads(said)
    for item in known["errors"]:
        name = item.pop("name", None)
        if name == "Accept":
            item["pointer"] = "/accept"
        elif name is not None or "pointer" in item:
            item["pointer"] = "/request" + (f"/{name}" if name else item.get("pointer", ""))
    return orjson.dumps(known)


@router.get("", dependencies=[Depends(guard), no_query], **told(401, 403, 422, 500, 503) | {"response_model": JobList})
def list_jobs(request: Request, keeper: KeptKeeper) -> Response:
    """All jobs, for whoever has the token; a service without a token lists none."""
    if not keeper.settings.token:
        raise Refused(403, "This service has no token, so it lists no jobs: keep the address that Location gave you.")
    root = request.scope.get("root_path", "")
    listed = b",".join(status(job, root) for job in keeper.store.all())
    return Response(b'{"jobs":[' + listed + b"]}", headers=NOT_KEPT, media_type=JSON)


@router.get("/{job_id}", dependencies=[no_query], **told(404, 422, 500, 503) | {"response_model": JobStatus})
def job(request: Request, found: Found) -> Response:
    """How far a job is."""
    return Response(status(found, request.scope.get("root_path", "")), headers=NOT_KEPT, media_type=JSON)


@router.delete(
    "/{job_id}",
    dependencies=[no_query],
    **told(404, 422, 500, 503, 507) | {"response_model": JobStatus},
)
def dismiss(request: Request, keeper: KeptKeeper, found: Found) -> Response:
    """Dismisses a job that is not finished; removes a finished one with all that is known of it (204)."""
    if keeper.store.dismiss(found.id):
        return job(request, keeper.store.get(found.id) or found)
    keeper.store.remove(found.id)
    return Response(status_code=204)


@router.get(
    "/{job_id}/result",
    dependencies=[no_query],
    **told(404, 409, 410, 422, 500, 503, **{"*/*": {"schema": {}}}),
)
def result(keeper: KeptKeeper, found: Found) -> Response:
    """What the call itself would have answered, to the byte; of a failed job its problem."""
    if not found.is_finished:
        detail = f"The job is {found.state}, so it has no result yet: ask again, or follow its events."
        raise Refused(409, detail, headers={"Retry-After": "1"})
    if found.problem is not None:
        known = orjson.loads(found.problem)
        return Response(found.problem, known["status"], NOT_KEPT, PROBLEM_TYPE)
    file = keeper.store.result(found.id)
    if found.state is State.DISMISSED or found.expired or not file.is_file():
        why = "The job was dismissed" if found.state is State.DISMISSED else "The result has expired"
        raise Refused(410, f"{why}: there is no result, ask the question again.")
    return FileResponse(file, headers=NOT_KEPT, media_type=found.media_type)


@router.get(
    "/{job_id}/events",
    dependencies=[no_query],
    **told(404, 422, 500, 503, **{EVENTS_TYPE: {"schema": {"type": "string"}}}),
)
async def events(
    keeper: KeptKeeper,
    found: Found,
    last_event_id: Annotated[str, Header(description="Number of the last event that the client has")] = "0",
) -> Response:
    """The status of a job at every change, as server-sent events, until it is finished."""
    after = int(last_event_id) if last_event_id.isascii() and last_event_id.isdigit() else 0
    if found.is_finished and not await run_in_threadpool(keeper.store.events, found.id, after):
        return Response(status_code=204)  # The word for a browser not to come again.
    if not keeper.free.acquire(blocking=False):
        detail = (
            f"{keeper.settings.jobs_listeners_max} clients follow jobs, as many as may: ask for the status instead."
        )
        raise Refused(503, detail, headers=COME_AGAIN)
    return News(keeper, found.id, after)


class News(StreamingResponse):
    """Events of a job after one of them as they happen, until it is finished, it is gone, or the service ends."""

    def __init__(self, keeper: Keeper, job: str, after: int) -> None:
        self.keeper, self.job, self.latest = keeper, job, after
        super().__init__(self.told(), headers={**NOT_KEPT, "X-Accel-Buffering": "no"}, media_type=EVENTS_TYPE)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        try:
            await super().__call__(scope, receive, send)
        finally:
            self.keeper.free.release()

    async def told(self) -> AsyncIterator[bytes]:
        store, beat = self.keeper.store, monotonic()
        yield b"retry: 1000\n\n"
        while not self.keeper.leaving.is_set():
            known = await run_in_threadpool(store.get, self.job)
            # Asked for after the status, so that of a finished job none is missing.
            for number, data in await run_in_threadpool(store.events, self.job, self.latest):
                yield b"id: %d\ndata: %b\n\n" % (number, data)
                self.latest, beat = number, monotonic()
            if known is None or known.is_finished:
                return
            if monotonic() - beat >= BEAT_SECONDS:
                yield b": it goes on\n\n"
                beat = monotonic()
            await asyncio.sleep(LOOK_SECONDS)
