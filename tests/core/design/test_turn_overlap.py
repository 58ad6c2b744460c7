"""Overlaps in boxes of turns: wherever one is exhibited, every turn of the box has a contact."""

import numpy as np
import pytest

from core import Dance, Dragon, first_contact
from core.design.turn_overlap import OverlapSearch
from tests.support.boxes_of_turns import CROSSING, SMALL, box_at, turns_drawn
from tests.support.depth import examples

DRAGON = Dragon(60)
MOST = 26  # benches of a pose


@pytest.mark.parametrize("place", CROSSING)
def test_every_turn_of_a_box_with_an_exhibited_overlap_has_a_contact(place):
    box, centre = box_at(*place, SMALL)
    result = OverlapSearch(DRAGON, 0.0, MOST).exhibited(box)
    assert result.shared
    assert result.depth > 0.3
    turns = turns_drawn(centre, SMALL, examples(8, 100), 0.0)
    assert turns
    for turn in turns:
        assert first_contact(Dance(DRAGON, turn), start=0.0, stop=60.0).time is not None


@pytest.mark.parametrize("place", [*CROSSING, (4.2, 4.3, 1.4)])
@pytest.mark.parametrize("size", [0.2, 1.0, 2.0])
def test_handles_stand_between_their_least_and_greatest_places(place, size):
    box, centre = box_at(*place, size * SMALL)
    overlap = OverlapSearch(DRAGON, 0.0, MOST)
    last = 14
    moved = 0.0
    low, at, high = overlap.chain_within(box, box.nominal.length + 2.0, last)
    for turn in turns_drawn(centre, size * SMALL, examples(20, 200), 0.5):
        middle = turn.radii[0] * turn.angles[0]
        others = overlap.places(turn, float(at[0] + middle), overlap.chords, last) - middle
        assert ((low - 1e-9 <= others) & (others <= high + 1e-9)).all()
        moved = max(moved, float((np.abs(others - at)[1:] / (high - low)[1:]).max()))
    assert moved > 0.02  # the places are not far too wide


@pytest.mark.parametrize("place", [(4.2904, 4.4999, 2.0), (4.49, 3.94, 1.0)])
def test_nothing_is_exhibited_where_a_turn_can_be_danced(place):
    for size in (0.01, 1.0, 10.0):
        box, _ = box_at(*place, size * SMALL)
        if box is not None:
            result = OverlapSearch(DRAGON, 0.0, MOST).exhibited(box)
            assert not result.shared
            assert result.depth < 0.0


def test_a_dragon_of_two_benches_has_no_pair():
    box, _ = box_at(2.3, 4.45, 1.2, SMALL)
    assert not OverlapSearch(Dragon(2), 0.0, MOST).exhibited(box).shared
