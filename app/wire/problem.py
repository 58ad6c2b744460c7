"""An error on the wire: RFC 9457 problem details."""

from __future__ import annotations

import json
from collections.abc import Iterable
from http import HTTPStatus

from pydantic import BaseModel, Field

PROBLEM_TYPE = "application/problem+json"
# Titles by RFC 9110, which newer Pythons know by these names and older ones do not.
TITLES = {413: "Content Too Large", 422: "Unprocessable Content"}


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
        text = json.dumps(self.model_dump(exclude_none=True), ensure_ascii=False, separators=(",", ":"))
        return text.encode(errors="backslashreplace")  # Half a character of a request is shown as JSON escapes it.


def problem_of(status: int, code: str, detail: str, errors: Iterable[ErrorItem] = ()) -> Problem:
    """What is said of a request that failed. code: kind of problem, such as invalid-value"""
    return Problem(
        type=f"urn:problem-type:bench-dragon:{code}",
        title=title(status),
        status=status,
        detail=detail,
        errors=list(errors),
    )


def title(status: int) -> str:
    return TITLES.get(status) or HTTPStatus(status).phrase
