"""Checks of the members of a certificate: none is missing, none is unknown, and each has its form.

Written by hand. A schema of msgspec refuses the same 4,749 changed certificates with 80 lines less (measured on
2026-11-21), but its messages name Python types instead of the value and its rule, the rules that depend on the claim
(faces, order of places, directions, overlap) remain, and core would need one package more.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from core.errors import ProofRefused
from core.language import phrase
from core.proof.claims import CollisionTimeClaim, MinimumPitchClaim
from core.proof.dances import ENDINGS, DanceClearClaim, DanceContactClaim
from core.proof.ground import ONE_BY_ONE, SIDES
from core.proof.pairs import ALL_FACES, CIRCLES, DIRECTION, malformed
from core.proof.paths import FREE_TURN, PIECES, POINTS, TURN
from core.proof.strays import ToleranceClaim
from core.quantities import Given, Parameter, Quantity, Value, quantities

# The fewest and the most bits that a certificate may ask for. Its numbers are doubles, of 53 bits; the default dragon's
# certificate is checked in 0.9 s with 96 bits, in 7.5 s with 4,096 (measured 2026-11-21).
PRECISION_LEAST, PRECISION_MOST = 53, 4096
# Largest number in a certificate [m], [s], [rad], [m/s], [turns]: beyond it the sum of two doubles has no decimals.
NUMBER_MOST = 1e15
# Messages shorten longer values to this [characters].
TEXT_MOST = 40
CLAIMS = {
    kind.kind: kind
    for kind in (CollisionTimeClaim, MinimumPitchClaim, DanceClearClaim, DanceContactClaim, ToleranceClaim)
}

Rule = Callable[[str, Any], None]


def refuse_malformed(certificate: Any) -> None:
    """Refuse a value without the members of a certificate.

    raises: ProofRefused naming the member, what it must be and what it is
    """
    claim: Any = certificate.get("claim") if isinstance(certificate, dict) else None
    kind: Any = claim.get("kind") if isinstance(claim, dict) else None
    strays = kind == ToleranceClaim.kind
    with_overlap = "shown" in claim if strays else kind != DanceClearClaim.kind
    _object("", certificate, MEMBERS | ({"overlap": _any_object} if with_overlap else {}))
    _one_of(*CLAIMS)("claim.kind", kind)
    optional = {name: _positive for name in ("shown" if strays else "margin",) if name in claim}
    _object("claim", claim, {"kind": _text} | CLAIM_MEMBERS[kind] | optional)
    if with_overlap:
        _overlap(kind, certificate["overlap"])
    on_spiral = "path" not in claim or claim["path"]["kind"] == "spiral"
    letters = ALL_FACES + (DIRECTION if optional else "") + ("" if on_spiral else CIRCLES)
    if certificate["sweeps"] != []:  # A contact at the very start leaves nothing to sweep.
        stretch = _strayed_stretch if strays else _stretch(letters, on_spiral)
        sweep: dict[str, Rule] = {"bench": _whole, "stretches": _each(stretch)}
        _each(lambda name, value: _object(name, value, sweep))("sweeps", certificate["sweeps"])


def _malformed(name: str, must: str, got: Any, **values: Value) -> ProofRefused:
    return malformed(name, must, Given(got, _json_text(got)), **values)


def _json_text(value: Any) -> str:
    """A value as JSON writes it, an object or a list by name."""
    if isinstance(value, dict | list):
        return "an object" if isinstance(value, dict) else f"a list of {len(value)}"
    if value is None or isinstance(value, bool):
        return "null" if value is None else str(value).lower()
    text = f'"{value}"' if isinstance(value, str) else str(value)
    return text if len(text) <= TEXT_MOST else f"{text[:TEXT_MOST]}..."


def _object(name: str, value: Any, members: dict[str, Rule]) -> None:
    _any_object(name, value)
    inside = f"{name}." if name else ""
    for member in members:
        if member not in value:
            missing = f"{inside}{member}"
            raise malformed(missing, "is missing")
    for member in value:
        if member not in members:
            unknown = f"{inside}{str(member)[:TEXT_MOST]}"
            raise malformed(unknown, "is unknown")
    for member, rule in members.items():
        rule(f"{inside}{member}", value[member])


def _each(rule: Rule, count: int | None = None) -> Rule:
    """A list with this number of entries; without a number, a list that is not empty."""

    def checked(name: str, value: Any) -> None:
        if not isinstance(value, list) or (not value if count is None else len(value) != count):
            must = "must be a list with entries" if count is None else "must be a list of {count}"
            raise _malformed(name, must, value, count=count or 0)
        for k, entry in enumerate(value):
            rule(f"{name}.{k}", entry)

    return checked


def _any_object(name: str, value: Any) -> None:
    if not isinstance(value, dict):
        raise _malformed(name, "must be an object", value)


def _text(name: str, value: Any) -> None:
    if not isinstance(value, str):
        raise _malformed(name, "must be a string", value)


def _true(name: str, value: Any) -> None:
    if value is not True:
        raise _malformed(name, "must be true", value)


def _number(name: str, value: Any, *, whole: bool = False) -> None:
    least = 0.0 if whole else -NUMBER_MOST
    if not isinstance(value, int | float) or isinstance(value, bool):
        raise _malformed(name, "must be a whole number" if whole else "must be a number", value)
    if not least <= value <= NUMBER_MOST:  # also refuses NaN
        span = quantities("", 6, least=least, most=NUMBER_MOST)
        rule = "must be a number from {least} to {most}"
        if whole:
            rule = "must be a whole number from {least} to {most}"
        raise _malformed(name, rule, value, **span)


def _positive(name: str, value: Any) -> None:
    _number(name, value)
    if not value > 0:
        raise _malformed(name, "must be positive (leave it out for no {member})", value, member=name.split(".")[-1])


def _whole(name: str, value: Any) -> None:
    if isinstance(value, float):
        raise _malformed(name, "must be a whole number", value)
    _number(name, value, whole=True)


def _precision(name: str, value: Any) -> None:
    _whole(name, value)
    if not PRECISION_LEAST <= value <= PRECISION_MOST:
        most = Quantity(PRECISION_MOST, "bits")
        raise _malformed(name, "must be from {least} to {most}", value, least=PRECISION_LEAST, most=most)


def _one_of(*words: str) -> Rule:
    def checked(name: str, value: Any) -> None:
        if not isinstance(value, str) or value not in words:
            raise _malformed(name, "must be {words}", value, words=f"{', '.join(words[:-1])} or {words[-1]}")

    return checked


def _run(name: str, value: Any) -> None:
    """[count, length, width, overhang] of equal benches."""
    _each(_number, 4)(name, value)
    _whole(f"{name}.0", value[0])


def _overlap(kind: str, value: Mapping[str, Any]) -> None:
    members: dict[str, Rule] = {"benches": _each(_whole, 2)}
    if kind == ToleranceClaim.kind:
        members |= {"time": _number, "head": _each(_number, 2), "headings": _each(_number)}
    elif kind == MinimumPitchClaim.kind:
        members |= {"head_theta": _number}
        if value.keys() == {"start_within_circle"}:
            members = {"start_within_circle": _true}
        elif "folds" in value:
            members = {"folds": _whole, "head_theta": _each(_number, 2)}
    _object("overlap", value, members)


def _by_kind(members: Mapping[str, dict[str, Rule]]) -> Rule:
    """An object whose kind decides which other members it has."""

    def checked(name: str, value: Any) -> None:
        _any_object(name, value)
        _one_of(*members)(f"{name}.kind", value.get("kind"))
        _object(name, value, {"kind": _text} | members[value["kind"]])

    return checked


def _strayed_stretch(name: str, value: Any) -> None:
    """[highest theta, lowest theta, sides]: for each bench behind the number of one side, or of nine (16.)."""
    if not isinstance(value, list) or len(value) != 3 or not isinstance(value[2], list):
        raise _malformed(name, "must be [highest theta, lowest theta, sides]", value)
    _stretch("", True)(name, [*value[:2], ""])
    for k, sides in enumerate(value[2]):
        place, nine = f"{name}.2.{k}", len(ONE_BY_ONE)
        if not isinstance(sides, list) or len(sides) not in (1, nine):
            raise _malformed(place, "must be a list of 1 or {nine} sides", sides, nine=nine)
        for i, side in enumerate(sides):
            _whole(f"{place}.{i}", side)
            if not side < 2 * SIDES:
                raise _malformed(f"{place}.{i}", "must be a side, from 0 to {last}", side, last=2 * SIDES - 1)


# What a stretch must be, by whether its places are angles, and whether it may have directions.
STRETCH = {
    (False, False): phrase("must be [highest place, lowest place, faces]"),
    (False, True): phrase("must be [highest place, lowest place, faces] or [..., directions]"),
    (True, False): phrase("must be [highest theta, lowest theta, faces]"),
    (True, True): phrase("must be [highest theta, lowest theta, faces] or [..., directions]"),
}


def _stretch(letters: str, positive: bool) -> Rule:
    """[highest place, lowest place, faces], and the directions if faces has any. positive: whether places must be."""
    last = max(letters, default="")

    def checked(name: str, value: Any) -> None:
        lengths = (3, 4) if DIRECTION in letters else (3,)
        if not isinstance(value, list) or len(value) not in lengths:
            raise _malformed(name, STRETCH[positive, len(lengths) == 2], value)
        high, low, faces, *rest = value
        _number(f"{name}.0", high)
        _number(f"{name}.1", low)
        _text(f"{name}.2", faces)
        if not low < high or (positive and not low > 0.0):
            rule = "must lie between 0 and {front}, {at}" if positive else "must be less than {front}, {at}"
            at = Quantity(high, "rad" if positive else "m")
            raise _malformed(f"{name}.1", rule, low, front=Parameter(f"{name}.0"), at=at)
        if not set(letters).issuperset(faces):
            rule = "must be faces, digits from 0 to {last}"
            if DIRECTION not in letters and last >= DIRECTION:
                rule = "must be faces, digits from 0 to {last} but {skipped}"
            raise _malformed(f"{name}.2", rule, faces, last=last, skipped=DIRECTION)
        if faces.count(DIRECTION) or rest:
            _each(_number, faces.count(DIRECTION))(f"{name}.3", rest[0] if rest else None)

    return checked


MEMBERS: dict[str, Rule] = {
    "format": _text,
    "versions": lambda name, value: _object(name, value, {"python-flint": _text, "flint": _text}),
    "precision": _precision,
    "dragon": _each(_run),
    "claim": _any_object,
    "repeats_from": _whole,
    "sweeps": lambda name, value: None,  # once the claim is known
    "digest": _text,
}
_PIECES: dict[str, dict[str, Rule]] = {
    kind: {name: _each(_number, 2) if name in POINTS else _number for name in names}
    for kind, (_, names) in PIECES.items()
}
_SPIRAL: dict[str, Rule] = dict.fromkeys(("pitch", "start_turns"), _number)
PATHS: dict[str, dict[str, Rule]] = {
    "spiral": _SPIRAL,
    "turn": dict.fromkeys(TURN, _number),
    "free_turn": dict.fromkeys(FREE_TURN, _number),
    "route": {"start": _number, "pieces": _each(_by_kind(_PIECES))},
}
_DANCE: dict[str, Rule] = {"path": _by_kind(PATHS), "head_speed": _number, "start": _number}
CLAIM_MEMBERS: dict[str, dict[str, Rule]] = {
    CollisionTimeClaim.kind: _SPIRAL | dict.fromkeys(("head_speed", "time"), _number),
    MinimumPitchClaim.kind: _SPIRAL | {"turning_radius": _number},
    DanceClearClaim.kind: _DANCE | {"stop": _number, "until": _one_of(*ENDINGS)},
    DanceContactClaim.kind: _DANCE | {"time": _number},
    ToleranceClaim.kind: _SPIRAL | dict.fromkeys(("head_speed", "start", "stop", "stray"), _number),
}
