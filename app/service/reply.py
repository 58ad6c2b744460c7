"""One reply to one request: conditional, in a form that the client accepts, limited in number, cacheable."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Mapping, Sequence
from importlib.metadata import version
from threading import BoundedSemaphore
from typing import Annotated

from fastapi import Depends, Request, Response
from prometheus_client import Gauge
from starlette.datastructures import Headers

from app.jobs.task import Task
from app.questions import Call
from app.questions.figures import Format
from app.service.problems import Refused
from app.settings import Settings
from app.wire.models import JSON, Wire
from app.wire.problem import ErrorItem
from app.wire.refusals import reworded
from core import BenchDragonError

VERSION = version("bench-dragon")
RESPOND_ASYNC = "respond-async"


class Reply:
    """Answers a request, unless the client already has the answer, prefers a job, or the service is full."""

    def __init__(self, request: Request) -> None:
        state = request.app.state
        self.request = request
        self.settings: Settings = state.settings
        self._free: BoundedSemaphore = state.free
        self._busy: Gauge = state.busy
        self._later: Callable[[Request, Task], Response] = state.later

    def __call__(self, call: Call, asked: Wire, *form: Format) -> Response:
        """The answer to the request, in the best form that the client accepts; a figure has the form of its address.

        raises: Refused (503) when the largest number of computations is running
        """
        offers = [one.media_type for one in form] or call.question.forms
        media_type = form_of(self.request.headers.get("accept"), offers, {"name": "Accept"})
        headers = {
            "ETag": self._tag(asked, media_type),
            "Cache-Control": f"public, max-age={self.settings.cache_seconds}",
            "Vary": "Accept",
        }
        if headers["ETag"] in _tags(self.request.headers.get("if-none-match", "")):
            return Response(status_code=304, headers=headers)
        if prefers_later(self.request.headers):
            given = asked.model_dump(mode="json", exclude_unset=True)
            return self._later(self.request, Task(call.name, given, media_type))
        if not self._free.acquire(blocking=False):
            detail = f"{self.settings.concurrent_max} computations are running, which is the limit: try again later."
            raise Refused(503, detail, headers={"Retry-After": str(self.settings.retry_after)})
        try:
            with self._busy.track_inprogress():
                data = call.question.told(asked, self.settings, media_type)
                return Response(data, headers=headers, media_type=media_type)
        except BenchDragonError as error:
            raise reworded(error, asked) from error
        finally:
            self._free.release()

    def _tag(self, asked: Wire, media_type: str) -> str:
        """Strong ETag: an answer depends only on the call, its values with all defaults, the form and the version."""
        values = "\n".join((VERSION, self.request.url.path, media_type, asked.model_dump_json()))
        return f'"{hashlib.blake2b(values.encode(), digest_size=16).hexdigest()}"'


async def reply_body(request: Request) -> Reply:
    """Reply to a call that takes a JSON body and no query.

    raises: Refused 415 for a body of another type, 422 for a query
    """
    kind = request.headers.get("content-type", "").partition(";")[0].strip().lower()
    has_body = request.headers.get("content-length", "0") != "0" or "transfer-encoding" in request.headers
    if has_body and kind != JSON:
        detail = f"The body must be {JSON}, got {kind or 'no Content-Type'}: send the header Content-Type: {JSON}."
        raise Refused(415, detail, [ErrorItem(name="Content-Type", detail=detail)], {"Accept-Post": JSON})
    await refuse_query(request)
    return Reply(request)


async def refuse_query(request: Request) -> None:
    """raises: Refused (422) when a request has query parameters but its call takes none"""
    detail = "this call takes no query parameters: leave it out"
    unknown = [ErrorItem(name=name, detail=f"{name[:60]} is unknown here: {detail}") for name in request.query_params]
    if unknown:
        raise Refused(422, unknown[0].detail, unknown)


async def reply_query(request: Request) -> Reply:
    """Reply to a call that takes its values from the query.

    raises: Refused (422) for a name that is given twice
    """
    given = [name for name, _ in request.query_params.multi_items()]
    twice = sorted({name for name in given if given.count(name) > 1})
    if twice:
        items = [ErrorItem(name=name, detail=f"{name} is given more than once: give it once") for name in twice]
        raise Refused(422, items[0].detail, items)
    return Reply(request)


QueryReply = Annotated[Reply, Depends(reply_query)]
BodyReply = Annotated[Reply, Depends(reply_body)]


def _tags(header: str) -> list[str]:
    return [tag.strip().removeprefix("W/") for tag in header.split(",")]


def prefers_later(headers: Headers) -> bool:
    """Does the client prefer a job to a wait (RFC 7240)?"""
    wishes = ",".join(headers.getlist("prefer")).split(",")
    return any(wish.partition(";")[0].strip().lower() == RESPOND_ASYNC for wish in wishes)


def form_of(header: str | None, offers: Sequence[str], place: Mapping[str, str]) -> str:
    """The form to answer in.

    place: of the wish, for who must mend it
    raises: Refused (406) when the client takes none of the offers
    """
    chosen = accepted(header, offers)
    if chosen is None:
        detail = f"This call answers {' or '.join(offers)}, but Accept asks for {header[:100] if header else ''}."
        raise Refused(406, detail, [ErrorItem(**place, detail=detail)])
    return chosen


def accepted(header: str | None, offers: Sequence[str]) -> str | None:
    """The offer that an Accept header prefers, the earlier one if equal; None if it accepts none.

    >>> accepted("text/csv, */*;q=0.1", ["application/json", "text/csv"])
    'text/csv'
    """
    liked: dict[str, float] = {}
    for entry in (header or "*/*").split(","):
        kind, *parameters = (part.strip().lower() for part in entry.split(";"))
        quality = next((part[2:] for part in parameters if part.startswith("q=")), "1")
        liked[kind] = float(quality) if quality.replace(".", "", 1).isdecimal() else 0.0

    def quality_of(offer: str) -> float:
        return next((liked[kind] for kind in (offer, f"{offer.partition('/')[0]}/*", "*/*") if kind in liked), 0.0)

    best = max(offers, key=quality_of)
    return best if quality_of(best) > 0 else None
