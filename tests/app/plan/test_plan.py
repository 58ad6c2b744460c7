"""The plan on paper, opened again by another program: true to scale, words that can be found, fonts within."""

import json
import re

import numpy as np
import pytest
from matplotlib import font_manager

from app.files import fonts
from app.plan.drawing import RATIOS, scale_of
from app.plan.paper import MARGIN
from app.questions.plan import PDF_TYPE, PlanRequest
from app.questions.plan import QUESTION as PLAN
from app.wire.messages import checked
from app.wire.question import Terms
from core import InvalidValue
from tests.support.asking import box
from tests.support.near import assert_near
from tests.support.paper import assert_printable, pages_of, shapes_of, words_of
from tests.support.refusal_rows import assert_refused

# Millimetres in a point of PDF, and how well a place on paper is known [mm].
POINT = 25.4 / 72.0
ON_PAPER = 0.02
BODY = json.loads("""{
    "dragon": {"benches": 6}, "margin": 0.3, "title": "Lantern night",
    "path": {"kind": "route", "pieces": [{"kind": "line", "start": [0, 0], "end": [40, 0]}]},
    "venue": {"type": "FeatureCollection", "origin": {"longitude": 120.1, "latitude": 30.2}, "features": [
        {"type": "Feature", "properties": {"name": "square"}, "geometry":
            {"type": "Polygon", "coordinates": [[[-5, -12], [45, -12], [45, 12], [-5, 12], [-5, -12]]]}},
        {"type": "Feature", "properties": {"name": "kiosk"}, "geometry":
            {"type": "Polygon", "coordinates": [[[20, 4], [26, 4], [26, 8], [20, 8], [20, 4]]]}}
    ]}
}""")

WITH_STREET = json.loads(
    json.dumps(BODY["venue"]).replace("[45, 12]", "[45, 12], [23, 12], [23, 250], [17, 250], [17, 12]")
)


def plan_of(body, **more):
    """The plan, which no deadline ends."""
    return pages_of(PLAN.to_bytes(checked(PlanRequest, body | more), Terms(), PDF_TYPE))


@pytest.fixture(scope="module")
def data(client):
    answer = client.post("/plan", json=BODY).raise_for_status()
    assert answer.headers["content-type"] == "application/pdf"
    return answer.content


@pytest.fixture
def pages(data):
    return pages_of(data)


def size(page):
    return [POINT * side for side in page.get_size()]


def boxes(page):
    """Boxes (N, 4) of all drawn shapes: left, bottom, right, top [mm]."""
    return POINT * np.array(shapes_of(page))


def holds_box(page, width, height):
    result = boxes(page)
    sizes = result[:, 2:] - result[:, :2]
    # The bounds of a shape hold the line around it, too.
    return (np.abs(sizes - [width, height]) < 0.9).all(axis=1).any()


def test_ten_metres_are_fifty_millimetres_at_one_to_two_hundred(pages):
    assert_near(size(pages[0]), [297.0, 210.0], 0.01)
    assert "1:200" in words_of(pages[0])
    result = boxes(pages[0])
    sizes = result[:, 2:] - result[:, :2]
    # The black half of the scale bar is 5 m long, without a line around it.
    assert np.abs(sizes - [25.0, 1.6]).max(axis=1).min() < ON_PAPER
    # Above the title block the nine marks, 2.2 mm high and as wide as their lines, stand every 5 m.
    ticks = result[(np.abs(sizes[:, 1] - 2.6) < 0.1) & (sizes[:, 0] < 0.5) & (result[:, 1] > 45.0)]
    assert_near(np.diff(np.sort(ticks[:, 0])), np.full(8, 25.0), ON_PAPER)
    # The kiosk: 6 m by 4 m; the square: 50 m by 24 m.
    assert holds_box(pages[0], 30.0, 20.0)
    assert holds_box(pages[0], 250.0, 120.0)


def test_all_that_is_promised_can_be_found_as_words(pages):
    texts = list(map(words_of, pages))
    assert len(pages) == 5
    first = "Lantern night|kiosk|N|keep clear, 0.3 m|chalk mark every 5 m|Checked: passes|1/5"
    assert [word for word in first.split("|") if word not in texts[0]] == []
    # The title is read first, and the marks in the order of the path.
    assert texts[0].startswith("Lantern night Plan of the ground 6 benches, 11.1 m from head to tail")
    assert texts[0].endswith("0 5 10 15 20 25 30 35 40")
    for k, time in enumerate(("0:11.1", "0:25.6", "0:40.0")):
        assert f"Place of each bench at {time}" in texts[1 + k]
    # The dragon is 2.86 + 5 x 1.65 = 11.11 m long, and goes the 28.89 m to the end at 1 m/s.
    ends = "the dance begins, head at 11.1 m 0:11.1|the dance ends, head at 40.0 m 0:40.0"
    # The tail is 11.11 s behind the head, and at the end of the dance 11.11 m before it.
    rows = "25 0:25.0 0:36.1|30 0:30.0 –|30 30.000 0.000|kiosk 26.000 4.000"
    assert [word for word in f"{ends}|{rows}".split("|") if word not in texts[4]] == []


def test_the_file_holds_its_fonts_and_tags_and_names_its_language(data):
    assert_printable(data, b"/Lang(en)", b"/S/H1", b"/S/Table", b"/S/TH", b"/Alt(Map, 1:200)")


def test_nothing_leaves_the_paper_and_no_sheet_is_empty(pages):
    for page in pages:
        text = page.get_textpage()
        rects = POINT * np.array([text.get_rect(k) for k in range(text.count_rects())])
        wide, high = size(page)
        assert len(rects) > 20
        assert (rects[:, :2] > MARGIN - 0.5).all()
        assert (rects[:, 2:] < [wide - MARGIN + 0.5, high - MARGIN + 0.5]).all()


def test_a_path_that_goes_on_beyond_the_map_ends_at_its_frame():
    body = {"dragon": {"benches": 6}, "path": {"kind": "turn", "pitch": 1.7}, "start": -20, "stop": 20}
    dots = 2.0  # in a millimetre
    picture = plan_of(body)[0].render(scale=dots * POINT).to_numpy()[..., :3].copy()
    edge = int(dots * (MARGIN - 1.0))
    inner = picture[edge:-edge, edge:-edge]
    assert inner.min() < 100
    inner[:] = 255
    assert picture.min() == 255


def test_a_street_that_the_sheet_cuts_is_broken_at_its_edge():
    page = plan_of(BODY, venue=WITH_STREET)[0]
    assert "goes on beyond the sheet" in words_of(page)
    dots = 20  # in a millimetre
    # The street is 6 m wide, and its middle that of the sheet.
    column = page.render(scale=dots * POINT).to_numpy()[:, int(dots * (size(page)[0] / 2.0 + 15.0))].max(axis=1) < 128
    top = int(dots * MARGIN)
    assert 0.2 < column[top + dots // 2 : top + 6 * dots].mean() < 0.8
    assert column[top + 7 * dots : top + 12 * dots].all()


def test_the_square_fills_a_sheet_whose_streets_go_as_far_as_their_benches():
    way = {"kind": "route", "pieces": [{"kind": "line", "start": [18.5, 100], "end": [18.5, -10]}]}
    sheets = [words_of(one) for one in plan_of(BODY, venue=WITH_STREET, path=way, stop=109.0)[:4]]
    assert [re.search(r"1:\d+(?= 0 )", one)[0] for one in sheets] == ["1:200", "1:500", "1:300", "1:200"]


def test_laps_on_one_another_are_marked_once():
    arc = {"kind": "arc", "centre": [9, 9], "radius": 5.0, "start_angle": 0.0}
    turns, words = (1, 3), []
    for turn in turns:
        path = {"kind": "route", "pieces": [arc | {"sweep": 2.0 * np.pi * turn}]}
        words.append(words_of(plan_of(BODY, path=path, start=12.0, stop=31.0 * turn)[0]))
    numbers = [set(re.findall(r"(?<= )(?:5|10|15|20|25|30|35|60|90)(?= )", one)) for one in words]
    assert numbers[1] == numbers[0] == {"5", "10", "15", "20", "25"}
    assert ["of equal laps" in one for one in words] == [False, True]


SPIRAL = {"kind": "spiral", "pitch": 0.4, "start_turns": 6, "centre": [9, 9]}


def test_a_spiral_has_its_radius_and_angle_and_its_failure_in_the_title():
    first, *_, last = map(words_of, plan_of({"dragon": {"benches": 9}, "path": SPIRAL, "spacing": 10}))
    assert "Checked: benches touch or are too near at 0:" in first
    # The head starts at 2.4 m from the centre, at 0 degrees.
    assert "11.400 9.000 2.400 0.00" in last


def test_a_square_from_a_survey_says_where_its_origin_is():
    square = box(-20, -20, 20, 20) | {"grid": {"x": 499_950.0, "y": 3_170_000.25}}
    body = {"dragon": {"benches": 9}, "path": {"kind": "spiral", "pitch": 1.0, "start_turns": 6}}
    words = words_of(plan_of(body, venue=square)[0])
    assert "x = y = 0 is x 499950 m, y 3170000.25 m of the survey grid" in words


def test_the_largest_scale_that_fits_is_taken_and_none_is_refused():
    corners = np.zeros(2), np.array([50.0, 20.0])
    assert scale_of("A4", *corners).ratio == 200
    assert scale_of("A3", *corners).ratio == 200
    turned = scale_of("A4", np.zeros(2), np.array([17.0, 22.0]))
    assert turned.ratio == 100
    assert turned.paper.width == 210.0
    assert turned.on_paper(np.array([8.5, 11.0])) == pytest.approx([105.0, 10.0 + 30.0 + (297.0 - 50.0) / 2.0])
    with pytest.raises(InvalidValue, match=f"to fit on A4 at 1:{RATIOS[-1]}"):
        scale_of("A4", np.zeros(2), np.array([1e5, 1.0]))


@pytest.mark.parametrize(
    "row",
    [
        '{"paper": "A5"} -> /paper',
        '{"spacing": 0.5, "venue": null, "path": {"kind": "spiral", "pitch": 5, "start_turns": 30}} -> /spacing 2000',
        '{"gates": [{"name": "far", "x": 21.3, "y": 8}]} -> /gates/0 5 far',
    ],
)
def test_a_plan_that_cannot_be_is_refused(client, row):
    assert_refused(client, "/plan", BODY, row)


def test_a_font_that_is_gone_or_broken_draws_nothing(tmp_path):
    (tmp_path / "broken.ttf").write_bytes(b"no font")
    for name in ("gone.ttf", "broken.ttf"):
        assert not fonts.draws_our_words(font_manager.FontEntry(fname=str(tmp_path / name), name="Noto Sans CJK SC"))


# -- several dances ------------------------------------------------------------------------------------------

TWO = json.loads("""{
    "dances": [
        {"name": "Long", "dragon": {"benches": 5, "names": ["Zhou", "Wu", "Zheng", "Wang", "Feng"]},
         "path": {"kind": "waypoints", "points": [[-30, 0], [30, 0]]}},
        {"name": "North", "colour": "#1a6f33", "delay": 40, "dragon": {"benches": 4},
         "path": {"kind": "waypoints", "points": [[0, -30], [0, 30]]}}
    ],
    "venue": {"type": "Polygon", "coordinates": [[[-35, -35], [35, -35], [35, 35], [-35, 35], [-35, -35]]]},
    "gates": [{"name": "south gate", "x": 0, "y": -20}], "title": "Lanterns", "margin": 0.3
}""")


@pytest.fixture(scope="module")
def several():
    return plan_of(TWO)


def test_the_plan_of_several_shows_all_of_them_and_then_each(several):
    sheets = list(map(words_of, several))
    words = ("Long", "North", "2 dragons, 9 benches", "south gate", "Checked: passes", "from 0:")
    assert [word for sheet in sheets[:4] for word in words if word not in sheet] == []
    assert "Place of each bench at" in sheets[1]
    assert "1 Wu" in sheets[1]
    first = next(k for k, sheet in enumerate(sheets) if "Lanterns: North" in sheet)
    assert all("Lanterns: Long" in sheet for sheet in sheets[4:first])
    # The table of gates stands with the dragon that passes the gate, on the clock of the performance.
    assert "Head and tail at the gates" not in "".join(sheets[4:first])
    assert "Head and tail at the gates" in sheets[-1]
    assert re.search(r"south gate 10\.0 m 0:50\.0 0:57\.8", " ".join(sheets[first:]))
    assert "times: minutes:seconds, from time 0 of the performance" in sheets[-1]
    # The second dragon has the colour that was asked for, as on the page.
    picture = several[0].render(scale=2, rev_byteorder=True).to_numpy()[..., :3]
    assert (picture == (0x1A, 0x6F, 0x33)).all(axis=-1).any()


def test_each_of_several_has_the_sheets_that_it_has_alone(several):
    north = {name: TWO["dances"][1][name] for name in ("dragon", "path")}
    alone = list(map(words_of, plan_of({name: TWO[name] for name in ("venue", "gates", "margin")} | north)))
    with_others = list(map(words_of, several[-len(alone) :]))
    assert [sheet.count("–") for sheet in with_others] == [sheet.count("–") for sheet in alone]
    marks = [re.findall(r"\b\d+ \d+\.000 -?\d+\.000\b", " ".join(sheets)) for sheets in (alone, with_others)]
    assert marks[0] == marks[1] != []


@pytest.mark.chinese_font
def test_an_encounter_stands_in_the_title_block():
    meeting = [TWO["dances"][0], TWO["dances"][1] | {"name": "北", "delay": 0}]
    sheets = list(map(words_of, plan_of(TWO, dances=meeting, start_clock="19:30", language="zh")))
    assert all(re.search("检查：19:30:.. 板凳相碰或过近", sheet) for sheet in sheets)
    assert "2 条龙，9 节板凳" in sheets[0]
    assert "北" in sheets[0]
    assert "时间：当日时刻" in sheets[-1]


@pytest.mark.parametrize(
    "row",
    [
        '{"gates": [{"name": "far", "x": 20, "y": 20}]} -> /gates/0 5',
        f"{json.dumps({'dances': [TWO['dances'][1] | {'name': None}] * 21})} -> /dances 20",
        '{"path": {"kind": "spiral"}} -> /path dances',
    ],
    ids=["gate", "many", "path"],
)
def test_what_is_wrong_with_several_is_refused(client, row):
    assert_refused(client, "/plan", TWO, row)
