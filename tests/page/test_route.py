"""A dance drawn on the picture by mouse, touch and keys: its verdict, its address and its files."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import openpyxl
import pytest
from playwright.sync_api import expect

from tests.support import polite
from tests.support.axe import findings
from tests.support.pending import reached, settled, with_below

ROOT = Path(__file__).parents[2]
PHONE = {"width": 390, "height": 844}
S_CURVE = "?path=route&route=*-80,-16_0,-16_16,-8_0,0_-16,8_*0,16_80,16"
VILLAGE = (
    "?path=route&route=*-67,-8_-12,-8_-3,-9_6,-8_10.5,-3_7,2.5_0,3.5_-4.5,7_-1,10.5_6,10.5_*12,15_12,62&begin=45&limit=1.1"
    "&things=a.square..-70,-11_-20,-11_-20,-15_20,-15_20,15_15,15_15,65_9,65_9,15_-20,15_-20,-5_-70,-5"
    "~c.well.1!5.6!5,-6!5~b.stage..-17,1!5_-6,1!5_-6,9!5_-17,9!5~w.fence.0!2.10!5,3!5_18,4"
)


def verdict(page: Any, words: str) -> None:
    page.locator("#judgement .value", has_text=words).wait_for()


def points(page: Any) -> list[list[float]]:
    """The points of the path as the page shares them, once it has written its address and drawn the path."""
    settled(page, "address", "course")
    text = page.evaluate("new URLSearchParams(location.search).get('route')")
    return [[float(one) for one in point.lstrip("*").split(",")] for point in (text or "").split("_") if point]


def drag(page: Any, knot: Any, dx: float, dy: float) -> None:
    box = knot.bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    for k in range(1, 6):
        page.mouse.move(x + dx * k / 5, y + dy * k / 5)
    page.mouse.up()


def test_a_dragged_point_brings_a_verdict_that_undo_redo_and_the_browser_take_back(open_page: Any) -> None:
    page = open_page(failing=True)
    page.locator("[data-path=route]").click()
    verdict(page, "Can be danced")
    assert page.locator(".knot").count() == 7
    before = points(page)
    knots = page.locator(".knot")
    corner = knots.nth(3).bounding_box()
    bend = knots.nth(2).bounding_box()
    drag(page, knots.nth(2), corner["x"] - bend["x"] - 8, corner["y"] - bend["y"] + 12)
    verdict(page, "Cannot be danced")
    page.locator(".failures li", has_text="The bend is too tight").first.wait_for()
    after = points(page)
    assert after[:2] + after[3:] == before[:2] + before[3:]
    assert after[2] != before[2]
    page.keyboard.press("ControlOrMeta+z")
    verdict(page, "Can be danced")
    assert points(page) == before
    page.locator("#redo").click()
    verdict(page, "Cannot be danced")
    page.go_back()
    verdict(page, "Can be danced")
    assert points(page) == before
    for _ in range(3):
        page.go_back()
    page.locator("[data-path=spiral][aria-pressed=true]").wait_for()
    page.locator("#first-contact .value", has_text="Contact at").wait_for()


def in_the_picture(page: Any) -> bool:
    """All points of the path are inside the picture."""
    settled(page)
    canvas, boxes = page.locator("#canvas").bounding_box(), [one.bounding_box() for one in page.locator(".knot").all()]
    return len(boxes) > 1 and all(
        0 < box["x"] - canvas["x"] < canvas["width"] and 0 < box["y"] - canvas["y"] < canvas["height"] for box in boxes
    )


def test_the_drawn_path_is_in_the_picture_whatever_answers_late_and_after_another_kind_of_dance(visit: Any) -> None:
    page = visit("?benches=5&time=end")
    held: list[Any] = []
    page.route("**/trajectory", lambda one: held.append(one))
    with page.expect_request(lambda one: '"decimals":4' in (one.post_data or "")):  # the path of the spiral
        page.locator("#pitch").fill("0.6")
    page.locator("[data-path=route]").click()
    verdict(page, "Can be danced")
    settled(page, "course")
    while held:
        held.pop(0).continue_()
    page.unroute_all()
    assert in_the_picture(page)
    page.locator("[data-path=spiral]").click()
    settled(page)
    page.locator("[data-path=route]").click()
    assert in_the_picture(page)


def test_nothing_of_a_spiral_is_shown_while_a_drawn_dance_is_waited_for(open_page: Any) -> None:
    page = open_page("?benches=60&time=end&route=-200,0_0,0_40,10")
    settled(page)
    expect(page.locator("#inset")).to_be_visible()
    held: list[Any] = []
    page.route("**/check", lambda one: held.append(one))
    page.locator("[data-path=route]").click()
    expect(page.locator("#inset")).to_be_hidden()
    page.wait_for_timeout(500)  # the spiral's player, if it still drew
    expect(page.locator("#inset")).to_be_hidden()
    while held:
        held.pop(0).continue_()
    page.unroute_all()
    settled(page)
    verdict(page, "Can be danced")


def test_a_bend_that_is_too_tight_is_shown_near(open_page: Any) -> None:
    page = open_page("?path=route&benches=9&route=*-60,0_*0,0_0,40&corner=0.3", failing=True)
    settled(page)
    verdict(page, "Cannot be danced")
    assert "view=" not in page.url
    page.locator("#judgement").get_by_role("button", name="Show").first.click()
    page.wait_for_url("**view=**")
    x, y, scale = [float(one) for one in page.evaluate("new URLSearchParams(location.search).get('view')").split(",")]
    assert abs(x) < 3
    assert -3 < y < 3
    assert scale > 20


def test_of_a_first_dance_that_is_refused_there_is_nothing_to_play(open_page: Any) -> None:
    page = open_page("?path=route&benches=40&route=0,0_9,0", failing=True)
    settled(page)
    expect(page.locator("#judgement .value")).to_contain_text("Cannot be danced")
    expect(page.locator("#play")).to_be_hidden()
    expect(page.locator("#legend")).to_be_hidden()
    page.locator("[data-field=benches] input").first.fill("3")
    settled(page)
    verdict(page, "Can be danced")
    expect(page.locator("#play")).to_be_visible()


def test_a_point_on_another_one_is_a_dot_until_the_picture_is_enlarged(open_page: Any) -> None:
    page = open_page("?path=route&benches=3&route=0,0_20,0_21,0_60,0", failing=True)
    settled(page)
    page.locator("#edit").click()
    second, third = page.locator(".knot").nth(1), page.locator(".knot").nth(2)
    expect(third).to_have_class(re.compile("near"))
    expect(second).not_to_have_class(re.compile("near"))
    assert third.bounding_box()["width"] < second.bounding_box()["width"]
    # With the keys it has its number, and a press takes the one that shows its number.
    third.focus()
    expect(third).to_have_css("font-size", second.evaluate("one => getComputedStyle(one).fontSize"))
    page.evaluate("document.activeElement.blur()")
    drag(page, third, 40, 0)
    assert points(page)[2] == [21.0, 0.0]
    settled(page)
    for _ in range(20):
        page.locator("#zoom-in").click()
    settled(page)
    expect(third).not_to_have_class(re.compile("near"))


@pytest.mark.parametrize("late", ["check", "course"])
def test_what_comes_late_is_not_shown_without_a_drawing_nor_after_a_switch_of_language(
    visit: Any, late: str, picture: Any, alike: Any
) -> None:
    page = visit("?path=route&benches=3&route=*-20,0_20,0")
    verdict(page, "Can be danced")
    settled(page)
    page.locator("#edit").click()
    held: list[Any] = []
    passing: list[bool] = []
    page.route(f"**/{late}", lambda one: one.continue_() if passing else held.append(one))
    with page.expect_request(f"**/{late}"):
        page.locator("#benches").fill("4")
    while not held:
        page.wait_for_timeout(10)
    page.locator("#delete").click()
    passing.append(True)
    for one in held:
        one.continue_()
    settled(page)
    empty = picture(page)
    for language, words in (("zh", "可以"), ("en", "Can be danced")):
        page.locator(f"[data-lang={language}]").click()
        settled(page)
        assert words not in page.locator("#judgement").inner_text()
    assert alike(picture(page), empty)


def test_points_are_moved_put_in_and_taken_away_by_keys_and_taps(visit: Any) -> None:
    page = visit(S_CURVE)
    verdict(page, "Can be danced")
    page.locator("#edit").click()
    before = points(page)
    page.locator("#delete").focus()
    page.keyboard.press("Tab")  # the picture
    page.keyboard.press("Tab")
    page.keyboard.press("Tab")
    assert "Point 2 of 7" in page.evaluate("document.activeElement.getAttribute('aria-label')")
    for key in ("ArrowRight", "ArrowRight", "Shift+ArrowUp"):
        page.keyboard.press(key)
    assert points(page)[1] == pytest.approx([before[1][0] + 0.2, before[1][1] + 1.0])
    page.keyboard.press("Enter")
    assert "Point 3 of 8" in page.evaluate("document.activeElement.getAttribute('aria-label')")
    page.keyboard.press("Delete")
    assert len(points(page)) == 7
    # A tap on the path divides it, and one beside it goes on from its end; the list has fields for both.
    first, second = (page.locator(".knot").nth(k).bounding_box() for k in (0, 1))
    page.mouse.click((first["x"] + second["x"]) / 2 + 11, (first["y"] + second["y"]) / 2 + 11)
    page.locator(".knot").nth(7).wait_for()
    drawn = points(page)
    assert drawn[0][0] < drawn[1][0] < drawn[2][0]
    last = page.locator(".knot").last.bounding_box()
    page.mouse.click(last["x"] + 11, last["y"] - 60)
    page.locator(".knot").nth(8).wait_for()
    page.locator("#points summary").click()
    page.locator("#points tbody tr").nth(8).locator("input").first.fill("75.5")
    page.keyboard.press("Enter")
    assert points(page)[8][0] == 75.5
    page.locator("#points tbody tr").nth(8).get_by_role("button").click()
    assert len(points(page)) == 8


def test_each_failure_stands_in_order_of_time_and_is_shown_on_the_picture(
    visit: Any, picture: Any, alike: Any, server: str
) -> None:
    page = visit(VILLAGE)
    verdict(page, "Cannot be danced")
    page.locator("#run-end[aria-busy=false]").wait_for()
    body = saved(page)
    answer = polite.post(f"{server}/check", json=body).raise_for_status().json()["failures"]
    assert [one["kind"] for one in answer] == ["venue", "speed"]
    rows = page.locator(".failures li")
    assert rows.locator("button").all_inner_texts() == [f"{one['time']:.6f} s" for one in answer]
    assert "the head touches well" in rows.first.text_content()
    assert "highest speed is 1.202470 m/s" in rows.nth(1).text_content()
    rows.first.get_by_role("button").click()
    page.wait_for_url(f"**time={round(answer[0]['time'], 9)}**")
    page.locator("#clock", has_text=f"{answer[0]['time']:.6f}").wait_for()
    settled(page)
    marked = picture(page)
    page.locator("#on").click()
    page.locator("#back").click()
    settled(page)
    assert alike(marked, picture(page))
    page.locator("#things li").nth(1).get_by_role("button").last.click()
    page.locator(".failures li", has_text="touches well").wait_for(state="detached")


@pytest.mark.parametrize(
    ("things", "words"),
    [
        ("a.court..-9,-9_30,-9_30,9_-9,9", "starts outside court."),
        ("a.court..-30,-9_30,-9_30,9_-30,9~c.elm.2.-18,0", "starts inside elm."),
    ],
    ids=["square", "obstacle"],
)
def test_a_dragon_that_starts_in_the_wrong_place_is_outside_the_square_or_inside_a_thing(
    visit: Any, things: str, words: str
) -> None:
    page = visit(f"?path=route&benches=3&route=*-20,0_20,0&things={things}")
    verdict(page, "Cannot be danced")
    expect(page.locator(".failures li").first).to_contain_text(words)


def begin_with(page: Any, name: str) -> None:
    page.locator("#preset").click()
    page.locator(f"[data-begin={name}]").click()
    expect(page.locator("#presets")).to_be_hidden()


def test_every_preset_can_be_danced_and_leaves_a_square_of_ones_own(visit: Any) -> None:
    page = visit("?path=route&benches=24&route=0,0_90,0")
    verdict(page, "Can be danced")
    for name in ("inout", "eight", "street", "village", "s"):
        begin_with(page, name)
        settled(page)
        verdict(page, "Can be danced")
    assert page.locator("#things li").count() == 0
    # Both places show the same end of the run.
    text, end = (page.locator(place).inner_text() for place in ("#clock", "#run-end .value"))
    assert text == end
    page = visit("?path=route&route=0,0_30,0_60,9&things=a.court..-99,-99_99,-99_99,99_-99,99~c.elm.1.40,40")
    for name, count in (("street", 2), ("empty", 0)):
        begin_with(page, name)
        page.locator("#points summary", has_text=f": {count}").wait_for()
        assert page.locator("#things li").count() == 2


def test_a_verdict_of_before_is_pale_and_says_so_while_the_service_does_not_answer(visit: Any) -> None:
    page = visit(S_CURVE)
    verdict(page, "Can be danced")
    page.locator("#tolerance .value").wait_for()
    page.route("**/check", lambda route: None)
    page.locator("#edit").click()
    page.locator(".knot").nth(2).focus()
    page.keyboard.press("Shift+ArrowUp")
    for box in ("#judgement", "#tolerance"):
        pale = "box => getComputedStyle(document.querySelector(`${box} > .value`)).opacity < 0.7"
        page.wait_for_function(pale, arg=box)
        assert page.locator(f"{box} > .old").is_visible()
    page.unroute("**/check")
    page.keyboard.press("Shift+ArrowDown")
    settled(page)
    assert page.evaluate("getComputedStyle(document.querySelector('#judgement > .value')).opacity") == "1"
    assert page.locator("#judgement > .old").is_hidden()


def test_a_dragon_that_cannot_follow_a_change_fades_and_the_drawing_does_not(open_page: Any, picture: Any) -> None:
    square = "things=a.square..-70,-9_9,-9_9,49_-70,49"
    page = open_page(f"?path=route&benches=9&route=*-60,0_*0,0_0,40&{square}", failing=True)
    settled(page)
    verdict(page, "Can be danced")

    def shown(name: str) -> bool:
        """True if the picture holds this colour of the page."""
        colour = page.evaluate("name => getComputedStyle(document.body).getPropertyValue(`--${name}`).trim()", name)
        rgb = [int(colour[k : k + 2], 16) / 255.0 for k in (1, 3, 5)]
        return bool((abs(picture(page)[..., :3] - rgb).max(axis=-1) < 0.01).any())

    assert shown("head")
    assert shown("circle")  # the border of the square
    page.locator("[data-field=benches] input").first.fill("90")
    settled(page)
    verdict(page, "Cannot be danced")
    assert not shown("head")
    assert shown("circle")
    assert page.locator("#canvas").evaluate("one => getComputedStyle(one).opacity") == "1"


def test_a_dance_that_begins_later_can_begin_at_time_0(visit: Any) -> None:
    page = visit("?path=route&benches=24&route=0,0_150,0", failing=True)
    offer = page.get_by_role("button", name="Begin at time 0: head at 40.9 m")
    offer.click()
    page.wait_for_url("**begin=40.9*")
    offer.wait_for(state="hidden")
    verdict(page, "Can be danced")
    page.go_back()
    offer.wait_for()
    # A path too short for the dragon is refused; the dance does not begin later instead.
    page.locator("#benches").fill("200")
    verdict(page, "Cannot be danced")
    offer.wait_for(state="hidden")


def saved(page: Any) -> Any:
    with page.expect_download() as download:
        page.locator("#save").click()
    return json.loads(Path(download.value.path()).read_text())


def test_a_square_with_a_tree_and_a_wall_is_drawn_named_and_judged(visit: Any) -> None:
    page = visit(S_CURVE)
    verdict(page, "Can be danced")
    page.locator("#zoom-out").click()
    page.locator("#edit").click()
    settled(page)
    canvas = page.locator("#canvas").bounding_box()
    left, top, right, low = (canvas["x"] + 120, canvas["y"] + 60, canvas["x"] + canvas["width"] - 30, canvas["y"] + 480)

    def tap(tool: str, *places: tuple[float, float]) -> None:
        page.locator(f"[data-tool={tool}]").click()
        for x, y in places:
            page.mouse.click(x, y)

    tap("area", (left, low), (right, low), (right, top), (left, top))
    tap("circle", (left + 20, top + 20))
    tap("wall", (right - 20, low - 20), (right - 60, low - 20))
    names = page.locator("#things li input:first-of-type")
    assert [name.input_value() for name in names.all()] == ["square", "tree", "wall"]
    names.nth(1).fill("old oak")
    page.keyboard.press("Enter")
    verdict(page, "Can be danced")
    page.locator("#tolerance[aria-busy=false] .value").wait_for()
    kept = saved(page)["venue"]["features"]
    assert [(one["properties"]["name"], one["geometry"]["type"]) for one in kept] == [
        ("square", "Polygon"), ("old oak", "Point"), ("wall", "LineString"),
    ]  # fmt: skip
    assert len(kept[0]["geometry"]["coordinates"][0]) == 5
    page.locator("#things li").nth(1).get_by_role("button").first.click()
    page.locator(".knot").focus()
    settled(page)
    canvas = page.locator("#canvas").bounding_box()
    path = page.locator("#canvas")
    assert path.is_visible()
    drag(page, page.locator(".knot"), canvas["width"] / 2 - 140, canvas["height"] / 2 - 80)
    page.locator("#judgement .value").wait_for()
    assert saved(page)["venue"]["features"][1]["geometry"] != kept[1]["geometry"]


@pytest.mark.parametrize(
    ("query", "place"),
    [(S_CURVE, "#judgement"), pytest.param("?benches=20&time=end", "#first-contact", marks=pytest.mark.deep)],
    ids=["drawn", "spiral"],
)
def test_a_dance_is_back_after_a_look_at_an_empty_square(
    visit: Any, picture: Any, alike: Any, query: str, place: str
) -> None:
    page = visit(query)
    before, words = picture(page), page.locator(place).inner_text()
    visit("?path=route")
    assert not alike(picture(page), before)
    visit(query)
    assert page.locator(place).inner_text() == words
    assert alike(picture(page), before)


@pytest.mark.parametrize(
    ("query", "text"),
    [
        ("?pitch=0.5&benches=100&margin=0.02&time=100", "Within 0.02 m at"),
        ("?path=turn&turning_diameter=10&benches=40", "Nothing touches"),
    ],
    ids=["spiral", "turn"],
)
def test_an_address_of_before_opens_the_same_dance(open_page: Any, query: str, text: str) -> None:
    page = open_page(query)
    page.locator("#first-contact .value", has_text=text).wait_for()
    settled(page, "address")
    for part in query.strip("?").split("&"):
        assert part in page.url
    assert not page.locator("#route").is_visible()


def test_the_whole_dance_is_in_the_address_or_in_a_file_and_opens_again(visit: Any, tmp_path: Path) -> None:
    page = visit(VILLAGE)
    verdict(page, "Cannot be danced")
    settled(page, "address")
    body, address = saved(page), page.url
    page.goto(address)
    verdict(page, "Cannot be danced")
    assert saved(page) == body
    # A long drawing leaves the address, and the page says so; it is still there after going away and back.
    body["path"] |= {"points": [[0.5 * k, 0.01 * (k % 7)] for k in range(900)], "straight": []}
    del body["venue"], body["speed_limit"]
    body["path"]["start"] = 0.0
    file = tmp_path / "long.json"
    file.write_text(json.dumps(body))
    page.locator("#open-file").set_input_files(file)
    page.locator("#route-note", has_text="too long for an address").wait_for()
    assert len(page.url) < 8_000
    page.reload()
    page.locator("#points summary", has_text="900").wait_for()


def test_a_map_of_a_survey_grid_keeps_it_in_the_address_and_in_files(visit: Any, tmp_path: Path) -> None:
    page = visit("?path=route")
    corners = [[499_950, 3_219_950], [500_050, 3_219_950], [500_050, 3_220_050], [499_950, 3_220_050]]
    square = {"type": "Polygon", "coordinates": [[*corners, corners[0]]]}
    line = {"type": "LineString", "coordinates": [[499_960, 3_220_000], [500_040, 3_219_990]]}
    both = {"type": "GeometryCollection", "geometries": [square, line]}
    (tmp_path / "grid.geojson").write_text(json.dumps(both))
    page.locator("#open-file").set_input_files(tmp_path / "grid.geojson")
    page.locator("#status", has_text="x = y = 0 is its x 500000 m, y 3220000 m").wait_for()
    settled(page, "address")
    assert "grid=500000%2C3220000" in page.url or "grid=500000,3220000" in page.url
    assert saved(page)["venue"]["grid"] == {"x": 500_000, "y": 3_220_000}
    page.goto(page.url)
    settled(page, "address")
    assert saved(page)["venue"]["grid"] == {"x": 500_000, "y": 3_220_000}


def test_a_table_of_a_chinese_spreadsheet_is_opened_and_so_is_a_workbook(visit: Any, tmp_path: Path) -> None:
    page = visit("?path=route", failing=True)
    (tmp_path / "benches.csv").write_bytes("周,3.41,0.3,0.275\n李,2.2,0.3,0.275\n".encode("gb18030"))
    page.locator("#open-file").set_input_files(tmp_path / "benches.csv")
    page.locator("#one-by-one summary", has_text="2").wait_for()
    assert page.locator("#csv").input_value().startswith("周,3.41")
    book = openpyxl.Workbook()
    for row in (["周", 3.41, 0.3, 0.275], ["李", 2.2, 0.3, 0.275], ["吴", 2.2, 0.3, 0.275]):
        book.active.append(row)
    book.save(tmp_path / "benches.xlsx")
    page.locator("#csv-file").set_input_files(tmp_path / "benches.xlsx")
    page.locator("#one-by-one summary", has_text="3").wait_for()
    assert page.locator("#csv").input_value() == "周,3.41,0.3,0.275\n李,2.2,0.3,0.275\n吴,2.2,0.3,0.275\n"
    (tmp_path / "old.xlsx").write_bytes(bytes.fromhex("d0cf11e0a1b11ae1") + bytes(99))
    page.locator("#csv-file").set_input_files(tmp_path / "old.xlsx")
    page.locator("#status", has_text="The workbook is in an old or encrypted form").wait_for()


def test_a_number_that_cannot_be_used_is_refused_beside_its_field_and_the_dance_stays(visit: Any) -> None:
    page = visit(VILLAGE + "&lang=zh", failing=True)
    verdict(page, "无法表演")
    speed, latitude = (page.locator(f"#route [data-label={name}]") for name in ("speedLimit", "latitude"))
    error = page.locator("#route > .error")
    for field, text, words in (
        (speed, "1.1 m/s", "“把手限速”应为 0.001 到 100 之间的数，现为“1.1 m/s”。"),
        (speed, "-2", "现为“-2”"),
        (latitude, "129", "“原点的纬度”应为 -90 到 90 之间的数，现为“129”。"),
    ):
        field.fill(text)
        field.blur()
        expect(error).to_contain_text(words)
        assert (field.get_attribute("aria-invalid"), field.input_value()) == ("true", text)
    assert (speed.get_attribute("aria-invalid"), speed.input_value()) == (None, "1.1")  # one at a time
    assert "limit=1.1" in page.url
    verdict(page, "无法表演")
    page.locator("[data-lang=en]").click()
    expect(error).to_have_text(
        "“Latitude of x = y = 0” must be a number from -90 to 90; you typed “129”. The dance stays as it was."
    )
    latitude.fill("29.11")
    latitude.blur()
    error.wait_for(state="detached")
    # A number may be written in any way; a field that needs one takes back its own when it is emptied.
    speed.fill(",5")
    speed.blur()
    page.wait_for_url("**limit=0.5*")
    begin = page.locator("#route [data-label=pathBegin]")
    begin.fill("")
    begin.blur()
    expect(begin).to_have_value("45")
    # An empty field stands for no limit.
    speed.fill("")
    speed.blur()
    page.wait_for_function("!location.search.includes('limit=')")


def test_a_route_takes_the_numbers_that_the_service_takes(visit: Any, server: str) -> None:
    schemas = polite.get(f"{server}/openapi.json").json()["components"]["schemas"]
    known = visit(S_CURVE).evaluate("import('/page/route.js').then(({ LIMITS }) => LIMITS)")

    def limits(schema: str, name: str) -> list[float]:
        field = schemas[schema]["properties"][name]
        own = field.get("anyOf", [field])[0]
        return [own["minimum"], own["maximum"]]

    for key, schema, name in (
        ("speedLimit", "CheckRequest", "speed_limit"),
        ("pathBegin", "WaypointsPath", "start"),
        ("cornerRadius", "WaypointsPath", "radius"),
    ):
        assert known[key] == limits(schema, name), key


def test_files_dropped_on_the_picture_are_opened_and_maps_are_kept(visit: Any, tmp_path: Path) -> None:
    page = visit(S_CURVE + "&things=c.well.1!5.0,-40")
    verdict(page, "Can be danced")
    drop = """([name, text]) => {
      const data = new DataTransfer();
      data.items.add(new File([text], name));
      for (const type of ["dragenter", "dragover", "drop"])
        stage.dispatchEvent(new DragEvent(type, { dataTransfer: data, bubbles: true, cancelable: true }));
    }"""
    for name in ("village_square.toml", "village_square.geojson"):
        page.evaluate(drop, [name, (ROOT / "examples" / name).read_text()])
        page.locator("#status", has_text=f"Opened {name}").wait_for()
        if name.endswith("toml"):  # It names another file as its venue; the square that was drawn is not its own.
            page.locator("#status", has_text="village_square.geojson").wait_for()
            page.locator("#things summary", has_text="0").wait_for()
    page.locator("#things li").nth(4).wait_for()
    page.locator("#points summary", has_text="12").wait_for()
    verdict(page, "Can be danced")
    body = saved(page)
    assert body["margin"] == 0.5
    assert body["path"]["start"] == 45.0
    assert [one["properties"]["name"] for one in body["venue"]["features"]][:3] == ["square", "well", "stage"]
    reached(page.locator("#keep"))
    with page.expect_download() as download:
        page.locator("[data-keep=keepMap][data-form=GeoJSON]").click()
    drawn = json.loads(Path(download.value.path()).read_text())
    assert {"square", "well", "stage"} <= {one["properties"].get("name") for one in drawn["features"]}
    # KML needs the place on earth, which the form takes; it is in the address.
    latitude, longitude = (page.locator(f"#route [data-label={name}]") for name in ("latitude", "longitude"))
    latitude.fill("29,11")
    longitude.fill("119.64")
    longitude.blur()
    page.wait_for_url("**origin=119.64,29.11*")
    with page.expect_download() as download:
        page.locator("[data-keep=keepMap][data-form=KML]").click()
    assert ">119.64" in Path(download.value.path()).read_text()


def test_a_drawn_dance_is_played_listed_and_kept_as_a_spiral_is(visit: Any, server: str) -> None:
    page = visit(S_CURVE + "&time=60&handle=2&rate=1")
    verdict(page, "Can be danced")
    page.locator("#rows tr.chosen", has_text="2 · body 2").wait_for()
    page.locator("#table-time", has_text="60").wait_for()
    reached(with_below(page).locator("#keep"))
    expect(page.locator("#curl")).to_have_text(re.compile(r"'\S+/check'.*\"kind\":\"waypoints\"", re.DOTALL))
    with page.expect_download() as download:
        page.locator("[data-keep=keepTrajectory][data-form=CSV]").click()
    assert Path(download.value.path()).read_text().startswith("time,handle,x,y,speed")
    page.locator("#play").click()
    expect(page.locator("#clock")).to_have_text(re.compile(r"^6[1-9]"))
    page.locator("#play").click()


def test_a_finger_drags_points_on_a_phone_and_nothing_is_cut_off(visit: Any) -> None:
    page = visit(S_CURVE, viewport=PHONE, has_touch=True, is_mobile=True, locale="zh-CN")
    verdict(page, "可以表演")
    page.locator("#edit").tap()
    assert page.evaluate("document.documentElement.scrollWidth") <= PHONE["width"]
    before = points(page)
    box = page.locator(".knot").nth(2).bounding_box()
    touch = page.context.new_cdp_session(page)
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    touch.send("Input.dispatchTouchEvent", {"type": "touchStart", "touchPoints": [{"x": x, "y": y}]})
    for k in range(1, 5):
        touch.send("Input.dispatchTouchEvent", {"type": "touchMove", "touchPoints": [{"x": x, "y": y - 1.5 * k}]})
    touch.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
    after = points(page)
    assert after[2][1] > before[2][1]
    page.locator("#verdict", has_text="可以表演").wait_for()
    assert after[:2] + after[3:] == before[:2] + before[3:]
    settled(page)
    assert findings(page) == []
    assert "undefined" not in page.locator("body").inner_text()
