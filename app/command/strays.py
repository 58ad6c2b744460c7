"""The commands about people who stray: tolerance, its curve over the pitch, and the probability of a contact."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from app.command import show
from app.command.options import Json, asks
from app.questions import contact_probability as chances
from app.questions import tolerance as tolerances
from app.questions import tolerance_curve as curves
from app.questions.contact_probability import ContactProbabilityQuery, ContactProbabilityRequest
from app.questions.tolerance import ToleranceQuery, ToleranceRequest
from app.questions.tolerance_curve import ToleranceCurveQuery, ToleranceCurveRequest
from app.wire.question import Terms
from core.errors import format_number
from core.language import say

# Why a question that looks for the largest stray ignores strays in a FILE: the end of a note to the user.
FILE_STRAYS_IGNORED = "the answer is the largest stray, by people and by the play of pins together"


@asks(ToleranceQuery, ToleranceRequest, FILE_STRAYS_IGNORED)
def tolerance(request: ToleranceQuery | ToleranceRequest, json: Json = False) -> None:
    """Largest proven stray without contact, and a pose that touches with a slightly larger one.

    Without a FILE: on the way to the turning circle. With a FILE: in the whole dance.
    """
    with show.waiting(say("tolerance")):
        answer = tolerances.tolerance(request, Terms())
    show.print_answer("Tolerance to strays", answer, json)


@asks(ToleranceCurveQuery, ToleranceCurveRequest, FILE_STRAYS_IGNORED)
def tolerance_curve(request: ToleranceCurveQuery | ToleranceCurveRequest, json: Json = False) -> None:
    """Tolerance against the pitch: largest proven stray, and stray that is shown to touch."""
    with show.waiting(say("tolerance curve")) as progress:
        answer = curves.tolerance_curve(request, Terms(progress=progress))
    show.print_result(answer, json, _curve_parts(answer.columns))


@asks(ContactProbabilityQuery, ContactProbabilityRequest, "--lateral and --forward describe how people wobble")
def contact_probability(request: ContactProbabilityQuery | ContactProbabilityRequest, json: Json = False) -> None:
    """Probability of a contact when people wobble, from dances drawn at random.

    Without a FILE: on the way to the turning circle. With a FILE: in the whole dance.
    """
    with show.waiting(say("drawing dances at random")) as progress:
        answer = chances.contact_probability(request, Terms(progress=progress))
    show.print_answer("Probability of a contact when people wobble", answer, json)


def _curve_parts(columns: dict[str, Any]) -> Iterator[show.Part]:
    """One row for each pitch."""
    table = show.new_table("Tolerance to strays", "pitch [m]", "stray [m]", "shown to touch [m]", "limited by")
    for pitch, stray, touching, limit in zip(*columns.values(), strict=True):
        table.add_row(
            format_number(pitch),
            format_number(stray),
            "unknown" if touching is None else format_number(touching),
            limit.value,
        )
    yield table
