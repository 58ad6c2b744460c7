"""Every file under examples/ is a request that runs, with the verdict that its comment promises."""

import numpy as np

import core
from app.maps.dances import read_dance
from app.questions.check import CheckRequest
from core import FailureKind, check
from tests.conftest import ROOT
from tests.support.near import assert_near
from tests.support.reference import reference, reference_cases

EXAMPLES = ROOT / "examples"
REFERENCE_ERROR = 1e-9  # [m], [m/s], [s]


def report(name):
    """The verdict on an example, read as the command reads it."""
    request = CheckRequest.model_validate(read_dance(EXAMPLES / f"{name}.toml"))
    dance = request.to_dance(1000)
    limits = {limit: getattr(request, limit) for limit in ("margin", "speed_limit", "start", "stop")}
    return check(dance, venue=request.to_place(dance.dragon).venue, **limits)


# docs/sweeps.md runs the sweep, docs/performances.md the several dragons, docs/paths-and-venues.md the village.
DANCES = "paper_dance contest_turn clothoid_turn village_square two_dragons crossing_streets sweep"


def test_every_example_has_its_test():
    assert {path.stem for path in EXAMPLES.glob("*.toml")} == set(DANCES.split())
    # test_tour.py, test_verify.py; the village reads the last one. The lessons have test_lessons.py.
    others = {path.name for path in EXAMPLES.glob("*.*") if path.suffix != ".toml"}
    assert others == {"README.md", "tour.py", "verify.py", "village_square.geojson"}


def test_the_turn_with_clothoids_is_that_of_the_library_and_passes():
    verdict = report("clothoid_turn")
    turn = core.ClothoidTurn(1.7, ratio=1.0, middle=4.0, ends=0.5)
    s = np.linspace(turn.begin, turn.end, 2_001)
    request = CheckRequest.model_validate(read_dance(EXAMPLES / "clothoid_turn.toml"))
    assert np.abs(request.to_dance(1000).path.position(s) - turn.position(s)).max() < REFERENCE_ERROR
    assert verdict.passed
    assert verdict.highest_speed.speed < 2.0


def test_the_papers_dance_ends_where_the_head_touches_bench_8():
    result = report("paper_dance")
    assert not result.passed
    assert [(failure.kind, failure.benches) for failure in result.failures] == [(FailureKind.CONTACT, (0, 8))]
    time = reference_cases("first_contact")["default"]["time"]
    assert_near([result.first_contact.time, result.stop], [time] * 2, REFERENCE_ERROR)


def test_the_contests_turn_passes_below_2_metres_a_second():
    result = report("contest_turn")
    assert result.passed
    values = [result.least_clearance.distance, result.highest_speed.speed]
    expected = [reference("turn")["clearance"]["least"], reference("maximum_head_speed")["speed_ratio"]]
    assert_near(values, expected, REFERENCE_ERROR)
