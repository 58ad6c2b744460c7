"""Claims and their proofs in sentences.

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
    TailClaim,
    format_safe,
)
from core.dance import EndReason
from core.display import format_range
from core.language import Listed, counted, phrase, say, sense
from core.passages import Passage
from core.paths.path import PathSummary
from core.quantities import format_bound, format_number
from core.values import Interval

PROOF = phrase(
    "Proven in steps, each by a bound on the second derivative of the gap along an axis fixed in a bench, and further "
    "out by ring bounds in closed form; computed in doubles, with allowances for their rounding."
)
NO_PAIR = phrase("Of fewer than three benches, any two share a handle, so there is no pair to judge.")
TRIED = phrase("Computed in doubles, with allowances for their rounding.")
MEASURED = phrase("Measured at that instant, in doubles.")
ENDS = {
    EndReason.FOLD: phrase("; there a bench folds, and the run ends."),
    EndReason.CENTRE: phrase("; there the head is at the centre."),
    EndReason.END: phrase("; there the path ends."),
    EndReason.STOP: phrase("; the search was to stop there."),
}
ENCOUNTERS = phrase(
    "Proven in steps of time for all benches at once, each by a bound on the second derivative of the gap along an "
    "axis fixed in a bench, and further out in one spiral by ring bounds in closed form; computed in doubles, with "
    "allowances for their rounding."
)
ONE_DRAGON = phrase("There is only one dragon, so there is no pair to judge.")
PERFORMANCE_ENDS = {
    EndReason.FOLD: phrase("; there a bench folds, and the performance ends."),
    EndReason.END: phrase("; there the last path ends."),
    EndReason.STOP: ENDS[EndReason.STOP],
}
HULLS = phrase(
    "Proven in steps for the hulls of all places that benches can have then, as first contacts are for benches; "
    "computed in doubles, with allowances for their rounding."
)
BETWEEN = {
    BenchBetween.HELD: phrase(
        " Two benches with one between them are held apart by it: distances of handles prove that."
    ),
    BenchBetween.UNUSED: phrase(
        " The two benches that limit it have one between them, which is not used here: they are assumed to stray "
        "independently, so the stray is lower than it could be."
    ),
}
OF_ONE, OF_TWO = phrase("two benches that share no handle"), phrase("benches of two dragons")
PIECES = {
    "line": phrase("line"), "arc": phrase("arc"), "coil": phrase("coil"), "clothoid": phrase("clothoid"),
}  # fmt: skip


def claim_words(claim: Claim) -> str:
    """A claim and its proof in sentences, in the language that is spoken.

    >>> from core.claims.claim import ClaimKind, GroundClaim
    >>> from core.language import speaking
    >>> with speaking("zh"):
    ...     claim_words(GroundClaim(ClaimKind.SWEPT_GROUND, 0.0, 9.5, 1e-3, 2, 30.0, 88))[:25]
    '0 s 至 9.5 s，没有板凳越出这些多边形，其'
    """
    return SENTENCES[type(claim)](claim)


def _contact(claim: ContactClaim) -> str:
    proof = PROOF if claim.dance.dragon.benches > 2 else NO_PAIR
    return _search(claim, _dance(claim.dance), OF_ONE, ENDS, proof) + (
        say(BETWEEN[claim.between]) if claim.between else ""
    )


def _encounter(claim: EncounterClaim) -> str:
    parts = say("; ").join(_part(k, part) for k, part in enumerate(claim.parts))
    parts = parts or say(
        "{dragons} dragons with {benches} benches in all", dragons=claim.part_count, benches=claim.bench_count
    )
    return _search(claim, parts, OF_TWO, PERFORMANCE_ENDS, ENCOUNTERS if claim.part_count > 1 else ONE_DRAGON)


def _search(
    claim: ContactClaim | EncounterClaim, scene: str, judged: str, ends: Mapping[EndReason, str], proof: str
) -> str:
    """The claim of a search. scene: what dances; judged: which benches; ends, proof: words of such a search"""
    start, pairs = format_number(claim.start), say(judged)
    if claim.kind is ClaimKind.CONTACT_AT_START:
        near = _near(claim, may=claim.stray > 0.0)
        fact, proof = say("at {pair} {near}.", pair=_pair(claim), near=near), MEASURED
    elif claim.clear_until is None:
        values = {"start": start, "pairs": pairs, "near": _near(claim), "before": _before(claim)}
        fact = say("from {start} s on it is not decided whether {pairs} {near}{before}.", **values)
        proof = TRIED
    else:
        values = {"start": start, "pairs": pairs, "until": format_number(claim.clear_until), "then": _then(claim, ends)}
        fact = say("from {start} s to {until} s no {pairs} touch{then}", **values)
        if claim.margin:
            margin = format_number(claim.margin)
            fact = say(
                "from {start} s to {until} s no {pairs} are nearer to each other than {margin} m{then}",
                margin=margin,
                **values,
            )
    if not claim.stray:
        return say("{scene}: {fact} {proof}", scene=scene, fact=fact, proof=say(proof))
    return say(
        "{scene}: while every hole is within {stray} m of its place, and every chord keeps its length, {fact} {proof}",
        scene=scene,
        stray=format_number(claim.stray),
        fact=fact,
        proof=say(proof),
    )


def _stray(claim: StrayClaim) -> str:
    dragon = claim.dance.dragon
    danced = say(
        "{benches} benches, {long} long, {wide} wide on {path}: from {start} s to {stop} s",
        benches=dragon.benches,
        long=_range(dragon.lengths),
        wide=_range(dragon.widths),
        path=_path(claim.dance.path),
        start=format_number(claim.start),
        stop=format_number(claim.stop),
    )
    if claim.kind is ClaimKind.NO_SAFE_STRAY:
        why = say("none was proven")
        if claim.touches:
            edge = say(" or an edge of the venue") if claim.venue else ""
            why = say("a bench touches another{edge} with everybody in place", edge=edge)
        return say("{danced} no stray is known to be safe: {why}.", danced=danced, why=why)
    apart = say(
        "{danced}, while every hole is within {stray} m of its place and every chord keeps its length, no bench "
        "touches another that it shares no handle with{edge}. {proof}",
        danced=danced,
        stray=format_safe(claim.stray),
        edge=sense("nothing touches", " or an edge of the venue") if claim.venue else "",
        proof=say(HULLS),
    )
    return apart + (say(BETWEEN[claim.between]) if claim.between else "")


def _range(sizes: Interval) -> str:
    low, high = (format_range([size], "m") for size in sizes)
    return high if low == high else say("{low} to {high}", low=low.removesuffix(" m"), high=high)


def _probability(claim: ProbabilityClaim) -> str:
    words = say(
        "In {claim.contacts} of {claim.samples} dances drawn from the model two benches that share no handle touch at "
        "one of {claim.instants} instants {step} s apart; what happens between two of them is not judged. The limits "
        "are Clopper and Pearson's: whatever the probability of the model is, it lies outside them for at most "
        "{outside:.3g} % of all seeds.",
        claim=claim,
        step=format_number(claim.step),
        outside=100.0 * (1.0 - claim.confidence),
    )
    if claim.union_bound is not None:
        words += say(
            " The probability of the model is at most {bound} at these instants, whatever the samples say: a union "
            "bound over all pairs and instants, in first order with bounds of the rest, computed in doubles.",
            bound=format_number(claim.union_bound),
        )
    if claim.tolerance:
        within = say("in every sample a hole is further away at one of these instants")
        if claim.within:
            within = say("in {count} samples no hole is further away at any of these instants", count=claim.within)
        words += say(
            " While no hole is further than {safe} m from its place, nothing touches at any time, which is proven; "
            "{within}.",
            safe=format_safe(claim.tolerance),
            within=within,
        )
    return words


def _ground(claim: GroundClaim) -> str:
    return say(
        "From {start} to {stop} s no bench leaves the polygons, and no point of theirs is more than {claim.excess:.3g} "
        "m from ground that a bench covers. Benches of one size sweep together what one of them sweeps over all their "
        "places: {sizes}, {claim.length:.6g} m of the path, {cells}. In each cell a bound on the second derivative "
        "shows how far a point of a bench can be from the straight line between its first and its last place. The "
        "polygons are the union of what edges sweep along such lines, grown by more than that.",
        claim=claim,
        start=format_number(claim.start),
        stop=format_number(claim.stop),
        sizes=counted(claim.sizes, "{count} size", "{count} sizes"),
        cells=counted(claim.cells, "{count} cell", "{count} cells"),
    )


def _tail(claim: TailClaim) -> str:
    reach, excess = (format_number(float(format_bound(one, 6, up=True))) for one in (claim.reach, claim.excess))
    return say(
        "Whenever from {start} to {stop} s {loose} while the others dance on, the polygons hold all that they can "
        "reach: as links that turn freely they come at most {reach} m from the handle that still follows the path"
        "{strayed}, and the polygons hold all points that near to any of its places. No point of theirs is more than "
        "{excess} m further away.",
        start=format_number(claim.start),
        stop=format_number(claim.stop),
        loose=counted(claim.benches, "the last bench is let go", "the last {count} benches are let go"),
        reach=reach,
        strayed=say(" or {stray} m beside it", stray=format_number(claim.stray)) if claim.stray else "",
        excess=excess,
    )


def _near(claim: ContactClaim | EncounterClaim, *, may: bool = False) -> str:
    margin = format_number(claim.margin)
    if not claim.margin:
        return say("may touch") if may else say("touch")
    if may:
        return say("may be nearer to each other than {margin} m", margin=margin)
    return say("are nearer to each other than {margin} m", margin=margin)


def _overlap(claim: ContactClaim | EncounterClaim) -> str:
    margin = format_number(claim.margin)
    if not claim.margin:
        return say("may overlap") if claim.stray else say("overlap")
    return (
        say("may be nearer than {margin} m", margin=margin)
        if claim.stray
        else say("are nearer than {margin} m", margin=margin)
    )


def _benches(claim: ContactClaim | EncounterClaim) -> str:
    assert claim.benches is not None
    a, b = claim.benches
    if isinstance(claim, EncounterClaim) and claim.dragons is not None:
        i, j = claim.dragons
        return say("bench {a} of dragon {i} and bench {b} of dragon {j}", a=a, i=i, b=b, j=j)
    return sense("claim", "benches {a} and {b}", a=a, b=b)


def _pair(claim: ContactClaim | EncounterClaim) -> str:
    assert claim.time is not None
    return say("{time} s {benches}", time=format_number(claim.time), benches=_benches(claim))


def _then(claim: ContactClaim | EncounterClaim, ends: Mapping[EndReason, str]) -> str:
    """The end of the sentence about a time without a contact."""
    if claim.kind is ClaimKind.UNDECIDED:
        return say("; whether any do after that is not decided{before}.", before=_before(claim))
    if claim.end:
        return say(ends[claim.end])
    return say(", and at {pair} {overlap}.", pair=_pair(claim), overlap=_overlap(claim))


def _before(claim: ContactClaim | EncounterClaim) -> str:
    """The later contact that is certain, if an undecided search found one."""
    if claim.time is None:
        return ""
    time, overlap = format_number(claim.time), _overlap(claim)
    return say(" before {time} s, when {benches} {overlap}", time=time, benches=_benches(claim), overlap=overlap)


def _part(k: int, part: PartSummary) -> str:
    words = say("dragon {k}", k=k) if part.name is None else say("dragon {k} ({name})", k=k, name=part.name)
    words = say("{dragon}, {dance}", dragon=words, dance=_dance(part.dance))
    if part.centre != (0.0, 0.0):
        x, y = map(format_number, part.centre)
        words += say(", about ({x}, {y}) m", x=x, y=y)
    if part.rotation:
        words += say(", turned by {angle} rad", angle=format_number(part.rotation))
    if not part.clockwise:
        words += say(", counter-clockwise")
    return words + (say(", delayed by {delay} s", delay=format_number(part.delay)) if part.delay else "")


def _dance(dance: DanceSummary) -> str:
    speed, count = format_number(dance.head_speed), dance.passage_count
    head = say("the head at {speed} m/s", speed=speed)
    if dance.passages:
        passages = Listed(map(_passage, dance.passages))
        head = say("the head at {passages}, and then at {speed} m/s", passages=passages, speed=speed)
    elif count:
        head = say("the head at {speed} m/s after {count} passages given one by one", speed=speed, count=count)
    return say("{dragon} on {path}, {head}", dragon=_dragon(dance.dragon), path=_path(dance.path), head=head)


def _dragon(dragon: DragonSummary) -> str:
    count = counted(dragon.benches, "{count} bench", "{count} benches")
    if dragon.head_length is None or dragon.width is None or dragon.overhang is None:
        return say("{benches} given one by one", benches=count)
    body = ""
    if dragon.body_length is not None:
        body = say(", body {length} m", length=format_number(dragon.body_length))
    return say(
        "{benches} (head {head} m{body}, width {width} m, overhang {overhang} m)",
        benches=count,
        head=format_number(dragon.head_length),
        body=body,
        width=format_number(dragon.width),
        overhang=format_number(dragon.overhang),
    )


def _path(path: PathSummary) -> str:
    if path.pitch is not None and path.start_turns is not None:
        pitch, turns = format_number(path.pitch), format_number(path.start_turns)
        return say("a spiral of {pitch} m pitch from {turns} turns", pitch=pitch, turns=turns)
    return say(
        "a route from s = {begin} m to {end} m ({pieces})",
        begin=format_number(path.begin),
        end=format_number(path.end),
        pieces=Listed(_piece(piece) for piece in path.pieces),
    )


def _piece(kind: str) -> str:
    return sense("piece", "waypoints") if kind == "waypoints" else say(PIECES[kind])


def _passage(passage: Passage) -> str:
    speed = format_number(passage.speed)
    if passage.until_s is not None:
        return say("{speed} m/s until {end} m", speed=speed, end=format_number(passage.until_s))
    return say("{speed} m/s until {end} s", speed=speed, end=format_number(passage.until_time or 0.0))


# The function that puts each class of claims in sentences.
SENTENCES: dict[type[Claim], Callable[[Any], str]] = {
    ContactClaim: _contact,
    EncounterClaim: _encounter,
    StrayClaim: _stray,
    ProbabilityClaim: _probability,
    GroundClaim: _ground,
    TailClaim: _tail,
}
