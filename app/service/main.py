"""The service: create_app(settings) puts the calls, their limits and what surrounds them together.

uvicorn --factory app.service.main:create_app
"""

from __future__ import annotations

import logging
import os
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from pathlib import Path
from typing import Any

from fastapi import Depends, FastAPI, Request, Response
from fastapi.responses import FileResponse, HTMLResponse
from prometheus_client import CollectorRegistry, generate_latest
from prometheus_client.exposition import CONTENT_TYPE_LATEST
from prometheus_client.multiprocess import MultiProcessCollector
from pydantic import Field
from starlette.middleware import Middleware
from starlette.staticfiles import StaticFiles

from app.service import problems, routes
from app.service.examples import EXAMPLES
from app.service.lanes import Lanes
from app.service.middleware import HeadAsGet, Metrics, Mistakes, RequestId, RequestLimits, SafetyHeaders
from app.service.reply import VERSION, build, refuse_query
from app.settings import SHARED_COUNTS, Settings
from app.wire.models import Answer
from core import Dragon, Spiral, first_contact, trajectory
from core.dance import Dance

logger = logging.getLogger("uvicorn.error")


class State(Answer):
    """Is the service alive, and is it ready?"""

    status: str = Field(description="ok or ready")


PAGE = Path(__file__).parent.parent / "page"
DESCRIPTION = """Where is every bench of a bench dragon and how fast, when do two benches first touch, and how
tight may the spiral be? SI units and radians throughout. A collision is an answer, never an error; errors are problem
details (RFC 9457). An answer depends on its request alone and carries a strong ETag.
"""
TAGS = [
    {"name": "Questions", "description": "Answers in numbers, by a query or by a body with a dragon and a path."},
    {"name": "Figures", "description": "Answers as pictures, in SVG or PNG."},
    {"name": "Service", "description": "Is it alive, and is it right?"},
]
# Swagger UI's files come from a pip package; its start is a file of its own, because pages here run no inline script.
DOCS = """<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<title>Bench Dragon: all calls</title>
<link rel="stylesheet" href="docs/assets/swagger-ui.css">
<link rel="icon" href="docs/assets/favicon-32x32.png">
</head>
<body>
<div id="calls"></div>
<script src="docs/assets/swagger-ui-bundle.js"></script>
<script src="docs/start.js"></script>
</body>
</html>
"""
DOCS_START = 'SwaggerUIBundle({ url: "openapi.json", dom_id: "#calls", deepLinking: true });\n'

# Known answers for the self-test, computed once in 256-bit ball arithmetic: first contact of the default dance [s]
# and x of its handle 1 at the start [m].
KNOWN_CONTACT = 412.47383768211466
KNOWN_X = 8.363823851392647
KNOWN_TOLERANCE = 1e-9


def fault() -> str:
    """What is wrong with this installation's arithmetic, empty when known answers come out."""
    try:
        return _difference()
    except Exception as error:  # Whatever is broken, the process must live to say so at /readyz.
        logger.exception("The self-test failed")
        return type(error).__name__


def _difference() -> str:
    x = float(trajectory(Dance(Dragon(), Spiral()), [0.0]).position[0, 1, 0])
    contact = first_contact(Dance(Dragon(), Spiral())).time
    if abs(x - KNOWN_X) > KNOWN_TOLERANCE:
        return f"x of handle 1 at the start is {x!r} m, known is {KNOWN_X!r} m"
    if contact is None or abs(contact - KNOWN_CONTACT) > KNOWN_TOLERANCE:
        return f"first contact is at {contact!r} s, known is {KNOWN_CONTACT!r} s"
    return ""


@asynccontextmanager
async def _lifespan(app: FastAPI) -> AsyncIterator[None]:
    app.state.fault = fault()
    build()
    yield


def create_app(settings: Settings | None = None) -> FastAPI:
    """The service with these limits, by default those of the environment."""
    settings = settings or Settings()
    registry = CollectorRegistry()
    app = FastAPI(
        title="Bench Dragon",
        version=VERSION,
        description=DESCRIPTION,
        servers=[{"url": "/", "description": "This service"}],
        license_info={"name": "MIT", "identifier": "MIT"},
        openapi_tags=TAGS,
        docs_url=None,
        redoc_url=None,
        redirect_slashes=False,
        lifespan=_lifespan,
        middleware=[
            Middleware(RequestId),
            Middleware(SafetyHeaders),
            Middleware(HeadAsGet),
            Middleware(Metrics, registry=registry),
            Middleware(Mistakes),
            Middleware(RequestLimits, settings=settings),
        ],
    )
    app.state.settings = settings
    app.state.fault = "it has not run"
    app.state.lanes = Lanes(settings, registry)
    app.state.registry = registry
    app.openapi = lambda: _openapi(app)  # type: ignore[method-assign]
    problems.install(app)
    app.include_router(routes.router())
    _add_health(app)
    _add_pages(app)
    return app


def _openapi(app: FastAPI) -> dict[str, Any]:
    if app.openapi_schema is None:
        schema = FastAPI.openapi(app)
        problem = problems.Problem.model_json_schema(ref_template="#/components/schemas/{model}")
        schema["components"]["schemas"] |= problem.pop("$defs") | {"Problem": problem}
        for name, example in EXAMPLES.items():  # FastAPI drops every null of an example.
            method, path = name.split()
            call = schema["paths"][path][method.lower()]
            call["responses"]["200"]["content"]["application/json"]["example"] = example.answer
        _state_benches(schema, app.state.settings.benches_max)
    return app.openapi_schema or {}


def _state_benches(part: Any, most: int) -> None:
    """The number of benches that this service takes, in place of what a dragon may have in core."""
    if isinstance(part, dict):
        for name, inner in part.items():
            if name == "benches" and isinstance(inner, dict) and "maximum" in inner:
                inner["maximum"] = most
            _state_benches(inner, most)
        if part.get("name") == "benches" and "maximum" in part.get("schema", {}):
            part["schema"]["maximum"] = most
    elif isinstance(part, list):
        for inner in part:
            _state_benches(inner, most)


def _add_health(app: FastAPI) -> None:
    problem = {"description": "A query was given, and this call takes none", "content": routes.PROBLEM}
    described: dict[str, Any] = {
        "response_model": State,
        "dependencies": [Depends(refuse_query)],
        "tags": ["Service"],
        "responses": {422: problem},
        "openapi_extra": {"security": []},
    }

    @app.get("/healthz", operation_id="healthz", **described)
    async def healthz(response: Response) -> State:
        """Is the process alive?"""
        response.headers["Cache-Control"] = "no-store"
        return State(status="ok")

    @app.get("/readyz", operation_id="readyz", **described)
    async def readyz(request: Request, response: Response) -> State:
        """Does this installation give known answers?"""
        if request.app.state.fault:
            raise problems.Refused(503, f"The self-test failed: {request.app.state.fault}.")
        response.headers["Cache-Control"] = "no-store"
        return State(status="ready")

    @app.get("/metrics", include_in_schema=False)
    async def metrics(request: Request) -> Response:
        registry = request.app.state.registry
        if SHARED_COUNTS in os.environ:  # of all processes that serve this port
            registry = CollectorRegistry()
            MultiProcessCollector(registry)  # type: ignore[no-untyped-call]
        return Response(generate_latest(registry), media_type=CONTENT_TYPE_LATEST)


class _Files(StaticFiles):
    """Files of a page; not the Python beside them that makes their folder a package."""

    def lookup_path(self, path: str) -> tuple[str, os.stat_result | None]:
        return ("", None) if path.endswith((".py", ".pyc")) else super().lookup_path(path)


def _add_pages(app: FastAPI) -> None:
    @app.get("/docs", include_in_schema=False)
    async def docs() -> Response:
        return HTMLResponse(DOCS)

    @app.get("/docs/start.js", include_in_schema=False)
    async def docs_start() -> Response:
        return Response(DOCS_START, media_type="text/javascript")

    @app.get("/", include_in_schema=False)
    async def index() -> Response:
        return FileResponse(PAGE / "index.html")

    app.mount("/docs/assets", _Files(packages=[("fastapi_swagger", "resources")]))
    app.mount("/page/uplot", _Files(packages=[("uplot", "static")]))
    app.mount("/page", _Files(directory=PAGE))
