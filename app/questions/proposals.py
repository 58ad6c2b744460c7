"""The question proposals: dances that fit into a square."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Annotated, Any, Self

import orjson
from pydantic import Field

import core
from app.questions.check import Failure
from app.wire.dances import DragonFields, VenueFields
from app.wire.degrees import GeographicOrigin, Place
from app.wire.fields import Angle, Answer, Margin, OneLine, SpeedLimit, Whole, Wire, measure
from app.wire.geojson import venue_geometry
from app.wire.labels import Heading, Part, TextTable, value_word
from app.wire.paths import Point, path_of
from app.wire.proposal_cards import ProposalCard, ProposalCards
from app.wire.question import Command, Output, Question, Terms, Writer
from core.dragon import BENCHES_MAX
from core.language import Language, say
from core.proposal.gates import GATES_MAX, STREETS
from core.proposal.propose import COUNT_MOST, DURATIONS
from core.proposal.search import HEAD_SPEED, LAPS_MOST

# Time for a village square with gates [s], measured 2026-11-27.
SECONDS = 6.0


class GateBody(Wire, strict=True):
    """A gate on the border of the square, with a straight street beyond it."""

    point: Point = measure("m", "Place on the border of the square, x and y")
    heading: Angle = measure("rad", "Direction of those who enter there, counter-clockwise from the x axis")

    name: OneLine = Field("", description="Name of the gate, for the words of a dance")
    use: core.GateUse = Field(
        core.GateUse.BOTH, strict=False, description="Whether a dance may begin there, end there, or both"
    )
    street_width: float | None = measure(
        "m", "Width of the street; default: 1 m more on both sides than benches need, or less where there is no room",
        None, ge=STREETS[0], le=STREETS[1],
    )  # fmt: skip
    street_length: float | None = measure(
        "m", "Length of the street, in which the whole dragon stands; default: as long as it needs", None,
        ge=STREETS[0], le=STREETS[1],
    )  # fmt: skip

    def to_gate(self) -> core.Gate:
        x, y = self.point
        return core.Gate((x, y), self.heading, self.use, self.street_width, self.street_length)


class ProposalsRequest(VenueFields, DragonFields, strict=True):
    """A square, a dragon, and what its dances shall keep."""

    gates: list[GateBody] = Field(
        default_factory=list,
        max_length=GATES_MAX,
        description="Gates at which a dance begins and ends, with the dragon in the street beyond; default: the whole "
        "dragon stands in the square",
    )
    figures: list[Annotated[core.Figure, Field(strict=False)]] | None = Field(
        None,
        min_length=1,
        description="Figures to try: spiral (in and out, with the turn between), eight, serpentine, ring, parade (from "
        "gate to gate); default: all that are possible",
    )
    stray: float = measure("m", "Largest distance of a person from their place that must be safe", 0.05, ge=0, le=25)
    margin: Margin = 0.0
    speed_limit: SpeedLimit | None = measure("m/s", "Highest speed allowed for any handle; default: no limit", None)
    objective: core.Objective = Field(
        core.Objective.TOLERANCE,
        strict=False,
        description="What is best. tolerance: the largest proven stray; benches: the most benches; turns: the most "
        "turns of the head; duration: the longest dance",
    )
    laps: Whole | None = Field(
        None,
        ge=1,
        le=LAPS_MOST,
        description="Times around a ring or an eight, once the whole dragon stands on it or has entered by its gate; "
        "no other figures are tried then. Default: twice around a ring and once around an eight, with gates once",
    )
    duration_limit: float | None = measure(
        "s",
        "Longest time of a dance, from its start to its end; rings and eights go around as often as it lasts. "
        "Default: no limit",
        None,
        ge=DURATIONS[0],
        le=DURATIONS[1],
    )
    head_speed: float = measure(
        "m/s", "Speed of the head, or less where the speed limit asks for it", HEAD_SPEED, ge=1e-3, le=20
    )
    count: Whole = Field(3, ge=1, le=COUNT_MOST, description="Number of proposals")


class Proposal(Answer, of=core.Proposal):
    """A dance that fits, which passes its check.

    dance: the dance with its venue and limits, as a body of POST /check
    duration: time from its start, with the whole dragon on its path, to its end [s]
    length: way of the head in this time [m]
    area: area of the ground that benches sweep, which reaches at most 0.1 m beyond them [m2]
    turns: turns of the head, all bends added up [turns]
    sharpest_bend: largest angle of two consecutive benches; null for a single bench [rad]
    clearance: least distance of the ground that two benches may cover with the stray of the request, which a bench
        between them may hold further apart; null with fewer than three [m]
    clearance_in_place: the same with everybody in place [m]
    highest_speed: highest speed of any handle [m/s]
    summary: the proposal in one sentence
    cards: what to say of it beside the others, in every language
    """

    figure: core.Figure
    dance: dict[str, Any]
    tolerance: float
    duration: float
    length: float
    area: float
    turns: float
    sharpest_bend: float | None
    clearance: float | None
    clearance_in_place: float | None
    highest_speed: float | None
    near: core.Near
    gates: list[int]
    summary: str
    cards: dict[Language, ProposalCard]

    @classmethod
    def of(cls, result: core.Proposal, body: dict[str, Any], cards: dict[Language, ProposalCard]) -> Self:
        speed = result.report.highest_speed
        own = {"highest_speed": speed and speed.speed, "summary": result.message, "cards": cards}
        return cls.from_result(result, dance=body, **own)


class Lack(Answer, of=core.Reason):
    """The numbers of a reason: m2 for area, m for width, way, stray, s for duration, benches for benches and fails."""

    have: float | None
    need: float | None
    figure: core.Figure | None
    who: list[int]
    failure: Failure | None

    @classmethod
    def of(cls, result: core.Reason, dragon: core.Dragon) -> Self:
        return cls.from_result(result, failure=result.failure and Failure.of(result.failure, dragon, None))


class Proposals(Answer):
    """Dances that fit, the best one of those that were tried first; none is proven to be the best there is.

    proposals: the proposals; none if no dance passes
    tried: dances that were laid out and measured
    checked: of these, dances that a check judged
    reason: why there is none, in one sentence; null if there is one
    reason_kind: area: the benches cover more than the square has; width: nowhere is room for a turn as tight as those
        that are tried; way: no way between the gates is wide enough; stray: only a smaller stray is possible; duration:
        the dances that were found last longer than the limit; benches: only a shorter dragon fits; fails: none of the
        dances that were tried passes
    reason_values: the numbers of the reason; null if there is a proposal
    most_benches: Proven: no dragon of this kind with more benches fits, by the area of the square; null with gates
    summary: the answer in one sentence
    """

    proposals: list[Proposal]
    tried: int
    checked: int
    reason: str | None
    reason_kind: core.ReasonKind | None
    reason_values: Lack | None
    most_benches: int | None
    summary: str


def proposals(request: ProposalsRequest, terms: Terms) -> Proposals:
    """Dances that fit into a square, the best first, each certified by a check; or the reason why none does."""
    return _with_files(request, terms)[0]


def _with_files(request: ProposalsRequest, terms: Terms) -> tuple[Proposals, dict[str, Writer]]:
    """The answer, and what makes a file for check and a picture of each dance, and an overview of several."""
    result, place = _proposed(request, terms)
    answer = _answer_of(request, result, place)

    def files(form: str) -> dict[str, bytes]:
        from app.files.proposals import overview, proposal_picture  # matplotlib takes a second to import

        made = dict[str, bytes]()
        for k, (one, body) in enumerate(zip(result.proposals, answer.proposals, strict=True), start=1):
            name = f"{k}-{one.figure.value}"
            made[f"{name}.json"] = orjson.dumps(body.dance, option=orjson.OPT_INDENT_2)
            made[f"{name}.png"] = proposal_picture(one)
        return made | ({"overview.png": overview(result.proposals)} if result.proposals else {})

    return answer, {"output": files}


def _answer_of(request: ProposalsRequest, result: core.Proposals, place: Place) -> Proposals:
    """The answer with the proposals of core."""
    bodies = _worded(request, result.proposals, place)
    reason, kind = (result.reason.message, result.reason.kind) if result.reason else (None, None)
    values = result.reason and Lack.of(result.reason, request.to_dragon(BENCHES_MAX))
    own: dict[str, Any] = {"reason": reason, "reason_kind": kind, "reason_values": values}
    return Proposals.from_result(result, proposals=bodies, summary=result.message, **own)


def _worded(
    request: ProposalsRequest, found: Sequence[core.Proposal], place: Place, ended: bool = True
) -> list[Proposal]:
    """Proposals with their cards, each beside the others; ended: with what each has most of."""
    assert place.venue is not None
    names = [gate.name or say("gate {k}", k=k) for k, gate in enumerate(request.gates)]
    cards = ProposalCards(found, place.venue.square, names, request.stray, ended)
    return [Proposal.of(one, body_of(request, one, place.origin), cards.of(k)) for k, one in enumerate(found)]


def _proposed(request: ProposalsRequest, terms: Terms) -> tuple[core.Proposals, Place]:
    """The proposals as objects of core, and the place of the venue. raises: TooLarge, InvalidValue"""
    dragon = request.to_dragon(terms.settings.checked_benches_max)
    place = request.to_place(dragon)
    if place.venue is None:
        raise core.InvalidValue("venue", "must be given: a dance is proposed for a square")
    gates = [gate.to_gate() for gate in request.gates]
    limits: dict[str, Any] = {"stray": request.stray, "margin": request.margin, "speed_limit": request.speed_limit}
    wishes = ("objective", "count", "laps", "duration_limit", "head_speed")
    wish: dict[str, Any] = {name: getattr(request, name) for name in wishes}
    found: list[core.Proposal] = []

    def tell(one: core.Proposal) -> None:
        found.append(one)
        terms.part(_worded(request, found, place, ended=False)[-1])

    result = core.propose(
        place.venue,
        dragon,
        gates=gates,
        figures=request.figures,
        budget=terms.budget,
        on_proposal=tell,
        progress=terms.progress,
        **wish,
        **limits,
    )
    return result, place


def body_of(request: ProposalsRequest, one: core.Proposal, origin: GeographicOrigin | None) -> dict[str, Any]:
    """The body of POST /check for a proposal, with the limits that were asked for."""
    body = {
        "dragon": dragon_of(one.dance.dragon),
        "path": path_of(one.dance.path.as_route(one.dance.path.end)),
        "head_speed": one.dance.head_speed,
        "venue": venue_geometry(one.venue, origin),
        "margin": request.margin,
        "stray": request.stray,
        "start": 0.0,
    }
    return body if request.speed_limit is None else {**body, "speed_limit": request.speed_limit}


def dragon_of(dragon: core.Dragon) -> dict[str, Any]:
    """A dragon in a body: bench by bench, unless all but the head are alike."""
    names = {"names": list(dragon.names)} if dragon.names else {}
    summary = core.DragonSummary.of(dragon)
    if summary.head_length is None:
        columns = {"lengths": dragon.lengths, "widths": dragon.widths, "overhangs": dragon.overhangs}
        return {name: column.tolist() for name, column in columns.items()} | names
    body = summary.body_length or summary.head_length
    sizes = {"width": summary.width, "overhang": summary.overhang}
    return {"benches": dragon.benches, "head_length": summary.head_length, "body_length": body, **sizes, **names}


def _parts(answer: Proposals, request: ProposalsRequest) -> Iterator[Part]:
    yield Heading(answer.summary)
    if not answer.proposals:
        return
    counts = request.objective is core.Objective.BENCHES
    has_gates = bool(answer.proposals[0].gates)
    table = TextTable(
        say("Proposals"), say("figure"), *[say("gates")] * has_gates, *[say("benches")] * counts, say("safe stray"),
        say("duration"), say("length"), say("turns"), say("nearest"), say("with stray"), say("highest speed"),
    )  # fmt: skip
    for one in answer.proposals:
        near = f"{one.near.in_place:.3f} m, {one.near.name}"
        speed = "" if one.highest_speed is None else f"{one.highest_speed:.2f} m/s"
        way = [" → ".join(map(str, one.gates))] * has_gates
        row: list[Any] = [value_word(one.figure.value), *way, *[str(_benches(one.dance["dragon"]))] * counts]
        row += [f"{one.tolerance:.3f} m", f"{one.duration:.0f} s", f"{one.length:.0f} m"]
        table.add(*row, f"{one.turns:.1f}", near, f">= {one.near.distance:.3f} m", speed)
    yield table
    if counts and answer.most_benches is not None:
        yield say(
            "By the area of the square, no dragon of this kind has more than {most} benches.", most=answer.most_benches
        )


def _benches(dragon: dict[str, Any]) -> int:
    """Number of the benches of a dragon in a body."""
    return len(dragon["lengths"]) if "lengths" in dragon else int(dragon["benches"])


QUESTION = Question(
    proposals,
    Proposals,
    body=ProposalsRequest,
    cost=lambda request: SECONDS,
    command=Command(
        "Dances that fit into a square, each certified by a check; or the reason why none does. The exit code is 0.",
        lambda request: say("propose"),
        _parts,
        file="Venue, dragon, gates and wishes as for POST /proposals, as a .toml or .json file.",
        outputs={
            "output": Output(
                "Write a file for check and a picture of each dance, and an overview, into this folder.",
                {},
                extras={"": "figures"},
            )
        },
        solve=_with_files,
    ),
)
