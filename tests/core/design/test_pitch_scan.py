"""The scan of pitches: its pieces are continuous, its jumps are jumps, and pitches without contact are left out."""

import math
from itertools import pairwise

import numpy as np
import pytest

import core.design.pitch_scan
from core import Dance, Dragon, Outcome, Spiral, TooMuchWork, first_contact, minimum_pitch
from core.design.pitch_scan import JUMP, JUMP_WIDTH, RADIUS_WIDTH, Stops, pitch_scan, scan_near_minimum
from tests.core.contact.test_fold import TO_THE_FOLD
from tests.support.depth import some
from tests.support.near import assert_near
from tests.support.refused import refused

SMALL = Dragon(benches=30)
BRACKET = 1e-9  # [m]: how well the minimum pitch is known
PITCHES = np.linspace(0.44, 0.46, 5)


def test_a_scan_covers_all_samples_in_continuous_pieces_with_a_jump_at_the_minimum_pitch():
    """The head stops at 4.573 m just below 0.4503374 m and at 4.406 m just above; nothing in between."""
    shares = []
    scan = pitch_scan(Dragon(), PITCHES, progress=shares.append)
    assert shares == [0.2, 0.4, 0.6, 0.8, 1.0]
    steps = np.flatnonzero(np.abs(np.diff(scan.radius)) > JUMP)
    ends = [0, *(steps + 1).tolist(), len(scan.pitch)]
    assert scan.pieces == tuple(pairwise(ends))
    assert scan.jumps == tuple((end - 1, end) for end in ends[1:-1])
    jumps = np.array(scan.jumps)
    assert (np.diff(scan.pitch[jumps]) <= JUMP_WIDTH).all()
    (at,) = np.flatnonzero(
        np.abs(scan.pitch[jumps] - minimum_pitch(Dragon()).pitch).max(axis=1) <= JUMP_WIDTH + BRACKET
    )
    assert_near(scan.radius[jumps[at]], (4.573, 4.406), 1e-3)  # [m]: the digits given above


def test_a_first_look_has_the_samples_alone_and_the_same_radii():
    look, scan = (pitch_scan(Dragon(), PITCHES, locate=locate) for locate in (False, True))
    assert look.pitch.tolist() == PITCHES.tolist()
    assert_near(look.radius, scan.radius[np.isin(scan.pitch, PITCHES)], RADIUS_WIDTH)
    assert look.jumps == ()


def test_a_pitch_without_contact_between_two_others_separates_two_pieces():
    dragon = Dragon.of([0.33, 0.43, 1.15, 1.02], [0.05, 0.07, 0.04, 0.06], [0.02, 0.04, 0.13, 0.16])
    scan = pitch_scan(dragon, [0.26, 0.28, 0.3, 0.32, 0.34], start_turns=7.0, margin=0.1, locate=False)
    assert scan.pitch.tolist() == [0.26, 0.28, 0.32, 0.34]
    assert scan.pieces == ((0, 2), (2, 4))
    assert scan.jumps == ()


def test_a_run_that_is_undecided_just_before_its_fold_stops_there():
    """In the last nanometre of travel the clearance falls from 0.27395 to 0.27289 mm."""
    dragon, spiral = TO_THE_FOLD["30 micrometres apart"]
    dance = Dance(dragon, spiral)
    margin = 2.734e-4
    assert first_contact(dance, margin=margin).outcome is Outcome.UNDECIDED
    at_fold = dance.path.head(dance.end.time).radius
    assert_near(Stops(dragon, margin).radius(spiral), at_fold, RADIUS_WIDTH)


def radius_of_contact(dragon, pitch, margin=0.0):
    head = first_contact(Dance(dragon, Spiral(pitch)), margin=margin).head
    return head and pytest.approx(head.radius, abs=RADIUS_WIDTH)


def test_radii_are_those_of_first_contact_also_beside_jumps():
    """Beside a jump a contact is within rounding of a graze: first_contact() narrows it in decimals."""
    scan = pitch_scan(Dragon(), PITCHES)
    beside = {k for jump in scan.jumps for k in jump}
    chosen = sorted(beside | set(range(0, len(scan.pitch), 8)))
    assert len(chosen) > 2 * len(PITCHES)
    stops = Stops(Dragon(), 0.0)
    for pitch in some(scan.pitch[chosen].tolist(), 20):
        assert stops.radius(Spiral(pitch)) == radius_of_contact(Dragon(), pitch), pitch


@pytest.mark.parametrize(
    "dragon, pitch, margin",
    [
        (Dragon(), 0.8, 0.0),
        (Dragon(2), 0.5, 0.0),
        (Dragon(), 0.3, 0.05),
    ],
    ids=["clear to the fold", "two benches", "touching at the start"],
)
def test_a_run_to_a_fold_and_a_contact_are_distinguished_as_by_first_contact(dragon, pitch, margin):
    assert Stops(dragon, margin).radius(Spiral(pitch)) == radius_of_contact(dragon, pitch, margin)


def test_work_that_ends_before_the_scan_does_is_an_error(monkeypatch):
    monkeypatch.setattr(core.design.pitch_scan, "SCAN_WORK", 1e4)
    with refused("pitches", TooMuchWork):
        pitch_scan(Dragon(), PITCHES)
    with refused("samples", TooMuchWork, got=7):
        scan_near_minimum(Dragon(), turning_radius=4.5, start_turns=16.0, margin=0.0, samples=7)


@pytest.mark.parametrize(
    "pitches, field",
    [([0.5, 0.4], "pitches.1"), ([0.5, math.nan], "pitches.1"), ([[0.5]], "pitches")],
)
def test_pitches_that_do_not_ascend_are_refused(pitches, field):
    with refused(field):
        pitch_scan(Dragon(3), pitches)


def test_a_pitch_given_twice_counts_once_and_one_without_contact_not_at_all():
    scan = pitch_scan(SMALL, [0.4, 0.4, 0.8], start_turns=8.0)
    assert set(scan.pitch.tolist()) == {0.4}
