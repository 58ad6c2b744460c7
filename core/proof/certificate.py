"""Certificates: made with a proof, and checked without a search."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np
from flint import __FLINT_VERSION__, __version__, arb, ctx

from core.checks import checked_type
from core.dance import Dance
from core.dragon import BENCHES_MAX, Dragon
from core.errors import InvalidValue, OutsideRun, ProofRefused
from core.language import phrase
from core.proof.claims import CollisionTimeClaim, MinimumPitchClaim, refusing
from core.proof.dances import DanceClearClaim, DanceContactClaim, last_stop
from core.proof.members import CLAIMS, TEXT_MOST, refuse_malformed
from core.proof.paths import core_path, recorded_path
from core.proof.strays import ToleranceClaim, recorded_pose
from core.proof.sweeps import AnyChain, SweepOverlap, proven_sweeps, recorded_stretches, searched_stretches
from core.proof.words import runs
from core.tolerance.exhibit import Exhibit
from core.values import Progress, unheard

FORMAT = "bench-dragon proof 1"
# Working precision [bits]: the claims decide gaps of about 1e-12 m; 96 bits leave 1e-24 m after 1e5 handles.
PRECISION = 96

# What differs in the claim of a certificate about another dance.
ANOTHER = {
    "dragon": phrase("the certificate is about another dragon"),
    "path": phrase("the certificate is about another path"),
    "head_speed": phrase("the certificate is about another head speed"),
}

Certificate = dict[str, Any]
AnyClaim = CollisionTimeClaim | MinimumPitchClaim | DanceClearClaim | DanceContactClaim | ToleranceClaim


@dataclass(frozen=True, slots=True)
class Proof:
    """A proven statement, and the size of its proof: stretches, pair_proofs (a pair apart over a stretch).

    >>> from core import Spiral
    >>> proof = verify(prove_clear(Dance(Dragon(3), Spiral(0.8)), stop=60.0))
    >>> proof.stretches > 0, proof.pair_proofs > 0
    (True, True)
    """

    statement: str
    stretches: int
    pair_proofs: int


def prove_collision_time(
    dance: Dance, time: float, *, margin: float = 0.0, every_pair: bool = False, progress: Progress | None = None
) -> Certificate:
    """A certificate that nothing touches in [0, time - 1e-10], and that a pair strictly overlaps at time + 1e-10 [s].

    margin: [m]; if positive, nothing comes within it until then, and a pair is strictly nearer after
    every_pair: prove each pair of the chain by itself, without step 6 of core/proof/__init__.py; this is slower by the
        number of benches
    progress: called with the fraction done, 0 to 1
    returns: a dictionary that json can write and verify() can check
    raises: ProofRefused if the claim is wrong, or too close to wrong for the balls to decide

    >>> from core import Spiral, first_contact
    >>> dance = Dance(Dragon(12), Spiral(start_turns=5.0))
    >>> certificate = prove_collision_time(dance, first_contact(dance).time)
    >>> verify(certificate).pair_proofs > 0
    True
    """
    path = _steady(dance).path.spiral
    if path is None:
        raise InvalidValue("path", "must be a spiral: prove_contact() takes any other")
    claim = CollisionTimeClaim(dance.dragon, path.pitch, path.start_turns, dance.head_speed, time, margin)
    return _proven(claim, every_pair, progress)


def prove_minimum_pitch(
    dragon: Dragon,
    pitch: float,
    *,
    turning_radius: float = 4.5,
    start_turns: float = 16.0,
    margin: float = 0.0,
    every_pair: bool = False,
    progress: Progress | None = None,
) -> Certificate:
    """A certificate that nothing touches on the way to the circle, and that a pair overlaps at a pitch 1e-6 m smaller.

    Every bench follows on that way. At the smaller pitch a bench may also fold before the circle, or the start may lie
    within the circle; then the certificate proves that instead. It proves nothing about larger pitches.
    pitch, turning_radius: [m]; margin, every_pair, progress, returns, raises: as prove_collision_time()

    >>> from core import minimum_pitch
    >>> dragon = Dragon(12)
    >>> pitch = minimum_pitch(dragon, start_turns=5.0, turning_radius=1.5).pitch
    >>> certificate = prove_minimum_pitch(dragon, pitch, turning_radius=1.5, start_turns=5.0)
    >>> certificate["claim"]["pitch"] == pitch
    True
    """
    checked_type("dragon", dragon, Dragon)
    return _proven(MinimumPitchClaim(dragon, pitch, start_turns, turning_radius, margin), every_pair, progress)


def prove_clear(
    dance: Dance,
    stop: float | None = None,
    *,
    start: float | None = None,
    margin: float = 0.0,
    every_pair: bool = False,
    progress: Progress | None = None,
) -> Certificate:
    """A certificate that nothing touches in [start, stop] [s], or comes within the margin [m].

    dance: on a spiral, a turn, or a route of lines, arcs and coils
    start: None for dance.default_start
    stop: None for the end of the run: then the certificate also proves the end within 1e-9 s after its stop: a fold,
        the centre of the spiral, or the end of the route
    every_pair, progress, returns, raises: as prove_collision_time(); OutsideRun for times outside the dance

    >>> from core import Spiral
    >>> certificate = prove_clear(Dance(Dragon(3), Spiral(0.8)), stop=60.0)
    >>> certificate["claim"]["stop"]
    60.0
    """
    record, until = recorded_path(_steady(dance).path), "stop"
    if stop is None:
        stop, until = last_stop(Dance(dance.dragon, core_path(record), dance.head_speed))
    begin = dance.default_start if start is None else start
    claim = DanceClearClaim(dance.dragon, record, dance.head_speed, begin, stop, until, margin)
    return _proven(claim, every_pair, progress)


def prove_contact(
    dance: Dance,
    time: float,
    *,
    start: float | None = None,
    margin: float = 0.0,
    every_pair: bool = False,
    progress: Progress | None = None,
) -> Certificate:
    """As prove_collision_time(), in [start, time - 1e-10], on any path that prove_clear() takes.

    >>> from core import Turn, first_contact
    >>> dance = Dance(Dragon(20), Turn(1.7))
    >>> contact = first_contact(dance, margin=0.33, start=0.0)
    >>> prove_contact(dance, contact.time, start=0.0, margin=0.33)["claim"]["time"] == contact.time
    True
    """
    record, begin = recorded_path(_steady(dance).path), dance.default_start if start is None else start
    return _proven(DanceContactClaim(dance.dragon, record, dance.head_speed, begin, time, margin), every_pair, progress)


def prove_tolerance(
    dance: Dance,
    stray: float,
    *,
    exhibit: Exhibit | None = None,
    start: float = 0.0,
    stop: float | None = None,
    every_pair: bool = False,
    progress: Progress | None = None,
) -> Certificate:
    """A certificate that nothing touches in [start, stop] [s] while every hole is within the stray of its place [m].

    dance: on a spiral; exhibit: a pose in which two benches overlap, proven too, with strays up to 1e-9 m above its own
    stop: None for the end of the run, or 0.5e-9 s before a fold or the centre
    every_pair, progress, returns, raises: as prove_collision_time(); OutsideRun for times outside the dance

    >>> from core import Spiral
    >>> certificate = prove_tolerance(Dance(Dragon(12), Spiral(0.7, 5.0)), 0.04, stop=44.0)
    >>> certificate["claim"]["stray"]
    0.04
    """
    path = _steady(dance).path.spiral
    if path is None:
        raise InvalidValue("path", "must be a spiral: strays have no proof on any other")
    if stop is None:
        stop, _ = last_stop(Dance(dance.dragon, core_path(recorded_path(path)), dance.head_speed))
    if exhibit is not None:
        exhibit = replace(exhibit, handles=dance.path.frame.back(exhibit.handles))
    pose, most = ({}, None) if exhibit is None else recorded_pose(exhibit)
    sizes = dance.dragon, path.pitch, path.start_turns, dance.head_speed
    return _proven(ToleranceClaim(*sizes, start, stop, stray, most), every_pair, progress, pose)


def _steady(dance: Dance) -> Dance:
    """The dance, whose places and times are proportional. raises: InvalidValue for passages"""
    checked_type("dance", dance, Dance)
    if dance.passages:
        rule = (
            "must be left out for a proof, which is about places of the head: prove dance.steady, whose times are "
            "those places divided by its head speed"
        )
        raise InvalidValue("passages", rule)
    return dance.steady


def _proven(
    claim: AnyClaim, every_pair: bool, progress: Progress | None, pose: dict[str, Any] | None = None
) -> Certificate:
    report = progress or unheard
    with ctx.workprec(PRECISION), refusing("claim"):
        chain = claim.chain
        overlap = pose or claim.find_overlap(lambda share: report(claim.search_share * share))
        claim.verify_overlap(overlap)
        each = max(0, chain.count - 3)
        repeats_from = each if every_pair else chain.repeats_from

        def report_sweeps(share: float) -> None:
            report(1.0 - (1.0 - claim.search_share) * (1.0 - share))

        def proven(first: int) -> list[dict[str, Any]]:
            return proven_sweeps(chain, *claim.way, first, searched_stretches(chain), report_sweeps, claim.follows)

        try:
            sweeps = proven(repeats_from)
        except SweepOverlap as met:  # in a short dance no bench may come there
            if repeats_from == each or _comes_there(chain, claim.way, met):
                raise
            repeats_from, sweeps = each, proven(each)
    certificate = {
        "format": FORMAT,
        "versions": {"python-flint": __version__, "flint": __FLINT_VERSION__},
        "precision": PRECISION,
        "dragon": runs(claim.dragon),
        "claim": {"kind": claim.kind} | _values(claim),
        **({"overlap": overlap} if overlap else {}),
        "repeats_from": repeats_from,
        "sweeps": sweeps,
    }
    return certificate | {"digest": digest(certificate)}


def _comes_there(chain: AnyChain, way: tuple[float, float], met: SweepOverlap) -> bool:
    """Whether two benches of the dance come to the places of an overlap. way: of the head, see Claim"""
    before, after = (chain.pose_at(0, arb(place)) for place in way)
    for pose in (before, after):
        pose.grow_to(chain.count)
    handles = range(chain.repeats_from, chain.count - (met.b - met.a))
    return any(after.places[k] <= met.place <= before.places[k] for k in handles)


def _values(claim: AnyClaim) -> dict[str, Any]:
    """The members of a claim; a margin, and the stray of an exhibited pose, only if there is one."""
    values = {field.name: getattr(claim, field.name) for field in fields(claim) if field.name != "dragon"}
    return {name: value for name, value in values.items() if value or name not in ("margin", "shown")}


def verify(certificate: Certificate, *, dance: Dance | None = None, progress: Progress | None = None) -> Proof:
    """The statement that a certificate proves, after every inequality in it was verified again, without a search.

    dance: the certificate must be about its dragon, path and head speed; None: about any
    certificate: as made here, or read from JSON; the balls have the precision that it states, or PRECISION if that is
        more, because a proof holds whatever the precision with which it was made
    raises: ProofRefused if any member is changed, missing or unknown, or any step is not proven

    >>> from core import Spiral
    >>> verify(prove_clear(Dance(Dragon(3), Spiral(0.8)), stop=60.0)).statement.rpartition(": ")[2]
    'no two benches except neighbours touch from 0 s to 60 s.'
    """
    stated = certificate.get("format") if isinstance(certificate, dict) else None
    if isinstance(stated, str) and stated != FORMAT:
        words, start = "the certificate's format is not {format}: {stated}", stated[:TEXT_MOST]
        raise ProofRefused.in_words("format", words, format=repr(FORMAT), stated=repr(start))
    refuse_malformed(certificate)
    content = {name: value for name, value in certificate.items() if name != "digest"}
    if certificate["digest"] != digest(content):
        raise ProofRefused.in_words("digest", "the certificate was changed after it was made")
    if dance is not None:
        _refuse_another(content, _steady(dance))
    try:
        with ctx.workprec(max(PRECISION, certificate["precision"])), refusing("certificate"):
            return _verified(content, progress or unheard)
    except (InvalidValue, OutsideRun) as error:
        field = error.field if "path" in content["claim"] else error.field.removeprefix("path.")
        place = field if field.startswith("dragon.") else f"claim.{field}"
        renamed = error.with_field(place)
        words = f"the certificate is malformed: {renamed.template}"
        raise ProofRefused.in_words(place, words, got=renamed.got, reason=renamed.reason, **renamed.values) from error


def _refuse_another(content: Certificate, dance: Dance) -> None:
    """raises: ProofRefused for a certificate about another dragon, path or head speed"""
    claim = content["claim"]
    try:
        path = recorded_path(dance.path)
    except InvalidValue:  # a path that no certificate is about
        raise ProofRefused.in_words("claim.path", ANOTHER["path"]) from None
    same = {
        "dragon": content["dragon"] == runs(dance.dragon),
        "path": claim.get("path", {name: claim.get(name) for name in path} | {"kind": "spiral"}) == path,
        "head_speed": claim.get("head_speed", dance.head_speed) == dance.head_speed,
    }
    for name, as_given in same.items():
        if not as_given:
            raise ProofRefused.in_words(f"claim.{name}", ANOTHER[name])


def _verified(content: Certificate, progress: Progress) -> Proof:
    values = dict(content["claim"])
    claim = CLAIMS[values.pop("kind")](_dragon(content["dragon"]), **values)
    chain, repeats_from, sweeps = claim.chain, content["repeats_from"], content["sweeps"]
    if not chain.repeats_from <= repeats_from <= max(0, chain.count - 3):
        raise ProofRefused.in_words("repeats_from", "the benches from {first} on are not alike", first=repeats_from)
    statement = claim.verify_overlap(content.get("overlap", {}))
    proven = proven_sweeps(chain, *claim.way, repeats_from, recorded_stretches(chain, sweeps), progress, claim.follows)
    if len(proven) != len(sweeps):
        words, counts = "the certificate has {sweeps} sweeps, not {proven}", (len(sweeps), len(proven))
        raise ProofRefused.in_words("sweeps", words, sweeps=counts[0], proven=counts[1])
    tiles = [tile for sweep in proven for tile in sweep["stretches"]]
    return Proof(statement, len(tiles), sum(len(tile[2]) for tile in tiles))


def digest(content: Any) -> str:
    """A fingerprint of a certificate without its digest: it detects accidents and careless edits, not forgery.

    >>> from core import Spiral
    >>> certificate = prove_clear(Dance(Dragon(3), Spiral(0.8)), stop=60.0)
    >>> certificate.pop("digest") == digest(certificate)
    True
    """
    return hashlib.sha256(_text(content).encode()).hexdigest()


def _text(value: Any) -> str:
    if isinstance(value, dict):
        return "{" + ",".join(f"{name!r}:{_text(value[name])}" for name in sorted(value)) + "}"
    if isinstance(value, list):
        return "[" + ",".join(map(_text, value)) + "]"
    return repr(value)


def _dragon(runs: Sequence[Any]) -> Dragon:
    counts = [run[0] for run in runs]
    if not (min(counts) > 0 and sum(counts) <= BENCHES_MAX):
        raise ProofRefused.in_words("dragon", "a dragon has 1 to {most} benches", most=BENCHES_MAX)
    return Dragon.of(*(np.repeat([run[column] for run in runs], counts) for column in (1, 2, 3)))
