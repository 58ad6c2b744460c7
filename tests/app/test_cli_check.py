"""The commands check, turn, shortest-turn, turn-time, quickest-turn and maximum-head-speed, run as a user runs them."""

from __future__ import annotations

import csv
import json
import re
from pathlib import Path
from typing import Any

import httpx
import openpyxl
import pytest

from tests.app.test_cli import answer_of, served
from tests.support.command import run

ROUNDING = 1e-12  # of an angle [1]
DANCE = """
margin = 0.9
speed_limit = 0.5
start = 15
venue = "yard.geojson"

[dragon]
benches = 4

[path]
kind = "route"

[[path.pieces]]
kind = "line"
start = [0, 0]
end = [60, 0]
"""
YARD = {"type": "Polygon", "coordinates": [[[-2, -3], [62, -3], [62, 1], [-2, 1], [-2, -3]]]}
BODY: dict[str, Any] = {
    "dragon": {"benches": 4},
    "path": {"kind": "route", "pieces": [{"kind": "line", "start": [0, 0], "end": [60, 0]}]},
    "venue": YARD,
    "margin": 0.9,
    "speed_limit": 0.5,
    "start": 15,
}


@pytest.fixture
def dance(tmp_path: Path) -> Path:
    """A dance in a TOML file, and its venue beside it."""
    (tmp_path / "yard.geojson").write_text(json.dumps(YARD))
    file = tmp_path / "dance.toml"
    file.write_text(DANCE)
    return file


@pytest.mark.parametrize(
    ("arguments", "target"),
    [
        (["turn"], "/turn"),
        (["turn", "--pitch", "1.5", "--ratio", "1"], "/turn?pitch=1.5&ratio=1"),
        (["shortest-turn", "--benches", "20"], "/shortest-turn?benches=20"),
        (["shortest-turn", "--benches", "20", "--exit-opposite"], "/shortest-turn?benches=20&exit_opposite=true"),
        (["turn", "--entry-radius", "4.3", "--exit-radius", "4.5"], "/turn?entry_radius=4.3&exit_radius=4.5"),
        (
            ["shortest-turn", "--ratio", "1", "--margin", "0.2", "--benches", "40", "--exit-opposite"],
            "/shortest-turn?ratio=1&margin=0.2&benches=40&exit_opposite=true",
        ),
        (["turn-time", "--benches", "20", "--exit-radius", "4.5"], "/turn-time?benches=20&exit_radius=4.5"),
        (
            ["turn-time", "--benches", "20", "--ratio", "1", "--middle", "4", "--ends", "0.5"],
            "/turn-time?benches=20&ratio=1&middle=4&ends=0.5",
        ),
        (["turn", "--ratio", "1", "--middle", "4"], "/turn?ratio=1&middle=4"),
        (
            ["quickest-turn", "--benches", "12", "--speed-limit", "3"],
            "/quickest-turn?benches=12&speed_limit=3",
        ),
        (["maximum-head-speed", "--benches", "20"], "/maximum-head-speed?benches=20"),
        (
            ["maximum-head-speed", "--benches", "20", "--speed-limit", "3"],
            "/maximum-head-speed?benches=20&speed_limit=3",
        ),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, list) else None,
)
def test_json_is_the_answer_of_the_service(client: httpx.Client, arguments: list[str], target: str) -> None:
    assert json.loads(answer_of(*arguments, "--json")) == served(client, "GET", target)


def test_check_reads_toml_and_json_and_answers_like_the_service(client: httpx.Client, dance: Path) -> None:
    answer = served(client, "POST", "/check", BODY)
    assert not answer["passed"]
    assert json.loads(answer_of("check", str(dance), "--json")) == answer
    dance.with_suffix(".json").write_text(json.dumps(BODY))
    assert json.loads(answer_of("check", str(dance.with_suffix(".json")), "--json")) == answer


def test_check_has_the_engines_judge_whom_the_option_says_or_else_the_file(
    client: httpx.Client, tmp_path: Path
) -> None:
    body = {"dragon": {"benches": 30}, "path": {"pitch": 0.4}, "start": 100.0}
    file = tmp_path / "dance.json"
    for in_file, option, stated in (("none", [], "none"), ("none", ["pair"], "pair"), ("pair", ["dragon"], "dragon")):
        file.write_text(json.dumps(body | {"cross_check": in_file}))
        answer = json.loads(answer_of("check", str(file), "--json", *(f"--cross-check={word}" for word in option)))
        assert answer == served(client, "POST", "/check", body | {"cross_check": stated})
    check = answer["first_contact"]["cross_check"]
    assert (check["agree"], check["judged"]) == (True, list(range(30)))
    assert "engines agree" in answer_of("check", str(file), "--cross-check", "dragon")
    assert "all 30 benches" in answer_of("check", str(file), "--cross-check", "dragon")
    refused = run("check", str(file), "--cross-check", "all")
    assert (refused.returncode, refused.stdout) == (2, "")
    assert refused.stderr == 'Error: cross_check must be "dragon", "pair" or "none", got "all"\n'


def test_a_failed_check_is_an_answer_that_says_what_fails(dance: Path) -> None:
    output = answer_of("check", str(dance))
    for word in (
        "Failures in order",
        "'square'",
        "exceeds 0.5 m/s",
        "nearest to square",
        "proven: at least",
        "highest speed",
    ):
        assert word in output


def test_a_dance_that_passes_says_so(dance: Path) -> None:
    dance.write_text(DANCE.replace("0.9", "0.1").replace("0.5", "2.0"))
    output = answer_of("check", str(dance))
    assert "Nothing fails." in output
    assert "handles 0, 1, 2, 3, 4" in output


def test_a_dance_that_folds_is_no_dance_of_which_nothing_fails(client: httpx.Client, tmp_path: Path) -> None:
    body = {"dragon": {"benches": 40}, "path": {"pitch": 1.2, "start_turns": 8}}
    answer = served(client, "POST", "/check", body)
    assert (answer["verdict"], answer["passed"]) == ("fails", False)
    (fold,) = answer["failures"]
    assert (fold["kind"], fold["benches"], fold["area"]) == ("folds", [0], None)
    assert fold["time"] == answer["stop"] == answer["first_contact"]["end"]["time"]
    assert fold["head"]["theta"] == pytest.approx(answer["first_contact"]["end"]["theta"], rel=ROUNDING)
    assert answer["first_contact"]["end"]["bench"] == 0
    file = tmp_path / "dance.json"
    file.write_text(json.dumps(body))
    output = answer_of("check", str(file))
    assert output.startswith("Fails. Failures in order of time:\n  Bench 0 folds at 238.214985 s, the head at (1.0120")
    assert "Nothing fails" not in output
    file.write_text(json.dumps(body | {"stop": 238.0}))
    assert answer_of("check", str(file)).startswith("Passes. Nothing fails.")


def test_what_is_not_decided_is_no_failure(tmp_path: Path) -> None:
    yard = [[-70, -9], [70, -9], [70, 0.35 + 1e-14], [-70, 0.35 + 1e-14], [-70, -9]]
    lane = {"kind": "route", "pieces": [{"kind": "line", "start": [-60, 0], "end": [60, 0]}], "start": 60}
    venue = {"type": "Polygon", "coordinates": [yard]}
    body = {"dragon": {"benches": 5}, "path": lane, "venue": venue, "margin": 0.2, "start": 0}
    file = tmp_path / "dance.json"
    file.write_text(json.dumps(body))
    answer = json.loads(answer_of("check", str(file), "--json"))
    assert (answer["verdict"], answer["passed"]) == ("undecided", False)
    output = answer_of("check", str(file))
    assert output.startswith("Undecided. No failure is known, but these questions are open:\n")
    assert "fails" not in output


def test_a_margin_of_a_check_is_reported_in_every_line(dance: Path) -> None:
    output = answer_of("check", str(dance))
    assert "comes within 0.9 m of 'square'" in output
    assert "never within 0.9 m" in output
    assert "first within 0.9 m" in output
    assert "contact" not in output


def test_a_single_handle_is_no_handles(dance: Path) -> None:
    # While the head alone is on the arc, it turns away from the lane, along which the others follow more slowly.
    bend = 'kind = "arc"\ncentre = [60, 20]\nradius = 20\nstart_angle = -1.5707963267948966\nsweep = 1.5'
    times = DANCE.replace("start = 15", "start = 60.5").replace('venue = "yard.geojson"', "stop = 61")
    dance.write_text(f"{times}\n[[path.pieces]]\n{bend}")
    words = answer_of("check", str(dance)).splitlines()
    (row,) = [line for line in words if line.lstrip().startswith("highest speed")]
    assert row.rstrip().endswith("handle 0")


def test_the_dance_is_drawn_in_its_venue(dance: Path) -> None:
    figure = dance.with_name("dance.svg")
    done = run("check", str(dance), "--figure", str(figure), "--time", "59", "--json")
    assert (done.returncode, done.stderr) == (0, f"{figure}\n")
    assert " square -->" in figure.read_text()


def test_the_dance_that_is_judged_is_written_as_a_table(dance: Path) -> None:
    tables = {ending: dance.with_name(f"dance.{ending}") for ending in ("json", "csv", "xlsx")}
    for table in tables.values():
        done = run("check", str(dance), "--output", str(table))
        assert (done.returncode, done.stderr) == (0, f"{table}\n")
    simple = dance.with_name("plain.json")
    simple.write_text(json.dumps({name: BODY[name] for name in ("dragon", "path")}))
    answer = json.loads(answer_of("trajectory", str(simple), "--start", "15", "--stop", "60", "--json"))
    assert json.loads(tables["json"].read_text()) == answer
    rows = list(csv.DictReader(tables["csv"].read_text().splitlines()))
    assert [float(row["x"]) for row in rows] == [x for line in answer["x"] for x in line]
    sheet = openpyxl.load_workbook(tables["xlsx"]).worksheets[0]
    assert (sheet.max_row - 1, sheet.max_column - 1) == (2 * 5, len(answer["time"]))


LANES = [{"dragon": {"benches": 3}, "path": {"kind": "waypoints", "points": [[0, y], [40, y]]}} for y in (0, 5)]


@pytest.mark.parametrize("more", [LANES[0], {"dances": LANES}], ids=["one", "several"])
def test_the_last_second_of_a_table_is_not_after_the_end_of_a_path(tmp_path: Path, more: dict[str, Any]) -> None:
    file, table = tmp_path / "lane.json", tmp_path / "lane.csv"
    file.write_text(json.dumps({"start": 10, **more}))
    # The sides of this path are a rounding shorter than 40 m.
    done = run("check", str(file), "--output", str(table))
    assert done.stderr == f"{table}\n"
    report = json.loads(answer_of("check", str(file), "--json"))
    assert report["stop"] % 1.0 > 0.999
    times = [float(row["time"]) for row in csv.DictReader(table.read_text().splitlines())]
    assert (times[0], times[-1]) == (10.0, report["stop"])


# The last digit of a distance in a report [m].
LAST_DIGIT = 1e-6


def test_a_least_clearance_is_not_rounded_above_what_is_proven_and_a_fold_has_no_highest_speed(tmp_path: Path) -> None:
    file = tmp_path / "dance.json"
    file.write_text('{"dragon": {"benches": 40}, "path": {"pitch": 1.2, "start_turns": 8}}')
    output = answer_of("check", str(file))
    proven = json.loads(answer_of("check", str(file), "--json"))["least_clearance"]["at_least"]
    (displayed,) = re.findall(r"proven: at least ([\d.]+) m", output)
    assert proven - LAST_DIGIT < float(displayed) <= proven
    assert re.search(r"highest speed +grows without bound +238\.214985 s +towards the fold", output)


def test_benches_that_overlap_at_the_start_are_claimed_to(tmp_path: Path) -> None:
    file = tmp_path / "dance.json"
    file.write_text('{"path": {"pitch": 0.3}}')
    assert re.search(
        r"least clearance +overlap by 0\.114627 m +0\.000000 s +benches 8, 28 ", answer_of("check", str(file))
    )


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("margin = 0.9", "margin = 9", ["margin must be at most 2 m"]),
        ("end = [60, 0]", "end = [0, 0]", ["path.pieces[0]", "got 0 m"]),
        ("end = [60, 0]", "end = [60]", ["path.pieces[0].end", "at least 2 entries"]),
        ('"line"', '"maze"', ["path.pieces[0]", '"line"', "maze"]),
        ("yard.geojson", "garden.geojson", ["garden.geojson", "No such file"]),
        ("margin =", "margin", ["not TOML"]),
        ("margin =", "a = " + "[" * 10_000 + "\nmargin =", ["dance.toml nests too many"]),
        ("start = 15", "start = 1", ["start must be at least 7.81", "got 1 s"]),
    ],
)
def test_an_invalid_dance_is_one_line_and_exit_code_2(dance: Path, old: str, new: str, words: list[str]) -> None:
    dance.write_text(DANCE.replace(old, new))
    done = run("check", str(dance))
    assert (done.returncode, done.stdout) == (2, "")
    assert len(done.stderr.splitlines()) == 1
    assert [word for word in words if word not in done.stderr] == []


def test_a_file_that_windows_saved_is_read(dance: Path) -> None:
    answer = answer_of("check", str(dance))
    for encoding in ("utf-8-sig", "utf-16"):
        dance.write_text(DANCE, encoding=encoding)
        assert answer_of("check", str(dance)) == answer


def test_a_figure_of_another_format_is_refused(dance: Path) -> None:
    done = run("check", str(dance), "--figure", str(dance.with_name("dance.gif")))
    assert (done.returncode, done.stdout) == (2, "")
    assert ".svg or .png" in done.stderr
