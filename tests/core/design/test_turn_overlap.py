"""Overlaps in boxes of turns: wherever one is exhibited, every turn of the box has a contact."""

from __future__ import annotations

import numpy as np
import pytest

from core import Dance, Dragon, first_contact
from core.design.turn_overlap import OverlapSearch
from tests.support.boxes_of_turns import CROSSING, SMALL, box_at, turn_at
from tests.support.depth import examples

DRAGON = Dragon(60)
MOST = 26  # benches of a pose


@pytest.mark.parametrize(("entry", "leaving", "ratio"), CROSSING)
def test_every_turn_of_a_box_with_an_exhibited_overlap_has_a_contact(
    entry: float, leaving: float, ratio: float
) -> None:
    box, centre = box_at(entry, leaving, ratio, SMALL)
    if box is None:
        pytest.fail("benches can follow no corner of the box")
    result = OverlapSearch(DRAGON, 0.0, MOST).exhibited(box)
    assert result.shared
    assert result.depth > 0.3
    rng, danced = np.random.default_rng(5), 0
    for _ in range(examples(8, 100)):
        turn = turn_at(centre + SMALL * rng.uniform(-1.0, 1.0, 3))
        if turn is not None:
            danced += 1
            assert first_contact(Dance(DRAGON, turn), start=0.0, stop=60.0).time is not None
    assert danced


@pytest.mark.parametrize(("entry", "leaving", "ratio"), [*CROSSING, (4.2, 4.3, 1.4)])
@pytest.mark.parametrize("size", [0.2, 1.0, 2.0])
def test_handles_stand_between_their_least_and_greatest_places(
    entry: float, leaving: float, ratio: float, size: float
) -> None:
    half = size * SMALL
    box, centre = box_at(entry, leaving, ratio, half)
    if box is None:
        pytest.fail("benches can follow no corner of the box")
    overlap, last = OverlapSearch(DRAGON, 0.0, MOST), 14
    place = box.nominal.length + 2.0
    within = overlap.chain_within(box, place, last)
    if within is None:
        pytest.fail("no places are known")
    low, at, high = within
    rng, moved = np.random.default_rng(6), 0.0
    for _ in range(examples(20, 200)):
        turn = turn_at(centre + half * rng.choice([-1.0, 1.0], 3) * rng.uniform(0.5, 1.0, 3))
        if turn is not None:
            middle = turn.radii[0] * turn.angles[0]
            others = overlap.places(turn, float(at[0] + middle), overlap.chords, last) - middle
            assert (low - 1e-9 <= others).all()
            assert (others <= high + 1e-9).all()
            moved = max(moved, float((np.abs(others - at)[1:] / (high - low)[1:]).max()))
    assert moved > 0.02  # the places are not far too wide


@pytest.mark.parametrize(("entry", "leaving", "ratio"), [(4.2904, 4.4999, 2.0), (4.49, 3.94, 1.0)])
def test_nothing_is_exhibited_where_a_turn_can_be_danced(entry: float, leaving: float, ratio: float) -> None:
    for size in (0.01, 1.0, 10.0):
        box, _ = box_at(entry, leaving, ratio, size * SMALL)
        if box is not None:
            result = OverlapSearch(DRAGON, 0.0, MOST).exhibited(box)
            assert not result.shared
            assert result.depth < 0.0


def test_a_dragon_of_two_benches_has_no_pair() -> None:
    box, _ = box_at(2.3, 4.45, 1.2, SMALL)
    assert box is not None
    assert not OverlapSearch(Dragon(2), 0.0, MOST).exhibited(box).shared
