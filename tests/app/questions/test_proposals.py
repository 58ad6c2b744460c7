"""Proposals over HTTP and from a terminal: each is a dance that /check passes as it is."""

import math
import re

import pytest

from app.questions.proposals import ProposalsRequest, proposals
from app.wire.question import Terms
from core.language import Language
from tests.support.asking import box, written
from tests.support.command import run
from tests.support.depth import thorough
from tests.support.near import assert_near

BODY = {
    "venue": box(0, 0, 24, 20),
    "dragon": {"benches": 10},
    "figures": ["ring", "serpentine"],
    "count": 2,
}
GATES = [{"point": [0, 10], "heading": 0}, {"point": [24, 10], "heading": math.pi}]
ODD = {"lengths": [3, 2, 2.2, 2], "widths": [0.4, 0.3, 0.3, 0.3], "overhangs": [0.2] * 4, "names": ["Li", "", "", "Wu"]}
LANE = box(0, 0, 30, 3)
TOO_NARROW = (
    "No dance was found: the widest free circle is at most 3.01 m across, and the tightest turn of the head bench that "
    "is tried takes 3.91 m."
)


@pytest.mark.parametrize(
    "more",
    [
        {"figures": ["ring"], "count": 1},
        {"gates": GATES, "figures": ["parade", "ring"], "speed_limit": 1.2},
        *thorough({}, {"dragon": ODD}, {"objective": "benches", "figures": ["ring"], "count": 1}),
    ],
    ids=["ring", "gates", "square", "bench by bench", "most benches"],
)
def test_every_dance_passes_its_check_as_it_is(ask, more):
    answer = ask("proposals", BODY | more)
    assert answer["proposals"]
    for one in answer["proposals"]:
        body = one["dance"]
        assert body["stray"] == 0.05
        assert body["start"] == 0.0
        report = ask("check", body)
        assert report["verdict"] == "passes"
        nearest = min(area["nearest"]["distance"] for area in report["venue"]["areas"])
        measured = [report["stop"], report["highest_speed"]["speed"], report["sharpest_bend"]["angle"], nearest]
        known = [one["duration"], one["highest_speed"], one["sharpest_bend"], one["near"]["distance"]]
        assert_near(measured, known, 1e-9)
        calm = ask("check", body | {"stray": 0.0})
        own = next(area["nearest"] for area in calm["venue"]["areas"] if area["name"] == one["near"]["name"])
        in_place = [one["near"]["in_place"], one["clearance_in_place"]]
        assert_near([own["distance"], calm["least_clearance"]["distance"]], in_place, 1e-9)
        assert f"from '{one['near']['name']}'" in one["summary"]
        # Benches with one bench between them are always near each other.
        a, b = report["least_clearance"]["benches"]
        pair = (one["clearance"], one["clearance_in_place"])
        near = min(*[pair] * (b > a + 2), (one["near"]["distance"], one["near"]["in_place"]), (math.inf,))
        distances = re.findall(r"[\d.]+ c?m", one["cards"]["en"]["tight"])[:3]
        assert distances == [f"{near[1]:.2f} m", f"{near[0]:.2f} m", "5 cm"]
        assert not one["gates"] or "from gate {} to gate {}".format(*one["gates"]) in one["summary"]
    titles = [one["cards"][language]["title"] for language in ("en", "zh") for one in answer["proposals"]]
    assert len(set(titles)) == len(titles)


def test_a_width_says_that_the_ways_to_the_gates_count(ask):
    found = ask("proposals", BODY | {"figures": ["ring"], "gates": [GATES[0] | {"use": "both"}]})["proposals"]
    titles = [one["cards"]["en"]["title"] for one in found]
    assert len(titles) == 2
    assert all(re.fullmatch(r"Ring, \d+ m wide with its ways to the gates", one) for one in titles)


def test_what_a_dance_has_most_of_is_said_once_the_search_has_ended():
    parts = []
    request = ProposalsRequest.model_validate(BODY)
    found = proposals(request, Terms(part=parts.append)).proposals
    goods = [[one.cards[Language.ENGLISH].good for one in some] for some in (parts, found)]
    most = re.compile("Most room|longest|most turns|gentlest")
    before, after = ([good for good in some if most.search(good)] for some in goods)
    assert (before, len(parts)) == ([], 2)
    assert after


def test_a_reason_stands_where_no_dance_fits(ask):
    answer = ask("proposals", BODY | {"venue": LANE})
    assert (answer["proposals"], answer["reason_kind"], answer["reason"]) == ([], "width", TOO_NARROW)


def test_a_venue_in_degrees_keeps_its_place(ask):
    east = 24 / 111_320 / math.cos(math.radians(48.0))
    north = 20 / 111_195
    venue = {"venue": box(9.0, 48.0, 9.0 + east, 48.0 + north), "coordinates": "degrees"}
    dance = ask("proposals", BODY | venue | {"figures": ["ring"], "count": 1})["proposals"][0]["dance"]
    assert dance["venue"]["origin"]["longitude"] == pytest.approx(9.0 + 0.5 * east)
    report = ask("check", dance)
    assert (report["passed"], report["origin"]) == (True, dance["venue"]["origin"])


@pytest.mark.thorough
def test_the_command_writes_dances_and_pictures(tmp_path):
    written(tmp_path, BODY["venue"], "yard.geojson")
    file = tmp_path / "wish.toml"
    folder = tmp_path / "proposals"
    none = tmp_path / "none"
    file.write_text('venue = "yard.geojson"\nfigures = ["ring"]\ncount = 2\n[dragon]\nbenches = 10\n')
    result = run("propose", str(file), "--output", str(folder))
    assert result.stdout.startswith("The best 2 of "), result.stderr
    names = ["1-ring.json", "1-ring.png", "2-ring.json", "2-ring.png", "overview.png"]
    assert result.stderr.splitlines() == [str(folder / name) for name in names]
    assert {path.read_bytes()[:6] for path in folder.glob("*.png")} == {b"\x89PNG\r\n"}
    assert run("check", str(folder / "2-ring.json")).stdout.startswith("Passes.")
    result = run("propose", written(tmp_path, {"dragon": {"benches": 4}, "venue": LANE}), "--output", str(none))
    assert (result.returncode, " ".join(result.stdout.split()), list(none.iterdir())) == (0, TOO_NARROW, [])
