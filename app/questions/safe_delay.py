"""The question safe_delay: the delays of one dragon of a performance at which no dragons meet."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Any, Self

from pydantic import Field

import core
from app.wire.answers import TOTAL_STRAY
from app.wire.fields import Answer, Margin, Strays, Wire, measure
from app.wire.labels import Part, TextTable
from app.wire.performances import FILE_OF_DANCES, Moment, NumberOrName, PerformanceFields, dragon_of
from app.wire.question import Command, Question, Terms
from core.language import phrase, say
from core.performance import DELAY_MAX
from core.quantities import format_bound, format_number
from core.values import Point

Delay = Annotated[float, Field(ge=-DELAY_MAX, le=DELAY_MAX)]


class DelayFields(Strays):
    """The delays of one dragon that are tried, and what counts as a contact."""

    part: NumberOrName = Field(
        1,
        description="The dragon that waits: its number in the order of the dances, from 0, or its name. Its own delay "
        "does not count",
    )
    least: Delay = measure("s", "Shortest delay", 0.0)
    most: Delay = measure("s", "Longest delay", 600.0)
    margin: Margin = 0.0
    stop: Moment | None = measure(
        "s",
        "End of the judged time; needed, and before the fold, if a dragon folds; default: the end of the performance "
        "at every delay",
        None,
    )


class SafeDelayRequest(DelayFields, PerformanceFields, strict=True):
    """The delays of one dragon at which no benches of two dragons touch, or come within a margin."""


class SafeDelays(Answer, of=core.SafeDelays, leave=("performance",)):
    """The delays of one dragon at which no benches of two dragons come within the margin, or touch if it is 0.

    name: its name; null without
    first_safe: the shortest safe delay; null: none is known [s]
    summary: the answer in one sentence
    """

    part: int
    name: str | None
    first_safe: float | None
    safe: list[Point]
    undecided: list[Point]
    least: float
    most: float
    stray: float | None = TOTAL_STRAY
    summary: str

    @classmethod
    def of(cls, result: core.SafeDelays, request: SafeDelayRequest) -> Self:
        first = result.safe[0][0] if result.safe else None
        performance, k = result.performance, result.part
        span = {"least": format_number(result.least), "most": format_number(result.most)}
        template = NONE if first is None else AT_ONCE if first == result.least else FIRST
        summary = say(template, name=performance.name_of(k), delay=format_bound(first or 0.0, 1, up=True), **span)
        own = {"name": performance.parts[k].name, "first_safe": first, "stray": request.total_stray}
        return cls.from_result(result, **own, summary=summary)


def safe_delay(request: SafeDelayRequest, terms: Terms) -> SafeDelays:
    """The delays of one dragon at which no benches of two dragons touch or come within a margin, proven."""
    limits: dict[str, Any] = {"margin": request.margin, "stray": request.to_stray(), "stop": request.stop}
    performance = request.to_performance(terms.settings)
    part = dragon_of(request.part, performance)
    result = core.safe_delay(performance, part, request.least, request.most, budget=terms.budget, **limits)
    return SafeDelays.of(result, request)


class DelayOptions(DelayFields):
    """The fields of a question that are options of its command."""

    part: str = Field(
        "1", description="The dragon that waits: its number in the order of the dances, from 0, or its name."
    )


def _parts(answer: SafeDelays, request: Wire) -> Iterator[Part]:
    """The intervals of delays, the safe ones and the undecided ones."""
    name = answer.name or say("dragon {k}", k=answer.part)
    span = {"least": format_number(answer.least), "most": format_number(answer.most)}
    if not answer.safe:
        yield answer.summary
    for title, intervals in ((SAFE, answer.safe), (UNDECIDED, answer.undecided)):
        if intervals:
            yield say(title, name=name, **span)
            # Rounded inwards, so that they stay proven.
            lines = [(format_bound(low, 6, up=True), format_bound(high, 6)) for low, high in intervals]
            yield TextTable("", say("from [s]"), say("to [s]"), lines=lines)


NONE = phrase(
    "No delay of {name} from {least} to {most} s is known to be safe: the dragons stand on one another there, or meet. "
    "Give it another path or another street to begin in, or make the dragons shorter."
)
AT_ONCE = phrase("{name} need not wait: no dragons meet with a delay of {least} s, the shortest that was asked for.")
FIRST = phrase(
    "{name} waits {delay} s before it begins: the shortest delay from {least} to {most} s that is known to be safe."
)
SAFE = phrase("Safe delays of {name} from {least} to {most} s:")
UNDECIDED = phrase("Undecided delays of {name} from {least} to {most} s:")
QUESTION = Question(
    safe_delay,
    SafeDelays,
    body=SafeDelayRequest,
    command=Command(
        "The delays of one dragon at which no benches of two dragons touch, or come within a margin.",
        lambda request: say("Safe delays"),
        _parts,
        options=DelayOptions,
        file=FILE_OF_DANCES,
    ),
)
