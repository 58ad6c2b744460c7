"""An error on the wire: RFC 9457 problem details."""

from __future__ import annotations

import math
from collections.abc import Iterable
from http import HTTPStatus
from itertools import islice
from typing import Any

from pydantic import BaseModel, Field

from app.wire.sentences import sentence_for
from core.errors import BenchDragonError
from core.quantities import Given, Parameter, Quantity, Value

PROBLEM_TYPE = "application/problem+json"
# Errors beyond this number in one request are counted, not listed.
ERRORS_MAX = 20
# Longest problem [bytes]: the last errors are left out of a longer one.
BYTES_MAX = 20_000
# Longest detail and place [characters]; longer ones are cut.
DETAIL_MAX, PLACE_MAX = 300, 200
# Largest number that every reader of JSON takes exactly, if it is whole; a larger one stands in the text alone.
NUMBER_MAX = 2**53
# Titles by RFC 9110, which newer Pythons know by these names and older ones do not.
TITLES = {413: "Content Too Large", 414: "URI Too Long", 422: "Unprocessable Content"}


class Part(BaseModel):
    """A value in a sentence."""

    text: str = Field(description="As it stands in the sentence")
    value: int | float | str | None = Field(None, description="The number, or the value that was given")
    unit: str | None = Field(None, description="Unit of the number")
    parameter: str | None = Field(None, description="Dotted name of the parameter, if the text names one")


class Sentence(BaseModel):
    """A sentence, and its parts in English for programs that word it themselves: template, got and reason."""

    detail: str = Field(description="What is wrong and what to change")
    sentence: str = Field(description="The same for people: with labels of fields and units as the page shows them")
    template: str = Field(description="What must hold; {word} stands for a value, {field} for the wrong field")
    got: Part | None = Field(None, description="What was given")
    reason: str | None = Field(None, description="Why it must hold, or what to change; with words as in the template")
    values: dict[str, Part] = Field(description="The values of the words of the template and of the reason")


class ErrorPlace(BaseModel):
    """Where an error is."""

    pointer: str | None = Field(None, description="JSON pointer into the body")
    name: str | None = Field(None, description="Name of the query parameter or header")


class ErrorItem(Sentence, ErrorPlace):
    """One thing that is wrong."""


class ProblemKind(BaseModel):
    """Kind of a problem."""

    type: str = Field(description="Stable identifier of the kind of problem")
    title: str = Field(description="The status in words")
    status: int = Field(description="HTTP status")


class Problem(Sentence, ProblemKind):
    """RFC 9457 problem details; the parts of the sentence are those of the first error."""

    errors: list[ErrorItem] = Field(description="Each thing that is wrong, with its place")

    def to_json(self) -> bytes:
        return self.model_dump_json(exclude_none=True).encode()


def problem_of(
    status: int,
    code: str,
    error: BenchDragonError | str,
    errors: Iterable[ErrorItem] = (),
    more: Value = "",
    **values: Value,
) -> Problem:
    """The problem of a request that failed.

    code: kind of problem, such as invalid-value; error: what is wrong, or the template of a sentence with these values;
    more: stands after its message
    """
    error = BenchDragonError.in_words("", error, **values) if isinstance(error, str) else error
    kind, listed = f"urn:problem-type:bench-dragon:{code}", list(islice(errors, ERRORS_MAX))
    sentence = sentence_of(error)
    sentence["detail"] = sendable_text(f"{error}{more}", 2 * DETAIL_MAX)
    if listed:
        sentence["sentence"] = listed[0].sentence
    problem = Problem(type=kind, title=title(status), status=status, errors=listed, **sentence)
    while problem.errors and len(problem.to_json()) > BYTES_MAX:
        problem.errors.pop()
    return problem


def item_of(error: BenchDragonError, *, pointer: str | None = None, name: str | None = None) -> ErrorItem:
    """An error at its place."""
    return ErrorItem(pointer=pointer, name=name and sendable_text(name, PLACE_MAX), **sentence_of(error, pointer))


def sentence_of(error: BenchDragonError, pointer: str | None = None) -> dict[str, Any]:
    """The fields of a Sentence."""
    return {
        "detail": sendable_text(error.message),
        "sentence": sendable_text(sentence_for(error, pointer), 2 * DETAIL_MAX),
        "template": sendable_text(error.template),
        "got": None if error.got is None else _part(error.got),
        "reason": sendable_text(error.reason) or None,
        "values": {word: _part(value) for word, value in error.values.items()},
    }


def _part(value: Value) -> Part:
    if isinstance(value, Parameter):
        return Part(text=sendable_text(str(value)), parameter=sendable_text(value.name, PLACE_MAX))
    if isinstance(value, Quantity):
        number = float(f"{value.value:.{value.digits}g}")
        return Part(
            text=sendable_text(str(value)), value=number if math.isfinite(number) else None, unit=value.unit or None
        )
    inner = value.value if isinstance(value, Given) else None if isinstance(value, str) else value
    if isinstance(inner, str):
        inner = sendable_text(inner)
    elif isinstance(inner, bool) or not (isinstance(inner, int | float) and abs(inner) <= NUMBER_MAX):
        inner = None
    return Part(text=sendable_text(str(value)), value=inner)


def sendable_text(text: str, longest: int = DETAIL_MAX) -> str:
    """Text that can be sent: cut if it is long, without half characters."""
    text = text if len(text) <= longest else f"{text[:longest]}... ({len(text)} characters)"
    return text.encode(errors="replace").decode()


def title(status: int) -> str:
    return TITLES.get(status) or HTTPStatus(status).phrase
