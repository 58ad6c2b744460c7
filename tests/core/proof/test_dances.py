"""Proofs with a margin, of clear runs, and on routes: true claims are proven and checked, false ones refused."""

from functools import cache

import pytest

from core import Dance, Dragon, Spiral, Turn, first_contact
from core.contact.clearance import least_clearance
from core.errors import OutsideRun, ProofRefused
from core.proof import prove_clear, prove_collision_time, prove_contact, verify
from tests.campaigns import hunt_corners
from tests.campaigns.differential import made
from tests.support.depth import thorough
from tests.support.forgeries import OVER_BENDS, assert_refused, stretches, through_json
from tests.support.proof_routes import HAIRPIN, LOOP, OUTWARDS, TURNED
from tests.support.reference_contacts import CONTACTS, proven_then_only
from tests.support.refused import refused
from tests.support.shared_dances import FIVE_LENGTHS

# A difference of a margin from the least clearance that is refused [m].
MARGIN_OFF = 1e-6
# Half of what a run may last beyond the stop of a claim that includes its end [s].
HALF_BRACKET = 5e-10
SMALL = Dragon(14)
# Each with the span of a proof [s].
ROUTES = {
    "loop": (LOOP, 85.0, 95.0),
    "hairpin": (HAIRPIN, 42.0, 48.0),
    "outwards": (OUTWARDS, 30.0, 40.0),
    "inwards": (TURNED, 35.0, 40.0),
    "turn": (Turn(1.7), 8.0, 16.0),
}


def reference_dance(name):
    case = CONTACTS[name]
    return Dance(Dragon(**case["dragon"]), Spiral(case["pitch"], case["start_turns"]))


@cache
def certificate_of(kind):
    """Of a clear dance through the turn, with a margin, or of a head that meets its own tail on a route; proven."""
    if kind == "turn":
        certificate = prove_clear(Dance(SMALL, Turn(1.7)), 18.0, start=-8.0, margin=0.5)
    else:
        dance = Dance(Dragon(30), LOOP)
        certificate = prove_contact(dance, first_contact(dance, start=60.0).time or 0.0, start=60.0)
    words = "nearer to one another than 0.5 m" if kind == "turn" else "benches 0 and 19 overlap"
    assert words in verify(certificate).statement
    return through_json(certificate)


@pytest.mark.parametrize(
    "dance, margin",
    [
        (Dance(Dragon(5), Spiral()), 0.03),
        *thorough(
            (Dance(Dragon(5), Spiral()), 0.1),
            (Dance(Dragon(20), Spiral(0.55, 9.0)), 0.05),
            (Dance(Dragon(12, 1.8, 2.2, 0.25, 0.15), Spiral(0.5, 6.0)), 0.03),
            (Dance(FIVE_LENGTHS, Spiral(0.6, 6.0)), 0.1),
        ),
    ],
)
def test_a_contact_within_a_margin_is_proven_and_its_neighbourhood_refused(dance, margin):
    time = first_contact(dance, margin=margin).time
    certificate, statement = proven_then_only(prove_collision_time, dance, time, margin=margin)
    assert certificate["claim"]["margin"] == margin
    a, b = certificate["overlap"]["benches"]
    assert f"benches {a} and {b} are nearer than {margin!r} m" in statement
    assert_refused(certificate, "claim.margin += -1e-6", "not shown to be nearer")
    assert_refused(certificate, "claim.margin += 1e-6", "not apart by face")


def test_two_corners_within_a_margin_need_a_direction_and_are_proven():
    dance = Dance(Dragon(18), LOOP)
    request = {"start": 60.0, "margin": 1.05}
    contact = first_contact(dance, **request)
    assert contact.edge is None
    certificate, _ = proven_then_only(prove_contact, dance, contact.time, **request)
    assert stretches(certificate)[-1][2][0] == "8"


@pytest.mark.parametrize(
    "name, until, words",
    [
        *thorough(("pitch_0.80", "fold", "it folds"), ("combo_d", "centre", "the head reaches the centre before")),
        ("n_4", "fold", "it folds"),
    ],
)
def test_a_reference_run_is_clear_to_its_end_and_that_is_proven(name, until, words):
    certificate = through_json(prove_clear(reference_dance(name)))
    end = CONTACTS[name]["end"]["time"]
    stop = certificate["claim"]["stop"]
    assert certificate["claim"]["until"] == until
    assert "overlap" not in certificate
    assert stop < end < stop + 2 * HALF_BRACKET
    assert words in verify(certificate).statement
    for edit, reason in (
        (f"claim.stop = {stop - 2 * HALF_BRACKET!r}", "every bench is shown to follow"),
        (f"claim.stop = {end + HALF_BRACKET!r}", "claim.stop must be at most"),
        ('claim.until = "centre"', "not shown to reach the centre"),
        ('claim.until = "end"', "until must be stop or fold or centre on a spiral, got end"),
    ):
        if until == "fold":
            assert_refused(certificate, edit, reason)


def test_a_route_is_clear_to_its_end():
    certificate = through_json(prove_clear(Dance(SMALL, HAIRPIN), start=30.0))
    assert certificate["claim"]["stop"] == HAIRPIN.end
    assert "the route ends before" in verify(certificate).statement
    assert_refused(certificate, "claim.stop += -2e-9", "not shown to end")


def test_a_contact_soon_after_the_start_is_proven_though_no_bench_has_come_to_some_places_ahead():
    dance, *_ = hunt_corners.random_case(21, 62)
    time = first_contact(dance, start=0.0).time
    assert time is not None
    statement = verify(prove_contact(dance, time, start=0.0)).statement
    assert "benches 9 and 11 overlap at 0.345" in statement


@pytest.mark.parametrize("name, change, reason", OVER_BENDS)
def test_a_forged_certificate_over_a_bend_is_refused(name, change, reason):
    assert_refused(made(name), change, reason)


@pytest.mark.parametrize("field, query", [("start", {"start": 5.0}), ("stop", {"stop": 1e4})])
def test_what_is_no_run_is_refused_by_name(field, query):
    with refused(field, OutsideRun):
        prove_clear(Dance(SMALL, HAIRPIN), **({"stop": 50.0, "start": 40.0} | query))


@pytest.mark.parametrize("name", ["hairpin", "outwards", *thorough("loop", "inwards", "turn")])
@pytest.mark.parametrize(
    "dragon", [SMALL, pytest.param(Dragon(10, 2.0, 1.4, 0.3, 0.2), marks=pytest.mark.deep)], ids=["contest", "short"]
)
def test_a_route_is_proven_with_a_margin_up_to_its_least_clearance_and_not_beyond(name, dragon):
    path, start, stop = ROUTES[name]
    dance = Dance(dragon, path)
    result = least_clearance(dance, start=start, stop=stop)
    assert result is not None
    certificate = through_json(prove_clear(dance, stop, start=start, margin=result.distance - MARGIN_OFF))
    assert f"nearer to one another than {certificate['claim']['margin']!r} m" in verify(certificate).statement
    with pytest.raises(ProofRefused, match="nearer than the margin"):
        prove_clear(dance, stop, start=start, margin=result.distance + MARGIN_OFF)


def with_direction(change):
    """A change of the directions of the first stretch that has any."""
    return lambda content: change(next(tile for tile in stretches(content) if "8" in tile[2])[3])


FORGERIES = {
    "turn": [
        ("delete sweeps.0.stretches.-1", "short of"),
        ('sweeps.0.stretches.-1.2 = "999999999999"', "not apart by face 9"),
        ('sweeps.0.stretches.5.2 = "000000000000"', "not apart by face 0"),
        (with_direction(lambda directions: directions.__setitem__(0, directions[0] + 1.0)), "not apart by face 8"),
        (with_direction(list.clear), "must be a list of 1, got a list of 0"),
        ("claim.stop += 0.001", "short of"),
        ("claim.margin = 0.7", "not apart by face"),
        ("delete claim.margin", r"must be \[highest place, lowest place, faces\], got a list of 4"),
        ("claim.path.pitch = 1.3", "not proven"),
        ("claim.path.entry_radius = 3.5", "must bend so that every bench can follow"),
        ('claim.path = {"kind": "spiral", "pitch": 1.7, "start_turns": 16.0}', "digits from 0 to 8"),
        ('claim.until = "end"', "not shown to end"),
        ("dragon.1.2 = 0.6", "not apart by face"),
        ('overlap = {"benches": [0, 8]}', "overlap is unknown"),
    ],
    "route": [
        ("reverse claim.path.pieces", "must close"),
        (
            'claim.path.pieces = [{"kind": "line", "start": [-90.0, 0.0], "end": [60.0, 0.0]}]',
            "not apart by face|not shown to overlap",
        ),
        ("claim.path.pieces.1.radius = 6.0", "must close"),
        ("claim.path.start = 0.5", "not apart by face"),
        ("claim.time += 1e-9", "short of"),
        ("claim.time += -1e-9", "not shown to overlap"),
        ("claim.margin = 0.05", "not apart by face"),
        ("claim.head_speed = 1.0001", "short of|not shown"),
        ('claim.kind = "clear"', "overlap is unknown"),
        ('claim.path.pieces.0.kind = "waypoints"', "must be line, arc or coil"),
    ],
}


@pytest.mark.parametrize("kind, change, reason", [(kind, *row) for kind, rows in FORGERIES.items() for row in rows])
def test_a_forged_certificate_of_a_dance_is_refused(kind, change, reason):
    assert_refused(certificate_of(kind), change, reason)
