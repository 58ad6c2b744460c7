"""Certificates of a moved spiral equal those of the standard one; passages are not part of a proof."""

from dataclasses import replace

from core import Dance, Dragon, Passage, Spiral, tolerance
from core.proof import prove_clear, prove_tolerance, verify
from tests.support.refused import refused

STANDARD = Dance(Dragon(5), Spiral(0.55, 4.0))
ELSEWHERE = Dance(Dragon(5), Spiral(0.55, 4.0, (31.0, -12.5), 0.6, clockwise=False))
SPAN = {"start": 0.0, "stop": 0.5}


def test_a_certificate_does_not_depend_on_where_the_spiral_lies():
    certificate = prove_clear(ELSEWHERE, 2.0)
    assert certificate["digest"] == prove_clear(STANDARD, 2.0)["digest"]


def test_a_pose_that_overlaps_elsewhere_is_proven_in_the_frame_of_the_spiral():
    dance = Dance(Dragon(20), replace(ELSEWHERE.path, start_turns=8.0))
    result = tolerance(dance, **SPAN)
    assert result.exhibit is not None
    certificate = prove_tolerance(dance, result.stray, exhibit=result.exhibit, **SPAN)
    assert verify(certificate).pair_proofs > 0


def test_passages_are_refused_and_the_steady_dance_is_proven():
    dance = replace(ELSEWHERE, passages=[Passage(0.5, until_s=1.0)])
    with refused("passages"):
        prove_clear(dance, 2.0)
    assert prove_clear(dance.steady, 2.0)["digest"] == prove_clear(STANDARD, 2.0)["digest"]
