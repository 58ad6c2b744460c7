"""Claims as values: what a dance is summarised by, and what searches claim."""

import pickle

import pytest

from core import (
    Dance,
    Dragon,
    EndReason,
    Passage,
    Spiral,
    Turn,
    clearance_profile,
    first_contact,
    tolerance,
)
from core.claims.claim import PASSAGES_LISTED, ClaimKind, DanceSummary, DragonSummary, format_safe
from tests.support.shared_dances import STREET


@pytest.mark.parametrize("stray", [0.04654398712345678, 1.0 / 3.0, 0.1 + 0.2, 2.0**-20, 0.825])
def test_a_printed_stray_is_not_above_the_one_that_is_proven(stray):
    assert 0.0 <= stray - float(format_safe(stray)) <= 1.001e-12


def test_a_dragon_is_summarised_by_its_sizes_or_by_its_extents():
    assert DragonSummary.of(Dragon(3)) == DragonSummary(3, (2.2, 3.41), (0.3, 0.3), 3.41, 2.2, 0.3, 0.275)
    assert DragonSummary.of(Dragon(1)) == DragonSummary(1, (3.41, 3.41), (0.3, 0.3), 3.41, None, 0.3, 0.275)
    wide_head = Dragon.of([3.0, 2.0, 2.0], [0.4, 0.3, 0.3], [0.2] * 3)
    assert DragonSummary.of(wide_head) == DragonSummary(3, (2.0, 3.0), (0.3, 0.4))


@pytest.mark.parametrize("more, listed", [(0, PASSAGES_LISTED), (1, 0)])
def test_a_few_passages_are_listed_and_more_are_counted(more, listed):
    passages = [Passage(1.5, until_time=k + 1.0) for k in range(PASSAGES_LISTED + more)]
    summary = DanceSummary.of(Dance(Dragon(5), Spiral(), 1.0, passages))
    assert len(summary.passages) == listed
    assert summary.passage_count == PASSAGES_LISTED + more


# Dances, what is asked, and the kind and the end of the claim.
SEARCHES = {
    "contact": (Dance(Dragon(30), Spiral(0.6, 8.0)), {"margin": 0.05, "start": 10.0}, ClaimKind.CONTACT, None),
    "clear to a stop": (Dance(Dragon(3), Turn(1.7)), {"stray": 0.01, "stop": 20.0}, ClaimKind.CLEAR, EndReason.STOP),
    "clear to a fold": (Dance(Dragon(12), Spiral(0.9, 4.0)), {"start": 3.0}, ClaimKind.CLEAR, EndReason.FOLD),
    "at the start": (Dance(Dragon(), Spiral(0.35)), {}, ClaimKind.CONTACT_AT_START, None),
}


@pytest.mark.parametrize("dance, query, kind, end", SEARCHES.values(), ids=SEARCHES)
def test_a_search_claims_what_it_answers(dance, query, kind, end):
    contact = first_contact(dance, **query)
    claim = contact.certificate.claim
    assert (claim.kind, claim.end, claim.dance) == (kind, end, DanceSummary.of(dance))
    assert [query.get(name, 0.0) for name in ("margin", "stray", "start")] == [claim.margin, claim.stray, claim.start]
    clear = contact.end.time if contact.end else None
    assert (claim.clear_until, claim.time) == (contact.time_bracket or (clear, contact.time))
    assert claim.benches == contact.benches
    assert contact.certificate.clear_until == claim.clear_until


def test_a_start_within_rounding_of_the_margin_claims_no_clear_time():
    dance = Dance(Dragon(), Spiral())
    margin = float(clearance_profile(dance, 10.0).clearance)
    claim = first_contact(dance, margin=margin, start=10.0).certificate.claim
    assert (claim.kind, claim.start, claim.margin, claim.clear_until) == (ClaimKind.UNDECIDED, 10.0, margin, None)


def test_a_claim_is_plain_values_that_another_process_can_have():
    claim = tolerance(STREET, start=20.0).certificate.claim
    assert (claim.kind, claim.touches, claim.start, claim.venue) == (ClaimKind.SAFE_STRAY, False, 20.0, False)
    again = pickle.loads(pickle.dumps(claim))
    assert again == claim
    assert hash(again) == hash(claim)
    dragon = claim.dance.dragon
    assert {type(size) for size in (*dragon.lengths, *dragon.widths, dragon.head_length, dragon.overhang)} == {float}
