"""The claim of a certificate in sentences."""

from __future__ import annotations

import pytest

from core import (
    Dance,
    Dragon,
    Line,
    Outcome,
    Route,
    Spiral,
    Turn,
    clearance_profile,
    first_contact,
    minimum_pitch,
)

PROVEN = " Proven in steps,"
NO_PAIR = "Of fewer than three benches, any two share a handle, so there is no pair to judge."
TOUCHING = (
    "30 benches (head 3.41 m, body 2.2 m, width 0.3 m, overhang 0.275 m) on a spiral of 0.6 m pitch from 8 turns, the "
    "head at 1 m/s: from 0 s to {clear} s no two benches that share no handle touch, and at {within} s benches 0 and "
    "{b} overlap."
)
NEAR = (
    "the head at 0.5 m/s: from 10 s to {clear} s no two benches that share no handle are nearer to each other "
    "than 0.05 m, and at {within} s benches 0 and {b} are nearer than 0.05 m."
)
STOPPED = (
    "3 benches given one by one on a route from s = {begin} m to {end} m (coil, arc, arc, coil), the head at 1 m/s: "
    "from 0 s to 20 s no two benches that share no handle touch; the search was to stop there."
)
FOLDED = "no two benches that share no handle touch; there a bench folds, and the run ends."


@pytest.mark.parametrize(
    ("dragon", "path", "query", "words"),
    [
        (Dragon(30), Spiral(0.6, 8.0), {}, TOUCHING),
        (Dragon(30), Spiral(0.6, 8.0), {"margin": 0.05, "head_speed": 0.5, "start": 10.0}, NEAR),
        (Dragon.of([3.0, 2.0, 2.5], [0.3] * 3, [0.2] * 3), Turn(1.7), {"stop": 20.0}, STOPPED),
        (Dragon(12), Spiral(0.9, 4.0), {}, FOLDED),
    ],
    ids=["contact", "margin", "clear", "fold"],
)
def test_the_certificate_names_the_whole_claim_in_a_few_sentences(
    dragon: Dragon, path: Spiral | Route, query: dict[str, float], words: str
) -> None:
    contact = first_contact(Dance(dragon, path, query.pop("head_speed", 1.0)), **query)
    claim, proof = contact.certificate.method.split(PROVEN)
    if contact.time_bracket is not None:
        clear, within = contact.time_bracket
        words = words.format(clear=clear, within=within, b=contact.benches[1])
    if isinstance(path, Route):
        words = words.format(begin=path.begin, end=path.end)
    assert claim.endswith(words)
    assert "doubles" in proof
    assert proof.count(".") == 1


def test_one_or_two_benches_have_no_pair_and_no_proof_in_steps() -> None:
    one = first_contact(Dance(Dragon(1), Spiral(0.9, 4.0))).certificate.method
    two = first_contact(Dance(Dragon(2), Spiral(0.9, 4.0)), margin=0.1).certificate.method
    three = first_contact(Dance(Dragon(3), Spiral(0.9, 4.0))).certificate.method
    assert one.startswith(
        "1 bench (head 3.41 m, width 0.3 m, overhang 0.275 m) on a spiral of 0.9 m pitch from 4 turns,"
    )
    assert two.startswith("2 benches (head 3.41 m, body 2.2 m, width 0.3 m, overhang 0.275 m) on a spiral")
    for method in (one, two):
        assert method.endswith("there a bench folds, and the run ends. " + NO_PAIR)
        assert PROVEN not in method
    assert PROVEN in three


def test_a_claim_says_what_is_seen_at_the_start_and_what_is_not_decided() -> None:
    at_start = first_contact(Dance(Dragon(), Spiral(0.35)))
    assert "at 0 s benches {} and {} touch.".format(*at_start.benches) in at_start.certificate.method
    undecided = first_contact(Dance(Dragon(60), Spiral(minimum_pitch(Dragon(60)).pitch_bracket[0])))
    clear, touching = undecided.time_bracket
    never = f"to {clear} s no two benches that share no handle touch; whether any do after that is not decided"
    met = "before {} s, when benches {} and {} overlap.".format(touching, *undecided.overlapping)
    assert f"{never} {met}" in undecided.certificate.method


def test_no_clear_time_is_claimed_where_benches_touch_at_the_start_or_nothing_is_decided() -> None:
    dragon, spiral = Dragon(), Spiral()
    at_start = first_contact(Dance(dragon, spiral), margin=0.2)
    assert (at_start.outcome, at_start.certificate.clear_until) == (Outcome.CONTACT_AT_START, None)
    seen = float(clearance_profile(Dance(dragon, spiral), 10.0).clearance)
    undecided = first_contact(Dance(dragon, spiral), margin=seen, start=10.0)
    assert (undecided.outcome, undecided.certificate.clear_until) == (Outcome.UNDECIDED, None)
    words = f"not decided whether two benches that share no handle are nearer to each other than {seen} m"
    assert f"from 10 s on it is {words}" in undecided.certificate.method


def test_numbers_of_a_claim_have_no_needless_zero_and_no_sign_of_one() -> None:
    method = first_contact(Dance(Dragon(5), Route([Line((0.0, 0.0), (60.0, 0.0))])), start=20.0).certificate.method
    assert "on a route from s = 0 m to 60 m (line), the head at 1 m/s: from 20 s to 60 s" in method
