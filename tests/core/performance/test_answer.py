"""How first encounters read, and their proofs in both languages."""

from __future__ import annotations

from core import Dance, Dragon, Line, Outcome, Part, Performance, Route, first_encounter


def lanes(apart: float) -> Performance:
    """Two dragons that pass each other on parallel streets."""
    there, back = Route([Line((-30.0, 0.0), (30.0, 0.0))]), Route([Line((30.0, apart), (-30.0, apart))])
    return Performance([Part(Dance(Dragon(4), there), name="there"), Part(Dance(Dragon(4), back))])


def test_dragons_that_pass_are_clear_until_the_last_path_ends() -> None:
    met = first_encounter(lanes(0.36))
    assert repr(met) == "<FirstEncounter: no benches of two dragons touch until 60 s, where the last path ends>"
    near = met.certificate.least_clearance
    assert near is None or abs(near.clearance - 0.06) < 1e-9
    stopped = first_encounter(lanes(0.36), stop=20.0)
    assert repr(stopped) == "<FirstEncounter: no benches of two dragons touch until 20 s>"


def test_an_encounter_names_dragons_and_benches() -> None:
    met = first_encounter(lanes(0.2))
    assert repr(met) == "<FirstEncounter: bench 0 of there and bench 0 of dragon 1 touch at 29.725 s>"
    within = first_encounter(lanes(0.36), margin=0.1)
    assert repr(within).startswith(
        "<FirstEncounter: bench 0 of there and bench 0 of dragon 1 come within 0.1 m at 29.6"
    )


def test_dragons_that_slide_along_each_other_are_undecided() -> None:
    met = first_encounter(lanes(0.3))  # their sides touch, to rounding, all the way
    assert met.outcome is Outcome.UNDECIDED
    assert met.time_bracket is not None
    assert abs(met.time_bracket[0] - 29.725) < 1e-4
    assert repr(met).startswith("<FirstEncounter: undecided from 29.72")
    assert met.certificate.claim.clear_until == met.time_bracket[0]


def test_the_proof_has_words_in_both_languages() -> None:
    certificate = first_encounter(lanes(0.36)).certificate
    assert "from 7.8100000" in certificate.method
    assert "no benches of two dragons touch; there the last path ends." in certificate.method
    assert "不同龙的任何两节板凳都不相碰；此时最后一条路径结束。" in certificate.in_words("zh")
