"""Forged certificates: read from a file, edited with a matching digest; and forgeries of five benches."""

import copy
import json
import re

import pytest

from core.errors import ProofRefused
from core.proof import digest, verify
from core.proof.paths import recorded_path
from tests.support.proof_routes import rounded

EDIT = re.compile(r"(?:(delete|repeat|reverse|shorten) )?([^ ]+)(?: (\+?)= (.+))?")


def through_json(certificate):
    """A certificate as it is read from a file."""
    return json.loads(json.dumps(certificate, allow_nan=False))


def places(value, place=(), most=2):
    """Every member of a certificate, and the first entries of every list, or all of them."""
    entries = list(value) if isinstance(value, dict) else range(len(value))[:most] if isinstance(value, list) else ()
    return [place, *(result for entry in entries for result in places(value[entry], (*place, entry), most))]


def refusal(certificate):
    """Why a certificate is refused; empty for a proof."""
    try:
        verify(certificate)
    except ProofRefused as refused:
        return refused.message
    return ""


def put_at(*place, put):
    """The change that puts a value at this place."""

    def change(content):
        inside = content
        for step in place[:-1]:
            inside = inside[step]
        inside[place[-1]] = put

    return change


def in_words(edits):
    """The change that edits say, with `; ` between them: `claim.margin = 0.1`, `claim.time += 1e-9`, and `delete`,
    `repeat`, `reverse` (a list or a text) or `shorten` (by its last entry or sign) before a place."""

    def change(content):
        for edit in edits.split("; "):
            verb, place, more, text = EDIT.fullmatch(edit).groups()
            *path, last = [int(step) if step.lstrip("-").isdigit() else step for step in place.split(".")]
            inside = content
            for step in path:
                inside = inside[step]
            if verb == "delete":
                del inside[last]
            elif verb == "repeat":
                inside.insert(last, inside[last])
            elif verb:
                inside[last] = inside[last][::-1] if verb == "reverse" else inside[last][:-1]
            else:
                inside[last] = inside[last] + json.loads(text) if more else json.loads(text)

    return change


def forged(certificate, change):
    """A forger's edit: the change, or what in_words() makes of a text, and a digest that fits it."""
    content = copy.deepcopy(certificate)
    del content["digest"]
    (in_words(change) if isinstance(change, str) else change)(content)
    return content | {"digest": digest(content)}


def assert_refused(certificate, change, reason=None):
    """core.proof.verify refuses the forged certificate, for this reason (a pattern)."""
    with pytest.raises(ProofRefused, match=reason):
        verify(forged(certificate, change))


def stretches(content, bench=0):
    return content["sweeps"][bench]["stretches"]


def other_face(content):
    tile = stretches(content)[-1]
    tile[2] = tile[2][:-1] + str((int(tile[2][-1]) + 2) % 4)


def one_for_all(content):
    tiles = stretches(content)
    tiles[:] = [[tiles[0][0], *tiles[-1][1:]]]


# (change, why core.proof.verify refuses it), of any certificate with the stretches of a head and of a body.
DROPPED = [
    ("delete sweeps.0.stretches.7", "do not join"),
    ("repeat sweeps.0.stretches.7", "do not join"),
    ("delete sweeps.0.stretches.-1", "short of"),
    ("delete sweeps.1.stretches.0", "do not join"),
    (one_for_all, "not proven"),
    ("shorten sweeps.0.stretches.7.2", "pairs are missing"),
    ("delete sweeps.1", r"malformed: sweeps\[1\] is missing"),
    ("repeats_from = 0", "not alike"),
]
# The same of five benches.
FORGERIES = [
    *DROPPED,
    ("delete sweeps.0.stretches.0", "do not join"),
    ("delete sweeps.1.stretches.-1", "short of"),
    ("sweeps.0.stretches.7.0 += -1e-9", "do not join"),
    ("sweeps.0.stretches.7.1 += 1e-9", "do not join"),
    (other_face, "not apart by face"),
    ("repeat sweeps.-1", "has 3 sweeps"),
    ("reverse sweeps", "of another bench"),
    ("claim.time += 1e-9", "short of"),
    ("claim.time += -1e-9", "not shown to overlap"),
    ("claim.head_speed = 1.0001", "short of"),
    ("claim.head_speed = 0.9999", "not shown to overlap"),
    ("claim.pitch = 0.5501", "not shown to overlap"),
    ("claim.pitch = 0.5499", "not proven"),
    ("claim.start_turns = 16.001", "not shown to overlap"),
    ("claim.start_turns = 15.999", "short of"),
    ('claim.kind = "minimum-pitch"', "malformed"),
    ("dragon.0.2 = 0.2999", "not shown to overlap"),
    ("dragon.1.2 = 0.3001", "not apart by face"),
    ("dragon.1.0 = 3", "share no handle"),
    ("dragon = []", "malformed"),
    ("dragon.1.0 = 1000000000000", "1 to 10000000 benches"),
    ("overlap.benches = [0, 3]", "not shown to overlap"),
    ("overlap.benches = [0, 1]", "share no handle"),
    ("repeats_from = 3", "not alike"),
    ('format = "bench-dragon proof 0"', "format"),
    ("delete overlap", "malformed"),
    ('sweeps.0.stretches.7.1 = "30"', "malformed"),
    ("sweeps.0.stretches.7.1 = NaN", "malformed"),
]


def other_path(path):
    """The change that puts another path, which core.proof.paths writes down, into a claim."""

    def change(content):
        content["claim"]["path"] = recorded_path(path)

    return change


# Of the certificates "corner" and "tight arc" of tests/campaigns/differential.py: (its name, change, why core.proof
# refuses it). The last corners and arcs are paths that no bench can follow, or not without a jump.
OVER_BENDS = [
    *(
        (name, change, reason)
        for name in ("corner", "tight arc")
        for change, reason in [
            ("claim.path.start = 1.0", "when the path ends"),
            ("claim.path.start = -1.0", "when the whole dragon is on the path"),
            ("dragon.0.1 = 5.41", "when the whole dragon is on the path|must bend"),
            ("delete sweeps.0.stretches.9", "do not join"),
            ("delete sweeps.-1.stretches.-1", "short of"),
            (one_for_all, "is not|not apart"),
        ]
    ),
    ("corner", "claim.path.pieces.1.end = [11.0, 12.0]", "must turn by less than 90 degrees"),
    ("corner", "claim.path.pieces.1.end = [0.1, 0.0]", "must turn by less than 90 degrees"),
    ("corner", "claim.path.pieces.1.start = [12.0, 1e-6]", "must close"),
    ("tight arc", "claim.path.pieces.1.radius = 0.9", "must close"),
    ("tight arc", "claim.path.pieces.1.sweep = 1.5", "must close|must be smooth"),
    ("tight arc", other_path(rounded(12.0, 1.0, 150.0, 12.0)), "must bend so that every bench can follow"),
    ("tight arc", other_path(rounded(12.0, 0.6, 179.0, 12.0)), "must bend so that every bench can follow"),
]
