"""examples/verify.py, run as a reader runs it: alone, without site packages, on certificates that are files."""

from __future__ import annotations

import ast
import copy
import itertools
import json
import random
import re
import subprocess
import sys
from collections.abc import Callable
from functools import cache
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest
from flint import arb, ctx, fmpz

from core import Dance, Dragon, Spiral, first_contact, minimum_pitch
from core.errors import ProofRefused
from core.proof import (
    Certificate,
    chain,
    prove_collision_time,
    prove_minimum_pitch,
)
from core.proof import verify as core_verify
from tests.campaigns.differential import MAKERS, hunt, made, second
from tests.support.depth import DEEP, examples, some
from tests.support.forgeries import FORGERIES, edit, put_at, stretches
from tests.support.reference import reference_cases
from tests.support.reference_contacts import proof_of, random_contact

ROOT = Path(__file__).parents[1]
VERIFY = ROOT / "examples" / "verify.py"
CASES = reference_cases("first_contact") | reference_cases("minimum_pitch")
PITCH_ROUNDING = 1e-9  # the reference pitches are rounded: this much more is free of contact [m]
PATIENCE = 600.0  # [s]: only against a run that would hang
ARITHMETIC_CASES = 300
FUZZED = examples(24, 60)
CHANGED = examples(60, 2_000)
BEND_WIDTH_MOST = 1e-20  # far below what the proofs need, about 1e-14 [rad]


def alone(*arguments: str) -> subprocess.CompletedProcess[str]:
    """verify.py alone: -I and -S leave no path to any package but the standard library."""
    command = [sys.executable, "-I", "-S", str(VERIFY), *arguments]
    return subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE)


PROGRAM = compile(VERIFY.read_bytes(), str(VERIFY), "exec")


@pytest.fixture
def judged(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> Callable[[Any], subprocess.CompletedProcess[str]]:
    """Runs verify.py in this process on a certificate, or on a text or bytes that are none."""

    def judge(content: Any) -> subprocess.CompletedProcess[str]:
        data = json.dumps(content) if isinstance(content, dict | list) else content
        path, code = tmp_path / "certificate.json", 0
        path.write_bytes(data if isinstance(data, bytes) else data.encode())
        monkeypatch.setattr("sys.argv", [str(VERIFY), str(path)])
        try:
            exec(PROGRAM, {"__name__": "__main__"})
        except SystemExit as end:
            code = int(end.code or 0)
        return subprocess.CompletedProcess(sys.argv, code, *capsys.readouterr())

    return judge


def refusal(done: subprocess.CompletedProcess[str], code: int = 1) -> str:
    """The reason of a refusal, which is one line. code: 1 for a certificate that proves nothing, 3 for another kind"""
    assert (done.returncode, done.stdout) == (code, "")
    line, end, more = done.stderr.partition("\n")
    assert (line[:9], end, more) == ("Refused: ", "\n", "")
    return line


def collision(name: str, **changes: Any) -> Certificate:
    return proof_of(CASES[name], head_speed=CASES[name]["head_speed"], **changes)


@cache
def pitch(name: str, benches: int, start_turns: float = 16.0) -> Certificate:
    case = CASES[name]
    dragon = Dragon(**(case["dragon"] | {"benches": benches}))
    radius = case["turning_diameter"] / 2
    return prove_minimum_pitch(dragon, case["pitch"] + PITCH_ROUNDING, turning_radius=radius, start_turns=start_turns)


@cache
def graze() -> Certificate:
    dragon, radius, start_turns = Dragon(14), 3.2, 7.0
    least = minimum_pitch(dragon, turning_radius=radius, start_turns=start_turns).pitch
    return prove_minimum_pitch(dragon, least + PITCH_ROUNDING, turning_radius=radius, start_turns=start_turns)


def bench_by_bench(seed: int) -> Certificate:
    return prove_collision_time(*random_contact(seed))


def every_pair() -> Certificate:
    """Twelve equal benches, each pair proven in its own right."""
    case = CASES["combo_e_body_longer_than_head"]
    dragon, path = Dragon(**(case["dragon"] | {"benches": 12})), Spiral(case["pitch"], 4.0)
    time = first_contact(Dance(dragon, path)).time
    assert time is not None
    return prove_collision_time(Dance(dragon, path), time, every_pair=True)


def near_the_fold() -> Certificate:
    """Handle 1 turns back, and the head's bend grows beyond half a turn."""
    dragon, path = Dragon(12, 3.61, 2.4, 0.12, 0.1), Spiral(0.48, 4.0)
    time = first_contact(Dance(dragon, path, 0.7)).time
    assert time is not None
    return prove_collision_time(Dance(dragon, path, 0.7), time)


@pytest.fixture(scope="module")
def small() -> Certificate:
    return json.loads(json.dumps(collision("n_5")))  # type: ignore[no-any-return]


@pytest.fixture
def verify() -> ModuleType:
    """verify.py as a module, to look inside, with all the work that one certificate may take."""
    module = second()
    module.LEFT[0] = module.BENDS_MOST
    return module


def test_its_code_imports_the_standard_library_alone() -> None:
    source = VERIFY.read_text(encoding="utf-8")
    tree = ast.parse(source)
    names = {alias.name for node in ast.walk(tree) if isinstance(node, ast.Import) for alias in node.names}
    names |= {str(node.module) for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)}
    assert names
    assert names - set(sys.stdlib_module_names) == set()
    assert not re.search(r"\b(__import__|importlib|exec|eval)\b", source)


CERTIFICATES: dict[str, tuple[Callable[[], Certificate], str]] = {
    "five benches": (lambda: collision("n_5"), "benches 0 and 4 overlap"),
    "near the fold, with a slow head": (near_the_fold, "its head at 0.7 m/s: no two benches except neighbours touch"),
    "each pair in its own right": (every_pair, "A dragon of 12 benches (1 of 1.5 m by 0.3 m, overhang 0.15 m; 11 of "),
    "bench by bench": (lambda: bench_by_bench(17), "overlap at"),
    "bench by bench, another": (lambda: bench_by_bench(42), "overlap at"),
    "a contact at the start": (lambda: bench_by_bench(7), "m/s: within 2e-10 s of the start benches "),
    "a pitch limited by a graze": (graze, "with a pitch 1e-6 m smaller benches 0 and 12 overlap on the way"),
    "one bench, limited by the start": (lambda: prove_minimum_pitch(Dragon(1), 0.28125), "A dragon of 1 bench (1 of "),
    "two benches, limited by the start": (lambda: prove_minimum_pitch(Dragon(2), 0.28125), "smaller the head starts "),
    "a pitch limited by the start": (lambda: pitch("default R=7", 11), "1e-6 m smaller the head starts nearer."),
    "a pitch limited on the circle": (lambda: pitch("default R=2", 11, 5.0), "touch until the head is 2 m from"),
}  # fmt: skip
if DEEP:
    CERTIFICATES["a reference pitch limited by a graze"] = (
        lambda: pitch("default R=6.36", 27),
        "benches 0 and 26 overlap on the way",
    )
    CERTIFICATES["the contest's first contact"] = (
        lambda: prove_collision_time(Dance(Dragon(), Spiral()), 412.47383768211466),
        "benches 0 and 8 overlap",
    )
    CERTIFICATES["the contest's pitch"] = (
        lambda: prove_minimum_pitch(Dragon(), 0.450337394),
        "benches 0 and 19 overlap",
    )


@pytest.mark.parametrize("name", CERTIFICATES)
def test_certificates_of_all_kinds_are_verified(tmp_path: Path, name: str) -> None:
    make, words = CERTIFICATES[name]
    (tmp_path / "certificate.json").write_text(json.dumps(make()))
    done = alone(str(tmp_path / "certificate.json"))
    assert (done.returncode, done.stderr) == (0, "")
    assert words in done.stdout


# Refusals that verify.py words otherwise than core.proof.
OWN_WORDS = dict.fromkeys(("a sweep dropped", "a sweep too many", "sweeps exchanged"), "the sweeps are not those of")


@pytest.mark.parametrize("name", FORGERIES)
def test_a_forged_certificate_is_refused(
    judged: Callable[[Any], subprocess.CompletedProcess[str]], small: Certificate, name: str
) -> None:
    change, reason = FORGERIES[name]
    words = OWN_WORDS.get(name, reason)
    assert re.search(words, refusal(judged(edit(change)(small))))


MORE_FORGERIES: dict[str, tuple[Callable[[dict[str, Any]], Any], str]] = {
    "faces turned by half a turn": (
        lambda c: stretches(c)[5].__setitem__(2, "".join(str(int(f) ^ 2) for f in stretches(c)[5][2])), "not apart by",
    ),
    "no faces": (lambda c: stretches(c)[5].__setitem__(2, ""), "pairs are missing"),
    "the way in one stretch, ends kept": (
        lambda c: c["sweeps"][0].__setitem__("stretches", [[stretches(c)[0][0], stretches(c)[-1][1], "333"]]), "apart",
    ),
    "a stretch turned round": (lambda c: stretches(c)[5].__setitem__(slice(0, 2), stretches(c)[5][1::-1]), "malformed"),
    "a sweep of nothing": (lambda c: c["sweeps"][1].__setitem__("stretches", []), "short of"),
    "no sweep": (lambda c: c.__setitem__("sweeps", []), "the sweeps are not those"),
    "an outer bench that is longer": (lambda c: c["dragon"][1].__setitem__(1, 2.3), "not proven"),
    "a shorter head": (lambda c: c["dragon"][0].__setitem__(1, 3.40), "not shown to overlap"),
    "an overhang": (lambda c: c["dragon"][0].__setitem__(3, 0.2751), "not proven"),
    "one bench of the body another": (lambda c: c["dragon"].append([1, 2.2, 0.31, 0.275]), "not alike"),
    "benches swapped": (lambda c: c["dragon"].reverse(), "not"),
    "a longer dragon": (put_at("dragon", 1, 0, put=5), "pairs are missing"),
    "two benches": (put_at("dragon", put=[[2, 2.2, 0.3, 0.275]]), "share no handle"),
    "the overlap the other way round": (put_at("overlap", "benches", put=[4, 0]), "share no handle"),
    "an overlap behind the tail": (put_at("overlap", "benches", put=[0, 5]), "share no handle"),
    "another overlap": (put_at("overlap", "benches", put=[1, 4]), "not shown to overlap"),
    "a time of nothing": (put_at("claim", "time", put=0), "not shown to overlap"),
    "a time past the centre": (put_at("claim", "time", put=1e6), "past the centre"),
    "a head that stands": (put_at("claim", "head_speed", put=0), "head_speed must be from"),
    "a negative zero": (put_at("claim", "head_speed", put=-0.0), "head_speed must be from"),
    "a pitch of nothing": (put_at("claim", "pitch", put=0.0), "pitch must be from"),
    "the least pitch": (put_at("claim", "pitch", put=5e-324), "pitch must be from"),
    "the largest pitch": (put_at("claim", "pitch", put=1e15), "pitch must be from"),
    "the most turns": (put_at("claim", "start_turns", put=1e15), "start_turns must be from"),
    "a large number": (put_at("claim", "start_turns", put=1e308), "claim.start_turns must be a number from -1e15"),
    "a whole number of 400 digits": (put_at("claim", "pitch", put=10**400), "claim.pitch must be a number from -1e15"),
    "a bench that is true": (put_at("overlap", "benches", 0, put=True), r"overlap\.benches\[0\] must be a whole"),
    "a count that is true": (put_at("dragon", 0, 0, put=True), r"dragon\[0\]\[0\] must be a whole number"),
    "a tenth face": (lambda c: stretches(c)[5].__setitem__(2, "09"), r"sweeps\[0\]\.stretches\[5\]"),
    "faces for benches that are none": (lambda c: stretches(c)[5].__setitem__(2, "3333"), r"sweeps\[0\]\.stretches"),
    "an unknown kind": (put_at("claim", "kind", put="speed"), "claim.kind is another"),
    "a kind that is a list": (put_at("claim", "kind", put=[]), "claim.kind is another"),
    "an unknown member with a line break": (put_at("a\nb\ud800", put=1), r"a\\nb\\ud800 is unknown"),
    "a chord of nothing": (put_at("dragon", 1, put=[4, 2.2, 0.3, 1.1]), "room for a chord"),
    "no bench": (put_at("dragon", 0, 0, put=0), "room for a chord"),
    "benches of width 0": (put_at("dragon", 1, 2, put=0.0), "0.001 to 10000 m"),
    "a head of width 0": (put_at("dragon", 0, 2, put=0), "0.001 to 10000 m"),
    "benches of length 20 km": (put_at("dragon", 1, 1, put=2e4), "0.001 to 10000 m"),
    "too few digits": (put_at("precision", put=52), "precision must be from"),
}  # fmt: skip


@pytest.mark.parametrize("name", MORE_FORGERIES)
def test_a_forgery_of_its_own_kind_is_refused(
    judged: Callable[[Any], subprocess.CompletedProcess[str]], small: Certificate, name: str
) -> None:
    change, reason = MORE_FORGERIES[name]
    assert re.search(reason, refusal(judged(edit(change)(small))))


def test_a_stretch_too_wide_to_be_shown_at_once_is_halved(verify: ModuleType, small: Certificate) -> None:
    """Neighbouring stretches with the same faces may be joined: what is claimed stays true."""
    alike = [k for k, (one, after) in enumerate(itertools.pairwise(stretches(small))) if one[2] == after[2]]
    refused_by_core = 0
    for k in some(alike, 4):
        joined = edit(lambda c, k=k: stretches(c)[k].__setitem__(1, stretches(c).pop(k + 1)[1]))(small)
        assert "benches 0 and 4 overlap" in verify.verified(copy.deepcopy(joined))
        try:
            core_verify(joined)
        except ProofRefused:
            refused_by_core += 1
    assert refused_by_core > 0


def test_an_accident_is_refused_by_the_digest(
    judged: Callable[[Any], subprocess.CompletedProcess[str]], small: Certificate
) -> None:
    assert "changed after it was made" in refusal(judged(small | {"precision": 97}))


@pytest.mark.parametrize(
    ("overlap", "reason"),
    [
        ({"benches": [0, 12], "head_theta": 40.0}, "on the way"),  # within the circle
        ({"benches": [0, 12], "head_theta": 43.0}, "not shown to overlap"),
        ({"benches": [0, 12], "head_theta": 44.5}, "on the way"),  # before the start
        ({"start_within_circle": True}, "does not lie within it"),
        ({"benches": [0, 12]}, "head_theta is missing"),
    ],
)
def test_a_forged_overlap_on_the_way_to_the_circle_is_refused(
    judged: Callable[[Any], subprocess.CompletedProcess[str]], overlap: dict[str, Any], reason: str
) -> None:
    assert reason in refusal(judged(edit(put_at("overlap", put=overlap))(graze())))


@pytest.mark.parametrize(
    ("change", "value"),
    [("pitch", -1e-8), ("pitch", 1.1e-6), ("turning_radius", -1e-3)],
)
def test_a_pitch_or_a_circle_that_the_stretches_do_not_show_is_refused(
    judged: Callable[[Any], subprocess.CompletedProcess[str]], change: str, value: float
) -> None:
    certificate = graze()
    forged = edit(put_at("claim", change, put=certificate["claim"][change] + value))(certificate)
    assert "not proven" in refusal(judged(forged))


@pytest.mark.parametrize(
    ("data", "reason"),
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
def test_what_is_no_certificate_is_refused_in_one_line(
    judged: Callable[[Any], subprocess.CompletedProcess[str]], data: bytes, reason: str
) -> None:
    assert reason in refusal(judged(data))


def test_a_width_of_0_is_refused_by_both(verify: ModuleType) -> None:
    """Rectangles without interiors never overlap, although each face has a corner of the other before it."""
    with pytest.raises(verify.Refused, match=r"0\.001 to 10000 m"):
        verify.verified(edit(put_at("dragon", 0, 2, put=0.0))(made("contact")))
    with pytest.raises(ProofRefused, match=r"must be from 0\.001"):
        core_verify(edit(put_at("dragon", 0, 2, put=0.0))(made("contact")))


def test_a_path_of_nothing_is_refused_by_both(verify: ModuleType) -> None:
    nowhere = edit(put_at("claim", "path", put={}))(made("clear"))
    with pytest.raises(verify.Refused, match=r"claim\.path\.kind is another"):
        verify.verified(nowhere)
    with pytest.raises(ProofRefused, match="path"):
        core_verify(nowhere)


@pytest.mark.parametrize("name", MAKERS)
def test_every_kind_of_claim_is_verified_and_no_other_number_of_it(verify: ModuleType, name: str) -> None:
    """A little larger stop, time or way, or a stray above the proven one, is refused."""
    certificate = made(name)
    statement = verify.verified(copy.deepcopy(certificate))
    for value in certificate["claim"].values():
        if isinstance(value, float) and value:
            assert repr(value).removesuffix(".0") in statement
    for member, factor in (("stop", 1.001), ("time", 1.001), ("turning_radius", 0.999), ("stray", 1.01)):
        if member in certificate["claim"] and (member != "stray" or "shown" in certificate["claim"]):
            larger = edit(put_at("claim", member, put=certificate["claim"][member] * factor))(certificate)
            with pytest.raises(verify.Refused):
                verify.verified(larger)


def test_both_checkers_have_one_verdict_on_changed_certificates() -> None:
    """`python -m tests.campaigns.differential` checks 100,000."""
    count, disagreements = hunt(seed=4, cases=CHANGED)
    assert (count, disagreements) == (CHANGED, [])


def test_wrong_usage_gets_exit_code_2(tmp_path: Path) -> None:
    for arguments in ([], ["a", "b"], [str(tmp_path / "nowhere")], [str(tmp_path)], ["--other"]):
        done = alone(*arguments)
        assert (done.returncode, done.stdout) == (2, "")
        assert "usage: verify.py" in done.stderr
        assert "Traceback" not in done.stderr


def cut(content: dict[str, Any]) -> None:
    """Every stretch in eight, as verify.py may halve it three times."""
    for sweep in content["sweeps"]:
        tiles = sweep["stretches"]
        sweep["stretches"] = []
        for high, low, faces in tiles:
            places = [high, *(high + (low - high) * k / 8 for k in range(1, 8)), low]
            sweep["stretches"] += [[start, end, faces] for start, end in itertools.pairwise(places)]


def test_what_it_accepts_of_random_edits_core_proof_accepts_too(verify: ModuleType, small: Certificate) -> None:
    """A digit of the text is changed, and the digest made to fit: refused by both, or proven by both."""
    dice = random.Random(7)
    text = json.dumps({name: value for name, value in small.items() if name not in ("digest", "precision", "versions")})
    digits = [place for place, sign in enumerate(text) if sign.isdigit()]
    accepted = 0
    for place in dice.sample(digits, FUZZED):
        other = dice.choice([digit for digit in "0123456789" if digit != text[place]])
        try:
            content = small | json.loads(text[:place] + other + text[place + 1 :])
        except json.JSONDecodeError:  # a number does not begin with 0
            continue
        try:
            verify.verified(edit(lambda c: None)(content))
        except verify.Refused:
            continue
        accepted += 1
        try:
            core_verify(edit(lambda c: None)(content))
        except ProofRefused:
            core_verify(edit(cut)(content))
    assert 0 < accepted < FUZZED / 2


def inside(verify: ModuleType, result: Any, true: arb) -> bool:
    return bool(arb(fmpz(result.lo)) / verify.UNIT <= true and true <= arb(fmpz(result.hi)) / verify.UNIT)


def test_its_arithmetic_encloses_that_of_flint(verify: ModuleType) -> None:
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
            y = int(dice.choice([1.0, 1.5, 2.0, 10.0, 1e6, 1e15]) * (1.0 + dice.random()) * verify.UNIT)
            point = verify.Interval(y, y)
            assert inside(verify, verify.log(point), (arb(fmpz(y)) / verify.UNIT).log())
            assert inside(verify, verify.sqrt(point), (arb(fmpz(y)) / verify.UNIT).sqrt())
            assert inside(verify, result * point, x * (arb(fmpz(y)) / verify.UNIT)) or place != high
            assert (result / point).lo <= (result / point).hi


@pytest.mark.parametrize("theta", [14.735, 15.0, 30.0, 100.0, 6e5])
@pytest.mark.parametrize("chord", [0.1, 1.65, 2.86])
def test_its_bends_are_those_of_core_proof(verify: ModuleType, theta: float, chord: float) -> None:
    growth = verify.exactly(0.55) / (verify.TWO * verify.PI)
    bench = verify.Bench(chord, 0.3, 0.0, growth)
    result = verify.bend(verify.exactly(theta), bench)
    assert result.hi - result.lo < BEND_WIDTH_MOST * verify.UNIT
    with ctx.workprec(400):
        b = arb(0.55) / (2 * arb.pi())
        needed, low, high = (arb(chord) / b) ** 2, *(arb(fmpz(end)) / verify.UNIT for end in (result.lo, result.hi))
        for end, side in ((low, -1), (high, 1)):
            reached = end**2 + 2 * arb(theta) * (arb(theta) + end) * (1 - end.cos())
            assert side * (reached - needed) > 0
        assert chain.delta(arb(theta), needed).overlaps(low.union(high))


def test_past_the_fold_there_is_no_bend(verify: ModuleType) -> None:
    growth = verify.exactly(0.55) / (verify.TWO * verify.PI)
    with pytest.raises(verify.Refused, match="no root"):
        verify.bend(verify.exactly(14.73), verify.Bench(2.86, 0.3, 0.0, growth))
