"""The plan on paper, opened again by another program: true to scale, words that can be found, fonts within."""

from __future__ import annotations

import ctypes
import json
import re
from pathlib import Path
from typing import Any

import httpx
import numpy as np
import pypdfium2
import pypdfium2.raw as pdfium
import pytest
from matplotlib import font_manager

from app.files import fonts
from app.plan.sheet import MARGIN, RATIOS, scale_of
from app.questions.plan import PDF_TYPE, PlanRequest
from app.questions.plan import QUESTION as PLAN
from app.wire.messages import checked
from app.wire.question import Terms
from core import InvalidValue
from tests.support.command import run

# Millimetres in a point of PDF, and how well a place on paper is known [mm].
POINT, ON_PAPER = 25.4 / 72.0, 0.02
SQUARE = [[[-5, -12], [45, -12], [45, 12], [-5, 12], [-5, -12]]]
KIOSK = [[[20, 4], [26, 4], [26, 8], [20, 8], [20, 4]]]
BODY: dict[str, Any] = {
    "dragon": {"benches": 6},
    "path": {"kind": "route", "pieces": [{"kind": "line", "start": [0, 0], "end": [40, 0]}]},
    "venue": {"type": "FeatureCollection", "origin": {"longitude": 120.1, "latitude": 30.2}, "features": [
        {"type": "Feature", "properties": {"name": name}, "geometry": {"type": "Polygon", "coordinates": rings}}
        for name, rings in (("square", SQUARE), ("kiosk", KIOSK))
    ]},
    "margin": 0.3,
    "title": "Lantern night",
}  # fmt: skip


@pytest.fixture(scope="module")
def data(client: httpx.Client) -> bytes:
    answer = client.post("/plan", json=BODY).raise_for_status()
    assert answer.headers["content-type"] == "application/pdf"
    return answer.content


@pytest.fixture
def pages(data: bytes) -> Any:
    return list(pypdfium2.PdfDocument(data))


def words(page: Any) -> str:
    return str(page.get_textpage().get_text_bounded())


def size(page: Any) -> list[float]:
    return [POINT * side for side in page.get_size()]


def boxes(page: Any) -> np.ndarray[Any, Any]:
    """Boxes (N, 4) of all drawn shapes: left, bottom, right, top [mm]."""
    shapes = page.get_objects(filter=[pdfium.FPDF_PAGEOBJ_PATH])
    return POINT * np.array([one.get_bounds() for one in shapes])


def holds_box(page: Any, width: float, height: float) -> bool:
    result = boxes(page)
    sizes = result[:, 2:] - result[:, :2]
    # The bounds of a shape hold the line around it, too.
    return bool((np.abs(sizes - [width, height]) < 0.9).all(axis=1).any())


def test_ten_metres_are_fifty_millimetres_at_one_to_two_hundred(pages: Any) -> None:
    assert size(pages[0]) == pytest.approx([297.0, 210.0], abs=0.01)
    assert "1:200" in words(pages[0])
    result = boxes(pages[0])
    sizes = result[:, 2:] - result[:, :2]
    # The black half of the scale bar is 5 m long, without a line around it.
    assert np.abs(sizes - [25.0, 1.6]).max(axis=1).min() < ON_PAPER
    # Above the title block the nine marks, 2.2 mm high and as wide as their lines, stand every 5 m.
    ticks = result[(np.abs(sizes[:, 1] - 2.6) < 0.1) & (sizes[:, 0] < 0.5) & (result[:, 1] > 45.0)]
    assert np.diff(np.sort(ticks[:, 0])) == pytest.approx(np.full(8, 25.0), abs=ON_PAPER)
    # The kiosk: 6 m by 4 m; the square: 50 m by 24 m.
    assert holds_box(pages[0], 30.0, 20.0)
    assert holds_box(pages[0], 250.0, 120.0)


def test_all_that_is_promised_can_be_found_as_words(pages: Any) -> None:
    texts = [words(page) for page in pages]
    assert len(pages) == 5
    for word in ("Lantern night", "kiosk", "N", "keep clear, 0.3 m", "chalk mark every 5 m", "Checked: passes", "1/5"):
        assert word in texts[0]
    for k, time in enumerate(("0:11.1", "0:25.6", "0:40.0")):
        assert f"Place of each bench at {time}" in texts[1 + k]
    tables = " ".join(texts[4].split())
    # The dragon is 2.86 + 5 x 1.65 = 11.11 m long, and goes the 28.89 m to the end at 1 m/s.
    assert "the dance begins, head at 11.1 m 0:11.1" in tables
    assert "the dance ends, head at 40.0 m 0:40.0" in tables
    # The tail is 11.11 s behind the head, and at the end of the dance 11.11 m before it.
    assert "25 0:25.0 0:36.1" in tables
    assert "30 0:30.0 –" in tables
    assert "30 30.000 0.000" in tables


def test_every_font_is_in_the_file(pages: Any) -> None:
    for page in pages:
        used = [one.get_font() for one in page.get_objects(filter=[pdfium.FPDF_PAGEOBJ_TEXT])]
        assert used
        assert all(font.is_embedded for font in used)


def test_fonts_are_true_type(data: bytes) -> None:
    assert b"/FontFile2" in data
    assert b"/Type3" not in data


def test_no_words_are_painted_over(pages: Any) -> None:
    drawn = list(pages[-1].get_objects())
    complete = (ctypes.c_uint * 4)()
    bands = []
    for k, one in enumerate(drawn):
        if one.type == pdfium.FPDF_PAGEOBJ_PATH and pdfium.FPDFPageObj_GetFillColor(
            one.raw, *(ctypes.cast(ctypes.byref(complete, 4 * i), ctypes.POINTER(ctypes.c_uint)) for i in range(4))
        ):
            bands += [k] if tuple(complete[:3]) == (242, 242, 242) else []
    assert len(bands) > 10
    assert max(bands) < min(k for k, one in enumerate(drawn) if one.type == pdfium.FPDF_PAGEOBJ_TEXT)


def test_nothing_leaves_the_paper_and_no_sheet_is_empty(pages: Any) -> None:
    for page in pages:
        text = page.get_textpage()
        rects = POINT * np.array([text.get_rect(k) for k in range(text.count_rects())])
        wide, high = size(page)
        assert len(rects) > 20
        assert (rects[:, :2] > MARGIN - 0.5).all()
        assert (rects[:, 2:] < [wide - MARGIN + 0.5, high - MARGIN + 0.5]).all()


def test_a_path_that_goes_on_beyond_the_map_ends_at_its_frame(client: httpx.Client) -> None:
    body = {"dragon": {"benches": 6}, "path": {"kind": "turn", "pitch": 1.7}, "start": -20, "stop": 20}
    page = pypdfium2.PdfDocument(client.post("/plan", json=body).raise_for_status().content)[0]
    dots = 2.0  # in a millimetre
    picture = page.render(scale=dots * POINT).to_numpy()[..., :3]
    edge = int(dots * (MARGIN - 1.0))
    inner = picture[edge:-edge, edge:-edge]
    assert inner.min() < 100
    blank = picture.copy()
    blank[edge:-edge, edge:-edge] = 255
    assert blank.min() == 255


@pytest.mark.chinese_font
def test_a_plan_in_chinese_on_a3_is_the_same_from_a_terminal(client: httpx.Client, tmp_path: Path) -> None:
    with_names = BODY | {
        "dragon": {"benches": 6, "names": ["龙头组", "王家", "", "", "", "李家"]},
        "start_clock": "19:30",
    }
    body = with_names | {"language": "zh", "paper": "A3", "title": "板凳龙 2027"}
    data = client.post("/plan", json=body).raise_for_status().content
    file = tmp_path / "dance.json"
    file.write_text(json.dumps(with_names))
    output = tmp_path / "plan.pdf"
    done = run(
        "plan", str(file), "--output", str(output), "--language", "zh", "--paper", "A3", "--title", "板凳龙 2027"
    )
    assert (done.returncode, done.stderr) == (0, f"{output}\n")
    assert output.read_bytes() == data
    pages = list(pypdfium2.PdfDocument(data))
    page, table = pages[0], " ".join(words(pages[4]).split())
    assert "1 王家 19:30:13" in table
    assert "40.0 m 19:30:40" in table
    assert "5 李家" in words(pages[1])
    assert size(page) == pytest.approx([420.0, 297.0], abs=0.01)
    assert all(word in words(page) for word in ("板凳龙 2027", "保持清空", "检查：通过", "1:200"))
    assert holds_box(page, 30.0, 20.0)


def test_a_gate_stands_on_the_map_and_has_the_times_of_head_and_tail(client: httpx.Client, tmp_path: Path) -> None:
    # The head is at x = t, the last handle 2.86 + 5 1.65 m behind it.
    gates = [{"name": "north gate", "x": 21.3, "y": 2.0}]
    data = client.post("/plan", json=BODY | {"gates": gates}).raise_for_status().content
    pages = list(pypdfium2.PdfDocument(data))
    assert "north gate" in words(pages[0])
    table = " ".join(words(pages[-1]).split())
    for text in ("Head and tail at the gates", "north gate", "21.3 m", "0:21.3", "0:32.4"):
        assert text in table
    file = tmp_path / "dance.json"
    file.write_text(json.dumps(BODY))
    run("plan", str(file), "--gate", "north gate,21.3,2", "--output", str(tmp_path / "plan.pdf"))
    assert (tmp_path / "plan.pdf").read_bytes() == data
    refused = client.post("/plan", json=BODY | {"gates": [{"name": "far", "x": 21.3, "y": 8}]})
    assert refused.status_code == 422
    assert refused.json()["detail"] == "gates[0] must be within 5 m of the path that the dragon walks, got 'far'"


def test_the_name_of_a_square_stands_in_no_street(client: httpx.Client) -> None:
    # A square of 20 m with a street of 60 m.
    ring = [[-70, -3], [-10, -3], [-10, -10], [10, -10], [10, 10], [-10, 10], [-10, 3], [-70, 3], [-70, -3]]
    geometry = {"type": "Polygon", "coordinates": [ring]}
    venue = {"type": "Feature", "properties": {"name": "threshing floor"}, "geometry": geometry}
    path = {"kind": "waypoints", "points": [[-68, 0], [8, 0]], "straight": [0]}
    body = {"dragon": {"benches": 5}, "path": path, "venue": {"type": "FeatureCollection", "features": [venue]}}
    data = client.post("/plan", json=body).raise_for_status().content
    page = pypdfium2.PdfDocument(data)[0]
    text = page.get_textpage()
    name = text.get_charbox(text.search("threshing floor").get_next()[0])
    # The street is left of the square, which is the last quarter of the ground.
    shapes = boxes(page)
    assert POINT * name[0] > 0.5 * (shapes[:, 0].min() + shapes[:, 2].max())


def test_a_spiral_has_its_radius_and_angle_and_its_failure_in_the_title(client: httpx.Client) -> None:
    body = {"dragon": {"benches": 9}, "path": {"kind": "spiral", "pitch": 0.4, "start_turns": 6, "centre": [9, 9]}}
    pages = list(pypdfium2.PdfDocument(client.post("/plan", json=body | {"spacing": 10}).raise_for_status().content))
    assert "Checked: benches touch or are too near at 0:" in words(pages[0])
    # The head starts at 2.4 m from the centre, at 0 degrees.
    assert "11.400 9.000 2.400 0.00" in " ".join(words(pages[-1]).split())


def test_a_square_from_a_survey_says_where_its_origin_is(client: httpx.Client) -> None:
    line = "x = y = 0 is x 499950 m, y 3170000.25 m of the survey grid"
    square = {"type": "Polygon", "coordinates": [[[-20, -20], [20, -20], [20, 20], [-20, 20], [-20, -20]]]}
    body = {"dragon": {"benches": 9}, "path": {"kind": "spiral", "pitch": 1.0, "start_turns": 6}, "venue": square}
    pages = pypdfium2.PdfDocument(client.post("/plan", json=body).raise_for_status().content)
    assert line not in words(pages[0])
    body["venue"] = square | {"grid": {"x": 499_950.0, "y": 3_170_000.25}}
    pages = pypdfium2.PdfDocument(client.post("/plan", json=body).raise_for_status().content)
    assert line in words(pages[0])


def test_the_largest_scale_that_fits_is_taken_and_none_is_refused() -> None:
    box = np.zeros(2), np.array([50.0, 20.0])
    assert (scale_of("A4", *box).ratio, scale_of("A3", *box).ratio) == (200, 200)
    turned = scale_of("A4", np.zeros(2), np.array([17.0, 22.0]))
    assert (turned.ratio, turned.paper.width) == (100, 210.0)
    assert turned.on_paper(np.array([8.5, 11.0])) == pytest.approx([105.0, 10.0 + 30.0 + (297.0 - 50.0) / 2.0])
    with pytest.raises(InvalidValue, match=f"to fit on A4 at 1:{RATIOS[-1]}"):
        scale_of("A4", np.zeros(2), np.array([1e5, 1.0]))


def test_a_wrong_paper_and_too_many_marks_are_refused(client: httpx.Client) -> None:
    wrong = client.post("/plan", json=BODY | {"paper": "A5"})
    assert (wrong.status_code, wrong.json()["errors"][0]["pointer"]) == (422, "/paper")
    many = client.post("/plan", json={"spacing": 0.5, "path": {"pitch": 5, "start_turns": 30}})
    assert (many.status_code, many.json()["errors"][0]["pointer"]) == (422, "/spacing")
    assert "marks must be at most 2000 here" in many.json()["detail"]


def test_a_font_that_is_gone_or_broken_draws_nothing(tmp_path: Path) -> None:
    (tmp_path / "broken.ttf").write_bytes(b"no font")
    for name in ("gone.ttf", "broken.ttf"):
        assert not fonts.draws_our_words(font_manager.FontEntry(fname=str(tmp_path / name), name="Noto Sans CJK SC"))


# -- several dances ------------------------------------------------------------------------------------------

LANES = [{"kind": "waypoints", "points": points} for points in ([[-30, 0], [30, 0]], [[0, -30], [0, 30]])]
TWO: dict[str, Any] = {
    "dances": [
        {"name": "Long", "dragon": {"benches": 5, "names": ["Zhou", "Wu", "Zheng", "Wang", "Feng"]}, "path": LANES[0]},
        {"name": "North", "delay": 40, "dragon": {"benches": 4}, "path": LANES[1]},
    ],
    "venue": {"type": "Polygon", "coordinates": [[[-35, -35], [35, -35], [35, 35], [-35, 35], [-35, -35]]]},
    "gates": [{"name": "south gate", "x": 0, "y": -20}],
    "title": "Lanterns",
    "margin": 0.3,
}


def printed(body: dict[str, Any]) -> bytes:
    """The plan, which the deadline of the service does not end."""
    return PLAN.to_bytes(checked(PlanRequest, body), Terms(), PDF_TYPE)


def several_pages(**more: Any) -> Any:
    return list(pypdfium2.PdfDocument(printed(TWO | more)))


def test_the_plan_of_several_shows_all_of_them_and_then_each() -> None:
    sheets = [words(page) for page in several_pages()]
    for sheet in sheets[:4]:
        for word in ("Long", "North", "2 dragons, 9 benches", "south gate", "Checked: passes", "from 0:"):
            assert word in sheet
    assert "Place of each bench at" in sheets[1]
    first = next(k for k, sheet in enumerate(sheets) if "Lanterns: North" in sheet)
    assert all("Lanterns: Long" in sheet for sheet in sheets[4:first])
    assert "Lanterns: North" in sheets[-1]
    # The table of gates stands with the dragon that passes the gate, on the clock of the performance.
    assert "Head and tail at the gates" not in "".join(sheets[4:first])
    (gate,) = (
        line for line in "\n".join(sheets[first:]).splitlines() if line.startswith("south gate") and " m " in line
    )
    assert gate.split()[2:] == ["10.0", "m", "0:50.0", "0:57.8"]
    assert "times: minutes:seconds, from time 0 of the performance" in sheets[-1]


def test_each_of_several_has_the_sheets_that_it_has_alone() -> None:
    alone = {"dragon": TWO["dances"][1]["dragon"], "path": LANES[1]} | {
        name: TWO[name] for name in ("venue", "gates", "margin")
    }
    own = [words(page) for page in pypdfium2.PdfDocument(printed(alone))]
    several = [words(page) for page in several_pages()][-len(own) :]
    assert [sheet.count("–") for sheet in several] == [sheet.count("–") for sheet in own]
    marks = [line for line in "\n".join(own).splitlines() if re.fullmatch(r"\d+ \d+\.000 -?\d+\.000", line.strip())]
    assert marks
    for line in marks:
        assert line in "\n".join(several)


@pytest.mark.chinese_font
def test_an_encounter_stands_in_the_title_block() -> None:
    meeting = [TWO["dances"][0], TWO["dances"][1] | {"name": "北", "delay": 0}]
    sheets = [words(page) for page in several_pages(dances=meeting, start_clock="19:30", language="zh")]
    assert all(re.search("检查：19:30:.. 板凳相碰或过近", sheet) for sheet in sheets)
    assert "2 条龙，9 节板凳" in sheets[0]
    assert "北" in sheets[0]
    assert "时间：当日时刻" in sheets[-1]


@pytest.mark.parametrize(
    ("wrong", "pointer", "detail"),
    [
        ({"gates": [{"name": "far", "x": 20, "y": 20}]}, "/gates/0", "gates[0] must be within 5 m of the path"),
        ({"dances": [TWO["dances"][1] | {"name": None}] * 21}, "/dances", "dragons of a plan must be at most 20 here"),
        ({"path": LANES[0]}, "/path", "path must stand in each of the dances, got it beside them"),
    ],
)
def test_what_is_wrong_with_several_is_refused(
    client: httpx.Client, wrong: dict[str, Any], pointer: str, detail: str
) -> None:
    refused = client.post("/plan", json=TWO | wrong)
    assert refused.status_code == 422
    (error,) = refused.json()["errors"]
    assert (error["pointer"], error["detail"][: len(detail)]) == (pointer, detail)


def test_the_command_prints_the_plan_of_several(tmp_path: Path) -> None:
    file, output = tmp_path / "two.json", tmp_path / "two.pdf"
    file.write_text(json.dumps(TWO))
    assert run("plan", str(file), "--output", str(output)).returncode == 0
    assert output.read_bytes() == printed(TWO)
