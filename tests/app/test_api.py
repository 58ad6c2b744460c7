"""Promises of every call in addition to its numbers: formats, caching, HEAD and OPTIONS, health, documentation."""

from __future__ import annotations

import csv
import io
import math
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from urllib.parse import urljoin

import httpx
import openpyxl
import pytest

from app.files.tables import ARROW_TYPE, CSV_TYPE, XLSX_TYPE
from app.service.version import build
from tests.app.files.test_figures import PNG_SIGNATURE
from tests.support.asking import Asking, line
from tests.support.depth import few

SMALL = {"dragon": {"benches": 3}, "times": [0.0, 1.5]}
GETS = ("collision-time", "minimum-pitch", "clearance", "figures/trajectory.svg", "figures/contact.png?benches=40")
# Two benches that cross in the middle of both, and a third apart.
PLACES = [(0, 0, 0), (9, 9, 0), (0.2, 0.1, math.pi / 2)]
CROSSED = [{"x": x, "y": y, "heading": heading, "length": 2, "width": 0.3} for x, y, heading in PLACES]
ENGINES = {"separating_axis", "fcl", "shapely", "angle_sum"}


def numbers(value: Any) -> Iterator[Any]:
    if isinstance(value, (dict, list)):
        for part in value.values() if isinstance(value, dict) else value:
            yield from numbers(part)
    else:
        yield value


# -- trajectories --------------------------------------------------------------------------------------------


def test_trajectory_answers_columns_with_a_row_for_each_instant_and_an_entry_for_each_handle(ask: Asking) -> None:
    table = ask("trajectory", SMALL)
    assert list(table) == ["time", "x", "y", "speed"]
    assert table["time"] == [0.0, 1.5]
    assert [len(row) for name in ("x", "y", "speed") for row in table[name]] == [4] * 6
    assert [row[0] for row in table["speed"]] == pytest.approx([1.0, 1.0], rel=1e-15)
    lists = {"lengths": [3.41, 2.2, 2.2], "widths": [0.3] * 3, "overhangs": [0.275] * 3}
    assert ask("trajectory", SMALL | {"dragon": lists}) == table


def test_trajectory_without_a_body_is_the_default_one(ask: Asking) -> None:
    assert ask.client.post("/trajectory").content == ask.file("trajectory", {})


@pytest.mark.parametrize(
    ("times", "instants"),
    [
        ({"start": 0, "stop": 0.3, "step": 0.1}, [0.0, 0.1, 0.2, 0.3]),
        ({"start": -1, "stop": 0.9, "step": 1}, [-1.0, 0.0]),
        ({"start": 2, "stop": 2}, [2.0]),
        ([3.0, 1.0, 2.5], [3.0, 1.0, 2.5]),
    ],
    ids=["tenths", "stop_between_steps", "one", "list"],
)
def test_times_are_a_range_with_both_ends_or_a_list(ask: Asking, times: Any, instants: list[float]) -> None:
    assert ask("trajectory", SMALL | {"times": times})["time"] == pytest.approx(instants, rel=1e-15)


def test_decimals_round_all_but_the_time(ask: Asking) -> None:
    request = SMALL | {"times": [0.123456789], "path": {"start_turns": 8}}
    full, rounded = (ask("trajectory", request | extra) for extra in ({}, {"decimals": 2}))
    assert rounded["time"] == [0.123456789]
    for name in ("x", "y", "speed"):
        assert rounded[name][0] == pytest.approx(full[name][0], abs=0.005)
        assert all(value == round(value, 2) and str(value) != "-0.0" for value in rounded[name][0])


def test_trajectory_comes_as_csv_and_workbook_with_the_same_numbers(ask: Asking) -> None:
    table, text = ask("trajectory", SMALL), ask.send("trajectory", SMALL, f"{CSV_TYPE}, */*;q=0.5")
    assert text.headers["content-type"].startswith(CSV_TYPE)
    rows = list(csv.DictReader(io.StringIO(text.text)))
    assert [float(row["x"]) for row in rows] == [x for instant in table["x"] for x in instant]
    workbook = ask.send("trajectory", SMALL, XLSX_TYPE)
    assert workbook.headers["content-type"] == XLSX_TYPE
    assert openpyxl.load_workbook(io.BytesIO(workbook.content)).worksheets[1].cell(2, 2).value == 1.0


def test_trajectory_comes_as_arrow_where_pyarrow_is_installed(ask: Asking) -> None:
    pyarrow = pytest.importorskip("pyarrow")
    table = pyarrow.ipc.open_file(ask.file("trajectory", SMALL, ARROW_TYPE)).read_all()
    assert table["speed"][0].as_py() == 1.0


# -- contacts and their cross-checks -------------------------------------------------------------------------


def test_a_margin_is_reached_before_contact_and_judged_by_the_engines_that_know_margins(ask: Asking) -> None:
    answer, touch = ask("collision-time", margin=0.05), ask("collision-time")
    assert answer["time"] < touch["time"]
    assert touch["outcome"] == "contact"
    check = answer["cross_check"]
    assert (check["agree"], check["left_out"]) == (True, ["angle_sum"])
    assert set(check["engines"]) == ENGINES - {"angle_sum"}


@pytest.mark.parametrize(
    ("call", "pair"), [("collision-time", [0, 8]), ("minimum-pitch", [0, 19])], ids=["time", "pitch"]
)
def test_the_engines_judge_the_whole_dragon_the_pair_or_nobody(ask: Asking, call: str, pair: list[int]) -> None:
    dragon, both, nobody = (ask(call, cross_check=whom) for whom in ("dragon", "pair", "none"))
    assert ask(call) == dragon
    assert dragon["benches"] == both["cross_check"]["judged"] == pair
    assert dragon["cross_check"]["judged"] == list(range(223))
    assert nobody["cross_check"] is None
    for check in (dragon["cross_check"], both["cross_check"]):
        assert list(check) == ["agree", "judged", "engines", "together", "left_out"]
        assert check["agree"]
        assert check["engines"] == {name: {"before": False, "after": True} for name in ENGINES}
        assert check["together"] == check["left_out"] == []
    for answer in (both, nobody):
        assert answer | {"cross_check": None} == dragon | {"cross_check": None}


def test_a_scan_of_pitches_answers_its_samples_and_the_jumps_besides(ask: Asking) -> None:
    scan, look = (ask("pitch-scan", benches=40, samples=3, locate=locate) for locate in (True, False))
    assert len(scan["pitch"]) == len(scan["radius"]) == 3
    assert scan["pieces"] == [[0, 1], [1, 2], [2, 3]]
    assert len(scan["jumps"]) > 10
    for jump in scan["jumps"]:
        assert 0.0 < jump["pitch"][1] - jump["pitch"][0] <= 1e-6
        assert abs(jump["radius"][1] - jump["radius"][0]) > 0.02
    assert (look["pitch"], look["jumps"]) == (scan["pitch"], [])


def test_a_contact_at_the_start_has_no_before(ask: Asking) -> None:
    answer = ask("collision-time", pitch=0.25, start_turns=8, benches=60)
    assert (answer["outcome"], answer["cross_check"]["agree"]) == ("contact_at_start", True)
    assert answer["cross_check"]["engines"] == {name: {"before": None, "after": True} for name in ENGINES}


def test_of_a_long_dragon_the_benches_near_the_pair_are_judged(ask: Asking) -> None:
    check = ask("collision-time", benches=100_000)["cross_check"]
    assert check["agree"]
    assert {0, 8} < set(check["judged"])
    assert len(check["judged"]) < 2_000


def test_overlaps_gives_depth_witnesses_and_each_engines_pairs(ask: Asking) -> None:
    body = ask("overlaps", {"benches": CROSSED})
    (overlap,) = body["overlaps"]
    assert overlap["benches"] == [0, 2]
    for a, b, n in zip(overlap["witness_a"], overlap["witness_b"], overlap["normal"], strict=True):
        assert b - a == pytest.approx(overlap["separation"] * n, abs=1e-12)
    engines = body["cross_check"]["engines"]
    # No corner lies inside the other bench, so the angle sum cannot see this crossing.
    assert engines == {name: [[0, 2]] for name in ENGINES} | {"angle_sum": []}
    assert not body["cross_check"]["agree"]


def test_chained_benches_have_neighbours_that_are_never_checked(ask: Asking) -> None:
    pair = {"benches": [CROSSED[0], CROSSED[2]]}
    assert ask("overlaps", pair)["overlaps"] == []
    assert len(ask("overlaps", pair | {"chained": False})["overlaps"]) == 1


@pytest.mark.parametrize("call", GETS[:3])
def test_every_number_is_finite(ask: Asking, call: str) -> None:
    assert not re.search(r"\b(NaN|Infinity)\b", ask.file(call).decode())
    if call == "clearance":
        assert None not in set(numbers(ask(call)))


# -- HTTP ----------------------------------------------------------------------------------------------------


ON_LANE = {"dragon": {"benches": 4}, "path": line((0, 0), (60, 0))}


@pytest.mark.parametrize(
    ("call", "body"),
    [
        *((call, None) for call in GETS),
        ("check", ON_LANE),
        ("clearance", ON_LANE | {"times": [20.0]}),
        ("figures/trajectory.svg", ON_LANE | {"time": 20.0}),
    ],
)
def test_an_answer_that_the_client_has_is_not_sent_again(ask: Asking, call: str, body: Any) -> None:
    first = ask.send(call, body)
    tag = first.headers["etag"]
    assert re.fullmatch(r'"[0-9a-f]{32}"', tag)
    assert re.fullmatch(r"public, max-age=\d+", first.headers["cache-control"])
    method = "POST" if body else "GET"
    again, other = (
        ask.client.request(method, call, json=body, headers={"If-None-Match": tags})
        for tags in (f'"other", W/{tag}', '"other"')
    )
    assert (again.status_code, again.content, again.headers["etag"]) == (304, b"", tag)
    assert other.content == first.content
    if body:
        assert ask.send(call, body | {"head_speed": 1.1}).headers["etag"] != tag


def test_the_tag_follows_the_values_and_the_form_and_nothing_else(ask: Asking) -> None:
    def tag(call: str, *body: Any) -> str:
        return ask.send(call, *body).headers["etag"]

    assert tag("clearance?stop=1") == tag("clearance?stop=1.0&pitch=0.55&step=1")
    assert tag("clearance?stop=1") != tag("clearance?stop=2")
    posted = ask.send("trajectory", SMALL)
    assert posted.headers["vary"] == "Accept, Accept-Encoding"
    assert posted.headers["etag"] != tag("trajectory", SMALL, CSV_TYPE)
    assert posted.headers["etag"] == tag("trajectory", {"path": {"kind": "spiral", "pitch": 0.55}, **SMALL})


@pytest.mark.parametrize("path", ["/healthz", "/collision-time", "/docs", "/"])
@pytest.mark.parametrize("taken", ["identity", "gzip"])
def test_head_has_the_headers_of_get_and_no_body(client: httpx.Client, path: str, taken: str) -> None:
    accept = {"Accept-Encoding": taken}
    head = client.head(path, headers=accept)
    with client.stream("GET", path, headers=accept) as get:
        sent = len(b"".join(get.iter_raw()))
    assert (head.status_code, head.content) == (200, b"")
    assert head.headers["content-length"] == get.headers["content-length"] == str(sent)


@pytest.mark.parametrize(("path", "allowed"), [("/overlaps", "OPTIONS, POST"), ("/paper", "GET, HEAD, OPTIONS")])
def test_options_names_the_methods(client: httpx.Client, path: str, allowed: str) -> None:
    answer = client.options(path)
    assert (answer.status_code, answer.headers["allow"]) == (204, allowed)


def test_the_service_is_alive_and_ready(ask: Asking) -> None:
    assert ask("healthz") == {"status": "ok"}
    assert ask("readyz") == {"status": "ready"}
    assert ask.send("readyz").headers["cache-control"] == "no-store"


def test_metrics_count_requests_by_path_and_status(ask: Asking) -> None:
    def refused_count() -> float:
        pattern = r'^bench_dragon_requests_total\{path="/clearance",status="422"\} (\S+)$'
        match = re.search(pattern, ask.send("metrics").text, re.MULTILINE)
        return float(match[1]) if match else 0.0

    before = refused_count()
    ask.send("clearance?pitch=55")
    assert refused_count() == before + 1


@pytest.mark.parametrize("path", ["/", "/docs"])
def test_pages_load_from_this_service_alone(client: httpx.Client, path: str) -> None:
    page = client.get(path)
    assert page.headers["content-security-policy"].startswith("default-src 'self'")
    assert "<script>" not in page.text
    links = re.findall(r'(?:src|href)="([^"]+)"', page.text)
    assert links
    assert not [link for link in links if "//" in link]
    for link in links:
        assert client.get(urljoin(path, link)).status_code == 200, link


@pytest.mark.parametrize(
    "call", few(["trajectory?benches=20", "contact?benches=40", "pitch-scan?samples=2&benches=20"], 1)
)
def test_figures_come_as_svg_and_png(ask: Asking, call: str) -> None:
    name, _, query = call.partition("?")
    for form, kind, begin in (("svg", "image/svg+xml", b"<?xml"), ("png", "image/png", PNG_SIGNATURE)):
        drawn = ask.send(f"figures/{name}.{form}?{query}")
        assert (drawn.headers["content-type"], drawn.content[: len(begin)]) == (kind, begin)


def test_a_dance_without_contact_is_drawn_too(ask: Asking) -> None:
    assert ask("collision-time", pitch=1.7)["outcome"] == "clear"
    assert "No contact" in ask.send("figures/contact.svg", pitch=1.7).text


def test_tags_depend_on_the_installed_libraries(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    before = build.__wrapped__()
    assert build.__wrapped__() == before
    (tmp_path / "matplotlib-99.0.dist-info").mkdir()
    monkeypatch.syspath_prepend(tmp_path)
    assert build.__wrapped__() != before
