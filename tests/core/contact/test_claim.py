"""What a search for first contact claims; the sentences of a claim are tried with those of every other kind."""

from core import Dance, Dragon, EndReason, Spiral, Turn, clearance_profile, first_contact, minimum_pitch
from core.claims.claim import ClaimKind, DanceSummary

UNDECIDED = ClaimKind.UNDECIDED
DANCE = Dance(Dragon(), Spiral())


def test_a_claim_names_the_whole_dance_and_how_it_ends():
    dance = Dance(Dragon.of([3.0, 2.0, 2.5], [0.3] * 3, [0.2] * 3), Turn(1.7))
    claim = first_contact(dance, stop=20.0).certificate.claim
    assert claim.dance == DanceSummary.of(dance)
    path = claim.dance.path
    assert (path.begin, path.end) == (dance.path.begin, dance.path.end)
    assert path.pieces == ("coil", "arc", "arc", "coil")
    folding = Dance(Dragon(12), Spiral(0.9, 4.0))
    claim = first_contact(folding, start=3.0).certificate.claim
    assert (claim.kind, claim.end) == (ClaimKind.CLEAR, EndReason.FOLD)
    assert (claim.start, claim.clear_until) == (3.0, folding.end.time)


def test_an_undecided_search_claims_the_clear_time_and_the_pair_that_surely_overlaps():
    contact = first_contact(Dance(Dragon(60), Spiral(minimum_pitch(Dragon(60)).pitch_bracket[0])))
    claim = contact.certificate.claim
    assert (claim.kind, claim.benches) == (UNDECIDED, contact.overlapping)
    assert (claim.clear_until, claim.time) == contact.time_bracket


def test_no_clear_time_is_claimed_where_benches_touch_at_the_start_or_nothing_is_decided():
    at_start = first_contact(DANCE, margin=0.2).certificate
    assert (at_start.claim.kind, at_start.clear_until) == (ClaimKind.CONTACT_AT_START, None)
    seen = float(clearance_profile(DANCE, 10.0).clearance)
    undecided = first_contact(DANCE, margin=seen, start=10.0).certificate
    assert (undecided.claim.kind, undecided.clear_until) == (UNDECIDED, None)
    assert (undecided.claim.start, undecided.claim.margin) == (10.0, seen)
