"""An error on the wire: RFC 9457 problem details."""

from __future__ import annotations

from collections.abc import Iterable
from http import HTTPStatus
from itertools import islice

from pydantic import BaseModel, Field

PROBLEM_TYPE = "application/problem+json"
# Errors beyond this number in one request are counted, not listed.
ERRORS_MAX = 20
# Longest detail and place [characters]; longer ones are cut, so that a problem has less than 20 kB.
DETAIL_MAX, PLACE_MAX = 300, 200
# Titles by RFC 9110, which newer Pythons know by these names and older ones do not.
TITLES = {413: "Content Too Large", 414: "URI Too Long", 422: "Unprocessable Content"}


class ErrorItem(BaseModel):
    """One thing that is wrong."""

    pointer: str | None = Field(None, description="JSON pointer into the body")
    name: str | None = Field(None, description="Name of the query parameter or header")
    detail: str = Field(description="What is wrong and what to change")


class Problem(BaseModel):
    """RFC 9457 problem details."""

    type: str = Field(description="Stable identifier of the kind of problem")
    title: str = Field(description="The status in words")
    status: int = Field(description="HTTP status")
    detail: str = Field(description="What is wrong and what to change")
    errors: list[ErrorItem] = Field(description="Each thing that is wrong, with its place")

    def to_json(self) -> bytes:
        return self.model_dump_json(exclude_none=True).encode()


def problem_of(status: int, code: str, detail: str, errors: Iterable[ErrorItem] = ()) -> Problem:
    """The problem of a request that failed. code: kind of problem, such as invalid-value"""
    return Problem(
        type=f"urn:problem-type:bench-dragon:{code}",
        title=title(status),
        status=status,
        detail=plain(detail, 2 * DETAIL_MAX),
        errors=[
            ErrorItem(pointer=one.pointer, name=one.name and plain(one.name, PLACE_MAX), detail=plain(one.detail))
            for one in islice(errors, ERRORS_MAX)
        ],
    )


def plain(text: str, longest: int = DETAIL_MAX) -> str:
    """Text that can be sent: cut if it is long, without half characters."""
    text = text if len(text) <= longest else f"{text[:longest]}... ({len(text)} characters)"
    return text.encode(errors="replace").decode()


def title(status: int) -> str:
    return TITLES.get(status) or HTTPStatus(status).phrase
