"""The question collision_time: first contact, or the first time that benches come within a margin."""

from __future__ import annotations

from typing import Self

import core
from app.wire import evidence
from app.wire.answers import SENTENCES, TOTAL_STRAY
from app.wire.dances import DanceFields, SpanFields
from app.wire.fields import Answer, CrossCheck, DanceQuery, Margin, Strays, UniformDragon
from app.wire.labels import with_strays
from app.wire.question import UNKNOWN_COST, Command, Question, Terms
from app.wire.readings import contact_words
from core import Outcome
from core.language import say
from core.quantities import format_number
from core.values import Pair

# Most benches of a dragon that are all judged; of a longer dragon only those near the contact are [1].
JUDGED_MOST = 2_000


class Contact(Strays):
    """Definition of a contact, and its check by independent engines."""

    margin: Margin = 0.0
    cross_check: CrossCheck = "dragon"


class CollisionQuery(Contact, DanceQuery):
    """First time that two benches touch, or come within a margin, on a spiral."""


class CollisionRequest(Contact, SpanFields, DanceFields, strict=True):
    """First time that two benches touch, or come within a margin, on any path."""


class Certificate(Answer, of=core.Evidence, leave=()):
    """Evidence for the answer."""

    method: str
    claim: core.ContactClaim


class CollisionTime(Answer, of=core.FirstContact, leave=("dance",)):
    """First time that two benches that share no handle come within the margin, or touch if it is 0.

    cross_check: verdicts of the engines 1e-6 m of travel before and after the contact (for a contact at the start: at
        the start and after it). With a stray they judge the pair at its own distance, and shapely the grounds that all
        benches may cover; null without a contact or if not requested
    """

    outcome: Outcome
    margin: float
    stray: float | None = TOTAL_STRAY
    time: float | None
    benches: Pair | None
    gap: float | None
    corner: core.Feature | None
    sentences: list[str] = SENTENCES
    words: evidence.ContactWords | None = evidence.WORDS
    certificate: Certificate
    cross_check: core.ContactCheck | None

    @classmethod
    def of(cls, contact: core.FirstContact, request: Contact, terms: Terms) -> Self:
        check = None
        if request.cross_check != "none":
            whole = request.cross_check == "dragon"
            check = core.contact_check(contact, whole=whole, budget=terms.budget)
        sentences = contact_words(contact)
        words = evidence.contact_words(contact, request, check, sentences) if terms.words else None
        own = {"margin": request.margin, "stray": request.total_stray, "cross_check": check}
        return cls.from_result(contact, sentences=sentences, words=words, **own)


def collision_time(request: CollisionQuery | CollisionRequest, terms: Terms) -> CollisionTime:
    """First time that two benches that share no handle touch or come within a margin, with the evidence."""
    dance, start, stop = request.to_dance(request.most_benches(terms.settings)), 0.0, None
    if isinstance(request, CollisionRequest):
        start, stop = dance.begin if request.start is None else request.start, request.stop
    result = core.first_contact(
        dance, margin=request.margin, stray=request.to_stray(), start=start, stop=stop, budget=terms.budget
    )
    return CollisionTime.of(result, request, terms)


def _cost(request: CollisionQuery | CollisionRequest) -> float:
    """Estimated time [s]: a search on a spiral does not grow with the benches; a judgement of the whole dragon does."""
    if isinstance(request, CollisionRequest):
        repeats = request.path.kind == "spiral" and isinstance(request.dragon, UniformDragon)
        if not repeats:
            return UNKNOWN_COST
    if request.has_stray:
        return UNKNOWN_COST
    judged = min(request.benches, JUDGED_MOST) if request.cross_check == "dragon" else 0
    return 0.003 + 5e-5 * judged + 2e-6 * request.benches


def _title(request: Contact) -> str:
    near = format_number(request.margin)
    first = say("First time that two benches are within {margin} m of each other", margin=near)
    return with_strays(first if request.margin else say("First contact"), request.to_stray())


QUESTION = Question(
    collision_time,
    CollisionTime,
    flat=CollisionQuery,
    body=CollisionRequest,
    cost=_cost,
    command=Command("Time of first contact: when two benches first touch, or come within a margin.", _title),
)
