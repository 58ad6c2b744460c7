"""What a client accepts, has and prefers, by the headers of its request."""

from __future__ import annotations

import re
import zlib
from collections.abc import Iterable, Iterator, Mapping, Sequence

from starlette.datastructures import Headers

from app.service.problems import Refused
from core.language import Language, say

RESPOND_ASYNC = "respond-async"
# Entry of the scope of a request: whether its client prefers a job to a wait.
AS_JOB = "as_job"
# gzip: level 1 makes 1.8 MB of a trajectory of 3.8 MB in 60 ms; level 6 makes 1.7 MB in 350 ms (2026-11-22).
GZIP_LEVEL, GZIP_WINDOW = 1, 31
# End of the tag of a compressed answer: other bytes need another tag.
GZIPPED = "-gzip"
# What follows the language in a tag, such as zh-CN.
REGION = re.compile(r"(?<=[A-Za-z])-[A-Za-z0-9-]+")


def header_list(headers: Headers, name: str) -> str | None:
    """A header that may stand on several lines, as one list (RFC 9110, section 5.3); None if it is missing."""
    return ",".join(headers.getlist(name)) or None


def tags_in(header: str) -> list[str]:
    """Tags of an If-None-Match."""
    return [tag.strip().removeprefix("W/") for tag in header.split(",")]


def prefers_job(headers: Headers) -> bool:
    """Whether the client prefers a job to a wait (RFC 7240)."""
    wishes = (header_list(headers, "prefer") or "").split(",")
    return any(wish.partition(";")[0].strip().lower() == RESPOND_ASYNC for wish in wishes)


def form_of(header: str | None, offers: Sequence[str], place: Mapping[str, str]) -> str:
    """The form of the answer.

    place: of the client's choice of form, for the refusal
    raises: Refused (406) if the client accepts none of the offers
    """
    form = accepted(header, offers)
    if form is None:
        words = "This call answers {offers}, but Accept asks for {asked}."
        raise Refused(406, words, place, offers=say(" or ").join(offers), asked=header[:100] if header else "")
    return form


def accepted(header: str | None, offers: Sequence[str]) -> str | None:
    """The offer that an Accept header prefers, the earlier one if equal; None if it accepts none.

    >>> accepted("text/csv, */*;q=0.1", ["application/json", "text/csv"])
    'text/csv'
    """
    if not header or header == "*/*":
        return offers[0]
    liked: dict[str, float] = {}
    for entry in header.split(","):
        kind, *parameters = (part.strip().lower() for part in entry.split(";"))
        quality = next((part[2:] for part in parameters if part.startswith("q=")), "1")
        liked[kind] = float(quality) if quality.replace(".", "", 1).isdecimal() else 0.0

    def quality_of(offer: str) -> float:
        return next((liked[kind] for kind in (offer, f"{offer.partition('/')[0]}/*", "*/*") if kind in liked), 0.0)

    best = max(offers, key=quality_of)
    return best if quality_of(best) > 0 else None


def language_of(header: str | None) -> Language:
    """The language of an Accept-Language header that has sentences here; else English.

    >>> str(language_of("de, zh-CN;q=0.9")), str(language_of("en-GB"))
    ('zh', 'en')
    """
    return Language(accepted(REGION.sub("", header or ""), list(Language)) or Language.ENGLISH)


def gzipped(blocks: Iterable[bytes]) -> Iterator[bytes]:
    """The blocks of one file, compressed."""
    packer = zlib.compressobj(GZIP_LEVEL, wbits=GZIP_WINDOW)
    for block in blocks:
        yield packer.compress(block)
    yield packer.flush()
