"""Faults of a request as a problem, each with its place in the query or the body."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from app.wire.dances import SHAPES
from app.wire.messages import fault_of, place_of
from app.wire.problem import ERRORS_MAX, PLACE_MAX, ErrorItem, Problem, item_of, problem_of, sendable_text
from core import BenchDragonError
from core.language import say

# A function that makes an error of the problem from the steps to its place and the error itself.
Placing = Callable[[Sequence[Any], BenchDragonError], ErrorItem]


def refusal_problem(error: BenchDragonError, item: Placing) -> Problem:
    """A value that core, or a limit of the service, refuses."""
    place = tuple(int(part) if part.isdigit() else part for part in error.field.split("."))
    return problem_of(422, error.code, error, [item(place, error)])


def misfit_problem(errors: Sequence[Any], request_type: Any, item: Placing) -> Problem:
    """Values that do not fit a request.

    errors: pydantic's, the first step to each is query or body; request_type: model of the request
    """
    faults = [(place_of(one)[1:], fault_of(one, request_type)) for one in errors[:ERRORS_MAX]]
    more = say(" (and {count} more)", count=len(errors) - 1) if len(errors) > 1 else ""
    return problem_of(422, "invalid-value", faults[0][1], [item(*fault) for fault in faults], more)


def in_query(place: Sequence[Any], error: BenchDragonError) -> ErrorItem:
    return item_of(error, name=next((part for part in reversed(place) if isinstance(part, str)), ""))


def in_body(body: Any, before: str = "") -> Placing:
    """Places in a body. body: JSON of the request; before: pointer to it in the object that holds it"""
    return lambda place, error: item_of(error, pointer=before + pointer(place, body))


def pointer(place: Sequence[Any], body: Any) -> str:
    """JSON pointer to a place in a body, without names of shapes, and without indices where the body has no list.

    >>> pointer(("dragon", "uniform", "width"), {"dragon": {"width": -1}})
    '/dragon/width'
    """
    steps = []
    for step in place:
        if isinstance(step, int) and not isinstance(body, list):
            break
        if step in SHAPES and not (isinstance(body, dict) and step in body):
            continue
        if len(str(step)) > PLACE_MAX:
            break
        steps.append(str(step).replace("~", "~0").replace("/", "~1"))
        inside = isinstance(step, int) if isinstance(body, list) else isinstance(body, dict) and step in body
        body = body[step] if inside else None
    return sendable_text("".join(f"/{step}" for step in steps), ERRORS_MAX * PLACE_MAX)
