"""The first encounter of several dragons, over HTTP, from a terminal, in a sweep and as a figure."""

from __future__ import annotations

import csv
import json
import math
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

import pytest

from app.files.performances import encounter_figure
from app.questions.encounter import Encounter, EncounterRequest
from app.sweeps.questions import question_of
from app.wire.question import Terms
from core import Dance, Dragon, Outcome, Part, Performance, Spiral, encounter_check, first_encounter
from tests.app.files.test_figures import PNG_SIGNATURE, texts
from tests.support.asking import Asking, box, dance, written
from tests.support.command import run
from tests.support.reference_encounters import CASES, performance_of

EXAMPLE = str(Path(__file__).parents[3] / "examples" / "two_dragons.toml")
LANE, BESIDE = dance(3, (0, 0), (30, 0)), dance(3, (0, 2), (30, 2))
EAST, NORTH = dance(5, (0, 0), (30, 0), name="east"), dance(5, (15, -20), (15, 20), name="north")
TWO = {"dances": [EAST, NORTH]}


def body_of(case: Any) -> dict[str, Any]:
    """The body that asks for the first encounter of a reference case."""
    return {name: case[name] for name in ("dances", "start", "stop")}


def test_a_clear_performance_has_no_pair_and_a_proof_to_its_stop(ask: Asking) -> None:
    case = next(case for case in CASES.values() if case["outcome"] == "clear")
    got = ask("encounter", body_of(case))
    assert (got["outcome"], got["end"]["reason"]) == ("clear", "stop")
    assert [got[name] for name in ("time", "dragons", "names", "cross_check")] == [None] * 4
    assert got["certificate"]["clear_until"] == got["end"]["time"] == case["stop"]


def test_corners_and_cross_checks_are_those_of_core(ask: Asking) -> None:
    case = CASES["same way, faster behind"]
    result = first_encounter(performance_of(case), start=case["start"], margin=0.1)
    body = body_of(case) | {"stop": None, "margin": 0.1}
    got, pair, none = (ask("encounter", body | {"cross_check": whom}) for whom in ("dragon", "pair", "none"))
    assert got["time"] == result.time
    features = zip((result.corner, result.edge), result.feature_dragons, strict=True)
    known = [asdict(feature) | {"dragon": dragon} if feature else None for feature, dragon in features]
    assert [got["corner"], got["edge"]] == known
    certificate = result.certificate
    assert [got["certificate"][name] for name in ("method", "bound")] == [certificate.method, certificate.bound]
    assert got["certificate"]["claim"]["time"] == certificate.claim.time
    for answer, whole in ((got, True), (pair, False)):
        check = encounter_check(result, whole=whole)
        assert check is not None
        assert check.agree
        assert answer["cross_check"]["judged"] == [list(judged) for judged in check.judged]
    assert pair["cross_check"]["judged"] == [[11], [0]]
    assert none == got | {"cross_check": None}


def test_several_pairs_that_meet_at_once_are_named(ask: Asking) -> None:
    got = ask("encounter", body_of(CASES["two dragons in one spiral, opposite"]))
    (together,) = got["cross_check"]["together"]
    assert together["dragons"] == [0, 1]
    assert {tuple(got["benches"]), tuple(together["benches"])} == {(3, 0), (0, 3)}


def test_passages_delays_and_strays_count(ask: Asking) -> None:
    at_once = ask("encounter", TWO)
    assert at_once["outcome"] == "contact"
    late = NORTH | {"delay": 2}
    assert ask("encounter", {"dances": [EAST, late]})["benches"] != at_once["benches"]
    both_wait = ask("encounter", {"dances": [EAST | {"passages": [{"speed": 0, "until_time": 2}]}, late]})
    assert both_wait["benches"] == at_once["benches"]
    assert both_wait["time"] == pytest.approx(at_once["time"] + 2.0, rel=0, abs=1e-8)  # [s]
    strays = ask("encounter", TWO | {"hole": 0.06, "pin": 0.02})
    assert (strays["stray"], ask("encounter", TWO | {"stray": 0.02})["time"]) == (0.02, strays["time"])
    assert strays["time"] < at_once["time"]


def test_benches_that_overlap_at_the_start_are_both_named(ask: Asking) -> None:
    got = ask("encounter", {"dances": [{"name": "one"}, {"name": "two"}], "stop": 9})
    assert (got["outcome"], got["names"], got["time"]) == ("contact_at_start", ["one", "two"], 0.0)
    assert len(got["benches"]) == 2
    assert got["gap"] < 0.0
    assert "bench" in got["certificate"]["method"]


def test_an_undecided_encounter_names_the_benches_that_are_certain() -> None:
    case = CASES["streets that cross, both at once"]
    result = first_encounter(performance_of(case), start=case["start"])
    unsure = replace(result, outcome=Outcome.UNDECIDED, time=None, overlapping=((0, 1), (3, 4)))
    answer = json.loads(Encounter.of(unsure, EncounterRequest.model_validate(body_of(case)), Terms()).to_json())
    assert answer["overlapping"] == {"dragons": [0, 1], "benches": [3, 4]}


@pytest.mark.thorough
def test_a_sweep_varies_the_delay_of_one_dragon(tmp_path: Path) -> None:
    spec = {"question": "encounter", "over": {"dances.1.delay": [0, 2]}, "request": TWO}
    table = tmp_path / "table.csv"
    made = run("sweep", "run", written(tmp_path, spec), "--output", str(tmp_path / "answers"))
    assert made.returncode == 0, made.stderr
    assert run("sweep", "compact", str(tmp_path / "answers"), "--csv", str(table)).returncode == 0
    times = []
    for delay in (0.0, 2.0):
        request = {"dances": [EAST, NORTH | {"delay": delay}], "cross_check": "none"}
        times.append(question_of("encounter").answer_to(request).model_dump()["time"])
    assert [float(row["time"]) for row in csv.DictReader(table.read_text().splitlines())] == times


def test_a_sweep_over_a_dance_that_is_not_there_is_refused(tmp_path: Path) -> None:
    spec = {"question": "encounter", "over": {"dances.2.delay": [0]}, "request": TWO}
    refused = run("sweep", "run", written(tmp_path, spec), "--output", str(tmp_path / "other"))
    assert refused.stderr.startswith("Error: over must name an entry of the list in the request by its number")


# -- the command ---------------------------------------------------------------------------------------------


def test_the_table_tells_the_encounter_and_the_margin_and_strays_for_which_it_holds() -> None:
    result = run("encounter", EXAMPLE)
    assert result.stderr == ""
    for words in ("First encounter", "207.37836126", "blue, red", "all 120 benches", "0 of dragon 0, 3 of dragon 1"):
        assert words in result.stdout
    alone = run("encounter", EXAMPLE, "--cross-check", "pair", "--margin", "0.1", "--stray", "0.01").stdout
    assert "within 0.1 m of each other that may come about with strays up to 0.01 m" in " ".join(alone.split())
    assert "only benches " in alone


def test_the_benches_and_the_path_of_each_dance_may_be_files(tmp_path: Path) -> None:
    (tmp_path / "benches.csv").write_text("name,length,width,overhang\n" + "Zhou,2.2,0.3,0.275\n" * 3)
    geometry = {"type": "LineString", "coordinates": [[0, 0], [30, 0]]}
    written(tmp_path, {"type": "Feature", "properties": {}, "geometry": geometry}, "lane.geojson")
    of_files = {"dragon": "benches.csv", "path": "lane.geojson"}
    done = run("encounter", written(tmp_path, {"dances": [of_files, BESIDE]}), "--json", "--margin", "1.8")
    assert done.returncode == 0, done.stderr
    dragons = [part["dance"]["dragon"] for part in json.loads(done.stdout)["certificate"]["claim"]["parts"]]
    assert [(one["benches"], one["lengths"]) for one in dragons] == [(3, [2.2, 2.2]), (3, [2.2, 3.41])]
    for k, name in enumerate(("dragon", "path")):
        dances = [BESIDE] * k + [{name: "missing.csv"}]
        file = written(tmp_path, {"dances": dances})
        assert run("encounter", file).stderr.startswith(f"Error: dances[{k}].{name} of {file}: ")


@pytest.mark.parametrize(
    ("command", "held", "words"),
    [
        ("encounter", LANE, "{file} must hold dances"),
        ("encounter", TWO | {"head_speed": 2}, "head_speed must stand in each of the dances"),
        ("encounter", TWO | {"marginn": 2}, "marginn is unknown here: did you mean margin?"),
        ("check", TWO | {"head_speed": 2}, "head_speed must stand in each of the dances"),
        *((name, TWO, "{file} holds the dances of several") for name in ("collision-time", "contact-probability")),
        ("propose", TWO, "{file} holds the dances of several"),
        ("figures --kind pitch-scan", TWO, "{file} holds the dances of several"),
    ],
)
def test_a_file_of_several_dragons_is_no_file_of_one(tmp_path: Path, command: str, held: Any, words: str) -> None:
    file = written(tmp_path, held)
    done = run(*command.split(), file)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.replace('"', "").startswith(f"Error: {words.format(file=file)}")


# -- figures -------------------------------------------------------------------------------------------------


def test_the_figure_shows_all_dragons_and_the_benches_that_meet(tmp_path: Path) -> None:
    svg, png = tmp_path / "two.svg", tmp_path / "two.png"
    done = run("encounter", EXAMPLE, "--figure", str(svg))
    assert (done.returncode, done.stderr) == (0, f"{svg}\n")
    words = texts(svg.read_bytes())
    for word in ("bench 3 of blue and bench 0 of red touch at 207.378361 s", "blue", "bench 0 of red", "x [m]"):
        assert word in words
    assert run("encounter", EXAMPLE, "--figure", str(png)).returncode == 0
    assert png.read_bytes().startswith(PNG_SIGNATURE)
    wrong = run("encounter", EXAMPLE, "--figure", str(tmp_path / "two.pdf"))
    assert wrong.stderr == "Error: --figure must end in .svg or .png, got .pdf\n"


def test_the_figure_of_an_instant_and_of_a_clear_performance(ask: Asking) -> None:
    at = texts(ask.file("figures/encounter.svg", TWO | {"time": 10, "venue": box(-5, -30, 40, 30)}))
    assert "At 10 s" in at
    assert "square" in at
    clear = ask.file("figures/encounter.svg", {"dances": [LANE, BESIDE]})
    assert "no benches of two dragons touch until 30 s" in texts(clear)


def test_signs_of_typesetting_in_names_are_drawn_as_they_are() -> None:
    spirals = [Spiral(1.1, 8.0, rotation=rotation) for rotation in (0.0, math.pi)]
    parts = [Part(Dance(Dragon(60), spiral), name=name) for spiral, name in zip(spirals, ("$x", "y$ _a_"), strict=True)]
    performance = Performance(parts)
    assert "bench 3 of $x" in texts(encounter_figure(performance, first_encounter(performance, start=207.0)))


@pytest.mark.parametrize(
    "language",
    ["en", pytest.param("zh", marks=[pytest.mark.chinese_font, pytest.mark.thorough])],
)
@pytest.mark.parametrize(
    ("kind", "more", "words"),
    [
        ("trajectory", {"time": 20}, {"en": "At 20 s", "zh": "20 s 时"}),
        (
            "contact",
            {},
            {
                "en": "bench 2 of east and bench 0 of north touch at ",
                "zh": "east的第 2 节板凳与north的第 0 节板凳在 ",
            },
        ),
        ("contact", {"margin": 0.2}, {"en": "come within 0.2 m at", "zh": "相距 0.2 m"}),
        (
            "contact",
            {"stop": 12},
            {"en": "no benches of two dragons touch until 12 s", "zh": "到 12 s 为止，各龙之间没有板凳相碰"},
        ),
        ("encounter", {}, {"en": "bench 0 of north", "zh": "north的第 0 节板凳"}),
    ],
)
def test_the_figures_of_one_dance_take_several_in_both_languages(
    ask: Asking, kind: str, more: Any, words: dict[str, str], language: str
) -> None:
    assert words[language] in texts(ask.file(f"figures/{kind}.svg", TWO | more | {"language": language}))


def test_the_command_draws_both_figures_of_several(ask: Asking, tmp_path: Path) -> None:
    done = run("figures", written(tmp_path, TWO), str(tmp_path), "--format", "svg")
    assert done.returncode == 0, done.stderr
    for kind in ("trajectory", "contact"):
        assert (tmp_path / f"{kind}.svg").read_bytes() == ask.file(f"figures/{kind}.svg", TWO)
