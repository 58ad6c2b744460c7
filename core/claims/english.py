"""Claims in English.

A claim names the whole dance and all its numbers with all their digits, because a rounded one would describe another
dance, or an instant that is not proven.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from core.claims.claim import (
    BenchBetween,
    Claim,
    ClaimKind,
    ContactClaim,
    DanceSummary,
    DragonSummary,
    EncounterClaim,
    GroundClaim,
    PartSummary,
    ProbabilityClaim,
    StrayClaim,
    format_safe,
)
from core.dance import EndReason
from core.display import format_count, format_range
from core.errors import format_number
from core.passages import Passage
from core.paths.path import PathSummary

PROOF = (
    "Proven in steps, each by a bound on the second derivative of the gap along an axis fixed in a bench, and further "
    "out by ring bounds in closed form; computed in doubles, with allowances for their rounding."
)
NO_PAIR = "Of fewer than three benches, any two share a handle, so there is no pair to judge."
TRIED = "Computed in doubles, with allowances for their rounding."
MEASURED = "Measured at that instant, in doubles."
ENDS = {
    EndReason.FOLD: "; there a bench folds, and the run ends.",
    EndReason.CENTRE: "; there the head is at the centre.",
    EndReason.END: "; there the path ends.",
    EndReason.STOP: "; the search was to stop there.",
}
ENCOUNTERS = (
    "Proven in steps of time for all benches at once, each by a bound on the second derivative of the gap along an "
    "axis fixed in a bench, and further out in one spiral by ring bounds in closed form; computed in doubles, with "
    "allowances for their rounding."
)
ONE_DRAGON = "There is only one dragon, so there is no pair to judge."
PERFORMANCE_ENDS = {
    EndReason.FOLD: "; there a bench folds, and the performance ends.",
    EndReason.END: "; there the last path ends.",
    EndReason.STOP: ENDS[EndReason.STOP],
}
HULLS = (
    "Proven in steps for the hulls of all places that benches can have then, as first contacts are for benches; "
    "computed in doubles, with allowances for their rounding."
)
BETWEEN = {
    None: "",
    BenchBetween.HELD: " Two benches with one between them are held apart by it: distances of handles prove that.",
    BenchBetween.UNUSED: " The two benches that limit it have one between them, which is not used here: they are "
    "assumed to stray independently, so the stray is lower than it could be.",
}


def contact(claim: ContactClaim) -> str:
    proof = PROOF if claim.dance.dragon.benches > 2 else NO_PAIR
    return _search(claim, _dance(claim.dance), "two benches that share no handle", ENDS, proof)


def encounter(claim: EncounterClaim) -> str:
    parts = "; ".join(_part(k, part) for k, part in enumerate(claim.parts))
    parts = parts or f"{claim.part_count} dragons with {claim.bench_count} benches in all"
    proof = ENCOUNTERS if claim.part_count > 1 else ONE_DRAGON
    return _search(claim, parts, "benches of two dragons", PERFORMANCE_ENDS, proof)


def _search(
    claim: ContactClaim | EncounterClaim, scene: str, pairs: str, ends: Mapping[EndReason, str], proof: str
) -> str:
    """The claim of a search. scene: what dances; pairs: which benches it judges; ends, proof: words of such a search"""
    start, stray = format_number(claim.start), format_number(claim.stray)
    if claim.kind is ClaimKind.CONTACT_AT_START:
        fact, proof = f"at {_pair(claim)} {_near(claim, may=claim.stray > 0.0)}.", MEASURED
    elif claim.clear_until is None:
        undecided = f"it is not decided whether {pairs} {_near(claim)}"
        fact, proof = f"from {start} s on {undecided}{_before(claim)}.", TRIED
    else:
        until = format_number(claim.clear_until)
        fact = f"from {start} s to {until} s no {pairs} {_near(claim)}{_then(claim, ends)}"
    strayed = f"while every hole is within {stray} m of its place, and every chord keeps its length, "
    return f"{scene}: {strayed if claim.stray else ''}{fact} {proof}"


def stray(claim: StrayClaim) -> str:
    dragon, stray = claim.dance.dragon, format_safe(claim.stray)
    sizes = f"{format_range(dragon.lengths, 'm')} long, {format_range(dragon.widths, 'm')} wide"
    span = f"from {format_number(claim.start)} s to {format_number(claim.stop)} s"
    danced = f"{dragon.benches} benches, {sizes} on {_path(claim.dance.path)}: {span}"
    edge = " or an edge of the venue" if claim.venue else ""
    if claim.kind is ClaimKind.NO_SAFE_STRAY:
        why = f"a bench touches another{edge} with everybody in place" if claim.touches else "none was proven"
        return f"{danced} no stray is known to be safe: {why}."
    strayed = f"while every hole is within {stray} m of its place and every chord keeps its length"
    apart = f"no bench touches another that it shares no handle with{edge}."
    return f"{danced}, {strayed}, {apart} {HULLS}{BETWEEN[claim.between]}"


def probability(claim: ProbabilityClaim) -> str:
    words = (
        f"In {claim.contacts} of {claim.samples} dances drawn from the model two benches that share no handle touch "
        f"at one of {claim.instants} instants {format_number(claim.step)} s apart; what happens between two of them is "
        "not judged. The limits are Clopper and Pearson's: whatever the probability of the model is, it lies outside "
        f"them for at most {100.0 * (1.0 - claim.confidence):.3g} % of all seeds."
    )
    if claim.union_bound is not None:
        most = f"is at most {format_number(claim.union_bound)} at these instants, whatever the samples say"
        order = "in first order with bounds of the rest, computed in doubles"
        words += f" The probability of the model {most}: a union bound over all pairs and instants, {order}."
    if claim.tolerance:
        safe = f"While no hole is further than {format_safe(claim.tolerance)} m from its place, nothing touches"
        within = "in every sample a hole is further away at one of these instants"
        if claim.within:
            within = f"in {claim.within} samples no hole is further away at any of these instants"
        words += f" {safe} at any time, which is proven; {within}."
    return words


def ground(claim: GroundClaim) -> str:
    over = f"{format_count(claim.sizes, 'size')}, {claim.length:.6g} m of the path, {format_count(claim.cells, 'cell')}"
    return (
        f"From {format_number(claim.start)} to {format_number(claim.stop)} s no bench leaves the polygons, and no "
        f"point of theirs is more than {claim.excess:.3g} m from ground that a bench covers. Benches of one size sweep "
        f"together what one of them sweeps over all their places: {over}. In each cell a bound on the second "
        "derivative shows how far a point of a bench can be from the straight line between its first and its last "
        "place. The polygons are the union of what edges sweep along such lines, grown by more than that."
    )


def _near(claim: ContactClaim | EncounterClaim, *, may: bool = False) -> str:
    if claim.margin:
        return f"{'may be' if may else 'are'} nearer to each other than {format_number(claim.margin)} m"
    return "may touch" if may else "touch"


def _pair(claim: ContactClaim | EncounterClaim, between: str = "") -> str:
    assert claim.benches is not None
    assert claim.time is not None
    (a, b), time = claim.benches, f"{format_number(claim.time)} s{between}"
    if isinstance(claim, EncounterClaim) and claim.dragons is not None:
        i, j = claim.dragons
        return f"{time} bench {a} of dragon {i} and bench {b} of dragon {j}"
    return f"{time} benches {a} and {b}"


def _overlap(claim: ContactClaim | EncounterClaim) -> str:
    if claim.margin:
        return f"{'may be' if claim.stray else 'are'} nearer than {format_number(claim.margin)} m"
    return "may overlap" if claim.stray else "overlap"


def _then(claim: ContactClaim | EncounterClaim, ends: Mapping[EndReason, str]) -> str:
    """The end of the sentence about a time without a contact."""
    if claim.kind is ClaimKind.UNDECIDED:
        return f"; whether any do after that is not decided{_before(claim)}."
    return ends[claim.end] if claim.end else f", and at {_pair(claim)} {_overlap(claim)}."


def _before(claim: ContactClaim | EncounterClaim) -> str:
    """The later contact that is certain, if an undecided search found one."""
    return f" before {_pair(claim, ', when')} {_overlap(claim)}" if claim.benches else ""


def _part(k: int, part: PartSummary) -> str:
    name = f"dragon {k}" if part.name is None else f"dragon {k} ({part.name})"
    x, y = map(format_number, part.centre)
    place = f", about ({x}, {y}) m" if part.centre != (0.0, 0.0) else ""
    place += f", turned by {format_number(part.rotation)} rad" if part.rotation else ""
    place += "" if part.clockwise else ", counter-clockwise"
    delay = f", delayed by {format_number(part.delay)} s" if part.delay else ""
    return f"{name}, {_dance(part.dance)}{place}{delay}"


def _dance(dance: DanceSummary) -> str:
    speed = f"{format_number(dance.head_speed)} m/s"
    head = f"{speed} after {dance.passage_count} passages given one by one" if dance.passage_count else speed
    if dance.passages:
        head = f"{', '.join(map(_passage, dance.passages))}, and then at {speed}"
    return f"{_dragon(dance.dragon)} on {_path(dance.path)}, the head at {head}"


def _dragon(dragon: DragonSummary) -> str:
    count = f"{dragon.benches} bench{'es' if dragon.benches > 1 else ''}"
    if dragon.head_length is None or dragon.width is None or dragon.overhang is None:
        return f"{count} given one by one"
    body = "" if dragon.body_length is None else f", body {format_number(dragon.body_length)} m"
    width, overhang = format_number(dragon.width), format_number(dragon.overhang)
    return f"{count} (head {format_number(dragon.head_length)} m{body}, width {width} m, overhang {overhang} m)"


def _path(path: PathSummary) -> str:
    if path.pitch is not None and path.start_turns is not None:
        return f"a spiral of {format_number(path.pitch)} m pitch from {format_number(path.start_turns)} turns"
    span = f"s = {format_number(path.begin)} m to {format_number(path.end)} m"
    return f"a route from {span} ({', '.join(path.pieces)})"


def _passage(passage: Passage) -> str:
    end = f"{format_number(passage.until_time or 0.0)} s"
    if passage.until_s is not None:
        end = f"{format_number(passage.until_s)} m"
    return f"{format_number(passage.speed)} m/s until {end}"


# The function that puts each class of claims in sentences.
SENTENCES: dict[type[Claim], Callable[[Any], str]] = {
    ContactClaim: contact,
    EncounterClaim: encounter,
    StrayClaim: stray,
    ProbabilityClaim: probability,
    GroundClaim: ground,
}
