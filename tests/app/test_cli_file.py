"""Commands that are asked about the dance of a FILE: the same as `check` takes."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import httpx
import pytest

from tests.support.command import run

DANCE = """
margin = 0.2
speed_limit = 1.5
head_speed = 2.0
start = 20
venue = "yard.geojson"

[dragon]
lengths = [3.41, 2.2, 2.0, 2.2, 1.9, 2.2]
widths = [0.3, 0.3, 0.4, 0.3, 0.3, 0.3]
overhangs = [0.275, 0.275, 0.275, 0.275, 0.275, 0.275]

[path]
kind = "waypoints"
points = [[0, 0], [30, 0], [36, 5], [30, 10], [24, 5], [24, -20]]
"""
BODY: dict[str, Any] = {
    "dragon": {
        "lengths": [3.41, 2.2, 2.0, 2.2, 1.9, 2.2],
        "widths": [0.3, 0.3, 0.4, 0.3, 0.3, 0.3],
        "overhangs": [0.275] * 6,
    },
    "path": {"kind": "waypoints", "points": [[0, 0], [30, 0], [36, 5], [30, 10], [24, 5], [24, -20]]},
    "head_speed": 2.0,
}
YARD = {"type": "Polygon", "coordinates": [[[-5, -25], [45, -25], [45, 20], [-5, 20], [-5, -25]]]}


@pytest.fixture
def file(tmp_path: Path) -> str:
    (tmp_path / "yard.geojson").write_text(json.dumps(YARD))
    dance = tmp_path / "dance.toml"
    dance.write_text(DANCE)
    return str(dance)


@pytest.mark.parametrize(
    ("arguments", "call", "more"),
    [
        (["collision-time"], "collision-time", {"margin": 0.2, "start": 20}),
        (["collision-time", "--margin", "0.1"], "collision-time", {"margin": 0.1, "start": 20}),
        (["collision-time", "--cross-check", "none"], "collision-time",
         {"margin": 0.2, "start": 20, "cross_check": "none"}),
        (["trajectory"], "trajectory", {"times": [*range(20, 41)]}),
        (["trajectory", "--times", "10,11.5", "--decimals", "3"], "trajectory", {"times": [10, 11.5], "decimals": 3}),
        (["trajectory", "--start", "10", "--stop", "12"], "trajectory", {"times": {"start": 10, "stop": 12}}),
        (["trajectory", "--stop", "22"], "trajectory", {"times": [20, 21, 22]}),
        (["clearance"], "clearance", {"times": [*range(20, 41)]}),
        (["clearance", "--step", "10"], "clearance", {"times": [20, 30, 40]}),
        (["clearance", "--start", "10", "--stop", "12", "--step", "0.5"], "clearance",
         {"times": {"start": 10, "stop": 12, "step": 0.5}}),
        (["maximum-head-speed"], "maximum-head-speed", {"speed_limit": 1.5, "start": 20}),
        (["maximum-head-speed", "--speed-limit", "3"], "maximum-head-speed", {"speed_limit": 3, "start": 20}),
    ],
    ids=lambda part: " ".join(part) if isinstance(part, list) else None,
)  # fmt: skip
def test_a_file_is_asked_as_a_body_is(
    client: httpx.Client, file: str, arguments: list[str], call: str, more: dict[str, Any]
) -> None:
    done = run(arguments[0], file, *arguments[1:], "--json")
    assert (done.returncode, done.stderr) == (0, "")
    assert json.loads(done.stdout) == client.post(f"/{call}", json=BODY | more).raise_for_status().json()


@pytest.mark.parametrize(
    ("arguments", "more"),
    [
        (["minimum-pitch", "--start-turns", "6", "--turning-diameter", "4"],
         {"margin": 0.2, "start_turns": 6, "turning_diameter": 4}),
        (["minimum-pitch", "--margin", "0.1", "--cross-check", "none"], {"margin": 0.1, "cross_check": "none"}),
        (
            ["shortest-turn", "--pitch", "2", "--ratio", "1", "--exit-opposite"],
            {"margin": 0.2, "pitch": 2, "ratio": 1, "exit_opposite": True},
        ),
        (["tolerance-curve", "--samples", "2"], {"samples": 2}),
    ],
    ids=lambda part: " ".join(part) if isinstance(part, list) else None,
)  # fmt: skip
def test_a_question_that_chooses_the_path_is_asked_about_the_dragon_of_a_file(
    client: httpx.Client, file: str, arguments: list[str], more: dict[str, Any]
) -> None:
    done = run(arguments[0], file, *arguments[1:], "--json")
    assert (done.returncode, done.stderr) == (0, "")
    answer = client.post(f"/{arguments[0]}", json={"dragon": BODY["dragon"]} | more).raise_for_status()
    assert json.loads(done.stdout) == answer.json()


@pytest.mark.parametrize(
    ("places", "where"),
    [(["FILE"], ""), (["FILE", "drawn"], "drawn"), (["drawn", "FILE"], "drawn"), (["-"], ""), (["-", "."], "")],
    ids=" ".join,
)
def test_figures_of_a_file_are_those_of_its_dance_in_its_venue(
    client: httpx.Client, file: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, places: list[str], where: str
) -> None:
    monkeypatch.chdir(tmp_path)
    arguments = [file if place == "FILE" else place for place in places]
    fields = BODY | {"venue": YARD}
    done = run(
        "figures", *arguments, "--time", "12", "--format", "svg", text=json.dumps(fields | {"margin": 0.2, "start": 20})
    )
    assert done.returncode == 0, done.stderr
    assert sorted(path.name for path in (tmp_path / where).glob("*.svg")) == ["contact.svg", "trajectory.svg"]
    for name, more in (("trajectory", {"time": 12}), ("contact", {"margin": 0.2, "start": 20})):
        answer = client.post(f"/figures/{name}.svg", json=fields | more).raise_for_status()
        assert (tmp_path / where / f"{name}.svg").read_bytes() == answer.content


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["collision-time", "FILE", "--pitch", "1"], "--pitch cannot be combined with FILE, which describes the dance"),
        (["trajectory", "FILE", "--head-speed", "1"], "--head-speed cannot be combined with FILE, which describes"),
        (["minimum-pitch", "FILE", "--width", "1"], "--width cannot be combined with FILE, which describes the dance"),
        (["trajectory", "FILE", "--times", "10", "--stop", "12"], "--times replaces --stop"),
        (["clearance", "FILE", "--stop", "1e5"], "stop must be at most"),
        (["clearance", "FILE", "--stop", "10"], "stop must not be before start (20 s), got 10 s"),
        (["figures", "FILE", "FILE"], "FOLDER must be a folder, got the file"),
        (["figures", "FOLDER", "README.md"], "README.md must end in .toml or .json, got .md"),
        (["figures", "README.md"], "README.md must end in .toml or .json, got .md"),
        (["figures", "nothing.toml"], "nothing.toml: No such file or directory"),
        (
            ["figures", "FILE", "FOLDER", "--samples", "3"],
            "--samples does not apply to the figure trajectory or contact",
        ),
        (["collision-time", "nothing.toml"], "nothing.toml: No such file or directory"),
    ],
    ids=lambda part: " ".join(part) if isinstance(part, list) else None,
)
def test_what_does_not_go_with_a_file_is_refused(file: str, tmp_path: Path, arguments: list[str], words: str) -> None:
    folder = tmp_path / "figures"
    done = run(*({"FILE": file, "FOLDER": str(folder)}.get(part, part) for part in arguments))
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith(f"Error: {words}")
    assert len(done.stderr.splitlines()) == 1
    assert not folder.exists()


# Values that questions have for themselves.
OWN = {("trajectory", "decimals"), ("film", "seconds"), ("tolerance", "turning_diameter"),
       ("contact-probability", "turning_diameter"), ("contact-probability", "step"),
       ("minimum-pitch", "turning_diameter"), ("minimum-pitch", "start_turns"), ("shortest-turn", "turning_diameter"),
       ("shortest-turn", "start_turns"), ("shortest-turn", "pitch"), ("quickest-turn", "turning_diameter"),
       ("quickest-turn", "start_turns"), ("quickest-turn", "pitch"), ("tolerance-curve", "turning_diameter"),
       ("tolerance-curve", "start_turns")}  # fmt: skip
MISPLACED = ("pitch", "start_turns", "turning_diameter", "decimals", "seconds", "step")
ASKING = ("trajectory", "collision-time", "clearance", "maximum-head-speed", "envelope", "film", "figures", "tolerance",
          "contact-probability", "minimum-pitch", "shortest-turn", "turn-time", "quickest-turn",
          "tolerance-curve")  # fmt: skip


@pytest.mark.parametrize(
    ("command", "name"),
    sorted({(c, n) for c in ASKING for n in MISPLACED} - OWN),
)
def test_a_value_that_check_would_refuse_is_no_silent_mistake(tmp_path: Path, command: str, name: str) -> None:
    file = tmp_path / "flat.toml"
    file.write_text(f"{name} = 2")
    done = run(command, str(file))
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith(f'Error: "{name}" is unknown here')


@pytest.mark.parametrize(("ends", "times"), [
    ("start = 430", [430, 431, 432]), ("start = 20.5", [20.5 + k for k in range(301)]), ("stop = 2", [0, 1, 2]),
    ("start = 7\nstop = 9", [7, 8, 9]), ("start = 7\ntimes = [3]", [3]),
])  # fmt: skip
@pytest.mark.parametrize("command", ["trajectory", "clearance"])
def test_instants_are_those_of_start_and_stop_in_the_file(
    tmp_path: Path, command: str, ends: str, times: list[float]
) -> None:
    file = tmp_path / "dance.toml"
    file.write_text(ends)
    assert json.loads(run(command, str(file), "--json").stdout)["time"] == times


def test_the_stop_of_a_file_with_a_start_is_counted_from_the_start_that_is_given(tmp_path: Path) -> None:
    file = tmp_path / "dance.toml"
    file.write_text("start = 7")
    result = run("trajectory", str(file), "--start", "20", "--step", "100", "--json")
    assert json.loads(result.stdout)["time"] == [20, 120, 220, 320]


@pytest.mark.parametrize("command", ["trajectory", "clearance"])
def test_instants_that_no_start_is_given_for_begin_when_the_whole_dragon_is_on_the_path(
    tmp_path: Path, command: str
) -> None:
    file = tmp_path / "dance.json"
    file.write_text(json.dumps(BODY))
    assert json.loads(run(command, str(file), "--stop", "10", "--step", "2", "--json").stdout)["time"] == [6, 8, 10]
    file.write_text(json.dumps(BODY | {"stop": 8}))
    assert json.loads(run(command, str(file), "--json").stdout)["time"] == [6, 7, 8]


@pytest.mark.parametrize(("ends", "words"), [
    ('start = "x"', 'start must be a number [s], got "x"'),
    ("start = 500", "start must be at most 432.917924228 s, when bench 0 folds, got 500 s"),
    ("start = 9\nstop = 8", "stop must not be before start (9 s), got 8 s"),
    ("stop = 500", "stop must be at most 432.917924228 s, when bench 0 folds, got 500 s"),
])  # fmt: skip
def test_wrong_ends_in_a_file_are_named_as_there(tmp_path: Path, ends: str, words: str) -> None:
    file = tmp_path / "dance.toml"
    file.write_text(ends)
    assert run("trajectory", str(file)).stderr == f"Error: {words}\n"


def test_the_figure_of_a_file_is_drawn_at_its_start(tmp_path: Path) -> None:
    file = tmp_path / "dance.toml"
    drawn = []
    for ends, options in (("start = 30", []), ("", ["--time", "30"])):
        file.write_text(f"{ends}\ndragon.benches = 3")
        run("figures", str(file), str(tmp_path), "--kind", "trajectory", "--format", "svg", *options)
        drawn.append((tmp_path / "trajectory.svg").read_bytes())
    assert drawn[0] == drawn[1]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("stop = 500", "stop must be at most 432.917924228 s, when bench 0 folds, got 500 s"),
        ("dragon.width = -1", "dragon.width must be at least 0.001 m, got -1 m"),
    ],
)
def test_refused_figures_of_a_file_leave_neither_file_nor_folder(text: str, words: str, tmp_path: Path) -> None:
    (tmp_path / "dance.toml").write_text(text)
    done = run("figures", str(tmp_path / "dance.toml"), str(tmp_path / "new"))
    assert (done.returncode, done.stderr) == (2, f"Error: {words}\n")
    assert [one.name for one in tmp_path.iterdir()] == ["dance.toml"]


def test_an_empty_name_of_a_file_is_refused_by_name() -> None:
    done = run("trajectory", "")
    assert (done.returncode, done.stderr) == (2, "Error: FILE must not be an empty name: the current folder is .\n")


def test_the_figure_that_a_file_leaves_out_is_named(tmp_path: Path) -> None:
    file = tmp_path / "dance.toml"
    file.write_text("dragon.benches = 3")
    *_, last = run("figures", str(file), str(tmp_path)).stderr.splitlines()
    assert last.startswith("pitch-scan is left out: ")
    assert run("figures", str(file), str(tmp_path), "--kind", "contact").stderr == f"{tmp_path}/contact.png\n"


@pytest.mark.parametrize("text", ['{"path": {"pitch": 0.5}}', "[path]\npitch = 0.5"], ids=["json", "toml"])
def test_standard_input_is_json_or_toml(client: httpx.Client, text: str) -> None:
    done = run("collision-time", "-", "--json", text=text)
    assert json.loads(done.stdout) == client.get("/collision-time?pitch=0.5").raise_for_status().json()


def test_an_empty_standard_input_is_no_dance() -> None:
    done = run("collision-time", "-", text=" ")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith("Error: standard input is not JSON: ")


@pytest.mark.parametrize("name", ["dance.toml", "dance.json"])
def test_rectangles_are_asked_for_where_a_dance_is_given(tmp_path: Path, name: str) -> None:
    file = tmp_path / name
    file.write_text("" if name.endswith("toml") else json.dumps(BODY))
    words = "must be JSON with benches, each a rectangle with x, y, heading, length and width"
    assert run("overlaps", str(file)).stderr == f"Error: {file} {words}: ask check or clearance about a dance\n"


def test_a_name_that_no_question_knows_is_refused(tmp_path: Path) -> None:
    file = tmp_path / "dance.json"
    file.write_text(json.dumps(BODY | {"margn": 1}))
    done = run("collision-time", str(file))
    assert (done.returncode, done.stderr) == (2, 'Error: "margn" is unknown here: did you mean margin?\n')


@pytest.mark.parametrize(
    ("name", "text", "words"),
    [
        ("list.json", "[1]", "list.json must hold a JSON object, got [1]"),
        ("dance.toml", "dragon = 5", "dragon must be a table, got 5"),
        ("dance.json", '{"dragon": 5}', "dragon must be a JSON object, got 5"),
        (
            "dance.json",
            '{"dragon": {"lengths": [2], "widths": 0.3, "overhangs": [0.2]}}',
            "dragon.widths must be a list of numbers [m], got 0.3",
        ),
        ("dance.json", '{"dragon": {"names": ["a", 3]}}', "dragon.names[1] must be a string, got 3"),
        ("dance.json", '{"path": {"pitch": -1}}', "path.pitch must be at least 0.001 m, got -1 m"),
        (
            "dance.json",
            '{"path": {"kind": "waypoints", "points": [[0, 0], [1, "x"]]}}',
            'path.points[1][1] must be a number [m], got "x"',
        ),
        ("dance.json", '{"path": {"kind": "route", "pieces": [{}]}}', "path.pieces[0].kind is missing"),
        ("dance.toml", 'venue = "yard.geojson"', "venue of dance.toml: yard.geojson: No such file or directory"),
        ("dance.txt", "", "dance.txt must end in .toml or .json, got .txt"),
        (
            "dance.json",
            '{"path": {"kind": "route", "pieces": [{"kind": "arc", "radius": 3}]}}',
            "path.pieces[0].centre is missing",
        ),
    ],
)
def test_a_message_about_a_file_speaks_of_the_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str, text: str, words: str
) -> None:
    (tmp_path / name).write_text(text)
    monkeypatch.chdir(tmp_path)
    done = run("check", name)
    assert (done.returncode, done.stdout, done.stderr) == (2, "", f"Error: {words}\n")


def test_an_empty_file_is_the_contests_dance_and_says_so(tmp_path: Path, client: httpx.Client) -> None:
    file = tmp_path / "empty.toml"
    file.write_text("")
    done = run("collision-time", str(file), "--json")
    assert (done.returncode, done.stderr) == (0, f"{file} is empty: the answer is for the contest's dance.\n")
    assert json.loads(done.stdout) == client.post("/collision-time", json={}).raise_for_status().json()


def test_a_clearance_is_a_table(file: str) -> None:
    done = run("clearance", file, "--start", "10", "--stop", "12")
    assert done.returncode == 0
    assert "clearance [m]" in done.stdout
    assert done.stdout.count("\n") > len(("title", "names", "10", "11", "12"))


@pytest.mark.parametrize(
    ("command", "names", "words"),
    [
        (
            "tolerance",
            "stray, hole, pin",
            "the answer is the largest stray, by people and by the play of pins together",
        ),
        ("contact-probability", "stray", "--lateral and --forward describe how people wobble"),
    ],
)
def test_a_stray_in_the_file_that_does_not_count_is_named(
    tmp_path: Path, client: httpx.Client, command: str, names: str, words: str
) -> None:
    strays = {"stray": 0.02, "hole": 0.055, "pin": 0.05}
    request: dict[str, Any] = {"dragon": {"benches": 5}, "start": 0, "stop": 10}
    request |= {} if command == "tolerance" else {"samples": 10}
    values = {} if command == "tolerance" else {name: strays[name] for name in ("hole", "pin")}
    file = tmp_path / "dance.json"
    file.write_text(json.dumps(request | strays))
    done = run(command, str(file), "--json")
    assert (done.returncode, done.stderr) == (0, f"{file}: ignored: {names}, because {words}.\n")
    assert json.loads(done.stdout) == client.post(f"/{command}", json=request | values).raise_for_status().json()
    file.write_text(json.dumps(request))
    assert run(command, str(file)).stderr == ""
