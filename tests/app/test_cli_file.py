"""Commands that are asked about the dance of a FILE: the same as `check` takes."""

import json
from pathlib import Path

import pytest

from app.maps.dances import read_dance
from tests.conftest import ROOT
from tests.support.asking import box, written
from tests.support.command import run, said
from tests.support.depth import thorough
from tests.support.refusal_rows import assert_refused_in_one_line

DANCE = """
margin = 0.2
speed_limit = 1.5
start = 20
venue = "yard.geojson"

"""
WAYPOINTS = """
head_speed = 2.0

[dragon]
lengths = [3.41, 2.2, 2.0, 2.2, 1.9, 2.2]
widths = [0.3, 0.3, 0.4, 0.3, 0.3, 0.3]
overhangs = [0.275, 0.275, 0.275, 0.275, 0.275, 0.275]

[path]
kind = "waypoints"
points = [[0, 0], [30, 0], [36, 5], [30, 10], [24, 5], [24, -20]]
"""
BODY = json.loads("""{
    "dragon": {"lengths": [3.41, 2.2, 2.0, 2.2, 1.9, 2.2], "widths": [0.3, 0.3, 0.4, 0.3, 0.3, 0.3],
               "overhangs": [0.275, 0.275, 0.275, 0.275, 0.275, 0.275]},
    "path": {"kind": "waypoints", "points": [[0, 0], [30, 0], [36, 5], [30, 10], [24, 5], [24, -20]]},
    "head_speed": 2.0
}""")
YARD = box(-5, -25, 45, 20)
# Two dragons in the lanes of a square.
TWO = json.loads("""{"dances": [
    {"name": "east", "dragon": {"benches": 4}, "path": {"kind": "waypoints", "points": [[0, 0], [30, 0]]}},
    {"dragon": {"benches": 3, "names": ["Zhou", "Wu", "=Li"]}, "delay": 12.5,
     "path": {"kind": "waypoints", "points": [[15, -20], [15, 20]]}}
], "start_clock": "19:30"}""")
TIMED = TWO | {"times": [5, 20, 45.25]}
NAMED = {"dragon": {"benches": 24, "names": ["", "Wang", "17", *[""] * 21]}, "start_clock": "19:44:30"}


@pytest.fixture
def file(tmp_path):
    (tmp_path / "yard.geojson").write_text(json.dumps(YARD))
    dance = tmp_path / "dance.toml"
    dance.write_text(DANCE + WAYPOINTS)
    return str(dance)


CHECKED = {"margin": 0.2, "speed_limit": 1.5, "start": 20, "venue": YARD, "cross_check": "none"}
# A command, also about the FILE, and what its body has beside the dance.
QUESTIONS = [
    'trajectory --start 1 --stop 2 --step 0.5 -> {"times": {"start": 1, "stop": 2, "step": 0.5}}',
    'trajectory --times 0,9 --head-length 3 -> {"times": [0, 9], "dragon": {"head_length": 3}}',
    'trajectory --times 0,12.5,3 -> {"times": [0, 12.5, 3]}',
    'trajectory --path turn --times -9,0 -> {"path": {"kind": "turn"}, "times": [-9, 0]}',
    'collision-time FILE -> {"margin": 0.2, "start": 20}',
    'collision-time FILE --margin 0.1 -> {"margin": 0.1, "start": 20}',
    'collision-time FILE --cross-check none -> {"margin": 0.2, "start": 20, "cross_check": "none"}',
    'trajectory FILE --times 10,11.5 --decimals 3 -> {"times": [10, 11.5], "decimals": 3}',
    'trajectory FILE --start 10 --stop 12 -> {"times": {"start": 10, "stop": 12}}',
    'trajectory FILE --stop 22 -> {"times": [20, 21, 22]}',
    'clearance FILE --step 10 -> {"times": [20, 30, 40]}',
    'clearance FILE --start 10 --stop 12 --step 0.5 -> {"times": {"start": 10, "stop": 12, "step": 0.5}}',
    f"check FILE --cross-check none -> {json.dumps(CHECKED)}",
    'maximum-head-speed FILE -> {"speed_limit": 1.5, "start": 20}',
    'maximum-head-speed FILE --speed-limit 3 -> {"speed_limit": 3, "start": 20}',
    # These choose the path, and take the dragon of the file.
    'minimum-pitch FILE --start-turns 6 -> {"margin": 0.2, "start_turns": 6}',
    'minimum-pitch FILE --margin 0.1 --cross-check none -> {"margin": 0.1, "cross_check": "none"}',
    'shortest-turn FILE --pitch 2 --exit-opposite -> {"margin": 0.2, "pitch": 2, "exit_opposite": true}',
    'tolerance-curve FILE --samples 2 -> {"samples": 2}',
]
OF_DRAGONS = ("minimum-pitch", "shortest-turn", "tolerance-curve")


@pytest.mark.parametrize("row", QUESTIONS)
def test_options_and_a_file_ask_as_a_body_does(client, file, row):
    line, more = row.split(" -> ")
    call, *_ = line.split()
    body = {"dragon": BODY["dragon"]} if call in OF_DRAGONS else BODY if "FILE" in line else {}
    answer = client.post(f"/{call}", json=body | json.loads(more)).raise_for_status().json()
    assert json.loads(said(*line.replace("FILE", str(file)).split(), "--json")) == answer


ACCEPT = {"csv": "text/csv", "arrow": "application/vnd.apache.arrow.file", "gif": "image/gif", "pdf": "application/pdf",
          "dxf": "image/vnd.dxf", "geojson": "application/geo+json",
          "xlsx": "application/vnd.openxmlformats-officedocument.spreadsheetml.sheet"}  # fmt: skip
VILLAGE = read_dance(ROOT / "examples" / "village_square.toml")
# Commands that write a file about a dance on standard input, with the call and what its body has beside the dance.
FILES = [
    *((TIMED, f"trajectory two.{ending} -> trajectory") for ending in ("csv", "arrow", "xlsx", "json")),
    *((BODY | {"times": [6, 9]}, f"trajectory one.{ending} -> trajectory") for ending in ("csv", "arrow", "xlsx")),
    (BODY, 'trajectory one.csv --times 6,9 --decimals 3 -> trajectory {"times": [6, 9], "decimals": 3}'),
    (TWO, 'film two.gif --seconds 0.2 --rate 10 --height 90 -> films {"seconds": 0.2, "rate": 10, "height": 90}'),
    (TWO, "maps two.geojson -> maps.geojson"),
    (TWO, "maps two.dxf -> maps.dxf"),
    (TWO, "cues two.csv -> cues"),
    *((TWO, f"envelope two.{ending} -> envelope") for ending in ("dxf", "geojson")),
    (BODY, 'plan plan.pdf --title Lanterns --paper A3 -> plan {"title": "Lanterns", "paper": "A3"}'),
    (VILLAGE | NAMED, 'cues cards.json --bench Wang --bench 6 --bench 17 -> cues {"cards": ["Wang", "6", "17"]}'),
    (VILLAGE, 'cues cards.json --last-bench 1 --language zh -> cues {"last_bench": 1, "language": "zh"}'),
    (VILLAGE | NAMED, 'crew crew.csv --spares 6 --point 6,-8 -> crew {"spares": 6, "points": [{"x": 6, "y": -8}]}'),
    (VILLAGE, 'crew crew.json --spares 6 -> crew {"spares": 6}'),
]
PAPERS = [
    (TWO, 'plan two.pdf --gate gate,15,0 -> plan {"gates": [{"name": "gate", "x": 15, "y": 0}]}'),
    (TWO, "cues two.pdf -> cues"),
    (VILLAGE, 'crew crew.pdf --spares 6 -> crew {"spares": 6}'),
]  # fmt: skip


@pytest.mark.parametrize(
    "body, row",
    [*FILES, *thorough(*PAPERS)],
    ids=[row.split(" -")[0] for _, row in (*FILES, *PAPERS)],
)
def test_a_command_writes_the_file_of_the_service(client, tmp_path, monkeypatch, body, row):
    monkeypatch.chdir(tmp_path)
    line, asked = row.split(" -> ")
    (command, file, *options), (call, _, more) = line.split(), asked.partition(" ")
    printed = said(command, "-", "--output", file, *options, aside=None, text=json.dumps(body))
    assert bool(printed) == (command == "envelope")
    headers = {"accept": ACCEPT.get(file.partition(".")[2], "*/*")}
    known = client.post(f"/{call}", json=body | json.loads(more or "{}"), headers=headers).raise_for_status()
    assert Path(file).read_bytes() == known.content


@pytest.mark.parametrize(
    "places, where",
    [("FILE", ""), ("FILE drawn", "drawn"), ("drawn FILE", "drawn"), ("-", ""), ("- .", "")],
)
def test_figures_of_a_file_are_those_of_its_dance_in_its_venue(client, file, tmp_path, monkeypatch, places, where):
    monkeypatch.chdir(tmp_path)
    fields = BODY | {"venue": YARD}
    text = json.dumps(fields | {"margin": 0.2, "start": 20})
    done = run("figures", *places.replace("FILE", file).split(), "--format", "svg", text=text)
    assert done.returncode == 0, done.stderr
    assert done.stderr.splitlines()[-1].startswith("pitch-scan is left out: ")
    assert sorted(path.name for path in (tmp_path / where).glob("*.svg")) == ["contact.svg", "trajectory.svg"]
    # The trajectory is drawn at the start of the file.
    for name, more in (("trajectory", {"time": 20}), ("contact", {"margin": 0.2, "start": 20})):
        answer = client.post(f"/figures/{name}.svg", json=fields | more).raise_for_status()
        assert (tmp_path / where / f"{name}.svg").read_bytes() == answer.content


@pytest.mark.parametrize(
    "row",
    [
        "collision-time FILE --pitch 1 -> --pitch cannot be combined with FILE",
        "trajectory FILE --head-speed 1 -> --head-speed cannot be combined with FILE",
        "minimum-pitch FILE --width 1 -> --width cannot be combined with FILE",
        "trajectory FILE --times 10 --stop 12 -> --times replaces --stop",
        "clearance FILE --stop 1e5 -> stop",
        "clearance FILE --stop 10 -> stop ... start (20 s), 10 s",
        "check FILE --figure FOLDER.svg --time 500 -> time ... 500",
        "check FILE --time 3 -> --time ... --figure",
        "check FILE --cross-check '' -> --cross-check ... dragon pair none",
        "overlaps --pitch 1 FILE -> --pitch ... FILE",
        "overlaps --margin=0 FILE -> --margin ... FILE",
        "figures FILE FOLDER --time 500 -> time",
        "figures FILE FILE -> FOLDER",
        "figures FOLDER README.md -> README.md ... .toml .json, .md",
        "figures README.md -> README.md ... .toml .json, .md",
        "figures nothing.toml -> nothing.toml: No such file or directory",
        "figures FILE FOLDER --samples 3 -> --samples ... trajectory contact",
        "collision-time nothing.toml -> nothing.toml: No such file or directory",
        "crew FILE --spares 2 --point 6 -> --point ... X,Y '6'",
    ],
)
def test_what_does_not_go_with_a_file_is_refused(file, tmp_path, row):
    line, words = row.split(" -> ")
    folder = tmp_path / "figures"
    line = line.replace("FILE", file).replace("FOLDER", str(folder))
    assert_refused_in_one_line(f"{line} -> {words}")
    assert not folder.exists()


# Questions, and values that other questions or paths have, which `check` would refuse.
MISPLACED = [
    "minimum-pitch: pitch decimals seconds step",
    "film: pitch start_turns turning_diameter decimals step",
]
MORE_MISPLACED = [
    "trajectory: pitch start_turns turning_diameter seconds step",
    "collision-time: pitch start_turns turning_diameter decimals seconds step",
    "clearance: pitch start_turns turning_diameter decimals seconds step",
    "maximum-head-speed: pitch start_turns turning_diameter decimals seconds step",
    "envelope: pitch start_turns turning_diameter decimals seconds step",
    "figures: pitch start_turns turning_diameter decimals seconds step",
    "tolerance: pitch start_turns decimals seconds step",
    "contact-probability: pitch start_turns decimals seconds",
    "shortest-turn: decimals seconds step",
    "turn-time: pitch start_turns turning_diameter decimals seconds step",
    "quickest-turn: decimals seconds step",
    "tolerance-curve: pitch decimals seconds step",
]


@pytest.mark.parametrize("row", [*MISPLACED, *thorough(*MORE_MISPLACED)])
def test_a_value_that_check_would_refuse_is_no_silent_mistake(tmp_path, row):
    command, names = row.split(": ")
    file = tmp_path / "flat.toml"
    for name in names.split():
        file.write_text(f"{name} = 2")
        assert_refused_in_one_line(f'{command} {file} -> "{name}" is unknown here')


@pytest.mark.parametrize("text", ['{"path": {"pitch": 0.5}}', "[path]\npitch = 0.5"], ids=["json", "toml"])
def test_standard_input_is_json_or_toml(client, text):
    answer = client.get("/collision-time?pitch=0.5").raise_for_status().json()
    assert json.loads(said("collision-time", "-", "--json", text=text)) == answer


@pytest.mark.parametrize(
    "name, text, named",
    [
        ("list.json", "[1]", "list.json ... [1]"),
        ("dance.toml", "dragon = 5", "dragon must be a table"),
        ("dance.json", '{"dragon": 5}', "dragon must be a JSON object"),
        ("dance.json", '{"margn": 1}', '"margn" is unknown here: did you mean margin?'),
        ("dance.json", '{"dragon": {"lengths": [2], "widths": 0.3, "overhangs": [0.2]}}', "dragon.widths ... 0.3"),
        ("dance.json", '{"dragon": {"names": ["a", 3]}}', "dragon.names[1] ... 3"),
        ("dance.json", '{"path": {"pitch": -1}}', "path.pitch ... 0.001 m, -1 m"),
        ("dance.json", '{"path": {"kind": "waypoints", "points": [[0, 0], [1, "x"]]}}', 'path.points[1][1] ... "x"'),
        ("dance.json", '{"path": {"kind": "route", "pieces": [{}]}}', "path.pieces[0].kind is missing"),
        ("dance.json", '{"path": {"kind": "route", "pieces": [{"kind": "arc", "radius": 3}]}}',
         "path.pieces[0].centre is missing"),
        ("dance.toml", 'venue = "yard.geojson"', "venue of dance.toml: yard.geojson: No such file or directory"),
        ("dance.txt", "", "dance.txt must end in .toml or .json, got .txt"),
        ("dance.toml", "margin 9", "dance.toml is not TOML"),
        ("dance.toml", "a = " + "[" * 10_000, "dance.toml nests too many"),
        ("dance.toml", "start = 9\nstop = 8", "stop ... start (9 s), 8 s"),
    ],
)  # fmt: skip
def test_a_message_about_a_file_speaks_of_the_file(tmp_path, monkeypatch, name, text, named):
    (tmp_path / name).write_text(text)
    monkeypatch.chdir(tmp_path)
    assert_refused_in_one_line(f"check {name} -> {named}")


def test_a_trajectory_of_several_is_a_table_for_each():
    table = said("trajectory", "-", "--handles", "0,3", text=json.dumps(TIMED))
    words = ("east: x [m]", "dragon 1: speed [m/s]", "3 =Li (rear)", "2 of 4 handles, 3 of 3 instants")
    assert [word for word in words if word not in table] == []
    assert_refused_in_one_line("trajectory - --handles 0,5 -> handles[1] ... 0 3 5", text=json.dumps(TIMED))


@pytest.mark.parametrize(
    "command, ignored, more",
    [("tolerance", ["stray", "hole", "pin"], {}), ("contact-probability", ["stray"], {"samples": 10})],
)
def test_a_stray_in_the_file_that_does_not_count_is_named(tmp_path, command, ignored, more):
    counting = {"dragon": {"benches": 5}, "start": 0, "stop": 10} | more
    strays = {"stray": 0.02, "hole": 0.055, "pin": 0.05}
    file = written(tmp_path, counting | strays)
    done = run(command, file, "--json")
    assert done.stderr.startswith(f"{file}: ignored: {', '.join(ignored)}, because ")
    counting |= {name: value for name, value in strays.items() if name not in ignored}
    assert done.stdout == said(command, written(tmp_path, counting), "--json")
