"""The verdict on several dances on one clock, over HTTP and from a terminal; that on one is unchanged."""

import pytest

from app.questions.check import CheckRequest
from app.settings import Settings
from core import check
from tests.app.files.test_figures import texts
from tests.support.asking import box, dance, json_like, written
from tests.support.command import run, said

EAST = dance(5, (0, 0), (30, 0))
NORTH = dance(5, (15, -20), (15, 20))
HOUSEHOLDS = ["Zhou", "Wu", "Zheng", "Wang", "Feng"]
LIMITS = {"venue": box(-5, -30, 28, 30), "speed_limit": 1.2, "margin": 0.05, "start_clock": "19:30"}
NAMED = NORTH | {"dragon": {"benches": 5, "names": HOUSEHOLDS}}
TWO = LIMITS | {"dances": [EAST | {"name": "east"}, NAMED | {"name": "north", "delay": 2, "head_speed": 1.1}]}
# North passes behind east.
PASSING = {"dances": [EAST, NORTH | {"delay": 40}], "cross_check": "none"}


@pytest.fixture(scope="module")
def verdict(ask):
    return ask("check", TWO)


def test_the_failures_are_those_of_core_in_order_of_time(verdict):
    performance, _ = CheckRequest.model_validate(TWO).to_placed(Settings())
    report = check(performance, margin=0.05, speed_limit=1.2)
    assert (verdict["verdict"], verdict["passed"], verdict["names"]) == ("fails", False, ["east", "north"])
    keys = ("kind", "time", "dragons", "benches", "message")
    known = [[json_like(getattr(failure, key)) for key in keys] for failure in report.failures]
    assert [[failure[key] for key in keys] for failure in verdict["failures"]] == known
    (met,) = (failure for failure in verdict["failures"] if len(failure["dragons"]) == 2)
    assert met["dragon_names"] == ["east", "north"]
    assert met["names"] == ["", HOUSEHOLDS[met["benches"][1]]]
    assert met["names"][1] in met["message"]
    assert met["clock"].startswith("19:30:")
    outside = [failure["dragon_names"] for failure in verdict["failures"] if failure["area"] == "square"]
    assert outside == [["east"]] * len(outside) != []


def test_each_report_is_the_answer_about_that_dance_alone(ask, verdict):
    assert verdict["reports"][0] == ask("check", LIMITS | EAST)
    assert verdict["reports"][1] == ask("check", LIMITS | NAMED | {"head_speed": 1.1, "start_clock": "19:30:02"})
    assert verdict["encounter"] == ask("encounter", {"dances": TWO["dances"], "margin": 0.05})


def test_without_details_the_verdict_is_the_same(ask, verdict):
    quick = ask("check", TWO | {"details": False})
    assert quick["failures"] == verdict["failures"]
    assert quick["least_clearance"] is None
    assert quick["reports"][0]["highest_speed"] is None


# -- the command ---------------------------------------------------------------------------------------------


def test_the_table_tells_every_failure_and_what_was_measured(verdict, tmp_path):
    words = " ".join(run("check", written(tmp_path, TWO)).stdout.split())
    failures = [f"{failure['clock']} {failure['message']}" for failure in verdict["failures"]]
    rows = ["least clearance of two dragons", "east: first within 0.05 m", "north: highest speed", "engines agree"]
    assert [row for row in failures + rows if row not in words] == []
    assert "Passes. Nothing fails." in run("check", written(tmp_path, PASSING)).stdout


def test_the_figure_shows_all_dragons(tmp_path):
    svg = tmp_path / "two.svg"
    for body, *words in ((TWO, "come within 0.05 m", "square"), (PASSING, "At ")):
        said("check", written(tmp_path, body), "--figure", str(svg), aside=None)
        assert [word for word in words if word not in texts(svg.read_bytes())] == []
