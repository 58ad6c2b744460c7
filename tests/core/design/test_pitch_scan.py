"""The scan of pitches: its pieces are continuous, its jumps are jumps, and pitches without contact are left out."""

from __future__ import annotations

import math

import numpy as np
import pytest

import core.design.pitch_scan
from core import Dance, Dragon, InvalidValue, Outcome, Spiral, TooMuchWork, first_contact, minimum_pitch
from core.design.pitch_scan import JUMP, JUMP_WIDTH, RADIUS_WIDTH, Stops, pitch_scan, scan_near_minimum
from tests.core.contact.test_fold import TO_THE_FOLD
from tests.support.depth import some

SMALL = Dragon(benches=30)
BRACKET = 1e-9  # [m]: how well the minimum pitch is known


def test_scan_finds_the_jump_at_the_minimum_pitch() -> None:
    """The head stops at 4.573 m just below 0.4503374 m and at 4.406 m just above; nothing in between."""
    scan = pitch_scan(Dragon(), np.array([0.449, 0.4515]))
    edges = [(scan.pitch[start - 1], scan.pitch[start]) for start, _ in scan.pieces[1:]]
    least = minimum_pitch(Dragon()).pitch
    [(low, high)] = [(low, high) for low, high in edges if low - BRACKET <= least <= high + BRACKET]
    assert high - low <= JUMP_WIDTH
    before, after = (scan.radius[scan.pitch == pitch].item() for pitch in (low, high))
    assert before > 4.5 > after
    assert before - after == pytest.approx(4.573 - 4.406, abs=1e-3)  # [m]: the digits given above


def test_scan_pieces_are_continuous_and_cover_every_sample() -> None:
    scan = pitch_scan(Dragon(), np.linspace(0.44, 0.46, 5))
    assert [end for _, end in scan.pieces[:-1]] == [start for start, _ in scan.pieces[1:]]
    assert (scan.pieces[0][0], scan.pieces[-1][1]) == (0, len(scan.pitch))
    for start, end in scan.pieces:
        assert np.abs(np.diff(scan.radius[start:end])).max(initial=0.0) <= JUMP


def test_a_first_look_has_the_samples_alone_and_the_same_radii() -> None:
    pitches = np.linspace(0.44, 0.46, 5)
    look, scan = (pitch_scan(Dragon(), pitches, locate=locate) for locate in (False, True))
    assert look.pitch.tolist() == pitches.tolist()
    assert look.radius == pytest.approx(scan.radius[np.isin(scan.pitch, pitches)], rel=0.0, abs=RADIUS_WIDTH)
    assert look.jumps == ()
    assert len(scan.jumps) == len(scan.pieces) - 1
    for before, after in scan.jumps:
        assert scan.pitch[after] - scan.pitch[before] <= JUMP_WIDTH
        assert abs(scan.radius[before] - scan.radius[after]) > JUMP


def test_scan_leaves_out_pitches_without_contact_and_reports_progress() -> None:
    shares: list[float] = []
    scan = pitch_scan(SMALL, np.array([0.55, 0.8]), progress=shares.append)
    assert shares == [0.5, 1.0]
    assert scan.pitch.max() < 0.8


def test_a_pitch_without_contact_between_two_others_separates_two_pieces() -> None:
    dragon = Dragon.of([0.33, 0.43, 1.15, 1.02], [0.05, 0.07, 0.04, 0.06], [0.02, 0.04, 0.13, 0.16])
    pitches = [0.26, 0.28, 0.3, 0.32, 0.34]
    scan = pitch_scan(dragon, pitches, start_turns=7.0, margin=0.1, locate=False)
    assert scan.pitch.tolist() == [0.26, 0.28, 0.32, 0.34]
    assert scan.pieces == ((0, 2), (2, 4))
    assert scan.jumps == ()


def test_each_pitch_may_take_the_whole_work_of_a_search() -> None:
    stops = Stops(SMALL, 0.0)
    stops.radius(Spiral(0.55))
    assert stops.search is not None
    stops.search.work = 1.0  # as if the first pitch had taken all of it
    assert stops.radius(Spiral(0.5)) == Stops(SMALL, 0.0).radius(Spiral(0.5))


def test_a_run_that_is_undecided_just_before_its_fold_stops_there() -> None:
    """In the last nanometre of travel the clearance falls from 0.27395 to 0.27289 mm."""
    dragon, spiral = TO_THE_FOLD["30 micrometres apart"]
    dance, margin = Dance(dragon, spiral), 2.734e-4
    assert first_contact(dance, margin=margin).outcome is Outcome.UNDECIDED
    at_fold = dance.path.head(dance.end.time).radius
    assert Stops(dragon, margin).radius(spiral) == pytest.approx(at_fold, rel=0.0, abs=RADIUS_WIDTH)


def test_radii_are_those_of_first_contact_also_beside_jumps() -> None:
    """Beside a jump a contact is within rounding of a graze: first_contact() narrows it in decimals."""
    scan = pitch_scan(Dragon(), np.linspace(0.40, 0.60, 41))
    beside = {k for start, _ in scan.pieces[1:] for k in (start - 1, start)}
    chosen = sorted(beside | set(range(0, len(scan.pitch), 8)))
    assert len(chosen) >= 100
    stops = Stops(Dragon(), 0.0)
    for pitch in some(scan.pitch[chosen].tolist(), 20):
        head = first_contact(Dance(Dragon(), Spiral(pitch))).head
        assert head is not None
        assert stops.radius(Spiral(pitch)) == pytest.approx(head.radius, rel=0.0, abs=RADIUS_WIDTH), pitch


@pytest.mark.parametrize(
    ("dragon", "pitch", "margin"),
    [
        pytest.param(Dragon(), 0.8, 0.0, id="clear to the fold"),
        pytest.param(Dragon(benches=2), 0.5, 0.0, id="two benches"),
        pytest.param(Dragon(), 0.55, 0.05, id="a margin"),
        pytest.param(Dragon(), 0.3, 0.0, id="touching at the start"),
        pytest.param(Dragon(benches=40, head_length=0.9, overhang=0.1), 0.5, 0.0, id="a short head"),
    ],
)
def test_a_run_to_a_fold_and_a_contact_are_distinguished_as_by_first_contact(
    dragon: Dragon, pitch: float, margin: float
) -> None:
    head = first_contact(Dance(dragon, Spiral(pitch)), margin=margin).head
    radius = Stops(dragon, margin).radius(Spiral(pitch))
    assert (radius is None) == (head is None)
    assert head is None or radius == pytest.approx(head.radius, rel=0.0, abs=RADIUS_WIDTH)


def test_work_that_ends_before_the_scan_does_is_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(core.design.pitch_scan, "SCAN_WORK", 1e4)
    with pytest.raises(
        TooMuchWork, match=r"pitches must be fewer, .* from a pitch of 0\..* m on were not found within 10000 steps"
    ):
        pitch_scan(Dragon(), np.linspace(0.44, 0.46, 5))
    with pytest.raises(
        TooMuchWork, match=r"^samples must be fewer, or benches, got 7: the first contacts from a pitch of"
    ):
        scan_near_minimum(Dragon(), turning_radius=4.5, start_turns=16.0, margin=0.0, samples=7)


@pytest.mark.parametrize(
    ("pitches", "text"),
    [
        ([0.5, 0.4], "pitches[1] must be at least 0.5 m, the one before it, got 0.4 m"),
        ([0.5, math.nan], "pitches[1] must be a finite number, got nan m"),
        ([-0.5, 0.5], "pitches[0] must be positive, got -0.5 m"),
        ([[0.5]], "pitches must be a list of numbers in metres, ascending, got [[0.5]]"),
    ],
)
def test_pitches_that_do_not_ascend_are_refused(pitches: list[float], text: str) -> None:
    with pytest.raises(InvalidValue) as refused:
        pitch_scan(Dragon(3), pitches)
    assert refused.value.message == text


def test_a_pitch_given_twice_counts_once() -> None:
    scan = pitch_scan(Dragon(30), [0.4, 0.4], start_turns=8.0)
    assert scan.pitch.tolist() == [0.4]
