"""Every kind of dance on a phone, a laptop and a wide screen: room for fingers, and nothing that scrolls inside."""

from __future__ import annotations

from typing import Any

import pytest
from playwright.sync_api import expect

from tests.support.pending import settled, with_below

PHONE = {"viewport": {"width": 390, "height": 844}, "has_touch": True, "is_mobile": True}
FINGER = 44  # [px]: the least width and height of what a finger should hit
VILLAGE = (
    "?path=route&route=*-67,-8_-12,-8_-3,-9_6,-8_10.5,-3_7,2.5_0,3.5_-4.5,7_-1,10.5_6,10.5_*12,15_12,62&begin=45&limit=1.1"
    "&things=a.square..-70,-11_-20,-11_-20,-15_20,-15_20,15_15,15_15,65_9,65_9,15_-20,15_-20,-5_-70,-5"
    "~c.well.1!5.6!5,-6!5~b.stage..-17,1!5_-6,1!5_-6,9!5_-17,9!5~w.fence.0!2.10!5,3!5_18,4"
    "&passages=0.5@20m_0@90s&start_clock=19:30"
)
DANCES = {
    "spiral": "?benches=12&time=0",
    "turn": "?path=turn&benches=12&time=0",
    "route": VILLAGE,
    "nothing drawn": "?path=route",
}
# A point on the picture is hit in a circle around it, a tick or a file in all of its label.
NARROW = """(least) => [...document.querySelectorAll("button, select, input, textarea, summary, a")]
  .filter((one) => one.checkVisibility() && !one.matches(".skip, .knot"))
  .map((one) => [one, one.matches("[type=checkbox], [type=file]") ? one.closest("label") : one])
  .filter(([one, target]) => {
    const { width, height, right } = target.getBoundingClientRect();
    return Math.min(height, one.matches("button") ? width : height) < least - 0.5 || right > innerWidth + 1;
  })
  .map(([one]) => one.outerHTML)"""
# The long list of handles draws only what is in sight of it, and a command is one line as in a terminal.
SCROLLING = """[...document.querySelectorAll("body *")]
  .filter((one) => one.checkVisibility() && !one.matches("#rows, pre, textarea"))
  .filter((one) => /auto|scroll/.test(getComputedStyle(one).overflow))
  .filter((one) => one.scrollHeight > one.clientHeight + 1 || one.scrollWidth > one.clientWidth + 1)
  .map((one) => one.id || one.className || one.tagName)"""


def answered(page: Any, query: str) -> None:
    settled(page)
    if query == DANCES["nothing drawn"]:
        page.locator("#invite").wait_for()
        return
    page.locator("#judgement .value:visible, #first-contact .value:visible").first.wait_for()
    if query == VILLAGE:
        page.locator("#edit").click()


@pytest.mark.parametrize("query", DANCES.values(), ids=list(DANCES))
def test_on_a_phone_a_finger_hits_every_control(visit: Any, query: str) -> None:
    page = visit(query, **PHONE)
    answered(page, query)
    if query != DANCES["nothing drawn"]:
        with_below(page)
    page.evaluate("document.querySelectorAll('details').forEach((one) => (one.open = true))")
    if query != DANCES["nothing drawn"]:
        page.locator("#paper table").wait_for()
    settled(page)
    # No point lies under the buttons of the picture.
    views = page.locator("#views").bounding_box()
    knots = [knot.bounding_box() for knot in page.locator(".knot").all()]
    assert [knot for knot in knots if knot["x"] < views["x"] + views["width"]] == []
    for language in ("en", "zh"):
        page.locator(f"[data-lang={language}]").tap()
        assert page.evaluate(NARROW, FINGER) == []
        assert page.evaluate("document.documentElement.scrollWidth") <= 390
        header = page.locator("header").bounding_box()
        assert header["height"] < 2.5 * FINGER


@pytest.mark.parametrize("query", DANCES.values(), ids=list(DANCES))
def test_nothing_scrolls_inside(visit: Any, query: str) -> None:
    page = visit(query)
    answered(page, query)
    page.evaluate("document.querySelectorAll('#answers details').forEach((one) => (one.open = true))")
    for width, height in ((1440, 900), (1920, 1080)):
        page.set_viewport_size({"width": width, "height": height})
        settled(page)
        assert page.evaluate(SCROLLING) == []
        # The picture stays in sight of answers and controls, however far down they reach.
        page.locator("#answers > :not([hidden])").last.evaluate("one => one.scrollIntoView({ block: 'end' })")
        canvas = page.locator("#canvas").bounding_box()
        assert canvas["y"] >= 0
        assert canvas["y"] + canvas["height"] <= height


# Sizes of all words in sight, on canvases too, in the usual size of the type [px].
SIZES = """() => {
  const sizes = new Set();
  for (const one of document.querySelectorAll("body *")) {
    const isField = one.matches("input:not([type=range], [type=color], [type=checkbox]), select, textarea");
    const hasText = [...one.childNodes].some((node) => node.nodeType === 3 && node.data.trim());
    if (!(isField || hasText) || one.matches("option, .unseen")) continue;
    if (!one.checkVisibility({ visibilityProperty: true })) continue;
    const scale = one.ownerSVGElement?.getScreenCTM().a ?? 1;
    sizes.add(Math.round(10 * scale * Number.parseFloat(getComputedStyle(one).fontSize)) / 10);
  }
  const { prototype } = CanvasRenderingContext2D;
  const fill = prototype.fillText;
  prototype.fillText = function (...all) {
    sizes.add(Math.round(10 * Number.parseFloat(/[\\d.]+px/.exec(this.font)[0])) / 10);
    return fill.apply(this, all);
  };
  dispatchEvent(new Event("look"));
  prototype.fillText = fill;
  return [...sizes];
}"""
FOUR = {13.1, 15.0, 19.2, 22.4}  # [px]


@pytest.mark.parametrize("query", ["", *DANCES.values(), f"{VILLAGE}&door=village", "?door=contest&time=end"])
def test_the_page_and_its_pictures_have_four_sizes_of_type(open_page: Any, query: str) -> None:
    page = open_page(query, reduced_motion="reduce")
    settled(page)
    if query:
        with_below(page)
        page.evaluate("document.querySelectorAll('details').forEach((one) => (one.open = true))")
        settled(page)
    for language in ("zh", "en"):
        page.locator(f"[data-lang={language}]").click()
        settled(page)
        assert set(page.evaluate(SIZES)) <= FOUR


@pytest.mark.parametrize(("width", "first"), [(1440, "controls"), (900, "controls"), (390, "answers")])
def test_the_tab_key_goes_through_numbers_and_answers_as_they_stand(open_page: Any, width: int, first: str) -> None:
    page = open_page("?benches=12&time=0")
    settled(page)
    page.set_viewport_size({"width": width, "height": 900})
    settled(page)
    last = "answers" if first == "controls" else "controls"
    boxes = [page.locator(f"#{one}").bounding_box() for one in (first, last)]
    assert boxes[0]["x"] < boxes[1]["x"] or boxes[0]["y"] < boxes[1]["y"]
    focused = """async () => {
      await new Promise(requestAnimationFrame);
      return document.activeElement.closest("#controls, #answers")?.id;
    }"""
    page.locator("#rate").focus()
    seen: list[str] = []
    for _ in range(40):
        page.keyboard.press("Tab")
        one = page.evaluate(focused)
        if one and one not in seen:
            seen.append(one)
    assert seen == [first, last]


def test_with_the_colours_of_the_system_marks_and_bars_stay_visible(open_page: Any) -> None:
    page = open_page("?benches=20&time=end", forced_colors="active")
    settled(with_below(page))
    page.locator("#crew summary").first.click()
    page.locator("#crew-ask").click()
    page.locator("#crew .bars i").first.wait_for()
    ground = "one => getComputedStyle(one).backgroundColor"
    card = page.locator("body").evaluate(ground)
    for place in ("#crew .bars i", "#contact-mark"):
        assert page.locator(place).first.evaluate(ground) not in (card, "rgba(0, 0, 0, 0)")


def test_the_words_of_a_failure_stand_below_a_time_of_day_that_takes_their_room(visit: Any) -> None:
    page = visit(VILLAGE)
    row = page.locator(".failures li").nth(1)
    words, button = row.locator("span").bounding_box(), row.locator("button").bounding_box()
    assert words["width"] > 150
    assert words["y"] >= button["y"] + button["height"]


def test_a_swipe_up_that_begins_on_a_slider_scrolls_and_changes_nothing(visit: Any) -> None:
    page = visit("?benches=40", **PHONE)
    settled(page)
    slider = page.locator("[data-field=benches] input[type=range]")
    slider.evaluate("one => one.scrollIntoView({ block: 'end' })")
    finger = page.context.new_cdp_session(page)

    def swipe(dx: float, dy: float) -> None:
        box = slider.bounding_box()
        x, y = box["x"] + 0.7 * box["width"], box["y"] + box["height"] / 2
        finger.send("Input.dispatchTouchEvent", {"type": "touchStart", "touchPoints": [{"x": x, "y": y}]})
        for k in range(1, 11):
            point = {"x": x + dx * k / 10, "y": y + dy * k / 10}
            finger.send("Input.dispatchTouchEvent", {"type": "touchMove", "touchPoints": [point]})
        finger.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
        settled(page)

    before = page.evaluate("scrollY")
    swipe(6, -150)
    page.wait_for_function("before => scrollY > before + 50", arg=before)
    assert page.locator("#benches").input_value() == "40"
    assert slider.input_value() == "40"
    slider.evaluate("one => one.scrollIntoView({ block: 'end' })")
    swipe(40, 3)
    assert int(page.locator("#benches").input_value()) > 200
    slider.tap()
    assert 150 < int(page.locator("#benches").input_value()) < 250


# Every state of the three doors: its address, and what is pressed there.
STATES: dict[str, tuple[str, list[str]]] = {
    "contest": ("?door=contest&benches=40&time=end", ["#play"]),
    "turn": ("?door=contest&path=turn&benches=12&time=0", []),
    "look": ("?door=look&benches=40&time=0", ["#play"]),
    "village": (f"{VILLAGE}&door=village", []),
    "path being drawn": (f"{VILLAGE}&door=village", ["#edit"]),
    "square being drawn": (f"{VILLAGE}&door=village", ["#edit", "[data-tool=area]"]),
    "nothing drawn": ("?door=village&path=route", []),
    "begins to draw": ("?door=village&path=route", ["#invite .main"]),
    "everything": (VILLAGE, ["#edit"]),
}
# What stays in sight above the rest, and what there is of it, in parts of the height of the window.
PICTURE = """() => {
  const box = (id) => document.querySelector(id).getBoundingClientRect();
  const [dance, stage, tools] = ["#dance", "#stage", "#tools"].map(box);
  const inside = [...document.querySelectorAll("#dance > :not(#tools)")].filter((one) => one.checkVisibility());
  return {
    share: dance.height / innerHeight,
    stage: stage.height / innerHeight,
    covered: tools.height > 0 && tools.top < stage.bottom - 1 && tools.bottom > stage.top,
    cut: inside.filter((one) => one.getBoundingClientRect().bottom > dance.bottom + 1).map((one) => one.id),
    wide: document.documentElement.scrollWidth > screen.width,
  };
}"""


@pytest.mark.parametrize("size", [(390, 844), (360, 640)], ids=["390x844", "360x640"])
@pytest.mark.parametrize("state", STATES)
def test_on_a_phone_the_picture_with_its_player_takes_a_third_of_the_height(
    visit: Any, state: str, size: tuple[int, int]
) -> None:
    query, presses = STATES[state]
    page = visit(query, **{**PHONE, "viewport": {"width": size[0], "height": size[1]}})
    settled(page)
    for place in presses:
        page.locator(place).click()
    for language in ("zh", "en"):
        page.locator(f"[data-lang={language}]").click()
        picture = page.evaluate(PICTURE)
        assert 0.25 < picture["share"] <= 0.351
        assert picture["stage"] > 0.18
        assert not picture["covered"]
        assert picture["cut"] == []
        assert not picture["wide"]


def test_with_dances_proposed_the_picture_of_a_phone_is_no_higher(open_page: Any) -> None:
    page = open_page("", reduced_motion="reduce", **PHONE)
    page.locator("#arrival [data-door=village]").tap()
    page.locator("#place-width").fill("30")
    page.locator("#place-height").fill("40")
    page.locator("#take-rectangle").tap()
    page.locator("#propose").tap()
    page.locator("#cards button").first.tap()
    settled(page)
    assert page.evaluate(PICTURE)["share"] <= 0.351


def test_on_a_phone_of_a_village_people_stand_together_and_files_under_save(visit: Any) -> None:
    page = with_below(visit(f"{VILLAGE}&door=village", **PHONE))
    settled(page)
    for section, within in (("people", ["#tolerance", "#crew", "#cues button"]), ("keep", ["#kept button"])):
        page.locator(f"[data-section={section}]:visible").tap()
        title = page.locator(f"#{section} > h2")
        expect(title).to_have_text(page.locator(f"[data-section={section}]").inner_text())
        expect(title).to_be_in_viewport()
        for place in within:
            expect(page.locator(f"#{section} {place}:visible").first).to_be_in_viewport()
    # On a wide screen they stand below the picture, and the numbers beside it.
    page.set_viewport_size({"width": 1366, "height": 768})
    settled(page)
    order = [page.locator(f"#{one}").bounding_box()["y"] for one in ("front", "people", "keep")]
    assert order == sorted(order)


def test_the_tab_save_leads_to_its_heading_also_when_its_files_load_only_then(open_page: Any) -> None:
    page = open_page("?door=contest&benches=20&time=end", **PHONE)
    settled(page)
    page.locator("[data-section=keep]").tap()
    page.locator("#kept li").first.wait_for()
    settled(page)
    expect(page.locator("#keep-title")).to_be_in_viewport()


def test_on_a_phone_one_tap_leads_everywhere(visit: Any) -> None:
    page = visit(VILLAGE, **PHONE)
    answered(page, VILLAGE)
    height = page.viewport_size["height"]
    for section in ("keep", "answers", "controls", "dance"):
        page.locator(f"[data-section={section}]").tap()
        top = page.locator(f"#{section}").evaluate("one => one.getBoundingClientRect().top")
        assert -1 <= top < height - 100, section


def test_the_page_how_it_works_has_the_same_sizes_of_type(open_page: Any) -> None:
    page = open_page("how?lang=zh")
    page.locator("#staircase .jump").first.wait_for(state="attached")
    settled(page)
    for width in (1366, 390):
        page.set_viewport_size({"width": width, "height": 900})
        settled(page)
        for language in ("zh", "en"):
            page.locator(f"[data-lang={language}]").click()
            sizes = set(page.evaluate(SIZES))
            assert sizes <= FOUR
            assert len(sizes) > 2


@pytest.mark.parametrize(
    ("door", "names"),
    [
        ("contest", {"en": "Picture Numbers Answers Save", "zh": "画面 参数 结果 保存"}),
        ("village", {"en": "Picture People Answers Save", "zh": "画面 人员 结果 保存"}),
        # Behind this door nothing is kept.
        ("look", {"en": "Picture Numbers Answers", "zh": "画面 参数 结果"}),
    ],
)
def test_the_tabs_of_a_phone_are_picture_people_answers_and_save(
    open_page: Any, door: str, names: dict[str, str]
) -> None:
    page = open_page(f"?door={door}&path=route&benches=3", viewport={"width": 360, "height": 780})
    settled(page)
    for language, words in names.items():
        page.locator(f"[data-lang={language}]").click()
        assert page.locator("#tabs").inner_text().split() == words.split()
        cut = "[...document.querySelectorAll('#tabs button')].filter((one) => one.scrollWidth > one.clientWidth).length"
        assert page.evaluate(cut) == 0
    page.locator("#tabs button:visible").nth(1).click()
    expect(page.locator("#controls")).to_be_in_viewport()
    if door == "village":
        # Nothing is drawn, so there is nothing to save yet.
        page.locator("#tabs button:visible").last.click()
        expect(page.locator("#answers")).to_be_in_viewport()
