"""The service: create_app(settings) assembles the calls, their limits and the middleware.

uvicorn --factory app.service.main:create_app
"""

from __future__ import annotations

import ctypes
import logging
import os
import sqlite3
import sys
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager, closing
from functools import partial
from typing import Any

from fastapi import Depends, FastAPI, Request, Response
from prometheus_client import CollectorRegistry, Counter, Gauge, Histogram, generate_latest
from prometheus_client.exposition import CONTENT_TYPE_LATEST
from prometheus_client.multiprocess import MultiProcessCollector
from pydantic import Field
from starlette.middleware import Middleware

import core
from app.jobs.keeper import kept
from app.service import job_routes as jobs
from app.service import middleware as layers
from app.service import problems, routes, uploads
from app.service.assistants import add_assistants
from app.service.bodies import refuse_query
from app.service.description import with_values
from app.service.examples import EXAMPLES
from app.service.graders import Graders
from app.service.hosts import Hosts
from app.service.job_calls import JobCalls
from app.service.job_metrics import JobMetrics
from app.service.kept_answers import KeptAnswers
from app.service.lanes import Lanes
from app.service.pages import add_pages
from app.service.proxies import Proxies, WholePath
from app.service.request_limits import RequestLimits
from app.service.short_tries import ShortTries
from app.service.version import VERSION, build
from app.settings import SHARED_COUNTS, Settings
from app.wire.fields import Answer
from app.wire.question import JSON
from core import Dragon, Spiral, contact_check, first_contact, trajectory
from core.dance import Dance

logger = logging.getLogger("uvicorn.error")


class State(Answer):
    """State of the service."""

    status: str = Field(description="ok or ready")


DESCRIPTION = """Place and speed of every bench of a bench dragon, first contact of two benches, and the tightest
spiral. SI units and radians throughout. A collision is an answer, never an error; errors are problem details
(RFC 9457). An answer depends on its request alone and carries a strong ETag.
"""
TAGS = {
    "Questions": "Answers in numbers. GET takes a query, POST a body with a dragon and a path.",
    "Figures": "Answers as pictures, films, maps and plans: files.",
    "Grading": "Right and wrong cells of a student's workbook, and the errors behind them.",
    "Maps": "The square and the path in a map file.",
    "Jobs": "Answers computed later; they survive the death of any process.",
    "Service": "Liveness and readiness.",
}

# Known answers for the self-test, computed once in 256-bit ball arithmetic: first contact of the default dance [s]
# and x of its handle 1 at the start [m].
KNOWN_CONTACT = 412.47383768211466
KNOWN_X = 8.363823851392647
KNOWN_TOLERANCE = 1e-9
# Borders of the classes in which memory of readers is counted [bytes].
READER_BYTES = (1e8, 2e8, 3e8, 5e8, 7e8, 1e9, 2e9, 4e9)


def fault() -> str:
    """Fault of this installation's arithmetic; empty if the known answers come out."""
    try:
        return _difference()
    except Exception as error:  # The process must survive any fault to report it at /readyz.
        logger.exception("The self-test failed")
        return type(error).__name__


def _difference() -> str:
    dance = Dance(Dragon(), Spiral())
    x = float(trajectory(dance, [0.0]).position[0, 1, 0])
    first = first_contact(dance)
    contact = first.time
    if abs(x - KNOWN_X) > KNOWN_TOLERANCE:
        return f"x of handle 1 at the start is {x!r} m, expected {KNOWN_X!r} m"
    if contact is None or abs(contact - KNOWN_CONTACT) > KNOWN_TOLERANCE:
        return f"first contact is at {contact!r} s, expected {KNOWN_CONTACT!r} s"
    check = contact_check(first)
    if not (check and check.agree):
        return f"the engines do not agree about the first contact: {check}"
    return ""


@asynccontextmanager
async def _lifespan(app: FastAPI) -> AsyncIterator[None]:
    for name in core.__all__:  # Loading a module at the first request that needs it would delay all other requests.
        getattr(core, name)
    app.state.fault = fault()
    build()
    with kept(app.state.settings) as app.state.jobs, closing(app.state.readers()) as app.state.graders:
        yield


# Longest time for which a thread that runs Python code holds Python's lock while others wait for it [s]. With the
# default of 5 ms, four such threads delayed /healthz by 1.6 s; with this value by 0.8 s, most of it in the client
# (2026-11-22).
SWITCH_SECONDS = 5e-4
# Size from which glibc returns freed blocks to the system [bytes]. By default glibc raises this size to that of the
# largest block freed, 24 MB for a table: five times 24 tables left 847 MB behind, and 206 MB with this fixed size
# (2026-11-22).
RETURNED_BYTES, M_MMAP_THRESHOLD = 1_000_000, -3


def return_memory() -> None:
    """Return the memory of large tables to the system, if the C library is glibc."""
    if sys.platform == "linux" and (mallopt := getattr(ctypes.CDLL(None), "mallopt", None)):
        mallopt(M_MMAP_THRESHOLD, RETURNED_BYTES)


def create_app(settings: Settings | None = None) -> FastAPI:
    """The service with these limits; default: those of the environment."""
    settings = settings or Settings()
    registry = CollectorRegistry()
    app = FastAPI(
        title="Bench Dragon",
        version=VERSION,
        description=DESCRIPTION,
        servers=[{"url": "/", "description": "This service"}],
        license_info={"name": "MIT", "identifier": "MIT"},
        openapi_tags=[{"name": name, "description": words} for name, words in TAGS.items()],
        openapi_url=None,
        docs_url=None,
        redoc_url=None,
        redirect_slashes=False,
        lifespan=_lifespan,
        middleware=[
            Middleware(Proxies, settings=settings),
            *map(Middleware, (layers.Headers, layers.Spoken, layers.HeadAsGet)),
            Middleware(layers.Outcomes, registry=registry),
            Middleware(Hosts, settings=settings),
            Middleware(RequestLimits, settings=settings),
            Middleware(JobCalls, settings=settings),
            Middleware(WholePath),
        ],
    )
    app.state.settings = settings
    app.state.fault = "it has not run"
    app.state.jobs, app.state.later = "it has not started", jobs.later
    app.state.lanes = Lanes(settings, registry)
    app.state.short_tries = ShortTries()
    app.state.answers = KeptAnswers(settings.kept_bytes_max, registry)
    sys.setswitchinterval(SWITCH_SECONDS)
    return_memory()
    app.state.registry = registry
    app.state.readers = partial(Graders, settings.reader_memory_max, _seen_by_readers(settings, registry))
    registry.register(JobMetrics(lambda: app.state.jobs))
    app.openapi = lambda: _openapi(app)  # type: ignore[method-assign]
    problems.install(app)
    routes.add_calls(app.router)
    app.include_router(jobs.asking)
    app.include_router(uploads.grading)
    app.include_router(uploads.maps)
    app.include_router(jobs.router)
    app.add_exception_handler(sqlite3.Error, jobs.store_problem)
    _add_health(app)
    add_assistants(app)
    add_pages(app)
    return app


def _seen_by_readers(settings: Settings, registry: CollectorRegistry) -> Callable[[int | None], None]:
    """What puts the memory of the process of each file into the metrics; None: the file ended it."""
    common: dict[str, Any] = {"registry": registry}
    memory = Histogram(
        "bench_dragon_reader_memory_bytes", "Memory of the process of each file", buckets=READER_BYTES, **common
    )
    ended = Counter("bench_dragon_readers_ended", "Processes that a file ended", **common)
    limit = Gauge(
        "bench_dragon_readers_memory_limit_bytes",
        "Most memory of all processes that read files at once",
        multiprocess_mode="livesum",
        **common,
    )
    limit.set(settings.readers_max * settings.reader_memory_max)
    return lambda peak: ended.inc() if peak is None else memory.observe(peak)


def _openapi(app: FastAPI) -> dict[str, Any]:
    if app.openapi_schema is None:
        schema = app.openapi_schema = with_values(FastAPI.openapi(app))
        # Examples are added here, because FastAPI drops every null in an example that a route declares.
        for name, example in EXAMPLES.items():
            method, path = name.split()
            forms = schema["paths"][path][method.lower()]["responses"]["200"]["content"]
            if JSON in forms:
                forms[JSON]["example"] = example.answer
        # The limit of benches is stated here, because the models are the same for all services of a process.
        fields = [model["properties"] for model in schema["components"]["schemas"].values() if "properties" in model]
        calls = [call for path in schema["paths"].values() for call in path.values()]
        fields += [{one["name"]: one["schema"]} for call in calls for one in call.get("parameters", [])]
        for field in fields:
            if "maximum" in field.get("benches", {}):
                field["benches"]["maximum"] = app.state.settings.benches_max
    return app.openapi_schema or {}


def _add_health(app: FastAPI) -> None:
    described: dict[str, Any] = {
        "response_model": State,
        "dependencies": [Depends(refuse_query)],
        "tags": ["Service"],
        "responses": routes.refusals([422], {422: "Query parameters were given, but this call takes none"}),
        "openapi_extra": {"security": []},
    }

    @app.get("/healthz", operation_id="healthz", summary="Liveness", **described)
    async def healthz(response: Response) -> State:
        """The process answers."""
        response.headers["Cache-Control"] = "no-store"
        return State(status="ok")

    @app.get("/readyz", operation_id="readyz", summary="Readiness", **described)
    def readyz(request: Request, response: Response) -> State:
        """This installation gives the known answers of the self-test, and the store of its jobs can be used."""
        if request.app.state.fault:
            raise problems.Refused(503, "The self-test failed: {why}.", why=str(request.app.state.fault))
        if fault_of_jobs := jobs.fault_of(request.app.state.jobs):
            raise problems.Refused(503, "The store of the jobs failed: {why}.", why=fault_of_jobs)
        response.headers["Cache-Control"] = "no-store"
        return State(status="ready")

    @app.get("/metrics", include_in_schema=False)
    def metrics(request: Request) -> Response:
        registry = request.app.state.registry
        # Counts of all processes on this port; those of this one if somebody removed their folder.
        if os.path.isdir(os.environ.get(SHARED_COUNTS, "")):
            registry = CollectorRegistry()
            MultiProcessCollector(registry)  # type: ignore[no-untyped-call]
            registry.register(JobMetrics(lambda: request.app.state.jobs))
        return Response(generate_latest(registry), media_type=CONTENT_TYPE_LATEST)
