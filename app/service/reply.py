"""One answer to one request: conditional, in a form that the client takes, bounded in number, cacheable."""

from __future__ import annotations

import hashlib
import zlib
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from functools import cache
from importlib.metadata import version
from pathlib import Path
from typing import Annotated

from fastapi import Depends, Request, Response
from pydantic import BaseModel
from starlette.responses import StreamingResponse

from app.questions import Question
from app.questions.figures import Format
from app.service.lanes import Lanes
from app.service.problems import ERRORS_MAX, ErrorItem, Refused
from app.settings import Settings
from app.wire.models import JSON
from app.wire.refusals import reworded
from core import BenchDragonError

VERSION = version("bench-dragon")
# Whose bytes decide over answers.
PACKAGES = tuple(Path(__file__).parents[2] / name for name in ("core", "app"))
# Of gzip. Level 1 makes 1.8 MB of a trajectory of 3.8 MB in 60 ms; level 6 makes 1.7 MB in 350 ms (2026-11-22).
GZIP_LEVEL, GZIP_WINDOW = 1, 31
# Ends the tag of an answer that is sent as gzip: other bytes, another tag.
GZIPPED = "-gzip"


@cache
def build() -> str:
    """What this build is made of: a new one gives other numbers, perhaps, under other tags."""
    found = hashlib.blake2b(VERSION.encode(), digest_size=16)
    for package in PACKAGES:
        for file in sorted(path for path in package.rglob("*") if path.suffix in (".py", ".so", ".pyd")):
            found.update(file.relative_to(package).as_posix().encode() + b"\n" + file.read_bytes())
    return found.hexdigest()


class Reply:
    """Answers a request, unless the client has the answer already or the service is full."""

    def __init__(self, request: Request) -> None:
        state = request.app.state
        self.request = request
        self.settings: Settings = state.settings
        self._lanes: Lanes = state.lanes

    def media_type(self, offers: Sequence[str]) -> str:
        """The form to answer in.

        raises: Refused (406) when the client takes none of the offers
        """
        header = self.request.headers.get("accept")
        chosen = accepted(header, offers)
        if chosen is None:
            detail = f"This call answers {' or '.join(offers)}, but Accept asks for {header[:100] if header else ''}."
            raise Refused(406, detail, [ErrorItem(name="Accept", detail=detail)])
        return chosen

    def __call__(self, question: Question, asked: BaseModel, *form: Format) -> Response:
        """The answer to the request, in the best form that the client takes; a figure in the form of its address.

        raises: Refused (503) when as many computations run as may run at once
        """
        media_type = self.media_type([one.media_type for one in form] or question.forms)
        tag = self._tag(asked, media_type)
        headers = {
            "ETag": f'"{tag}"',
            "Cache-Control": f"public, max-age={self.settings.cache_seconds}",
            "Vary": "Accept, Accept-Encoding",
        }
        known = _tags(self.request.headers.get("if-none-match", ""))
        for one in (headers["ETag"], f'"{tag}{GZIPPED}"'):
            if one in known:
                return Response(status_code=304, headers={**headers, "ETag": one})
        forms = form or (media_type,) * (len(question.forms) > 1)
        try:
            cost = question.cost(asked, *forms)
            with self._lanes.of(cost, media_type).taken(cost):
                found = question.answer(asked, self.settings, *forms)
                data = found if isinstance(found, (bytes, Iterator)) else found.to_json()
                if "*" in known:
                    return Response(status_code=304, headers=headers)
                if self._zips(data):
                    headers |= {"ETag": f'"{tag}{GZIPPED}"', "Content-Encoding": "gzip"}
                    data = _gzipped(data) if isinstance(data, Iterator) else b"".join(_gzipped([data]))
        except BenchDragonError as error:
            raise reworded(error, asked) from error
        if isinstance(data, bytes):
            return Response(data, headers=headers, media_type=media_type)
        return StreamingResponse(data, headers=headers, media_type=media_type)

    def _zips(self, data: bytes | Iterator[bytes]) -> bool:
        """Is the answer worth compressing, and may it be?"""
        least = self.settings.compressed_bytes_min
        large = least > 0 and (not isinstance(data, bytes) or len(data) >= least)
        coding = accepted(self.request.headers.get("accept-encoding", "identity"), ["identity", "gzip"])
        return large and coding == "gzip"

    def _tag(self, asked: BaseModel, media_type: str) -> str:
        """Strong tag: an answer depends on the call, its values with all defaults, the form and the build alone."""
        values = "\n".join((build(), self.request.url.path, media_type, asked.model_dump_json()))
        return hashlib.blake2b(values.encode(), digest_size=16).hexdigest()


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
    """raises: Refused (422) when the request has query parameters, for calls without any"""
    detail = "this call takes no query parameters: leave it out"
    names = list(request.query_params)[:ERRORS_MAX]
    unknown = [ErrorItem(name=name, detail=f"{name[:60]} is unknown here: {detail}") for name in names]
    if unknown:
        raise Refused(422, unknown[0].detail, unknown)


async def reply_query(request: Request) -> Reply:
    """Reply to a call that takes its values from the query.

    raises: Refused (422) for a name that is given twice
    """
    given = Counter(name for name, _ in request.query_params.multi_items())
    twice = sorted(name for name, times in given.items() if times > 1)[:ERRORS_MAX]
    if twice:
        items = [ErrorItem(name=name, detail=f"{name[:60]} is given more than once: give it once") for name in twice]
        raise Refused(422, items[0].detail, items)
    return Reply(request)


def _gzipped(blocks: Iterable[bytes]) -> Iterator[bytes]:
    packer = zlib.compressobj(GZIP_LEVEL, wbits=GZIP_WINDOW)
    for block in blocks:
        yield packer.compress(block)
    yield packer.flush()


QueryReply = Annotated[Reply, Depends(reply_query)]
BodyReply = Annotated[Reply, Depends(reply_body)]


def _tags(header: str) -> list[str]:
    return [tag.strip().removeprefix("W/") for tag in header.split(",")]


def accepted(header: str | None, offers: Sequence[str]) -> str | None:
    """The offer that an Accept header likes best, the earlier one when equal; None when it takes none.

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
