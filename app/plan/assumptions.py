"""What a safety sheet rests on: values that the request sets, and those that are assumed.

Input: the request, the dragons. Output: rows in words. State: none. Argument: a page sends every field, so a value that
is the default may be one that nobody has thought of: it counts as assumed.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from pydantic import BaseModel

from app.plan.safety_answer import Assumption
from app.wire.dances import PathFields
from core import Dragon
from core.language import say
from core.quantities import format_number

# Most dragons whose numbers of benches are named.
DRAGONS_NAMED = 6


def assumptions_of(request: Any, dragons: Sequence[Dragon], loose: int, *, has_added_streets: bool) -> list[Assumption]:
    """What a sheet rests on, and which of it the request sets to another value than the default.

    request: of the sheet; loose: number of the last benches that may be let go
    """
    bodies: Sequence[PathFields] = request.dances or [request]
    own = {name for one in bodies for name in _set_in(one.dragon)}
    moves = {name for one in bodies for name in _set_in(one)}
    given = _set_in(request)

    def each(values: Sequence[float]) -> str:
        """The value, or the least and the largest of several."""
        low, high = format_number(min(values)), format_number(max(values))
        return low if low == high else say("{low} to {high}", low=low, high=high)

    lengths = [float(one) for dragon in dragons for one in dragon.lengths]
    sizes = say("{low} to {high} m long", low=format_number(min(lengths)), high=format_number(max(lengths)))
    speed = say("no limit") if request.speed_limit is None else f"{format_number(request.speed_limit)} m/s"
    benches = " + ".join(str(dragon.benches) for dragon in dragons[:DRAGONS_NAMED])
    if len(dragons) > DRAGONS_NAMED:
        benches += " + …"
    head_speed = f"{each([one.head_speed for one in bodies])} m/s"
    rows = [
        (say("benches"), benches, bool(own & {"benches", "lengths", "csv"})),
        (say("sizes of benches"), sizes, bool(own - {"benches", "names"})),
        (say("speed of the head"), head_speed, bool(moves & {"head_speed", "passages", "beats"})),
        (say("people stray at most"), _metres(request.total_stray or 0.0), bool(given & {"stray", "hole", "pin"})),
        (say("benches keep apart"), _metres(request.margin), "margin" in given),
        (say("speed limit"), speed, "speed_limit" in given),
        *_ground_rows(request.venue is not None, has_added_streets),
        (say("people stand back"), _metres(request.spectators), "spectators" in given),
        (say("last benches that may be let go"), str(loose), "loose" in given),
        (say("time to stop"), f"{format_number(request.reaction)} s", "reaction" in given),
    ]
    return [Assumption(label=label, text=text, yours=yours) for label, text, yours in rows]


def _set_in(body: BaseModel) -> set[str]:
    """Names of the fields that a request sets to another value than their default."""
    fields = type(body).model_fields
    return {
        name
        for name in body.model_fields_set
        if getattr(body, name) != fields[name].get_default(call_default_factory=True)
    }


def _metres(value: float) -> str:
    return f"{format_number(value)} m"


def _ground_rows(has_venue: bool, has_added_streets: bool) -> list[tuple[str, str, bool]]:
    """What a sheet rests on of the venue: nobody has drawn the streets that were added to it for a dance."""
    if not has_added_streets:
        drawn = say("as drawn") if has_venue else say("none given")
        return [(say("square, streets and obstacles"), drawn, has_venue)]
    return [
        (say("square and obstacles"), say("as drawn"), True),
        (say("streets beyond the gates"), say("added for the dance, to be measured"), False),
    ]
