"""The members of a certificate: each is there, no other is, and each is of its kind, before any of them is judged."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields
from typing import Any

from core.errors import ProofRefused
from core.proof.claims import CollisionTime, MinimumPitch

# The fewest and the most bits that a certificate may ask for. Its numbers are doubles, of 53 bits; the default dragon's
# certificate is checked in 0.9 s with 96 bits, in 7.5 s with 4,096 (measured 2026-11-21).
PRECISION_LEAST, PRECISION_MOST = 53, 4096
# No number of a certificate is larger [m], [s], [rad], [m/s], [turns]: beyond it the sum of two doubles has no digits
# after the point.
NUMBER_MOST = 1e15
# A value that is longer is shortened in messages [characters].
SHOWN_MOST = 40
FACES = frozenset("01234567")
CLAIMS = {kind.kind: kind for kind in (CollisionTime, MinimumPitch)}

Check = Callable[[str, Any], None]


def check_members(certificate: Any) -> None:
    """Refuse what has not the members of a certificate.

    raises: ProofRefused naming the member, what it must be and what it is
    """
    _object("", certificate, MEMBERS)
    claim = certificate["claim"]
    if not isinstance(claim, dict) or claim.get("kind") not in list(CLAIMS):
        got = claim.get("kind") if isinstance(claim, dict) else claim
        raise _malformed("claim.kind", f"must be {' or '.join(CLAIMS)}", got)
    names = [field.name for field in fields(CLAIMS[claim["kind"]]) if field.name != "dragon"]
    _object("claim", claim, {"kind": _text} | dict.fromkeys(names, _number))
    within = claim["kind"] == MinimumPitch.kind and certificate["overlap"].keys() == {"start_within_circle"}
    if within:
        _object("overlap", certificate["overlap"], {"start_within_circle": _true})
    else:
        theta = {"head_theta": _number} if claim["kind"] == MinimumPitch.kind else {}
        _object("overlap", certificate["overlap"], {"benches": _each(_whole, 2)} | theta)


def _malformed(name: str, must: str, got: Any) -> ProofRefused:
    return ProofRefused(name, f"the certificate is malformed: {name or 'it'} {must}, got {_shown(got)}")


def _shown(value: Any) -> str:
    """A value as JSON writes it, an object or a list by name."""
    if isinstance(value, dict | list):
        return "an object" if isinstance(value, dict) else f"a list of {len(value)}"
    if value is None or isinstance(value, bool):
        return "null" if value is None else str(value).lower()
    text = f'"{value}"' if isinstance(value, str) else str(value)
    return text if len(text) <= SHOWN_MOST else f"{text[:SHOWN_MOST]}..."


def _object(name: str, value: Any, members: dict[str, Check]) -> None:
    if not isinstance(value, dict):
        raise _malformed(name, "must be an object", value)
    inside = f"{name}." if name else ""
    for member in members:
        if member not in value:
            raise ProofRefused(f"{inside}{member}", f"the certificate is malformed: {inside}{member} is missing")
    for member in value:
        if member not in members:
            unknown = f"{inside}{str(member)[:SHOWN_MOST]}"
            raise ProofRefused(unknown, f"the certificate is malformed: {unknown} is no member of it")
    for member, check in members.items():
        check(f"{inside}{member}", value[member])


def _each(check: Check, count: int | None = None) -> Check:
    """A list of so many entries, of any number but none where there is no count."""

    def checked(name: str, value: Any) -> None:
        if not isinstance(value, list) or (not value if count is None else len(value) != count):
            raise _malformed(name, f"must be a list{' with entries' if count is None else f' of {count}'}", value)
        for k, entry in enumerate(value):
            check(f"{name}.{k}", entry)

    return checked


def _any_object(name: str, value: Any) -> None:
    if not isinstance(value, dict):
        raise _malformed(name, "must be an object", value)


def _text(name: str, value: Any) -> None:
    if not isinstance(value, str):
        raise _malformed(name, "must be a text", value)


def _true(name: str, value: Any) -> None:
    if value is not True:
        raise _malformed(name, "must be true", value)


def _number(name: str, value: Any) -> None:
    if not isinstance(value, int | float) or isinstance(value, bool):
        raise _malformed(name, "must be a number", value)
    if not -NUMBER_MOST <= value <= NUMBER_MOST:  # nor NaN
        raise _malformed(name, f"must be a number from {-NUMBER_MOST:g} to {NUMBER_MOST:g}", value)


def _whole(name: str, value: Any) -> None:
    if not isinstance(value, int) or isinstance(value, bool):
        raise _malformed(name, "must be a whole number", value)
    if not 0 <= value <= NUMBER_MOST:
        raise _malformed(name, f"must be a whole number from 0 to {NUMBER_MOST:g}", value)


def _precision(name: str, value: Any) -> None:
    _whole(name, value)
    if not PRECISION_LEAST <= value <= PRECISION_MOST:
        raise _malformed(name, f"must be from {PRECISION_LEAST} to {PRECISION_MOST} bits", value)


def _run(name: str, value: Any) -> None:
    """[count, length, width, overhang] of benches alike."""
    _each(_number, 4)(name, value)
    _whole(f"{name}.0", value[0])


def _sweep(name: str, value: Any) -> None:
    _object(name, value, {"bench": _whole, "stretches": _each(_stretch)})


def _stretch(name: str, value: Any) -> None:
    if not isinstance(value, list) or len(value) != 3:
        raise _malformed(name, "must be [highest theta, lowest theta, faces]", value)
    high, low, faces = value
    _number(f"{name}.0", high)
    _number(f"{name}.1", low)
    _text(f"{name}.2", faces)
    if not 0.0 < low < high:
        raise _malformed(f"{name}.1", f"must lie between 0 and {name}.0, {high!r} rad", low)
    if not FACES.issuperset(faces):
        raise _malformed(f"{name}.2", "must be faces, digits from 0 to 7", faces)


def _sweeps(name: str, value: Any) -> None:
    if value != []:  # A contact at the very start leaves nothing to sweep.
        _each(_sweep)(name, value)


MEMBERS: dict[str, Check] = {
    "format": _text,
    "versions": lambda name, value: _object(name, value, {"python-flint": _text, "flint": _text}),
    "precision": _precision,
    "dragon": _each(_run),
    "claim": _any_object,
    "overlap": _any_object,
    "repeats_from": _whole,
    "sweeps": _sweeps,
    "digest": _text,
}
