"""Forged certificates: read from a file, edited with a matching digest; and forgeries of five benches."""

from __future__ import annotations

import copy
import json
import math
from collections.abc import Callable
from typing import Any

from core.errors import ProofRefused
from core.proof import Certificate, digest, verify


def through_json(certificate: Certificate) -> Certificate:
    """A certificate as it is read from a file."""
    return json.loads(json.dumps(certificate, allow_nan=False))  # type: ignore[no-any-return]


def places(value: Any, place: tuple[str | int, ...] = ()) -> list[tuple[str | int, ...]]:
    """Every member of a certificate, and the first entries of every list."""
    entries = list(value) if isinstance(value, dict) else range(min(2, len(value))) if isinstance(value, list) else ()
    return [place, *(result for entry in entries for result in places(value[entry], (*place, entry)))]


def refusal(certificate: Certificate) -> str:
    """Why a certificate is refused; empty for a proof."""
    try:
        verify(certificate)
    except ProofRefused as refused:
        return refused.message
    return ""


def put_at(*place: str | int, put: Any) -> Callable[[dict[str, Any]], None]:
    """The change that puts a value at this place."""

    def change(content: dict[str, Any]) -> None:
        inside: Any = content
        for step in place[:-1]:
            inside = inside[step]
        inside[place[-1]] = put

    return change


def edit(change: Callable[[dict[str, Any]], Any]) -> Callable[[Certificate], Certificate]:
    """A forger's edit: the change, and a digest that fits it."""

    def edited(certificate: Certificate) -> Certificate:
        content = copy.deepcopy(certificate)
        del content["digest"]
        change(content)
        return content | {"digest": digest(content)}

    return edited


def stretches(content: dict[str, Any], bench: int = 0) -> list[Any]:
    return content["sweeps"][bench]["stretches"]  # type: ignore[no-any-return]


def other_face(content: dict[str, Any]) -> None:
    tile = stretches(content)[-1]
    tile[2] = tile[2][:-1] + str((int(tile[2][-1]) + 2) % 4)


def one_for_all(content: dict[str, Any]) -> None:
    tiles = stretches(content)
    tiles[:] = [[tiles[0][0], tiles[-1][1], tiles[-1][2]]]


# name: (change, why core.proof.verify refuses it)
FORGERIES: dict[str, tuple[Callable[[dict[str, Any]], Any], str]] = {
    "a stretch dropped": (lambda c: stretches(c).pop(7), "do not join"),
    "a stretch twice": (lambda c: stretches(c).insert(7, stretches(c)[7]), "do not join"),
    "the first stretch dropped": (lambda c: stretches(c).pop(0), "do not join"),
    "the last stretch dropped": (lambda c: stretches(c).pop(), "short of"),
    "the last stretch of the body dropped": (lambda c: stretches(c, 1).pop(), "short of"),
    "the first stretch of the body dropped": (lambda c: stretches(c, 1).pop(0), "do not join"),
    "a stretch that begins later": (lambda c: stretches(c)[7].__setitem__(0, stretches(c)[7][0] - 1e-9), "do not join"),
    "a stretch that ends earlier": (lambda c: stretches(c)[7].__setitem__(1, stretches(c)[7][1] + 1e-9), "do not join"),
    "one stretch for all": (one_for_all, "not proven"),
    "another face": (other_face, "not apart by face"),
    "a pair left out": (lambda c: stretches(c)[7].__setitem__(2, stretches(c)[7][2][:-1]), "pairs are missing"),
    "a sweep dropped": (lambda c: c["sweeps"].pop(), "malformed"),
    "a sweep too many": (lambda c: c["sweeps"].append(c["sweeps"][-1]), "has 3 sweeps"),
    "sweeps exchanged": (lambda c: c["sweeps"].reverse(), "of another bench"),
    "a later time": (lambda c: c["claim"].__setitem__("time", c["claim"]["time"] + 1e-9), "short of"),
    "an earlier time": (lambda c: c["claim"].__setitem__("time", c["claim"]["time"] - 1e-9), "not shown to overlap"),
    "a faster head": (lambda c: c["claim"].__setitem__("head_speed", 1.0001), "short of"),
    "a slower head": (lambda c: c["claim"].__setitem__("head_speed", 0.9999), "not shown to overlap"),
    "a wider pitch": (lambda c: c["claim"].__setitem__("pitch", 0.5501), "not shown to overlap"),
    "a narrower pitch": (lambda c: c["claim"].__setitem__("pitch", 0.5499), "not proven"),
    "a start farther out": (lambda c: c["claim"].__setitem__("start_turns", 16.001), "not shown to overlap"),
    "a start farther in": (lambda c: c["claim"].__setitem__("start_turns", 15.999), "short of"),
    "another claim": (lambda c: c["claim"].__setitem__("kind", "minimum-pitch"), "malformed"),
    "a narrower head": (lambda c: c["dragon"][0].__setitem__(2, 0.2999), "not shown to overlap"),
    "a wider body": (lambda c: c["dragon"][1].__setitem__(2, 0.3001), "not apart by face"),
    "a shorter dragon": (lambda c: c["dragon"][1].__setitem__(0, 3), "share no handle"),
    "a dragon of nothing": (lambda c: c["dragon"].clear(), "malformed"),
    "benches without end": (lambda c: c["dragon"][1].__setitem__(0, 10**12), "1 to 10000000 benches"),
    "another pair": (lambda c: c["overlap"].__setitem__("benches", [0, 3]), "not shown to overlap"),
    "neighbours as the pair": (lambda c: c["overlap"].__setitem__("benches", [0, 1]), "share no handle"),
    "the head taken for a body bench": (lambda c: c.__setitem__("repeats_from", 0), "not alike"),
    "a repetition beyond the tail": (lambda c: c.__setitem__("repeats_from", 3), "not alike"),
    "another format": (lambda c: c.__setitem__("format", "bench-dragon proof 0"), "format"),
    "no overlap": (lambda c: c.pop("overlap"), "malformed"),
    "no number": (lambda c: stretches(c)[7].__setitem__(1, "30"), "malformed"),
    "not a number": (lambda c: stretches(c)[7].__setitem__(1, math.nan), "malformed"),
}
