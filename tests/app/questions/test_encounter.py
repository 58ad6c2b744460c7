"""The first encounter of several dragons, over HTTP, from a terminal and as a figure."""

import json
from dataclasses import replace

import pytest

from app.questions.encounter import Encounter, EncounterRequest
from app.wire.question import Terms
from core import Outcome, encounter_check, first_encounter
from tests.app.files.test_figures import texts
from tests.conftest import ROOT
from tests.support.asking import box, dance, json_like, written
from tests.support.command import refusal, run
from tests.support.reference_encounters import CASES, performance_of

EXAMPLE = str(ROOT / "examples" / "two_dragons.toml")
LANE = dance(3, (0, 0), (30, 0))
BESIDE = dance(3, (0, 2), (30, 2))
EAST = dance(5, (0, 0), (30, 0), name="east")
NORTH = dance(5, (15, -20), (15, 20), name="north")
TWO = {"dances": [EAST, NORTH]}


def body_of(case):
    """The body that asks for the first encounter of a reference case."""
    return {name: case[name] for name in ("dances", "start", "stop")}


def test_the_owners_of_features_and_the_cross_checks_are_those_of_core(ask):
    case = CASES["same way, faster behind"]
    result = first_encounter(performance_of(case), start=case["start"], margin=0.1)
    body = body_of(case) | {"stop": None, "margin": 0.1}
    got, pair, none = (ask("encounter", body | {"cross_check": whom}) for whom in ("dragon", "pair", "none"))
    for name, dragon in zip(("corner", "edge"), result.feature_dragons, strict=True):
        assert got[name] == (getattr(result, name) and json_like(getattr(result, name)) | {"dragon": dragon})
    for answer, whole in ((got, True), (pair, False)):
        assert answer["cross_check"]["judged"] == json_like(encounter_check(result, whole=whole))["judged"]
    assert none == got | {"cross_check": None}


def test_an_undecided_encounter_names_the_benches_that_are_certain():
    case = CASES["streets that cross, both at once"]
    result = first_encounter(performance_of(case), start=case["start"])
    unsure = replace(result, outcome=Outcome.UNDECIDED, time=None, overlapping=((0, 1), (3, 4)))
    answer = json.loads(Encounter.of(unsure, EncounterRequest.model_validate(body_of(case)), Terms()).to_json())
    assert answer["overlapping"] == {"dragons": [0, 1], "benches": [3, 4]}


# -- the command ---------------------------------------------------------------------------------------------


def test_the_table_tells_the_encounter():
    result = run("encounter", EXAMPLE)
    assert result.stderr == ""
    for words in ("First encounter", "207.37836126", "blue, red", "all 120 benches", "0 of dragon 0, 3 of dragon 1"):
        assert words in result.stdout


def test_the_benches_and_the_path_of_each_dance_may_be_files(tmp_path):
    (tmp_path / "benches.csv").write_text("name,length,width,overhang\n" + "Zhou,2.2,0.3,0.275\n" * 3)
    written(tmp_path, {"type": "LineString", "coordinates": [[0, 0], [30, 0]]}, "lane.geojson")
    file = written(tmp_path, {"dances": [{"dragon": "benches.csv", "path": "lane.geojson"}, BESIDE]})
    done = run("encounter", file, "--json", "--margin", "1.8")
    dragon = json.loads(done.stdout)["certificate"]["claim"]["parts"][0]["dance"]["dragon"]
    assert dragon["benches"] == 3
    assert dragon["lengths"] == [2.2, 2.2]
    for k, name in enumerate(("dragon", "path")):
        file = written(tmp_path, {"dances": [BESIDE] * k + [{name: "missing.csv"}]})
        assert run("encounter", file).stderr.startswith(f"Error: dances[{k}].{name} of {file}: ")


@pytest.mark.parametrize(
    "command, held, words",
    [
        ("encounter", LANE, "{file} must hold dances"),
        ("check", TWO | {"head_speed": 2}, "head_speed must stand in each of the dances"),
        *(
            (name, TWO, "{file} holds the dances of several")
            for name in ("collision-time", "figures --kind pitch-scan")
        ),
    ],
)
def test_a_file_of_several_dragons_is_no_file_of_one(tmp_path, command, held, words):
    file = written(tmp_path, held)
    assert refusal(*command.split(), file).startswith(f"Error: {words.format(file=file)}")


# -- figures -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "kind, more, words",
    [
        ("trajectory", {"time": 20}, "At 20 s"),
        ("contact", {"margin": 0.2}, "come within 0.2 m at"),
        ("encounter", {"stop": 12}, "no benches of two dragons touch until 12 s"),
        pytest.param("contact", {"language": "zh"}, "north的 0 号板凳", marks=pytest.mark.chinese_font),
    ],
)
def test_the_figures_of_one_dance_take_several_in_both_languages(ask, kind, more, words):
    drawn = texts(ask.file(f"figures/{kind}.svg", TWO | {"venue": box(-5, -30, 40, 30)} | more))
    assert words in drawn
    assert "square" in drawn
