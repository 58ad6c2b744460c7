"""The words of reasons and proposals."""

import pytest

from core import Dragon, Failure, FailureKind, Figure, Reason, ReasonKind, Venue, propose
from tests.support.random_squares import box

TOUCH = Failure(FailureKind.CONTACT, 3.0, (1, 9), None, "Benches 1 and 9 touch at 3.000000 s.")
REASONS = {
    "The benches cover at least 660.4 m2 at any moment; the square has 480.0 m2.": Reason(
        ReasonKind.AREA, 0, 480.0, 660.4
    ),
    "No dance was found: the widest free circle is at most 4.10 m across, "
    "and the tightest turn of bench 7 that is tried takes 5.20 m.": Reason(ReasonKind.WIDTH, 9, 4.1, 5.2, who=(7,)),
    "The free ground between gate 0 and gate 2 is at most 0.20 m wide at its narrowest; "
    "the benches need at least 0.40 m.": Reason(ReasonKind.WAY, 9, 0.2, 0.4, who=(0, 2)),
    "The free ground between gate 0 and gate 1 is at most 0.438 m wide at its narrowest; "
    "the benches need at least 0.440 m.": Reason(ReasonKind.WAY, 9, 0.4381, 0.44, who=(0, 1)),
    "People shall be free to stray 0.05 m; the best of 412 tried, a figure eight, allows 0.032 m.": Reason(
        ReasonKind.STRAY, 412, 0.0321, 0.05, Figure.EIGHT
    ),
    "None of 30 tried passes its check; the nearest, a ring: Benches 1 and 9 touch at 3.000000 s.": Reason(
        ReasonKind.FAILS, 30, 9.0, 9.0, Figure.RING, failure=TOUCH
    ),
    "No dance was found, not even with one bench; the nearest, a ring: Benches 1 and 9 touch at 3.000000 s.": Reason(
        ReasonKind.FAILS, 30, 1.0, 9.0, Figure.RING, failure=TOUCH
    ),
    "None of 0 tried passes its check.": Reason(ReasonKind.FAILS, 0, 1.0, 1.0),
}


@pytest.mark.parametrize("words", REASONS)
def test_a_reason_is_one_sentence_with_its_numbers(words):
    assert REASONS[words].message == words


def test_a_proposal_says_what_it_is():
    (one,) = propose(Venue(box("Yard", 0, 0, 24, 20)), Dragon(1), figures=["ring"], count=1).proposals
    assert one.message.startswith("A ring of 1 bench, ")
    assert one.clearance is None
    assert one.sharpest_bend is None
