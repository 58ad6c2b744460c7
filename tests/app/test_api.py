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

SMALL: dict[str, Any] = {"dragon": {"benches": 3}, "times": [0.0, 1.5]}
GETS = ("/collision-time", "/minimum-pitch", "/clearance", "/paper", "/figures/trajectory.svg", "/figures/contact.png")
# Two benches that cross in the middle of both, and a third apart.
CROSSED = {
    "benches": [
        {"x": 0, "y": 0, "heading": 0, "length": 2, "width": 0.3},
        {"x": 9, "y": 9, "heading": 0, "length": 2, "width": 0.3},
        {"x": 0.2, "y": 0.1, "heading": math.pi / 2, "length": 2, "width": 0.3},
    ]
}
ENGINES = {"separating_axis", "fcl", "shapely", "angle_sum"}


def numbers(value: Any) -> Iterator[Any]:
    if isinstance(value, (dict, list)):
        for part in value.values() if isinstance(value, dict) else value:
            yield from numbers(part)
    else:
        yield value


def test_trajectory_answers_columns_with_a_row_for_each_instant_and_an_entry_for_each_handle(
    client: httpx.Client,
) -> None:
    table = client.post("/trajectory", json=SMALL).json()
    assert list(table) == ["time", "x", "y", "speed"]
    assert table["time"] == [0.0, 1.5]
    assert [len(row) for name in ("x", "y", "speed") for row in table[name]] == [4] * 6
    assert [row[0] for row in table["speed"]] == pytest.approx([1.0, 1.0], rel=1e-15)


def test_trajectory_without_a_body_is_the_default_one(client: httpx.Client) -> None:
    assert client.post("/trajectory").content == client.post("/trajectory", json={}).content


def test_a_uniform_dragon_given_bench_by_bench_moves_alike(client: httpx.Client) -> None:
    lists = {"lengths": [3.41, 2.2, 2.2], "widths": [0.3] * 3, "overhangs": [0.275] * 3}
    listed = client.post("/trajectory", json=SMALL | {"dragon": lists})
    assert listed.json() == client.post("/trajectory", json=SMALL).json()


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
def test_times_are_a_range_with_both_ends_or_a_list(client: httpx.Client, times: Any, instants: list[float]) -> None:
    got = client.post("/trajectory", json=SMALL | {"times": times}).json()["time"]
    assert got == pytest.approx(instants, rel=1e-15)


def test_decimals_round_all_but_the_time(client: httpx.Client) -> None:
    request = SMALL | {"times": [0.123456789], "path": {"start_turns": 8}}
    full, rounded = (client.post("/trajectory", json=request | extra).json() for extra in ({}, {"decimals": 2}))
    assert rounded["time"] == [0.123456789]
    for name in ("x", "y", "speed"):
        assert rounded[name][0] == pytest.approx(full[name][0], abs=0.005)
        assert all(value == round(value, 2) and str(value) != "-0.0" for value in rounded[name][0])


def test_trajectory_comes_as_csv_and_workbook_with_the_same_numbers(client: httpx.Client) -> None:
    table = client.post("/trajectory", json=SMALL).json()
    answer = client.post("/trajectory", json=SMALL, headers={"Accept": f"{CSV_TYPE}, */*;q=0.5"})
    assert answer.headers["content-type"].startswith(CSV_TYPE)
    rows = list(csv.DictReader(io.StringIO(answer.text)))
    assert [float(row["x"]) for row in rows] == [x for instant in table["x"] for x in instant]
    answer = client.post("/trajectory", json=SMALL, headers={"Accept": XLSX_TYPE})
    assert answer.headers["content-type"] == XLSX_TYPE
    sheet = openpyxl.load_workbook(io.BytesIO(answer.content)).worksheets[1]
    assert sheet.cell(2, 2).value == 1.0


def test_trajectory_comes_as_arrow_where_pyarrow_is_installed(client: httpx.Client) -> None:
    pyarrow = pytest.importorskip("pyarrow")
    answer = client.post("/trajectory", json=SMALL, headers={"Accept": ARROW_TYPE})
    assert pyarrow.ipc.open_file(answer.content).read_all()["speed"][0].as_py() == 1.0


def test_clearance_names_the_pair_that_is_nearest(client: httpx.Client) -> None:
    table = client.get("/clearance", params={"start": 412, "stop": 413, "step": 0.5}).json()
    assert table["time"] == [412.0, 412.5, 413.0]
    assert [clearance > 0 for clearance in table["clearance"]] == [True, False, False]
    assert table["benches"][1] == [0, 8]


def test_a_collision_is_an_answer_with_the_word_of_four_engines(client: httpx.Client) -> None:
    answer = client.get("/collision-time", params={"pitch": 0.55})
    assert answer.status_code == 200
    assert answer.json()["outcome"] == "contact"
    assert answer.json()["cross_check"]["agree"]
    assert set(answer.json()["cross_check"]["engines"]) == ENGINES


def test_a_margin_is_reached_before_contact_and_judged_by_the_engines_that_know_margins(client: httpx.Client) -> None:
    answer = client.get("/collision-time", params={"margin": 0.05}).json()
    assert answer["time"] < client.get("/collision-time").json()["time"]
    assert answer["cross_check"]["agree"]
    assert set(answer["cross_check"]["engines"]) == ENGINES - {"angle_sum"}
    assert answer["cross_check"]["left_out"] == ["angle_sum"]


@pytest.mark.parametrize(
    ("call", "pair"), [("/collision-time", [0, 8]), ("/minimum-pitch", [0, 19])], ids=["time", "pitch"]
)
def test_the_engines_judge_the_whole_dragon_the_pair_or_nobody(
    client: httpx.Client, call: str, pair: list[int]
) -> None:
    default, dragon, both, nobody = (
        client.get(call, params=query).raise_for_status().json()
        for query in ({}, {"cross_check": "dragon"}, {"cross_check": "pair"}, {"cross_check": "none"})
    )
    assert default == dragon
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


def test_a_cross_check_of_anybody_else_is_refused(client: httpx.Client) -> None:
    refused = client.get("/collision-time?cross_check=everybody")
    assert refused.status_code == 422
    assert refused.json()["detail"] == 'cross_check must be "dragon", "pair" or "none", got "everybody"'
    refused = client.post("/check", json={"cross_check": None})
    assert (refused.status_code, refused.json()["errors"][0]["pointer"]) == (422, "/cross_check")
    for call in ("/pitch-scan", "/clearance", "/figures/contact.svg"):
        assert client.get(call, params={"cross_check": "pair"}).status_code == 422


def test_a_scan_of_pitches_answers_its_samples_and_the_jumps_besides(client: httpx.Client) -> None:
    request = {"benches": 40, "samples": 3}
    scan, look = (client.get("/pitch-scan", params=request | {"locate": locate}).json() for locate in (True, False))
    assert len(scan["pitch"]) == len(scan["radius"]) == 3
    assert scan["pieces"] == [[0, 1], [1, 2], [2, 3]]
    assert len(scan["jumps"]) > 10
    for jump in scan["jumps"]:
        assert 0.0 < jump["pitch"][1] - jump["pitch"][0] <= 1e-6
        assert abs(jump["radius"][1] - jump["radius"][0]) > 0.02
    assert (look["pitch"], look["jumps"]) == (scan["pitch"], [])


def test_a_contact_at_the_start_has_no_before(client: httpx.Client) -> None:
    answer = client.get("/collision-time?pitch=0.25&start_turns=8&benches=60").json()
    assert answer["outcome"] == "contact_at_start"
    assert answer["cross_check"]["agree"]
    assert answer["cross_check"]["engines"] == {name: {"before": None, "after": True} for name in ENGINES}


def test_of_a_long_dragon_the_benches_near_the_pair_are_judged(client: httpx.Client) -> None:
    check = client.get("/collision-time?benches=100000").json()["cross_check"]
    assert check["agree"]
    assert {0, 8} < set(check["judged"])
    assert len(check["judged"]) < 2_000


def test_overlaps_gives_depth_witnesses_and_each_engines_pairs(client: httpx.Client) -> None:
    body = client.post("/overlaps", json=CROSSED).raise_for_status().json()
    (overlap,) = body["overlaps"]
    assert overlap["benches"] == [0, 2]
    for a, b, n in zip(overlap["witness_a"], overlap["witness_b"], overlap["normal"], strict=True):
        assert b - a == pytest.approx(overlap["separation"] * n, abs=1e-12)
    engines = body["cross_check"]["engines"]
    assert set(engines) == ENGINES
    # No corner lies inside the other bench, so the angle sum cannot see this crossing.
    assert engines.pop("angle_sum") == []
    assert not body["cross_check"]["agree"]
    assert set(map(str, engines.values())) == {"[[0, 2]]"}


def test_chained_benches_have_neighbours_that_are_never_checked(client: httpx.Client) -> None:
    pair = {"benches": [CROSSED["benches"][0], CROSSED["benches"][2]]}
    assert client.post("/overlaps", json=pair).json()["overlaps"] == []
    assert len(client.post("/overlaps", json=pair | {"chained": False}).json()["overlaps"]) == 1


@pytest.mark.parametrize("path", ["/collision-time", "/minimum-pitch", "/clearance", "/paper"])
def test_every_number_is_finite(client: httpx.Client, path: str) -> None:
    text = client.get(path).raise_for_status().text
    assert not re.search(r"\b(NaN|Infinity)\b", text)
    if path == "/clearance":
        assert None not in set(numbers(client.get(path).json()))


@pytest.mark.parametrize("path", GETS)
def test_an_answer_that_the_client_has_is_not_sent_again(client: httpx.Client, path: str) -> None:
    first = client.get(path)
    tag = first.headers["etag"]
    assert re.fullmatch(r'"[0-9a-f]{32}"', tag)
    assert re.fullmatch(r"public, max-age=\d+", first.headers["cache-control"])
    again = client.get(path, headers={"If-None-Match": f'"other", W/{tag}'})
    assert (again.status_code, again.content, again.headers["etag"]) == (304, b"", tag)
    assert client.get(path, headers={"If-None-Match": '"other"'}).content == first.content


def test_the_tag_follows_the_values_and_the_form_and_nothing_else(client: httpx.Client) -> None:
    def tag(query: str, **headers: str) -> str:
        return client.get(f"/clearance?{query}", headers=headers).headers["etag"]

    assert tag("stop=1") == tag("stop=1.0&pitch=0.55&step=1")
    assert tag("stop=1") != tag("stop=2")
    posts = [client.post("/trajectory", json=SMALL, headers={"Accept": kind}) for kind in ("*/*", CSV_TYPE)]
    assert posts[0].headers["etag"] != posts[1].headers["etag"]
    assert posts[0].headers["vary"] == "Accept, Accept-Encoding"
    spelled = {"path": {"kind": "spiral", "pitch": 0.55}, **SMALL}
    assert client.post("/trajectory", json=spelled).headers["etag"] == posts[0].headers["etag"]


@pytest.mark.parametrize("path", ["/healthz", "/collision-time", "/docs", "/"])
def test_head_has_the_headers_of_get_and_no_body(client: httpx.Client, path: str) -> None:
    for taken in ("identity", "gzip"):
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


def test_the_service_is_alive_and_ready(client: httpx.Client) -> None:
    assert client.get("/healthz").json() == {"status": "ok"}
    assert client.get("/readyz").json() == {"status": "ready"}
    assert client.get("/readyz").headers["cache-control"] == "no-store"


def test_metrics_count_requests_by_path_and_status(client: httpx.Client) -> None:
    def refused_count() -> float:
        pattern = r'^bench_dragon_requests_total\{path="/clearance",status="422"\} (\S+)$'
        match = re.search(pattern, client.get("/metrics").text, re.MULTILINE)
        return float(match[1]) if match else 0.0

    before = refused_count()
    client.get("/clearance?pitch=55")
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


@pytest.mark.parametrize("name", ["trajectory", "contact", "pitch-scan"])
def test_figures_come_as_svg_and_png(client: httpx.Client, name: str) -> None:
    query = {"samples": 2} if name == "pitch-scan" else {}
    svg = client.get(f"/figures/{name}.svg", params=query)
    png = client.get(f"/figures/{name}.png", params=query)
    assert (svg.headers["content-type"], svg.content[:5]) == ("image/svg+xml", b"<?xml")
    assert (png.headers["content-type"], png.content[:4]) == ("image/png", b"\x89PNG")


def test_a_dance_without_contact_is_drawn_too(client: httpx.Client) -> None:
    assert client.get("/collision-time", params={"pitch": 1.7}).json()["outcome"] == "clear"
    assert "No contact" in client.get("/figures/contact.svg", params={"pitch": 1.7}).raise_for_status().text


def test_paper_gives_a_reason_for_each_number(client: httpx.Client) -> None:
    rows = client.get("/paper").json()["rows"]
    assert [row["paper"] for row in rows] == [442.590256, 406.43, 2.883, 0.474924]
    assert all(row["reason"] and row["difference"] == row["ours"] - row["paper"] for row in rows)


def test_tags_depend_on_the_installed_libraries(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    before = build.__wrapped__()
    assert build.__wrapped__() == before
    (tmp_path / "matplotlib-99.0.dist-info").mkdir()
    monkeypatch.syspath_prepend(tmp_path)
    assert build.__wrapped__() != before
