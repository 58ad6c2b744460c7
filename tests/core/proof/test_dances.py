"""Proofs with a margin, of clear runs, and on routes: true claims are proven and checked, false ones refused."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from flint import arb

from core import Arc, Dance, Dragon, Line, Route, Spiral, Turn, Waypoints, bench_poses, first_contact, trajectory
from core.contact.clearance import least_clearance
from core.errors import InvalidValue, OutsideRun, ProofRefused
from core.proof import Certificate, prove_clear, prove_collision_time, prove_contact, prove_minimum_pitch, verify
from core.proof.paths import chain_on, recorded_path
from core.shapes.rectangles import corners
from tests.support.depth import examples, some
from tests.support.forgeries import edit, places, refusal, stretches, through_json
from tests.support.forgeries import put_at as at
from tests.support.proof_routes import HAIRPIN, LOOP, OUTWARDS, TURNED
from tests.support.reference_contacts import CONTACTS

ROOT = Path(__file__).parents[3]
# Chains in doubles, as trajectory() has them, are this near to the true ones [m].
DOUBLES = 1e-11
# Differences that are refused: of a time from a contact [s], and of a margin from the least clearance [m].
OFF = 1e-8
MARGIN_OFF = 1e-6
# Half of what a run may last beyond the stop of a claim that includes its end [s].
HALF_BRACKET = 5e-10
# The dance through the turn: its span and instants of it [s].
START, STOP = -8.0, 18.0
INSTANTS = np.linspace(START + 0.1, STOP - 0.1, 40)

SMALL = Dragon(14)
SHORT = Dragon(10, 2.0, 1.4, 0.3, 0.2)
# Each with the span of a proof [s].
ROUTES = {
    "loop": (LOOP, 85.0, 95.0),
    "hairpin": (HAIRPIN, 42.0, 48.0),
    "outwards": (OUTWARDS, 30.0, 40.0),
    "inwards": (TURNED, 35.0, 40.0),
    "turn": (Turn(1.7), 8.0, 16.0),
}


@pytest.fixture(scope="module")
def turning() -> Certificate:
    """A clear dance through the turn, with a margin; proven."""
    certificate = through_json(prove_clear(Dance(SMALL, Turn(1.7)), STOP, start=START, margin=0.5))
    verify(certificate)
    return certificate


@pytest.fixture(scope="module")
def touching() -> Certificate:
    """A contact on a route: the head meets its own tail; proven."""
    dragon = Dragon(30)
    time = first_contact(Dance(dragon, LOOP), start=60.0).time
    assert time is not None
    certificate = through_json(prove_contact(Dance(dragon, LOOP), time, start=60.0))
    assert "benches 0 and 19 overlap" in verify(certificate).statement
    return certificate


@pytest.mark.parametrize(
    ("dragon", "path", "margin"),
    [
        (Dragon(5), Spiral(), 0.03),
        (Dragon(5), Spiral(), 0.1),
        (Dragon(20), Spiral(0.55, 9.0), 0.05),
        (Dragon(12, 1.8, 2.2, 0.25, 0.15), Spiral(0.5, 6.0), 0.03),
        (Dragon.of([3.0, 1.5, 2.5, 1.2, 2.0], [0.3] * 5, [0.2] * 5), Spiral(0.6, 6.0), 0.1),
    ],
    ids=["five", "five, wider", "twenty", "longer body", "bench by bench"],
)
def test_a_contact_within_a_margin_is_proven_and_its_neighbourhood_refused(
    dragon: Dragon, path: Spiral, margin: float
) -> None:
    contact = first_contact(Dance(dragon, path), margin=margin)
    assert contact.time
    certificate = through_json(prove_collision_time(Dance(dragon, path), contact.time, margin=margin))
    assert certificate["claim"]["margin"] == margin
    a, b = certificate["overlap"]["benches"]
    assert f"benches {a} and {b} are nearer than {margin!r} m" in verify(certificate).statement
    for wrong in (contact.time - OFF, contact.time + OFF):
        with pytest.raises(ProofRefused):
            prove_collision_time(Dance(dragon, path), wrong, margin=margin)


def test_two_corners_within_a_margin_need_a_direction_and_are_proven() -> None:
    dragon, margin = Dragon(18), 1.05
    contact = first_contact(Dance(dragon, LOOP), start=60.0, margin=margin)
    assert contact.time is not None
    assert contact.edge is None
    certificate = through_json(prove_contact(Dance(dragon, LOOP), contact.time, start=60.0, margin=margin))
    verify(certificate)
    assert stretches(certificate)[-1][2][0] == "8"
    for wrong in (contact.time - OFF, contact.time + OFF):
        with pytest.raises(ProofRefused):
            prove_contact(Dance(dragon, LOOP), wrong, start=60.0, margin=margin)


def test_a_minimum_pitch_with_a_margin_is_proven_and_one_off_it_refused() -> None:
    from core import minimum_pitch

    dragon, request = Dragon(14), {"turning_radius": 3.2, "start_turns": 7.0, "margin": 0.1}
    pitch = minimum_pitch(dragon, **request).pitch_bracket[1]
    certificate = through_json(prove_minimum_pitch(dragon, pitch, **request))
    assert "says nothing of larger pitches" in verify(certificate).statement
    with pytest.raises(ProofRefused, match="nearer than the margin"):
        prove_minimum_pitch(dragon, pitch - OFF, **request)
    with pytest.raises(ProofRefused, match="keeps the margin"):
        prove_minimum_pitch(dragon, pitch + 1.1e-6, **request)


@pytest.mark.parametrize("name", ["pitch_0.80", "n_4"])
def test_a_reference_run_is_clear_to_its_fold_and_it_folds(name: str) -> None:
    case = CONTACTS[name]
    dragon, path = Dragon(**case["dragon"]), Spiral(case["pitch"], case["start_turns"])
    certificate = through_json(prove_clear(Dance(dragon, path)))
    claim = certificate["claim"]
    assert (claim["until"], "overlap" in certificate) == ("fold", False)
    assert claim["stop"] < case["end"]["time"] < claim["stop"] + 2 * HALF_BRACKET
    assert "it folds" in verify(certificate).statement
    for change, reason in (
        (at("claim", "stop", put=claim["stop"] - 2 * HALF_BRACKET), "every bench is shown to follow"),
        (at("claim", "stop", put=case["end"]["time"] + HALF_BRACKET), "claim.stop must be at most"),
        (at("claim", "until", put="centre"), "not shown to reach the centre"),
        (at("claim", "until", put="end"), "until must be stop or fold or centre on a spiral, got end"),
    ):
        with pytest.raises(ProofRefused, match=reason):
            verify(edit(change)(certificate))


def test_the_reference_run_to_the_centre_is_clear() -> None:
    case = CONTACTS["combo_d"]
    certificate = prove_clear(Dance(Dragon(**case["dragon"]), Spiral(case["pitch"], case["start_turns"])))
    assert certificate["claim"]["until"] == "centre"
    assert "the head reaches the centre before" in verify(through_json(certificate)).statement


@pytest.mark.parametrize("seed", some(range(4), 2))
def test_a_run_to_the_centre_or_a_fold_beside_it_is_clear(seed: int) -> None:
    random = np.random.default_rng(seed)
    for _ in range(5):
        benches = int(random.integers(3, 8))
        sizes = random.uniform(0.5, 2.0, benches), random.uniform(0.05, 0.2, benches), random.uniform(0.0, 0.1, benches)
        dragon, path = Dragon.of(*sizes), Spiral(random.uniform(1.2, 3.5), random.uniform(4.0, 7.0))
        contact = first_contact(Dance(dragon, path))
        if contact.end is not None:
            certificate = through_json(prove_clear(Dance(dragon, path)))
            assert certificate["claim"]["until"] == contact.end.reason
            verify(certificate)


def test_a_run_that_is_not_clear_or_not_there_is_refused() -> None:
    case = CONTACTS["n_5"]
    dragon, path = Dragon(**case["dragon"]), Spiral(case["pitch"], case["start_turns"])
    with pytest.raises(ProofRefused, match="benches 0 and 4 overlap"):
        prove_clear(Dance(dragon, path), case["time"] + OFF)
    verify(prove_clear(Dance(dragon, path), case["time"] - OFF))
    with pytest.raises(OutsideRun, match="stop must be at most"):
        prove_clear(Dance(dragon, path), 1e4)
    with pytest.raises(OutsideRun, match="start must be at least"):
        prove_clear(Dance(SMALL, HAIRPIN), 50.0, start=5.0)
    with pytest.raises(InvalidValue, match="margin must be zero or more"):
        prove_clear(Dance(dragon, path), 1.0, margin=-0.1)
    with pytest.raises(InvalidValue, match="path must not bend tighter"):
        prove_clear(
            Dance(
                SMALL,
                Route(
                    [
                        Arc((0.0, 0.0), 1.2, 0.0, 6.0),
                    ]
                ),
            ),
            5.0,
            start=2.0,
        )


def test_waypoints_have_no_proof() -> None:
    curve = Waypoints(((0.0, 0.0), (20.0, 1.0), (40.0, 0.0)))
    with pytest.raises(
        InvalidValue, match="path must be a spiral, a turn or a route of lines, arcs and coils for a proof in"
    ):
        prove_clear(Dance(Dragon(3), Route([curve])), 30.0, start=20.0)
    with pytest.raises(
        InvalidValue,
        match=r"path.pieces\[1\] must be a line, an arc or a coil for a proof .*, got waypoints: on such a path "
        ".* with bounds on its rounding",
    ):
        recorded_path(Route([Line((-9.0, -0.45), (0.0, 0.0)), Waypoints(curve.points, math.atan2(0.45, 9.0))]))


@pytest.mark.parametrize("name", ROUTES)
@pytest.mark.parametrize("dragon", [SMALL, pytest.param(SHORT, marks=pytest.mark.deep)], ids=["contest", "short"])
def test_a_route_is_proven_with_a_margin_up_to_its_least_clearance_and_not_beyond(name: str, dragon: Dragon) -> None:
    path, start, stop = ROUTES[name]
    result = least_clearance(Dance(dragon, path), start=start, stop=stop)
    assert result is not None
    certificate = through_json(prove_clear(Dance(dragon, path), stop, start=start, margin=result.distance - MARGIN_OFF))
    assert f"nearer to one another than {certificate['claim']['margin']!r} m" in verify(certificate).statement
    with pytest.raises(ProofRefused, match="nearer than the margin"):
        prove_clear(Dance(dragon, path), stop, start=start, margin=result.distance + MARGIN_OFF)


def test_the_turn_of_the_contest_is_clear_and_within_its_margin_at_the_reference_time() -> None:
    """`make deep` takes all benches."""
    dance = Dance(Dragon(benches=examples(20, 223)), Turn(1.7))
    certificate = through_json(prove_clear(dance, 100.0, start=-100.0))
    assert "no two benches except neighbours touch from -100 s to 100 s" in verify(certificate).statement
    time = first_contact(dance, start=-100.0, margin=0.33).time
    assert time == pytest.approx(13.741349327226573, abs=1e-9)  # docs/proofs.md
    verify(through_json(prove_contact(dance, time, start=-100.0, margin=0.33)))
    for wrong in (time - OFF, time + OFF):
        with pytest.raises(ProofRefused):
            prove_contact(dance, wrong, start=-100.0, margin=0.33)


def test_a_route_is_clear_to_its_end() -> None:
    certificate = through_json(prove_clear(Dance(SMALL, HAIRPIN), start=30.0))
    assert certificate["claim"]["stop"] == HAIRPIN.end
    assert "the route ends before" in verify(certificate).statement
    with pytest.raises(ProofRefused, match="not shown to end"):
        verify(edit(at("claim", "stop", put=HAIRPIN.end - 2e-9))(certificate))


def test_every_pair_in_its_own_right_proves_the_same_on_the_turn() -> None:
    once, each = (
        prove_clear(Dance(SMALL, Turn(1.7)), 15.0, start=0.0, every_pair=every_pair) for every_pair in (False, True)
    )
    assert (len(once["sweeps"]), len(each["sweeps"])) == (2, 12)
    assert verify(once).statement == verify(each).statement


def test_at_every_instant_each_letter_of_the_turn_s_certificate_keeps_its_pair_apart(turning: Certificate) -> None:
    chain, margin, times = chain_on(SMALL, recorded_path(Turn(1.7)), 0.0), turning["claim"]["margin"], INSTANTS
    sizes = np.stack([SMALL.lengths, SMALL.widths], axis=-1)
    used = set()
    for time, poses in zip(times, bench_poses(trajectory(Dance(SMALL, Turn(1.7)), times).position), strict=True):
        shapes, chained = corners(poses, sizes), chain.pose_at(0, arb(-time))
        chained.grow_to(SMALL.benches)
        for a in range(SMALL.benches - 2):
            place = float(chained.places[a])
            tiles = stretches(turning, min(a, 1))
            _, _, faces, *rest = next(tile for tile in tiles if tile[1] - DOUBLES <= place <= tile[0] + DOUBLES)
            directions = iter(rest[0] if rest else [])
            used.update(faces)
            for b in range(a + 2, SMALL.benches):
                face = faces[b - a - 2] if b - a - 2 < len(faces) else "far"
                direction = next(directions) if face == "8" else 0.0
                assert gap_by(face, direction, poses, sizes, shapes, a, b) > margin
    assert {"8", "9"} < used


def gap_by(face: str, direction: float, poses: Any, sizes: Any, shapes: Any, a: int, b: int) -> float:
    """The distance that a letter of a certificate leaves between two benches [m]."""
    if face == "far":
        inner = shapely.Polygon(shapes[b]).distance(shapely.Point(0.0, 0.0))
        return float(inner - np.hypot(*shapes[a].T).max())
    if face == "9":
        return math.dist(poses[a, :2], poses[b, :2]) - (math.hypot(*sizes[a]) + math.hypot(*sizes[b])) / 2
    owner, other = (b, a) if face in "4567" else (a, b)
    angle = poses[owner, 2] + (direction if face == "8" else int(face) % 4 * math.pi / 2)
    normal = np.array([math.cos(angle), math.sin(angle)])
    return float((shapes[other] @ normal).min() - (shapes[owner] @ normal).max())


def swapped(content: dict[str, Any]) -> None:
    pieces = content["claim"]["path"]["pieces"]
    pieces[0], pieces[2] = pieces[2], pieces[0]


def straightened(content: dict[str, Any]) -> None:
    """The same length of path, without its bend."""
    path = content["claim"]["path"]
    path["pieces"] = [{"kind": "line", "start": [-90.0, 0.0], "end": [60.0, 0.0]}]


def with_direction(content: dict[str, Any], turned: float) -> None:
    tile = next(tile for tile in stretches(content) if "8" in tile[2])
    tile[3][0] += turned


Forgery = tuple[Callable[[dict[str, Any]], Any], str]
TURN_FORGERIES: dict[str, Forgery] = {
    "a stretch dropped": (lambda c: stretches(c).pop(5), "do not join"),
    "the last stretch dropped": (lambda c: stretches(c).pop(), "short of"),
    "the first stretch of the body dropped": (lambda c: stretches(c, 1).pop(0), "do not join"),
    "a pair left out": (lambda c: stretches(c)[5].__setitem__(2, stretches(c)[5][2][:-1]), "pairs are missing"),
    "circles for all": (lambda c: stretches(c)[-1].__setitem__(2, "9" * 12), "not apart by face 9"),
    "another face": (lambda c: stretches(c)[5].__setitem__(2, "0" + stretches(c)[5][2][1:]), "not apart by face 0"),
    "a direction turned": (lambda c: with_direction(c, 1.0), "not apart by face 8"),
    "a direction missing": (
        lambda c: next(tile for tile in stretches(c) if "8" in tile[2])[3].clear(),
        "must be a list of 1, got a list of 0",
    ),
    "a stretch moved": (lambda c: stretches(c)[5].__setitem__(0, stretches(c)[5][0] - 1e-9), "do not join"),
    "a later stop": (at("claim", "stop", put=STOP + 0.001), "short of"),
    "an earlier start": (at("claim", "start", put=START - 0.001), "do not join"),
    "a wider margin": (at("claim", "margin", put=0.7), "not apart by face"),
    "no margin": (
        lambda c: c["claim"].pop("margin"),
        r"must be \[highest place, lowest place, faces\], got a list of 4",
    ),
    "a tighter spiral": (at("claim", "path", "pitch", put=1.3), "not proven"),
    "another ratio": (at("claim", "path", "ratio", put=1.0), "not proven"),
    "a deeper entry": (at("claim", "path", "entry_radius", put=3.5), "must not bend tighter"),
    "a spiral for the turn": (
        at("claim", "path", put={"kind": "spiral", "pitch": 1.7, "start_turns": 16.0}),
        "digits from 0 to 8",
    ),
    "a run to its end": (at("claim", "until", put="end"), "not shown to end"),
    "wider benches": (at("dragon", 1, 2, put=0.6), "not apart by face"),
    "an overlap": (at("overlap", put={"benches": [0, 8]}), "overlap is unknown"),
    "the head taken for a body bench": (at("repeats_from", put=0), "not alike"),
}
ROUTE_FORGERIES: dict[str, Forgery] = {
    "pieces exchanged": (swapped, "must close"),
    "a straight path": (straightened, "not apart by face|not shown to overlap"),
    "a wider loop": (at("claim", "path", "pieces", 1, "radius", put=6.0), "must close"),
    "another start": (at("claim", "path", "start", put=0.5), "not apart by face"),
    "a later time": (lambda c: c["claim"].__setitem__("time", c["claim"]["time"] + 1e-9), "short of"),
    "an earlier time": (lambda c: c["claim"].__setitem__("time", c["claim"]["time"] - 1e-9), "not shown to overlap"),
    "another pair": (at("overlap", "benches", put=[0, 15]), "not shown to overlap"),
    "neighbours as the pair": (at("overlap", "benches", put=[0, 1]), "share no handle"),
    "a margin": (at("claim", "margin", put=0.05), "not apart by face"),
    "a faster head": (at("claim", "head_speed", put=1.0001), "short of|not shown"),
    "a clear run": (lambda c: c["claim"].__setitem__("kind", "clear"), "overlap is unknown"),
    "a piece of another kind": (
        at("claim", "path", "pieces", 0, "kind", put="waypoints"),
        "must be line, arc or coil",
    ),
    "a line to nowhere": (at("claim", "path", "pieces", 0, "end", put=[0.0]), "must be a list of 2"),
    "no pieces": (at("claim", "path", "pieces", put=[]), "must be a list with entries"),
}


@pytest.mark.parametrize("name", TURN_FORGERIES)
def test_a_forged_certificate_of_a_clear_turn_is_refused(turning: Certificate, name: str) -> None:
    change, reason = TURN_FORGERIES[name]
    with pytest.raises(ProofRefused, match=reason):
        verify(edit(change)(turning))


@pytest.mark.parametrize("name", ROUTE_FORGERIES)
def test_a_forged_certificate_of_a_contact_on_a_route_is_refused(touching: Certificate, name: str) -> None:
    change, reason = ROUTE_FORGERIES[name]
    with pytest.raises(ProofRefused, match=reason):
        verify(edit(change)(touching))


@pytest.mark.parametrize(
    ("kind", "word"), [("a smaller margin", "not shown to be nearer"), ("a wider margin", "not apart by face")]
)
def test_a_wrong_margin_of_a_contact_is_refused(kind: str, word: str) -> None:
    case = CONTACTS["n_5"]
    dragon, path = Dragon(**case["dragon"]), Spiral(case["pitch"], case["start_turns"])
    time = first_contact(Dance(dragon, path), margin=0.2).time
    assert time is not None
    certificate = through_json(prove_collision_time(Dance(dragon, path), time, margin=0.2))
    verify(certificate)
    off = -MARGIN_OFF if kind == "a smaller margin" else MARGIN_OFF
    with pytest.raises(ProofRefused, match=word):
        verify(edit(at("claim", "margin", put=0.2 + off))(certificate))


@pytest.mark.parametrize(
    "put", [None, "x", [], {}, -1, 0, 0.5, 1e15, 1e-300, math.nan, True, 10**20, [1], {"a": 1}], ids=repr
)
def test_no_change_of_any_member_escapes_or_shows_python(turning: Certificate, touching: Certificate, put: Any) -> None:
    for certificate in (turning, touching):
        content = {name: value for name, value in certificate.items() if name not in ("digest", "sweeps")}
        messages = [refusal(edit(at(*place, put=put))(certificate)) for place in places(content)[1:]]
        assert [m for m in messages if any(word in m for word in ("Error(", "None", "True", "False", "\n"))] == []
        assert sum(map(bool, messages)) > 10
