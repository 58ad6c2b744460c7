"""The first encounter of several dragons, over HTTP, from a terminal, as a job, in a sweep and as a figure."""

from __future__ import annotations

import csv
import json
import math
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

import httpx
import pytest

from app.files.performances import encounter_figure
from app.questions.encounter import Encounter, EncounterRequest
from app.sweeps.questions import question_of
from app.wire.question import Terms
from core import Dance, Dragon, Outcome, Part, Performance, Spiral, encounter_check, first_encounter
from tests.app.files.test_figures import PNG_SIGNATURE, texts
from tests.support.command import run
from tests.support.job_service import wait_for
from tests.support.reference_encounters import CASES, performance_of

ROOT = Path(__file__).parents[3]
EXAMPLE = ROOT / "examples" / "two_dragons.toml"
LANE = {"kind": "route", "pieces": [{"kind": "line", "start": [0, 0], "end": [30, 0]}]}
BESIDE = {"kind": "route", "pieces": [{"kind": "line", "start": [0, 2], "end": [30, 2]}]}
FEW = {"benches": 3}
TWO: dict[str, Any] = {
    "dances": [
        {"name": "east", "dragon": {"benches": 5}, "path": LANE},
        {"name": "north", "dragon": {"benches": 5}, "path": {"kind": "waypoints", "points": [[15, -20], [15, 20]]}},
    ]
}


def body_of(case: dict[str, Any]) -> dict[str, Any]:
    """The body that asks for the first encounter of a reference case."""
    return {name: case[name] for name in ("dances", "start", "stop")}


def ask(client: httpx.Client, body: dict[str, Any]) -> Any:
    return client.post("/encounter", json=body).raise_for_status().json()


@pytest.mark.parametrize("name", CASES)
def test_the_reference_is_met(client: httpx.Client, name: str) -> None:
    case = CASES[name]
    got = ask(client, body_of(case))
    assert got["outcome"] == case["outcome"]
    if case["outcome"] == "clear":
        assert (got["time"], got["dragons"], got["names"], got["cross_check"]) == (None, None, None, None)
        assert got["end"]["reason"] == "stop"
        assert got["certificate"]["clear_until"] == got["end"]["time"] == case["stop"]
    else:
        assert got["time"] == pytest.approx(case["time"], rel=0, abs=case["time_error"])
        assert got["cross_check"]["agree"]
        assert [len(judged) for judged in got["cross_check"]["judged"]] == [
            one["dragon"]["benches"] for one in case["dances"]
        ]


def test_an_answer_is_that_of_core(client: httpx.Client) -> None:
    case = CASES["same way, faster behind"]
    result = first_encounter(performance_of(case), start=case["start"], margin=0.1)
    got = ask(client, body_of(case) | {"stop": None, "margin": 0.1})
    assert (got["outcome"], got["time"], got["gap"], got["margin"]) == ("contact", result.time, 0.1, 0.1)
    assert tuple(got["time_bracket"]) == result.time_bracket
    assert (tuple(got["dragons"]), tuple(got["benches"])) == (result.dragons, result.benches)
    assert got["heads"] == [asdict(head) for head in result.heads or ()]
    features = (result.corner, result.edge)
    for name, feature, dragon in zip(("corner", "edge"), features, result.feature_dragons, strict=True):
        assert got[name] == (asdict(feature) | {"dragon": dragon} if feature else None)
    assert tuple(got["point"]) == result.point
    certificate = result.certificate
    assert got["certificate"]["method"] == certificate.method
    assert got["certificate"]["bound"] == certificate.bound
    assert got["certificate"]["claim"]["time"] == certificate.claim.time
    check = encounter_check(result)
    assert check is not None
    assert got["cross_check"]["judged"] == [list(judged) for judged in check.judged]
    pair = ask(client, body_of(case) | {"stop": None, "margin": 0.1, "cross_check": "pair"})
    one = encounter_check(result, whole=False)
    assert one is not None
    assert pair["cross_check"]["judged"] == [list(judged) for judged in one.judged] == [[11], [0]]
    assert one.agree
    none = ask(client, body_of(case) | {"stop": None, "margin": 0.1, "cross_check": "none"})
    assert none == got | {"cross_check": None}


def test_several_pairs_that_meet_at_once_are_named(client: httpx.Client) -> None:
    got = ask(client, body_of(CASES["two dragons in one spiral, opposite"]))
    ((together),) = got["cross_check"]["together"]
    assert together["dragons"] == [0, 1]
    assert {tuple(got["benches"]), tuple(together["benches"])} == {(3, 0), (0, 3)}


def test_passages_delays_and_strays_count(client: httpx.Client) -> None:
    at_once = ask(client, TWO)
    assert at_once["outcome"] == "contact"
    waits = json.loads(json.dumps(TWO))
    waits["dances"][1]["delay"] = 2
    assert ask(client, waits)["benches"] != at_once["benches"]
    waits["dances"][0]["passages"] = [{"speed": 0, "until_time": 2}]
    both_wait = ask(client, waits)
    assert both_wait["benches"] == at_once["benches"]
    assert both_wait["time"] == pytest.approx(at_once["time"] + 2.0, rel=0, abs=1e-8)  # [s]
    strays = ask(client, TWO | {"hole": 0.06, "pin": 0.02})
    assert (strays["stray"], ask(client, TWO | {"stray": 0.02})["time"]) == (0.02, strays["time"])
    assert strays["time"] < at_once["time"]


def test_benches_that_overlap_at_the_start_are_both_named(client: httpx.Client) -> None:
    got = ask(client, {"dances": [{"name": "one"}, {"name": "two"}], "stop": 9})
    assert (got["outcome"], got["names"], got["time"]) == ("contact_at_start", ["one", "two"], 0.0)
    assert len(got["benches"]) == 2
    assert got["gap"] < 0.0
    assert "bench" in got["certificate"]["method"]


def test_dances_that_share_no_time_share_the_ground_on_which_they_stand(client: httpx.Client) -> None:
    apart = [{"dragon": FEW, "path": LANE}, {"dragon": FEW, "path": BESIDE, "delay": 500}]
    got = ask(client, {"dances": apart})
    assert (got["outcome"], got["end"]) == ("clear", {"reason": "end", "time": 530.0, "dragon": None, "bench": None})
    # The second one stands at the beginning of the lane of the first one.
    same = [{"dragon": FEW, "path": LANE}, {"dragon": FEW, "path": LANE, "delay": 500}]
    assert ask(client, {"dances": same})["outcome"] == "contact_at_start"


def test_one_dragon_meets_nobody(client: httpx.Client) -> None:
    got = ask(client, {"dances": [{"dragon": FEW, "path": LANE}]})
    assert (got["outcome"], got["end"]["time"]) == ("clear", 30.0)


def test_an_undecided_encounter_names_the_benches_that_are_certain() -> None:
    case = CASES["streets that cross, both at once"]
    result = first_encounter(performance_of(case), start=case["start"])
    unsure = replace(result, outcome=Outcome.UNDECIDED, time=None, overlapping=((0, 1), (3, 4)))
    request = EncounterRequest.model_validate(body_of(case))
    answer = json.loads(Encounter.of(unsure, request, Terms()).to_json())
    assert answer["overlapping"] == {"dragons": [0, 1], "benches": [3, 4]}


def route(*points: list[float]) -> dict[str, Any]:
    return {"kind": "waypoints", "points": list(points)}


LATE = "dances[1].delay must let dances[1] begin, which is at 1000 s, before bench 0 of dances[0] folds at 432.917924"
WRONG: dict[str, tuple[dict[str, Any], str, str]] = {
    "no dance": ({"dances": []}, "/dances", "dances must have at least 1 entry, got none"),
    "nothing at all": ({}, "/dances", "dances is missing"),
    "1,000 dances": ({"dances": [{}] * 1_000}, "/dances", "dances must have at most 200 entries"),
    "equal names": (
        {"dances": [{"name": "a"}, {"name": "b"}, {"name": "a"}]},
        "/dances/2/name",
        "dances[2].name must differ from dances[0].name, got 'a'",
    ),
    "a name of two lines": ({"dances": [{"name": "a\nb"}]}, "/dances/0/name", "dances[0].name must be one line"),
    "a delay of 1e9": (
        {"dances": [{"delay": 1e9}]},
        "/dances/0/delay",
        "delay must be at most 1000000 s, got 1000000000",
    ),
    "a fold before a beginning": ({"dances": [{}, {"delay": 1000}]}, "/dances/1/delay", LATE),
    "too many benches": (
        {"dances": [{"dragon": {"benches": 6_000}}] * 2},
        "/dances",
        "benches of all dragons must be at most 10000 here, got 12000",
    ),
    "a wide bench": (
        {"dances": [{}, {"dragon": {"width": 30}}]},
        "/dances/1/dragon/width",
        "width must be at most 5 m, got 30 m: lengths are in metres, and 30 cm is 0.3 m",
    ),
    "a long overhang": (
        {"dances": [{}, {"dragon": {"overhang": 1.2}}]},
        "/dances/1/dragon/overhang",
        "dances[1].dragon.overhang must be ",
    ),
    "too tight a turn": (
        {"dances": [{}, {"path": {"kind": "turn", "turning_diameter": 2}}]},
        "/dances/1/path/turning_diameter",
        "dances[1].path.turning_diameter must be larger than 2 m: ",
    ),
    "a dragon beside them": (
        {"dances": [{}], "dragon": {}},
        "/dragon",
        '"dragon" is unknown here: it belongs in dances',
    ),
    "an early start": (
        {"dances": [{"delay": 5}], "start": 1},
        "/start",
        "start must be at least 5.000000 s, when the ",
    ),
    "a late stop": (
        {"dances": [{}], "stop": 500},
        "/stop",
        "stop must be at most 432.917924228 s, when bench 0 of dragon 0",
    ),
    "a large stray": ({"dances": [{}], "stray": 2}, "/stray", "stray must be "),
}


@pytest.mark.parametrize("name", WRONG)
def test_a_wrong_value_is_refused_at_its_place(client: httpx.Client, name: str) -> None:
    body, pointer, words = WRONG[name]
    refused = client.post("/encounter", json=body)
    assert refused.status_code == 422
    error = refused.json()["errors"][0]
    assert error["pointer"] == pointer
    assert error["detail"].startswith(words)


def test_a_job_has_the_same_answer(client: httpx.Client) -> None:
    known = client.post("/encounter", json=TWO).raise_for_status()
    job = client.post("/encounter", json=TWO, headers={"Prefer": "respond-async"})
    assert job.status_code == 202
    address = f"{job.headers['location']}/result"
    wait_for(lambda: client.get(address).status_code == 200)
    assert client.get(address).content == known.content


def test_a_sweep_varies_the_delay_of_one_dragon(tmp_path: Path) -> None:
    spec = {"question": "encounter", "over": {"dances.1.delay": [0, 2]}, "request": TWO}
    (tmp_path / "sweep.json").write_text(json.dumps(spec))
    made = run("sweep", "run", str(tmp_path / "sweep.json"), "--output", str(tmp_path / "answers"))
    assert made.returncode == 0, made.stderr
    assert run("sweep", "compact", str(tmp_path / "answers"), "--csv", str(tmp_path / "table.csv")).returncode == 0
    with (tmp_path / "table.csv").open() as table:
        rows = list(csv.DictReader(table))
    question = question_of("encounter")
    times = []
    for delay in (0.0, 2.0):
        dances = [TWO["dances"][0], TWO["dances"][1] | {"delay": delay}]
        times.append(question.answer_to({"dances": dances, "cross_check": "none"}).model_dump()["time"])
    assert [float(row["time"]) for row in rows] == times
    wrong = json.dumps(spec | {"over": {"dances.2.delay": [0]}})
    (tmp_path / "sweep.json").write_text(wrong)
    refused = run("sweep", "run", str(tmp_path / "sweep.json"), "--output", str(tmp_path / "other"))
    assert refused.stderr.startswith(
        "Error: over must name an entry of the list in the request by its number, which is "
    )


# -- the command ---------------------------------------------------------------------------------------------


def test_the_command_says_what_the_service_says(client: httpx.Client, tmp_path: Path) -> None:
    file = tmp_path / "two.json"
    file.write_text(json.dumps(TWO))
    output = run("encounter", str(file), "--json", "--margin", "0.05")
    assert output.stdout.encode() == client.post("/encounter", json=TWO | {"margin": 0.05}).content + b"\n"
    result = run("encounter", str(EXAMPLE))
    assert result.stderr == ""
    for words in ("First encounter", "207.37836126", "blue, red", "all 120 benches", "0 of dragon 0, 3 of dragon 1"):
        assert words in result.stdout
    alone = run("encounter", str(EXAMPLE), "--cross-check", "pair", "--margin", "0.1", "--stray", "0.01")
    assert "are within 0.1 m of each other that may come about with strays up to 0.01 m" in " ".join(
        alone.stdout.split()
    )
    assert "only benches " in alone.stdout


def test_the_benches_and_the_path_of_each_dance_may_be_files(tmp_path: Path) -> None:
    (tmp_path / "benches.csv").write_text("name,length,width,overhang\n" + "Zhou,2.2,0.3,0.275\n" * 3)
    line = {"type": "Feature", "properties": {}, "geometry": {"type": "LineString", "coordinates": [[0, 0], [30, 0]]}}
    (tmp_path / "lane.geojson").write_text(json.dumps(line))
    file = tmp_path / "dances.json"
    beside = {"dragon": FEW, "path": BESIDE}
    file.write_text(json.dumps({"dances": [{"dragon": "benches.csv", "path": "lane.geojson"}, beside]}))
    done = run("encounter", str(file), "--json", "--margin", "1.8")
    assert done.returncode == 0, done.stderr
    claim = json.loads(done.stdout)["certificate"]["claim"]
    dragons = [part["dance"]["dragon"] for part in claim["parts"]]
    assert [(one["benches"], one["lengths"]) for one in dragons] == [(3, [2.2, 2.2]), (3, [2.2, 3.41])]
    file.write_text(json.dumps({"dances": [beside, {"dragon": "missing.csv"}]}))
    assert run("encounter", str(file)).stderr.startswith(f"Error: dances[1].dragon of {file}: ")
    file.write_text(json.dumps({"dances": [{"path": "missing.geojson"}]}))
    assert run("encounter", str(file)).stderr.startswith(f"Error: dances[0].path of {file}: ")


ABOUT_ONE = "{file} holds the dances of several dragons, and this question is about one: give a file with"


@pytest.mark.parametrize(("command", "held", "words"), [
    ("encounter", {"dragon": FEW, "path": LANE}, "{file} must hold dances, each with a dragon and a path"),
    ("encounter", TWO | {"head_speed": 2}, "head_speed must stand in each of the dances, got it beside them"),
    ("encounter", TWO | {"marginn": 2}, "marginn is unknown here: did you mean margin?"),
    ("collision-time", TWO, ABOUT_ONE),
    ("contact-probability", TWO, ABOUT_ONE),
    ("propose", TWO, ABOUT_ONE),
    ("check", TWO | {"head_speed": 2}, "head_speed must stand in each of the dances, got it beside them"),
])  # fmt: skip
def test_a_file_of_several_dragons_is_no_file_of_one(
    tmp_path: Path, command: str, held: dict[str, Any], words: str
) -> None:
    file = tmp_path / "dances.json"
    file.write_text(json.dumps(held))
    done = run(command, str(file))
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.replace('"', "").startswith(f"Error: {words.format(file=file)}")


# -- figures -------------------------------------------------------------------------------------------------


def test_the_figure_shows_all_dragons_and_the_benches_that_meet(client: httpx.Client, tmp_path: Path) -> None:
    svg, png = tmp_path / "two.svg", tmp_path / "two.png"
    done = run("encounter", str(EXAMPLE), "--figure", str(svg))
    assert (done.returncode, done.stderr) == (0, f"{svg}\n")
    words = texts(svg.read_bytes())
    for word in ("bench 3 of blue and bench 0 of red touch at 207.378361 s", "blue", "bench 0 of red", "x [m]"):
        assert word in words
    assert run("encounter", str(EXAMPLE), "--figure", str(png)).returncode == 0
    assert png.read_bytes().startswith(PNG_SIGNATURE)
    drawn = client.post("/figures/encounter.svg", json=TWO | {"margin": 0.1}).raise_for_status()
    assert "come within" in texts(drawn.content)
    wrong = run("encounter", str(EXAMPLE), "--figure", str(tmp_path / "two.pdf"))
    assert wrong.stderr == "Error: --figure must end in .svg or .png, got .pdf\n"


def test_the_figure_of_an_instant_and_of_a_clear_performance(client: httpx.Client) -> None:
    square = {"type": "Polygon", "coordinates": [[[-5, -30], [40, -30], [40, 30], [-5, 30], [-5, -30]]]}
    at = client.post("/figures/encounter.svg", json=TWO | {"time": 10, "venue": square}).raise_for_status()
    assert "At 10 s" in texts(at.content)
    assert "square" in texts(at.content)
    apart = {"dances": [{"dragon": FEW, "path": LANE}, {"dragon": FEW, "path": BESIDE}]}
    clear = client.post("/figures/encounter.svg", json=apart).raise_for_status()
    assert "no benches of two dragons touch until 30 s" in texts(clear.content)
    folded = client.post("/figures/encounter.png", json={"dances": [{}], "time": 500})
    assert folded.json()["errors"][0]["pointer"] == "/time"
    assert folded.json()["detail"].startswith("time must be at most 432.917924228 s, when bench 0 of dragon 0 folds")


def test_signs_of_typesetting_in_names_are_drawn_as_they_are() -> None:
    spirals = [Spiral(1.1, 8.0, rotation=rotation) for rotation in (0.0, math.pi)]
    parts = [Part(Dance(Dragon(60), spiral), name=name) for spiral, name in zip(spirals, ("$x", "y$ _a_"), strict=True)]
    performance = Performance(parts)
    assert "bench 3 of $x" in texts(encounter_figure(performance, first_encounter(performance, start=207.0)))


@pytest.mark.parametrize("language", ["en", pytest.param("zh", marks=pytest.mark.chinese_font)])
@pytest.mark.parametrize(
    ("kind", "more", "english", "chinese"),
    [
        ("trajectory", {"time": 20}, "At 20 s", "20 s 时"),
        ("contact", {}, "bench 2 of east and bench 0 of north touch at ", "east的第 2 节板凳与north的第 0 节板凳在 "),
        ("contact", {"margin": 0.2}, "come within 0.2 m at", "相距 0.2 m"),
        ("contact", {"stop": 12}, "no benches of two dragons touch until 12 s", "到 12 s 为止，各龙之间没有板凳相碰"),
        ("encounter", {}, "bench 0 of north", "north的第 0 节板凳"),
    ],
)
def test_the_figures_of_one_dance_take_several_in_both_languages(
    client: httpx.Client, kind: str, more: dict[str, Any], english: str, chinese: str, language: str
) -> None:
    body = TWO | more | {"language": language}
    shown = texts(client.post(f"/figures/{kind}.svg", json=body).raise_for_status().content)
    assert {"en": english, "zh": chinese}[language] in shown
    beside = client.post(f"/figures/{kind}.svg", json=TWO | {"head_speed": 1.0})
    assert beside.status_code == 422
    assert beside.json()["errors"][0]["pointer"] == "/head_speed"


def test_the_command_draws_both_figures_of_several(client: httpx.Client, tmp_path: Path) -> None:
    file = tmp_path / "two.json"
    file.write_text(json.dumps(TWO))
    done = run("figures", str(file), str(tmp_path), "--format", "svg")
    assert done.returncode == 0, done.stderr
    for kind in ("trajectory", "contact"):
        drawn = client.post(f"/figures/{kind}.svg", json=TWO).raise_for_status().content
        assert (tmp_path / f"{kind}.svg").read_bytes() == drawn
    assert "holds the dances of several" in run("figures", str(file), "--kind", "pitch-scan").stderr
