"""Claims as values: what a dance is summarised by, and what searches claim."""

import pickle

import pytest

from core import Dance, Dragon, EndReason, Line, Outcome, Passage, Route, Spiral, Turn, first_contact, tolerance
from core.claims.claim import PASSAGES_LISTED, ClaimKind, DanceSummary, DragonSummary, format_safe

SHORT = Route([Line((0.0, 0.0), (60.0, 0.0))])


@pytest.mark.parametrize("stray", [0.04654398712345678, 1.0 / 3.0, 0.1 + 0.2, 2.0**-20, 0.825])
def test_a_printed_stray_is_not_above_the_one_that_is_proven(stray):
    assert 0.0 <= stray - float(format_safe(stray)) <= 1.001e-12


def test_a_dragon_is_summarised_by_its_sizes_or_by_its_extents():
    assert DragonSummary.of(Dragon(3)) == DragonSummary(3, (2.2, 3.41), (0.3, 0.3), 3.41, 2.2, 0.3, 0.275)
    assert DragonSummary.of(Dragon(1)) == DragonSummary(1, (3.41, 3.41), (0.3, 0.3), 3.41, None, 0.3, 0.275)
    odd = Dragon.of([3.0, 2.0, 2.5], [0.3, 0.2, 0.3], [0.2] * 3)
    assert DragonSummary.of(odd) == DragonSummary(3, (2.0, 3.0), (0.2, 0.3))
    wide_head = Dragon.of([3.0, 2.0, 2.0], [0.4, 0.3, 0.3], [0.2] * 3)
    assert DragonSummary.of(wide_head).widths == (0.3, 0.4)
    assert DragonSummary.of(wide_head).head_length is None


def test_a_few_passages_are_listed_and_more_are_counted():
    def summary(count):
        return DanceSummary.of(
            Dance(Dragon(5), Spiral(), 1.0, [Passage(1.5, until_time=k + 1.0) for k in range(count)])
        )

    most = summary(PASSAGES_LISTED)
    assert (len(most.passages), most.passage_count) == (PASSAGES_LISTED, PASSAGES_LISTED)
    more = summary(PASSAGES_LISTED + 1)
    assert (more.passages, more.passage_count) == ((), PASSAGES_LISTED + 1)


def test_a_search_claims_what_it_answers():
    contact = first_contact(Dance(Dragon(30), Spiral(0.6, 8.0)), margin=0.05, start=10.0)
    claim = contact.certificate.claim
    assert (claim.kind, claim.margin, claim.stray, claim.start) == (ClaimKind.CONTACT, 0.05, 0.0, 10.0)
    assert (claim.clear_until, claim.time) == contact.time_bracket
    assert (claim.benches, claim.end) == (contact.benches, None)
    clear = first_contact(Dance(Dragon(3), Turn(1.7)), stray=0.01, stop=20.0).certificate
    assert (clear.claim.kind, clear.claim.end) == (ClaimKind.CLEAR, EndReason.STOP)
    assert clear.claim.clear_until == clear.clear_until == 20.0
    at_start = first_contact(Dance(Dragon(), Spiral(0.35)))
    claim = at_start.certificate.claim
    assert at_start.outcome is Outcome.CONTACT_AT_START
    assert (claim.kind, claim.clear_until, claim.time) == (ClaimKind.CONTACT_AT_START, None, 0.0)


def test_a_tolerance_claims_its_stray_and_its_time():
    result = tolerance(Dance(Dragon(5), SHORT), start=20.0)
    claim = result.certificate.claim
    assert (claim.kind, claim.stray, claim.touches) == (ClaimKind.SAFE_STRAY, result.stray, False)
    assert (claim.start, claim.stop, claim.venue) == (20.0, result.stop, False)


def test_a_claim_is_plain_values_that_another_process_can_have():
    claims = [first_contact(Dance(dragon, SHORT), start=20.0).certificate.claim for dragon in (Dragon(5), Dragon(5))]
    assert claims[0] == claims[1]
    assert hash(claims[0]) == hash(claims[1])
    assert pickle.loads(pickle.dumps(claims[0])) == claims[0]
    dragon = claims[0].dance.dragon
    assert {type(one) for one in (*dragon.lengths, *dragon.widths, dragon.head_length, dragon.overhang)} == {float}
