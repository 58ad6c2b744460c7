"""Proofs: claims that hold are proven and checked, claims and certificates that do not are refused."""

from __future__ import annotations

import json
import math
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from flint import arb, ctx

from core import Dance, Dragon, Spiral, bench_poses, first_contact, trajectory
from core.errors import InvalidValue, ProofRefused
from core.proof import Certificate, check, prove_collision_time, prove_minimum_pitch
from core.proof.pairs import stays_positive
from core.shapes.rectangles import corners
from tests.core.forgeries import FORGERIES, edit, stretches, through_json
from tests.core.forgeries import put_at as at

ROOT = Path(__file__).parents[3]
CONTACTS = {
    case["name"]: case for case in json.loads((ROOT / "tests/reference/first_contact.json").read_text())["cases"]
}
PITCHES = {
    case["name"]: case for case in json.loads((ROOT / "tests/reference/minimum_pitch.json").read_text())["cases"]
}
# The reference pitches are rounded: this much more is free of contact [m].
PITCH_ROUNDING = 1e-9
SMALL = CONTACTS["n_5"]
# A delta from doubles, where F is steep, is this near to the true one [rad].
DOUBLES = 1e-9


def proof_of(case: dict[str, Any], **changes: Any) -> Certificate:
    dragon, path = Dragon(**case["dragon"]), Spiral(case["pitch"], case["start_turns"])
    return prove_collision_time(
        Dance(dragon, path, changes.pop("head_speed", 1.0)), case["time"] + changes.pop("later", 0.0), **changes
    )


@pytest.fixture(scope="module")
def small() -> Certificate:
    return through_json(proof_of(SMALL))


@pytest.mark.uncompiled
@pytest.mark.parametrize("name", ["default", "n_5", "head_spacing_1.00", "combo_b", "combo_e_body_longer_than_head"])
def test_a_reference_contact_is_proven_and_checked(name: str) -> None:
    case = CONTACTS[name]
    certificate = through_json(proof_of(case, head_speed=case["head_speed"]))
    assert certificate["overlap"] == {"benches": case["benches"]}
    assert f"benches {case['benches'][0]} and {case['benches'][1]} overlap" in check(certificate).statement


@pytest.mark.uncompiled
@pytest.mark.parametrize(
    ("name", "benches", "start_turns"),
    # Eleven benches that start nearer are limited by the same two as the whole dragon, exactly on the circle.
    [("default R=6.36", 223, 16.0), ("default R=7", 223, 16.0), ("default R=2", 11, 5.0)],
    ids=["graze", "start", "circle"],
)
def test_a_reference_pitch_is_proven_and_checked(name: str, benches: int, start_turns: float) -> None:
    case = PITCHES[name]
    pitch = case["pitch"] + PITCH_ROUNDING
    dragon = Dragon(**(case["dragon"] | {"benches": benches}))
    radius = case["turning_diameter"] / 2
    certificate = through_json(prove_minimum_pitch(dragon, pitch, turning_radius=radius, start_turns=start_turns))
    if case["limited_by"] == "start":
        assert certificate["overlap"] == {"start_within_circle": True}
    else:
        assert certificate["overlap"]["benches"] == case["benches"]
    assert repr(pitch) in check(certificate).statement


@pytest.mark.parametrize("seed", [0, 2, 8, 17, 26, 35, 42, 55])
def test_the_contact_of_a_random_dragon_given_bench_by_bench_is_proven_and_its_neighbourhood_refused(seed: int) -> None:
    random = np.random.default_rng(seed)
    benches = int(random.integers(4, 12))
    lengths, overhangs = random.uniform(1.2, 3.6, benches), random.uniform(0.0, 0.4, benches)
    dragon = Dragon.of(lengths, random.uniform(0.1, 0.4, benches), overhangs)
    path = Spiral(random.uniform(0.5, 0.8), random.uniform(5.0, 9.0))
    time = first_contact(Dance(dragon, path)).time
    assert time
    certificate = through_json(prove_collision_time(Dance(dragon, path), time))
    assert certificate["repeats_from"] == benches - 3
    check(certificate)
    for wrong in (time - 1e-8, time + 1e-8):
        with pytest.raises(ProofRefused):
            prove_collision_time(Dance(dragon, path), wrong)


@pytest.mark.parametrize("later", [-1.0, -2.1e-10, 2.1e-10, 1e-6, 1.0])
def test_a_bracket_moved_off_the_contact_is_refused(later: float) -> None:
    with pytest.raises(ProofRefused, match="no two benches overlap" if later < 0 else "benches 0 and 4 overlap"):
        proof_of(SMALL, later=later)


def test_a_contact_that_is_not_the_first_is_refused() -> None:
    # At pitch 0.55 the benches part again from 415.02 to 415.375 s: a contact there, but not the first.
    with pytest.raises(ProofRefused, match="benches 0 and 8 overlap"):
        prove_collision_time(Dance(Dragon(), Spiral()), 415.5)


@pytest.mark.parametrize(("more", "reason"), [(-1e-9, "overlap when handle 0"), (1.1e-6, "free of contact too")])
def test_a_pitch_off_the_smallest_is_refused(more: float, reason: str) -> None:
    with pytest.raises(ProofRefused, match=reason):
        prove_minimum_pitch(Dragon(), PITCHES["default R=6.36"]["pitch"] + more, turning_radius=6.36)


@pytest.mark.parametrize(
    ("benches", "reason"), [(1, "no two benches overlap"), (2, "no two benches overlap"), (223, "folds")]
)
def test_a_time_after_which_nothing_touches_is_refused(benches: int, reason: str) -> None:
    with pytest.raises(ProofRefused, match=reason):
        prove_collision_time(Dance(Dragon(benches), Spiral()), 433.0 if benches == 223 else 100.0)


@pytest.mark.parametrize("time", [-1.0, math.nan, math.inf, 1e9, "412"])
def test_a_time_that_is_no_time_of_the_dance_is_an_invalid_value(time: Any) -> None:
    with pytest.raises(InvalidValue, match="time must be"):
        prove_collision_time(Dance(Dragon(), Spiral()), time)


def test_every_pair_in_its_own_right_proves_the_same_as_equal_benches_taken_once() -> None:
    case = CONTACTS["combo_e_body_longer_than_head"]
    dragon, path = Dragon(**(case["dragon"] | {"benches": 12})), Spiral(case["pitch"], 4.0)
    time = first_contact(Dance(dragon, path)).time
    assert time is not None
    once, each = (prove_collision_time(Dance(dragon, path), time, every_pair=every) for every in (False, True))
    assert (len(once["sweeps"]), len(each["sweeps"])) == (2, 10)
    assert check(once).statement == check(each).statement
    assert check(each).pair_proofs > check(once).pair_proofs


@pytest.mark.parametrize("benches", [13, 40])
def test_at_every_instant_every_pair_has_a_face_between_it_or_is_rings_apart(benches: int) -> None:
    dragon, path = Dragon(benches), Spiral(0.55, 9.0)
    time = first_contact(Dance(dragon, path)).time
    assert time
    certificate = prove_collision_time(Dance(dragon, path), time)
    handles = trajectory(Dance(dragon, path), np.linspace(0.0, 0.999 * time, 40)).position
    thetas = np.hypot(*np.moveaxis(handles, -1, 0)) / path.growth
    sizes = np.stack([dragon.lengths, dragon.widths], axis=-1)
    for poses, fronts in zip(bench_poses(handles), thetas, strict=True):
        corners_all = corners(poses, sizes)
        radii = np.hypot(*np.moveaxis(corners_all, -1, 0)).max(axis=-1)
        for a in range(benches - 2):
            tiles = stretches(certificate, min(a, 1))
            faces = next(faces for high, low, faces in tiles if low - DOUBLES <= fronts[a] <= high + DOUBLES)
            for b in range(a + 2, benches):
                if b - a - 2 < len(faces):
                    owner, other = (a, b) if faces[b - a - 2] < "4" else (b, a)
                    side = int(faces[b - a - 2]) % 4
                    heading = poses[owner, 2] + side * math.pi / 2
                    out = (corners_all[other] - poses[owner, :2]) @ [math.cos(heading), math.sin(heading)]
                    assert out.min() > sizes[owner, side % 2] / 2
                else:
                    assert shapely.Polygon(corners_all[b]).distance(shapely.Point(0.0, 0.0)) > radii[a]


@pytest.mark.parametrize("name", FORGERIES)
def test_a_forged_certificate_is_refused(small: Certificate, name: str) -> None:
    change, reason = FORGERIES[name]
    with pytest.raises(ProofRefused, match=reason):
        check(edit(change)(small))


def test_an_edit_of_what_no_proof_needs_is_refused_by_the_digest(small: Certificate) -> None:
    with pytest.raises(ProofRefused, match="was changed"):
        check(small | {"versions": {"python-flint": "0", "flint": "0"}})
    with pytest.raises(ProofRefused, match="malformed"):
        check({name: value for name, value in small.items() if name != "digest"})


@pytest.mark.parametrize("precision", [53, 4096])
def test_a_certificate_is_checked_with_the_precision_that_it_states(
    small: Certificate, precision: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    used: list[int] = []
    monkeypatch.setattr("core.proof.certificate.swept", lambda *asked: used.append(ctx.prec) or [])
    with pytest.raises(ProofRefused):
        check(edit(at("precision", put=precision))(small))
    assert used == [precision]


@pytest.mark.parametrize(
    ("overlap", "reason"),
    [
        ({"benches": [0, 26], "head_theta": 97.0}, "not shown to overlap on the way"),  # within the circle
        ({"benches": [0, 26], "head_theta": 100.0}, "not shown to overlap on the way"),
        ({"start_within_circle": True}, "not shown to lie within the circle"),
    ],
)
def test_a_forged_overlap_on_the_way_to_the_circle_is_refused(overlap: dict[str, Any], reason: str) -> None:
    pitch = PITCHES["default R=6.36"]["pitch"] + PITCH_ROUNDING
    certificate = through_json(prove_minimum_pitch(Dragon(27), pitch, turning_radius=6.36))
    check(certificate)
    with pytest.raises(ProofRefused, match=reason):
        check(edit(lambda content: content.__setitem__("overlap", overlap))(certificate))


def test_progress_rises_to_one_and_the_precision_is_left_as_it_was() -> None:
    before, proving, checking = ctx.prec, [0.0], [0.0]
    check(proof_of(SMALL, progress=proving.append), progress=checking.append)
    with pytest.raises(ProofRefused):
        proof_of(SMALL, later=1.0)
    assert ctx.prec == before
    for shares in (proving, checking):
        assert shares == sorted(shares)
        assert shares[-1] == 1.0


def test_the_bound_on_a_stretch_never_calls_a_dip_positive() -> None:
    # g = first + rate x + bow x^2 on [0, width]: with the exact range of g' the bound may only be too careful.
    random = np.random.default_rng(5)
    proven = 0
    for first, rate, bow, width in random.uniform([0.0, -2.0, -3.0, 0.1], [1.0, 2.0, 3.0, 2.0], (4000, 4)):
        end, end_rate = first + rate * width + bow * width**2, rate + 2 * bow * width
        inside = -rate / (2 * bow) if 0.0 < -rate / (2 * bow) < width else 0.0
        least = min(first, end, first + rate * inside + bow * inside**2)
        positive = stays_positive(arb(first), arb(end), arb(rate).union(arb(end_rate)), arb(width))
        assert not positive or least > 0.0
        proven += positive
    assert proven > 1000


def test_without_flint_the_error_names_the_extra() -> None:
    code = "import sys; sys.modules['flint'] = None; import core.proof"
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 1
    assert "pip install 'bench-dragon[proof]'" in done.stderr.splitlines()[-1]
