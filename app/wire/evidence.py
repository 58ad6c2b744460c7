"""Answers in words for people, and how each is known: what the page shows of them beside their sentences."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from typing import Any

from pydantic import Field

import core
from app.wire.fields import Answer, Strays
from app.wire.readings import bench_words, has_drawn_path
from core.contact.answer import Outcome
from core.dance import EndReason
from core.design.pitch_search import JustifiedBy
from core.failures import approach_words
from core.language import Listed, Phrases, joined, phrase, say
from core.plots import FEATURES
from core.quantities import format_bound, format_number
from core.shapes.engines import Engine

# Sentences about contacts. With a margin benches in contact may be apart, and with a stray they only may touch.
FORMS: Phrases = {
    "first": "First contact",
    "first_near": "First time within {margin} m",
    "contact": "Contact at {time} s",
    "contact_near": "Within {margin} m at {time} s",
    "contact_stray": "May {touch} from {time} s",
    "contact_at_start": "Touching already at the start",
    "contact_at_start_near": "Within {margin} m from the start on",
    "contact_at_start_stray": "May {touch} already at the start",
    "clear": "Nothing touches",
    "clear_near": "Never within {margin} m",
    "clear_stray": "Stays clear: nothing can {touch}",
    "drawn": "Benches with each other: never touch",
    "drawn_near": "Benches with each other: never within {margin} m",
    "drawn_stray": "Benches with each other: nothing can {touch}",
    "fold": "The dragon folds at {time} s",
    "undecided": "Undecided",
    "end": "The dance stops at the first contact.",
    "end_near": "The dance is shown until two benches come within {margin} m of each other.",
    "end_stray": "The dance is shown until two benches may {touch}.",
    "graze": "{gap} mm between {a} and {b} at {time} s",
    "graze_stray": "{gap} mm between the areas that {a} and {b} may cover, at {time} s",
    "all": " judged all {count} benches.",
    "all_stray": (
        " judged the pair, each in its place, by the gap at this contact; shapely also judged the area that all "
        "{count} benches may cover."
    ),
    "pair": " judged {a} and {b} alone.",
    "pair_stray": " judged {a} and {b} alone, each in its place, by the gap at this contact.",
    "some": " judged the {count} of {benches} benches near the pair.",
    "False": "apart",
    "False_near": "not within {margin} m",
    "False_stray": "wider apart",
    "True": "they overlap",
    "True_near": "within {margin} m",
    "True_stray": "nearer",
    "None": "contact at the start",
    "meet": "{corner} of {a} meets {edge} of {b}",
    "meet_near": "{corner} of {a} is within {margin} m of {edge} of {b}",
    "meet_stray": "{corner} of {a} is nearest to {edge} of {b}",
}
ENGINES: Phrases = {
    Engine.SEPARATING_AXIS: "separating axis",
    Engine.FCL: "FCL",
    Engine.SHAPELY: "shapely",
    Engine.ANGLE_SUM: "angle sum (paper)",
}
# Why every larger pitch is right.
JUSTIFIED: Phrases = {
    JustifiedBy.BOUND: "feasible, proven for all at once",
    JustifiedBy.SCAN: ("feasible by a scan: up to {from} m only single pitches are proven, at most {step} mm apart"),
}
# Why a run without a contact ends.
ENDS: Phrases = {
    EndReason.CENTRE: "The head is at the centre.",
    EndReason.END: "The head is at the end of its path.",
    EndReason.STOP: "The time that was asked about is over.",
}
# A beginning that is so far from 0 is worth a word [s].
SHOWN = 0.05


class EngineTable(Answer):
    """Verdicts of the engines as a table in words.

    caption: who judged what, and whether they agree
    rows: its heads, then a row for each engine
    """

    caption: str
    rows: list[list[str]]


class Words(Answer):
    """An answer in words for people.

    title: what was asked
    headline: the answer in a few words, rounded as people say it
    exact: the same with all of its digits
    facts: how it is known: what, and its value
    notes: how it is known, in sentences, without those of a certificate beside them
    engines: verdicts of the engines; null without any
    """

    title: str
    headline: str
    exact: str
    facts: list[tuple[str, str]] = Field(default=[])
    notes: list[str] = Field(default=[])
    engines: EngineTable | None = None


class FoldWords(Words):
    """The highest speed of a dance that folds, which has none.

    sentences: what it means, in sentences
    near: what to say beside speeds just before the fold
    """

    sentences: list[str]
    near: str


class ContactWords(Words):
    """A first contact in words for people.

    fold: the highest speed where the dance folds; null where it does not
    meeting: what meets; null if nothing does
    ends: why the dance ends, in sentences
    """

    fold: FoldWords | None = None
    meeting: str | None
    ends: list[str]


# Field of an answer that holds its words.
WORDS: Any = Field(
    None, description="The answer in words, and how it is known; null unless the request has an Accept-Language"
)


@cache
def _form(name: str, has_stray: bool, has_margin: bool) -> str:
    """The template of FORMS for contacts with a stray or a margin."""
    kinds = ["_stray"] * has_stray + ["_near"] * has_margin + [""]
    return next(FORMS[f"{name}{kind}"] for kind in kinds if f"{name}{kind}" in FORMS)


class Contacts:
    """Words about contacts as a request defines them."""

    def __init__(self, request: Any, dragon: core.Dragon) -> None:
        self.stray, self.margin, self.dragon = request.to_stray(), request.margin, dragon
        touch = approach_words(self.margin, 0.0) if self.stray else ""
        self._values = {"margin": format_number(self.margin), "touch": touch}
        self._by_play = request.hole > 0.0

    def worded(self, name: str, **values: Any) -> str:
        """A sentence of FORMS in the form for these contacts."""
        return say(_form(name, self.stray > 0.0, self.margin > 0.0), **self._values, **values)

    def title(self, words: str) -> str:
        """A title with the stray of the answer."""
        if not self.stray:
            return words
        each = phrase("{title}, everybody within {stray} cm of their place")
        if self._by_play:
            each = phrase("{title}, every hole within {stray} cm of its place")
        return say(each, title=words, stray=f"{100.0 * self.stray:.9g}")

    def names(self, benches: Sequence[int]) -> list[str]:
        return [bench_words(bench % self.dragon.benches, self.dragon) for bench in benches]

    def pair(self, benches: Sequence[int]) -> dict[str, str]:
        return dict(zip("ab", self.names(benches), strict=True))

    def engines(self, check: core.ContactCheck | None) -> EngineTable | None:
        """The table of the engines."""
        if check is None:
            return None
        count, benches = len(check.judged), self.dragon.benches
        first = say("shapely judged the area that {count} benches may cover.", count=count)
        if len(check.engines) > 1:
            values = {"count": count, "benches": benches}
            form = "all" if count == benches else "pair" if count == len("ab") else "some"
            pair = self.pair(check.judged) if form == "pair" else {}
            first = say("{count} engines", count=len(check.engines)) + self.worded(form, **values, **pair)
        also = say("; ").join(str(Listed(self.names(both))) for both in check.together)
        caption = [
            first,
            say("They agree.") if check.agree else say("They differ."),
            say("At the same instant also: {list}.", list=also) if also else "",
        ]
        heads = [say("Engine"), say("just before"), say("just after")]
        rows = [
            [say(ENGINES[engine]), self.worded(str(one.before)), self.worded(str(one.after))]
            for engine, one in check.engines.items()
        ]
        return EngineTable(caption=joined(caption), rows=[heads, *rows])


def _digits(value: float, decimals: int) -> str:
    return f"{round(value, decimals) + 0.0:.{decimals}f}"


def gap_words(gap: float) -> str:
    """A gap of two benches [m] in words; a negative one as the depth of the overlap."""
    words = _digits(1000.0 * gap, 3)
    return say("overlap by {depth} mm", depth=words[1:]) if words[0] == "-" else say("gap {gap} mm", gap=words)


def _bracket(template: str, ends: Sequence[float], decimals: int) -> tuple[str, str]:
    low, high = ends
    values = {"low": format_bound(low, decimals), "high": format_bound(high, decimals, up=True)}
    return say("Bracket, rounded outwards"), say(template, **values)


def _fold_words(time: str) -> FoldWords:
    why = say("Near a fold, the speed of the handle behind it grows as one over the square root of the remaining way.")
    words = say("Grows without bound")
    return FoldWords(
        title=say("Highest speed"), headline=words, exact=words, notes=[why],
        sentences=[say("towards the fold, where a bench cannot follow any more")],
        near=say("Just before the fold at {time} s: towards it the speeds grow without bound.", time=time),
    )  # fmt: skip


def contact_words(
    contact: core.FirstContact, request: Strays, check: core.ContactCheck | None, sentences: Sequence[str]
) -> ContactWords:
    """The words of a first contact. sentences: of the answer"""
    near, end, dance = Contacts(request, contact.dance.dragon), contact.end, contact.dance
    is_drawn = has_drawn_path(dance)
    folds = end is not None and end.reason is EndReason.FOLD
    state = "fold" if folds else "drawn" if is_drawn and contact.outcome is Outcome.CLEAR else contact.outcome.value
    time = contact.time if end is None else end.time
    headline, exact = (near.worded(state, time="" if time is None else _digits(time, few)) for few in (2, 6))
    facts, least = [], contact.certificate.least_clearance
    if least is not None:
        gap, when = _digits(1000.0 * least.clearance, 3), f"{least.time:.6f}"
        facts = [(say("Narrowest graze"), near.worded("graze", gap=gap, time=when, **near.pair(least.benches)))]
    notes = [] if check else [say("No pair to cross-check.")]
    meeting, ends = None, [say("The dance is shown as far as it is proven clear.")]
    if contact.benches is not None:
        ends, pair = [near.worded("end")], str(Listed(near.names(contact.benches)))
        if contact.corner and contact.edge:
            features = {"corner": say(FEATURES[contact.corner.name]), "edge": say(FEATURES[contact.edge.name])}
            pair = near.worded("meet", **features, **near.pair((contact.corner.bench, contact.edge.bench)))
        meeting = pair if contact.gap is None else say("; ").join((pair, gap_words(contact.gap)))
    elif end is not None:
        ends = [sentences[-1] if folds else say(ENDS[end.reason])]
    if is_drawn and abs(dance.begin) >= SHOWN:
        ends.append(say("Times count from 0 s; the dance begins at {begin} s.", begin=_digits(dance.begin, 2)))
    return ContactWords(
        title=near.title(near.worded("first")), headline=headline, exact=exact, facts=facts, notes=notes,
        engines=near.engines(check), meeting=meeting, ends=ends,
        fold=_fold_words(_digits(time or 0.0, 6)) if folds else None,
    )  # fmt: skip


def pitch_words(
    result: core.MinimumPitch, request: Strays, dragon: core.Dragon, check: core.ContactCheck | None
) -> Words:
    """The words of a minimum pitch."""
    near, (low, high) = Contacts(request, dragon), result.pitch_bracket
    none = say("none: at every smaller pitch the dance would begin inside the circle")
    values = {
        "from": format_bound(result.proven_from, 9, up=True),
        "step": "" if result.scan_step is None else _digits(1000.0 * result.scan_step, 3),
        "to": "" if result.proven_up_to is None else format_number(result.proven_up_to),
    }
    proven = phrase("from {from} m to {to} m")
    if result.proven_up_to is None:
        proven = phrase("from {from} m on, without limit")
    bracket = _bracket(phrase("infeasible at {low} m, feasible at {high} m"), (low, high), 13)
    facts = [
        bracket if low < high else (bracket[0], none),
        (say("Every larger pitch"), say(JUSTIFIED[result.justified_by], **values)),
        (say("Proven for every pitch"), say(proven, **values)),
        (
            say("Runs to the circle that were computed, for single pitches and for bands of pitches"),
            str(result.evaluations),
        ),
    ]
    return Words(
        title=near.title(say("Minimum pitch")),
        headline=f"{format_bound(100.0 * result.pitch, 2, up=True)} cm",
        exact=f"{result.pitch:.9f} m",
        facts=facts,
        notes=[] if check else [say("No pair to cross-check.")],
        engines=near.engines(check),
    )


def _measured(title: str, value: float, unit: str, few: int, decimals: int, **known: Any) -> Words:
    headline, exact = (f"{_digits(value, count)} {unit}" for count in (few, decimals))
    return Words(title=title, headline=headline, exact=exact, **known)


def shortest_words(result: core.ShortestTurn | core.DeepestTurn, request: Strays, dragon: core.Dragon) -> Words:
    """The words of a shortest turn."""
    near = Contacts(request, dragon)
    facts = [_bracket(phrase("turns as short enter from {low} m to {high} m from the centre"), result.entry_bracket, 9)]
    if isinstance(result, core.ShortestTurn):
        danced = phrase("none is shorter than {low} m; this one was danced: {high} m")
        facts.insert(0, _bracket(danced, result.length_bracket, 9))
        facts.append(_bracket(phrase("and leave from {low} m to {high} m from it"), result.exit_bracket, 9))
    return _measured(
        near.title(say("Shortest turn at ratio {ratio}", ratio=format_number(result.turn.ratio))),
        result.turn.length,
        "m",
        2,
        6,
        facts=facts,
    )


def time_words(title: str, result: core.TurnTime, notes: list[str]) -> Words:
    """The words of the time through a turn."""
    return _measured(title, result.time, "s", 2, 6, notes=notes)


def head_words(result: core.MaximumHeadSpeed) -> Words:
    """The words of a maximum head speed."""
    low, high = result.head_speed_bracket
    known: dict[str, Any] = {}
    if low is None:
        reached = say(
            "{high} m/s reaches the limit; no lower speed is proven to keep it.", high=format_bound(high, 9, up=True)
        )
        known["notes"] = [reached]
    else:
        keeps = phrase("{low} m/s keeps the limit, {high} m/s reaches it")
        known["facts"] = [_bracket(keeps, (low, high), 9)]
    return _measured(say("Maximum head speed"), result.head_speed, "m/s", 3, 9, **known)


def speed_words(result: core.HighestSpeed) -> Words:
    """The words of a highest speed."""
    low, high = result.speed_bracket
    reached = phrase("{low} m/s is reached, {high} m/s never exceeded")
    facts = [] if high is None else [_bracket(reached, (low, high), 9)]
    return _measured(say("Highest speed"), result.speed, "m/s", 2, 6, facts=facts)


def stray_words(result: core.Tolerance) -> Words:
    """The words of a tolerance."""
    low, high = result.stray_bracket
    both = phrase("nothing touches up to {low} cm; a pose with {high} cm overlaps")
    if high is None:
        both = phrase("nothing touches up to {low} cm; no pose that overlaps is known")
    headline, exact = (f"{format_bound(100.0 * result.stray, count)} cm" for count in (1, 2))
    return Words(
        title=say("How far people may stray"),
        headline=headline,
        exact=exact,
        facts=[_bracket(both, (100.0 * low, 100.0 * (high or 0.0)), 7)],
    )
