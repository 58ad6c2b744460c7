"""examples/verify.py, run as a reader runs it: alone, without site packages, on certificates that are files."""

import ast
import itertools
import json
import math
import random
import re
import runpy
import subprocess
import sys

import pytest
from flint import arb, ctx, fmpz

from core import Dance, Dragon, Line, Route, Spiral, first_contact
from core.errors import ProofRefused
from core.proof import chain, prove_collision_time, prove_minimum_pitch
from core.proof.paths import recorded_path
from tests.campaigns.differential import (
    MAKERS,
    fitted,
    followed_to,
    hunt,
    made,
    proven_by_core,
    proven_by_second,
    second,
)
from tests.conftest import ROOT
from tests.core.paths.test_following import U_TURN
from tests.core.proof.test_claims import OF_GRAZE
from tests.support.depth import DEEP, examples, some, thorough
from tests.support.forgeries import DROPPED, FORGERIES, OVER_BENDS, forged, stretches
from tests.support.proof_routes import cornered
from tests.support.reference_contacts import graze, random_contact, small

VERIFY = ROOT / "examples" / "verify.py"
PATIENCE = 600.0  # [s]: only against a run that would hang
ARITHMETIC_CASES = 300
CHANGED = examples(100, 2_000)
BEND_WIDTH_MOST = 1e-20  # far below what the proofs need, about 1e-14 [rad]
NEAR_BEND = 1e-3  # from the place beyond which a bench cannot follow [m]
SLOW = ("stray", "stray with a pose", "minimum pitch at a fold")


def run(*arguments):
    """verify.py alone: -I and -S leave no path to any package but the standard library."""
    command = [sys.executable, "-I", "-S", VERIFY, *arguments]
    return subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE)


def assert_verdict(certificate, reason):
    """verify.py does not prove it, for this reason (a pattern)."""
    proven, words = proven_by_second(certificate)
    assert not proven
    assert re.search(reason, words)


@pytest.fixture
def verify():
    """verify.py as a module, to look inside, with all the work that one certificate may take."""
    module = second()
    module.LEFT[0] = module.BENDS_MOST
    return module


def test_its_code_imports_the_standard_library_alone():
    source = VERIFY.read_text(encoding="utf-8")
    tree = ast.parse(source)
    names = {alias.name for node in ast.walk(tree) if isinstance(node, ast.Import) for alias in node.names}
    names |= {str(node.module) for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)}
    assert names
    assert names - set(sys.stdlib_module_names) == set()
    assert not re.search(r"\b(__import__|importlib|exec|eval)\b", source)


def contact_of(dance, **options):
    time = first_contact(dance).time
    assert time is not None
    return prove_collision_time(dance, time, **options)


CERTIFICATES = {
    "five benches": (small, "benches 0 and 4 overlap"),
    # Handle 1 turns back, and the head's bend grows beyond half a turn.
    "near the fold, with a slow head": (
        lambda: contact_of(Dance(Dragon(12, 3.61, 2.4, 0.12, 0.1), Spiral(0.48, 4.0), 0.7)),
        "its head at 0.7 m/s: no two benches except neighbours touch",
    ),
    "bench by bench": (lambda: prove_collision_time(*random_contact(17)), "overlap at"),
    "a contact at the start": (
        lambda: prove_collision_time(*random_contact(7)), "m/s: within 2e-10 s of the start benches "
    ),
    "a pitch limited by a graze": (graze, "with a pitch 1e-6 m smaller benches 0 and 12 overlap on the way"),
}  # fmt: skip
if DEEP:
    CERTIFICATES |= {
        "the contest's first contact": (lambda: contact_of(Dance(Dragon(), Spiral())), "benches 0 and 8 overlap"),
        "the contest's pitch": (lambda: prove_minimum_pitch(Dragon(), 0.450337394), "benches 0 and 19 overlap"),
    }  # fmt: skip
FIRST, *OTHERS = CERTIFICATES


@pytest.mark.parametrize("name", [FIRST, *thorough(*OTHERS)])
def test_certificates_of_all_kinds_are_verified(tmp_path, name):
    make, words = CERTIFICATES[name]
    (tmp_path / "certificate.json").write_text(json.dumps(make()))
    done = run(tmp_path / "certificate.json")
    assert done.returncode == 0
    assert done.stderr == ""
    assert words in done.stdout


# Forgeries that verify.py refuses in other words than core.proof.
OWN_WORDS = dict.fromkeys(("delete sweeps.1", "repeat sweeps.-1", "reverse sweeps"), "the sweeps are not those of")


@pytest.mark.parametrize("change, reason", [*DROPPED, *thorough(*FORGERIES[len(DROPPED) :])])
def test_a_forged_certificate_is_refused(change, reason):
    assert_verdict(forged(small(), change), OWN_WORDS.get(str(change), reason))


@pytest.mark.parametrize("name, change, reason", OVER_BENDS)
def test_a_forged_certificate_over_a_bend_is_refused(name, change, reason):
    assert_verdict(forged(made(name), change), "not proven|malformed")


def lines(*points):
    """A path of lines as a certificate writes it, which core refuses at corners of 90 degrees and more."""
    pieces = [{"kind": "line", "start": [*start], "end": [*end]} for start, end in itertools.pairwise(points)]
    return {"kind": "route", "start": 0.0, "pieces": pieces}


# Paths, with the place of the head up to which a bench of the contest's head follows [m].
UNFOLLOWED = {
    "the leader would go backwards at a corner": (lines((0.0, 0.0), (9.0, 0.0), (8.9, 5.0)), 9.0),
    "a path that turns back": (lines((0.0, 0.0), (9.0, 0.0), (0.0, 0.0)), 9.0),
    "the rear handle would go across the bench": (
        recorded_path(Route([Line((0.0, 0.0), (8.0, 0.0)), *U_TURN])),
        8.0 + 0.9 * math.acos(-0.9 / (2.86 - 0.9)),
    ),
    "the rear handle would jump": (recorded_path(cornered([8.0, 0.55, 0.5, 8.0], [72.0, 24.0, 13.5])), 10.9516),
}  # fmt: skip


@pytest.mark.parametrize("name", UNFOLLOWED)
def test_neither_checker_proves_that_a_bench_follows_where_it_cannot(name):
    """Both prove the way up to there, and neither a last stretch that is made up."""
    path, last = UNFOLLOWED[name]
    certificate = followed_to(Dragon(1), path, 5.0, last - NEAR_BEND)
    assert proven_by_second(certificate)[0]
    with pytest.raises(ProofRefused, match="not proven where handle 0 is at s = "):
        followed_to(Dragon(1), path, 5.0, last + NEAR_BEND)
    certificate["claim"]["stop"] = last + NEAR_BEND
    end = stretches(certificate)[-1][1]
    stretches(certificate).append([end, -last - 2.0 * NEAR_BEND, ""])
    assert_verdict(fitted(certificate), "not proven")


def half_turned(content):
    tile = stretches(content)[5]
    tile[2] = "".join(str(int(face) ^ 2) for face in tile[2])


def at_once(content):
    """The way in one stretch, with the ends that it had."""
    tiles = stretches(content)
    tiles[:] = [[tiles[0][0], tiles[-1][1], "333"]]


FURTHER = [
    (half_turned, "not apart by"),
    ('sweeps.0.stretches.5.2 = ""', "pairs are missing"),
    (at_once, "apart"),
    (lambda c: stretches(c)[5].__setitem__(slice(0, 2), stretches(c)[5][1::-1]), "malformed"),
    ("sweeps.1.stretches = []", "short of"),
    ("sweeps = []", "the sweeps are not those"),
    ("dragon.1.1 = 2.3", "not proven"),
    ("dragon.0.1 = 3.40", "not shown to overlap"),
    ("dragon.0.3 = 0.2751", "not proven"),
    ("dragon += [[1, 2.2, 0.31, 0.275]]", "not alike"),
    ("reverse dragon", "not"),
    ("dragon.1.0 = 5", "pairs are missing"),
    ("dragon = [[2, 2.2, 0.3, 0.275]]", "share no handle"),
    ("overlap.benches = [1, 4]", "not shown to overlap"),
    ("claim.time = 0", "not shown to overlap"),
    ("claim.time = 1e6", "past the centre"),
    ("claim.head_speed = 0", "head_speed must be from"),
    ("claim.pitch = 0.0", "pitch must be from"),
    ("claim.pitch = 1e15", "pitch must be from"),
    ("claim.start_turns = 1e308", "claim.start_turns must be a number from -1e15"),
    (f"claim.pitch = 1{'0' * 400}", "claim.pitch must be a number from -1e15"),
    ("overlap.benches.0 = true", r"overlap\.benches\[0\] must be a whole"),
    ("dragon.0.0 = true", r"dragon\[0\]\[0\] must be a whole number"),
    ('sweeps.0.stretches.5.2 = "09"', r"sweeps\[0\]\.stretches\[5\]"),
    ('claim.kind = "speed"', "claim.kind is another"),
    ("claim.kind = []", "claim.kind is another"),
    (lambda c: c.__setitem__("a\nb\ud800", 1), r"a\\nb\\ud800 is unknown"),
    ("dragon.1 = [4, 2.2, 0.3, 1.1]", "room for a chord"),
    ("dragon.0.0 = 0", "room for a chord"),
    ("dragon.1.2 = 0.0", "0.001 to 10000 m"),
    ("dragon.1.1 = 2e4", "0.001 to 10000 m"),
    ("precision = 52", "precision must be from"),
]


@pytest.mark.parametrize("change, reason", FURTHER)
def test_a_forgery_of_its_own_kind_is_refused(change, reason):
    assert_verdict(forged(small(), change), reason)


@pytest.mark.thorough
def test_a_stretch_too_wide_to_be_shown_at_once_is_halved():
    """Neighbouring stretches with the same faces may be joined: what is claimed stays true."""
    alike = [k for k, (one, after) in enumerate(itertools.pairwise(stretches(small()))) if one[2] == after[2]]
    proven_by_both = []
    for k in some(alike, 4):
        joined = forged(small(), lambda c, k=k: stretches(c)[k].__setitem__(1, stretches(c).pop(k + 1)[1]))
        proven, statement = proven_by_second(joined)
        assert proven
        assert "benches 0 and 4 overlap" in statement
        proven_by_both.append(proven_by_core(joined)[0])
    assert not all(proven_by_both)


def test_an_accident_is_refused_by_the_digest():
    assert_verdict(small() | {"precision": 97}, "changed after it was made")


@pytest.mark.parametrize(
    "edit, reason",
    [
        *OF_GRAZE,
        ('overlap = {"benches": [0, 12]}', "head_theta is missing"),
        ("claim.pitch += -1e-8", "not proven"),
        *thorough(("claim.pitch += 1.1e-6", "not proven"), ("claim.turning_radius += -1e-3", "not proven")),
    ],
)
def test_a_pitch_a_circle_or_an_overlap_that_is_not_shown_is_refused(edit, reason):
    assert_verdict(forged(graze(), edit), reason)


@pytest.mark.parametrize(
    "data, reason",
    [
        (b"", "Expecting value"),
        (b"\xff\xfe\x00", "malformed"),
        (b"{", "Expecting property name"),
        (b"[" * 200_000, "nested too deeply"),
        (b'{"a":' * 200_000, "nested too deeply"),
        (b" " * ((1 << 24) + 1), "16 MB"),
        (b"null", "it must be an object, got null"),
        (b"[]", "it must be an object, got []"),
        (b"{}", "format is missing"),
        (b'{"format": "bench-dragon proof 2"}', "is missing"),
        (b'{"format": 1, "format": 1}', "a name stands twice"),
        (b"9" * 5000, "malformed"),
        (b'"\\ud800"', "must be an object"),
    ],
    ids=range(13),
)
def test_what_is_no_certificate_is_refused_in_one_line(data, reason, tmp_path, monkeypatch, capsys):
    (tmp_path / "certificate.json").write_bytes(data)
    monkeypatch.setattr("sys.argv", [str(VERIFY), str(tmp_path / "certificate.json")])
    with pytest.raises(SystemExit) as ended:
        runpy.run_path(str(VERIFY), run_name="__main__")
    output, errors = capsys.readouterr()
    assert ended.value.code == 1
    assert output == ""
    assert re.fullmatch(r"Refused: .*\n", errors)
    assert reason in errors


def test_a_path_of_nothing_is_refused_by_both():
    certificate = forged(made("clear"), "claim.path = {}")
    assert_verdict(certificate, r"claim\.path\.kind is another")
    proven, refusal = proven_by_core(certificate)
    assert not proven
    assert "path" in refusal


@pytest.mark.parametrize("name", [*(name for name in MAKERS if name not in SLOW), *thorough(*SLOW)])
def test_every_kind_of_claim_is_verified_and_no_other_number_of_it(name):
    """A little larger stop, time or way, or a stray above the proven one, is refused."""
    certificate = made(name)
    claim = certificate["claim"]
    proven, statement = proven_by_second(certificate)
    assert proven
    for value in claim.values():
        if isinstance(value, float) and value:
            assert repr(value).removesuffix(".0") in statement
    for member, factor in (("stop", 1.001), ("time", 1.001), ("turning_radius", 0.999), ("stray", 1.01)):
        if member in claim and (member != "stray" or "shown" in claim):
            assert_verdict(forged(certificate, f"claim.{member} = {claim[member] * factor!r}"), "")


@pytest.mark.thorough
def test_both_checkers_have_one_verdict_on_changed_certificates():
    """`python -m tests.campaigns.differential` checks 100,000."""
    assert hunt(4, cases=CHANGED)[:2] == (CHANGED, 0)


@pytest.mark.parametrize("arguments", [["--other"], *thorough([], ["a", "b"], ["nowhere"], ["/"])], ids=str)
def test_wrong_usage_gets_exit_code_2(arguments):
    done = run(*arguments)
    assert done.returncode == 2
    assert done.stdout == ""
    assert "usage: verify.py" in done.stderr
    assert "Traceback" not in done.stderr


def inside(verify, result, true):
    return bool(arb(fmpz(result.lo)) / verify.UNIT <= true and true <= arb(fmpz(result.hi)) / verify.UNIT)


def test_its_arithmetic_encloses_that_of_flint(verify):
    dice = random.Random(1)
    with ctx.workprec(400):
        assert inside(verify, verify.PI, arb.pi())
        for _ in range(ARITHMETIC_CASES):
            size = dice.choice([1e-20, 1e-6, 1.0, 4.0, 40.0, 900.0])
            low = int(dice.uniform(-size, size) * verify.UNIT)
            high = low + int(dice.choice([0.0, 1e-25, 1e-10, 0.1, 3.0, 5.9, 7.0]) * dice.random() * verify.UNIT)
            result = verify.Interval(low, high)
            for place in (low, high, dice.randint(low, high)):
                x = arb(fmpz(place)) / verify.UNIT
                assert inside(verify, verify.cos(result), x.cos())
                assert inside(verify, verify.sin(result), x.sin())
            whole = int(dice.choice([1.0, 1.5, 2.0, 10.0, 1e6, 1e15]) * (1.0 + dice.random()) * verify.UNIT)
            point = verify.Interval(whole, whole)
            y = arb(fmpz(whole)) / verify.UNIT
            assert inside(verify, verify.log(point), y.log())
            assert inside(verify, verify.sqrt(point), y.sqrt())
            assert inside(verify, result * point, x * y)
            assert inside(verify, result / point, x / y)


def bend_behind(verify, theta, chord):
    growth = verify.exactly(0.55) / (verify.TWO * verify.PI)
    return verify.bend(verify.exactly(theta), verify.Bench(chord, 0.3, 0.0, growth))


@pytest.mark.parametrize("theta", [14.735, 15.0, 30.0, 100.0, 6e5])
@pytest.mark.parametrize("chord", [0.1, 1.65, 2.86])
def test_its_bends_are_those_of_core_proof(verify, theta, chord):
    result = bend_behind(verify, theta, chord)
    assert result.hi - result.lo < BEND_WIDTH_MOST * verify.UNIT
    with ctx.workprec(400):
        needed = (arb(chord) / (arb(0.55) / (2 * arb.pi()))) ** 2
        low, high = (arb(fmpz(end)) / verify.UNIT for end in (result.lo, result.hi))
        for end, side in ((low, -1), (high, 1)):
            reached = end**2 + 2 * arb(theta) * (arb(theta) + end) * (1 - end.cos())
            assert side * (reached - needed) > 0
        assert chain.delta(arb(theta), needed).overlaps(low.union(high))


def test_past_the_fold_there_is_no_bend(verify):
    with pytest.raises(verify.Refused, match="no root"):
        bend_behind(verify, 14.73, 2.86)
