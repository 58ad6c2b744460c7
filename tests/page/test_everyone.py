"""The page for everyone: phones and wide screens, two languages, keyboard, dark, reduced motion, screen readers."""

import json
import re

import pytest
from playwright.sync_api import expect

from tests.support.depth import DEEP
from tests.support.person import COVERED, PHONE
from tests.support.pseudo import CODE, left
from tests.support.serving import serving

thorough = pytest.mark.thorough
FINGER = 44  # [px]: the least width and height of what a finger should hit
FOUR = {13.1, 15.0, 19.2, 22.4}  # sizes of type [px]
VILLAGE = (
    "?path=route&route=*-67,-8_-12,-8_-3,-9_6,-8_10.5,-3_7,2.5_0,3.5_-4.5,7_-1,10.5_6,10.5_*12,15_12,62&begin=45&limit=1.1"
    "&things=a.square..-70,-11_-20,-11_-20,-15_20,-15_20,15_15,15_15,65_9,65_9,15_-20,15_-20,-5_-70,-5"
    "~c.well.1!5.6!5,-6!5~b.stage..-17,1!5_-6,1!5_-6,9!5_-17,9!5~w.fence.0!2.10!5,3!5_18,4"
    "&passages=0.5@20m_0@90s&start_clock=19:30"
)
NOTHING = "?path=route"
DANCES = {"spiral": "?benches=12&time=0", "turn": "?path=turn&benches=12&time=0", "route": VILLAGE, "nothing": NOTHING}
# A point or a handle on the picture is hit in a circle around it, a tick or a file in all of its label.
NARROW = """(least) => [...document.querySelectorAll("button, select, input, textarea, summary, a")]
  .filter((one) => one.checkVisibility() && !one.matches(".skip, .knot, .grip"))
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
# Addresses at which every word is read; those of pages without sections below.
TWO = "?dances=name:A!benches:20!pitch:1.1!start_turns:8~rotation:180&dragon=1&benches=20&pitch=1.1&start_turns=8"
SHORT = "?benches=12&bench=3", "how?time=0"
SPOKEN = "?benches=12&stray=0.02&margin=0.05", "?path=turn&benches=12&time=end", VILLAGE, TWO, *SHORT
# Everything that a person reads or hears, but for what is typed in a terminal, and what was told before.
READ = """() => {
  for (const one of document.querySelectorAll("details")) one.open = true;
  for (const one of document.querySelectorAll("pre, #heard")) one.textContent = "";
  const all = [...document.querySelectorAll("body *")].filter((one) => one.checkVisibility());
  const heard = all.flatMap((one) => [one.title, one.ariaLabel, one.placeholder]);
  return [document.title, document.body.innerText, ...heard].filter(Boolean).join("\\n");
}"""
# Sizes of all words in sight, on canvases too, in the usual size of the type [px].
SIZES = """() => {
  const sizes = new Set();
  for (const one of document.querySelectorAll("body *")) {
    const isField = one.matches("input:not([type=range], [type=color], [type=checkbox]), select, textarea");
    const hasText = [...one.childNodes].some((node) => node.nodeType === 3 && node.data.trim());
    if (!(isField || hasText) || one.matches("option, .unseen")) continue;
    if (!one.checkVisibility({ visibilityProperty: true })) continue;
    const scale = one.ownerSVGElement?.getScreenCTM().a ?? 1;
    const size = Math.round(10 * scale * Number.parseFloat(getComputedStyle(one).fontSize)) / 10;
    if (size) sizes.add(size);
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
OPEN = "document.querySelectorAll('details').forEach((one) => (one.open = true))"
EMPTY = "[...document.querySelectorAll('[data-text]')].filter((one) => !one.textContent).length"
# Records, for every element that gets the focus from now on, its name, and whether an outline shows it.
FOCUSED = """window.focused = [];
  addEventListener("focusin", ({ target: one }) =>
    focused.push([one.id || one.className || one.tagName, getComputedStyle(one).outlineStyle !== "none"]))"""
COLUMN = """async () => {
  await new Promise(requestAnimationFrame);
  return document.activeElement.closest("#controls, #answers")?.id;
}"""
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
# States of the doors: addresses, and what is pressed there.
STATES = [
    ("?door=contest&benches=40&time=end", ["#play"]),
    ("?door=look&benches=40&time=0", []),
    (f"{VILLAGE}&door=village", []),
    (f"{VILLAGE}&door=village", ["#edit", "[data-tool=area]"]),
    ("?door=village&path=route", ["#invite .main"]),
    (VILLAGE, ["#edit"]),
]


def opened(person, query):
    """All that can be opened at an address."""
    if query == NOTHING:
        person.sees({"#invite": True})
    else:
        person.sees({":is(#judgement, #first-contact) .value:visible": True})
        if query == VILLAGE:
            person.presses("#edit")
        person.reaches_below()
    person.ask(OPEN)
    if query != NOTHING:
        person.sees({"#paper table": True})
    return person.settles()


def hits_every_control(person):
    """In both languages, in few sizes of type, with every word in its place."""
    # No point lies under the buttons of the picture.
    views = person.box("#views")
    lefts = [knot.bounding_box()["x"] for knot in person.all(".knot").all()]
    assert [left for left in lefts if left < views["x"] + views["width"]] == []
    for language in ("en", "zh"):
        person.at(f"[data-lang={language}]").tap()
        assert person.ask(NARROW, FINGER) == []
        assert not person.overflows(390)
        assert person.ask(EMPTY) == 0
        assert "undefined" not in person.text("body")
        assert set(person.ask(SIZES)) <= FOUR
        assert person.box("header")["height"] < 2.5 * FINGER


def test_on_a_phone_a_finger_hits_every_control_and_one_tap_leads_everywhere(open_page):
    person = opened(open_page(VILLAGE, failing=True, **PHONE), VILLAGE)
    hits_every_control(person)
    person.settles()  # the answers come again in the other language
    for section in ("keep", "answers", "controls", "dance"):
        person.at(f"[data-section={section}]").tap()
        top = person.at(f"#{section}").evaluate("one => one.getBoundingClientRect().top")
        assert -1 <= top < 744, section
    # The message of an import covers no control, and Escape ends it.
    person.opens("?path=route&route=0,0_60,0&benches=5").presses("#edit")
    person.takes({"name": "x.csv", "mimeType": "text/csv", "buffer": b"3.41,0.3,0.275\n2.2,0.3,0.275\n"})
    person.sees({"#status": "Opened x.csv"}).settles()
    assert person.ask(COVERED) == []
    person.presses("#edit").settles()
    assert person.ask(COVERED) == []
    person.strikes("Escape").reads({"#status": ""})
    expect(person.at("#status")).to_be_hidden()
    # Notes of a map are there as a whole.
    trees = [{"type": "Point", "coordinates": [10 * k, 9]} for k in range(12)]
    line = {"type": "LineString", "coordinates": [[0, 0], [120, 0]]}
    wood = json.dumps({"type": "GeometryCollection", "geometries": [line, *trees]}).encode()
    person.takes({"name": "wood.geojson", "mimeType": "application/geo+json", "buffer": wood})
    assert person.sees({"#opening": True}).findings() == []
    person.presses("#instead").sees({"#status": ["Opened wood.geojson", "No polygon is the square"]}).settles()
    assert person.ask(COVERED) == []
    assert person.at("#status").evaluate("one => one.scrollHeight <= one.clientHeight")
    # The path of another map is too short, which is all that is said of it.
    short = b'{"type": "LineString", "coordinates": [[0, 0], [4, 0]]}'
    person.takes({"name": "short.geojson", "mimeType": "application/geo+json", "buffer": short})
    person.presses("#instead").sees({"#judgement": "The path is too short", "main.stale": True}).settles()
    for old in ("#old", "#tolerance > .old"):
        expect(person.at(old)).to_be_hidden()
    # Nor does a short one, in any window; it says which things no file holds.
    query = "?lang=en&path=route&route=0,0_60,0&benches=5&things=b.shed..1,9_2,9~c.well.1.5,9"
    for width, height in ((1440, 900), (800, 600), (390, 844), (320, 568)):
        person.page.set_viewport_size({"width": width, "height": height})
        person.opens(query).reaches_below().saves("#keepMap-GeoJSON")
        person.sees({"#status": ["Saved map.geojson", "Left out, because corners are missing: “shed”."]}).settles()
        assert person.ask(COVERED) == []
        person.saves("#save")
        person.sees({"#status": ["Saved dance.json", "“shed”"]}).settles()
        assert person.ask(COVERED) == []


# The numbers in tables that stand on more than one line.
BROKEN = """() => {
  const broken = [];
  for (const cell of document.querySelectorAll("td, th")) {
    if (!cell.checkVisibility()) continue;
    const walker = document.createTreeWalker(cell, NodeFilter.SHOW_TEXT);
    for (let text = walker.nextNode(); text; text = walker.nextNode())
      for (const number of text.data.matchAll(/(?<![\\w./])\\d[\\d.:]*(?![\\w./])/g)) {
        const range = document.createRange();
        range.setStart(text, number.index);
        range.setEnd(text, number.index + number[0].length);
        if (new Set([...range.getClientRects()].map((box) => Math.round(box.top))).size > 1) broken.push(text.data);
      }
  }
  return broken;
}"""


def test_a_message_on_a_tablet_leaves_what_comes_next_and_a_tap_presses_nothing_that_comes_under_it(open_page):
    person = open_page("?door=village", failing=True, **PHONE | {"viewport": {"width": 1024, "height": 768}})
    person.takes({"name": "x.csv", "mimeType": "text/csv", "buffer": b"3.41,0.3,0.275\n2.2,0.3,0.275\n"})
    person.sees({"#status": "Opened x.csv"}).settles().at("#follow").tap()
    person.presses("#place button:text-is('Tree')").settles()
    # The tap meets the path under the head, which is edited from then on.
    for place in ("#canvas", "#show-all", ".knot >> nth=0"):
        person.at(place).tap()
    person.sees({"#status": "Point 1"}).settles()
    assert person.ask(COVERED) == []
    person = open_page("?door=village&path=route", failing=True, **PHONE)
    person.at("#invite button").tap()
    for away in ((-80, 70), (0, 80)):
        person.page.touchscreen.tap(*person.settles().spot("#canvas", *away))
    person.settles()
    assert person.ask("[document.activeElement.id, scrollY]") == ["canvas", 0]


@thorough
def test_on_a_phone_a_finger_hits_every_control_of_other_dances_and_scrolls_over_a_slider(open_page):
    person = open_page("?benches=40", **PHONE)
    _a_swipe_up_that_begins_on_a_slider_changes_nothing(person)
    for name in ("spiral", "turn", "nothing"):
        hits_every_control(opened(person.opens(DANCES[name]), DANCES[name]))
    # The crew of a spiral up to its first contact.
    person.opens("?benches=5&time=20&lang=en").reaches_below().presses("#crew summary", "#crew-ask")
    assert not person.sees({"#crew-result table": 2}).overflows(390)
    assert person.findings("#crew") == []
    person.presses("#paper summary").sees({"#paper table": 1})
    for language in ("en", "zh"):
        person.speaks(language)
        for width in (390, 360):
            person.page.set_viewport_size({"width": width, "height": 800})
            assert not person.settles().overflows(width)
            assert person.ask(BROKEN) == []


def _a_swipe_up_that_begins_on_a_slider_changes_nothing(person):
    slider = person.at("[data-field=benches] input[type=range]")

    def swipe(dx, dy):
        slider.evaluate("one => one.scrollIntoView({ block: 'end' })")
        slider.click(trial=True)  # waits until no swipe before moves it any more
        box = slider.bounding_box()
        person.swipes(box["x"] + 0.7 * box["width"], box["y"] + box["height"] / 2, dx, dy)

    before = person.ask("scrollY")
    swipe(6, -150)
    person.page.wait_for_function("before => scrollY > before + 50", arg=before)
    assert (person.holds({"#benches": "40"}).at("#benches").input_value(), slider.input_value()) == ("40", "40")
    swipe(40, 3)
    assert int(person.at("#benches").input_value()) > 200
    # The picture stays in sight of what is dragged.
    assert person.box("#canvas")["y"] >= 0


@thorough
def test_on_a_wide_screen_nothing_scrolls_inside_and_the_picture_stays_in_sight(open_page):
    person = open_page(DANCES["spiral"])
    _the_tab_key_goes_through_numbers_and_answers_as_they_stand(person)
    for query in DANCES.values():
        person.opens(query)
        person.ask("document.querySelectorAll('#answers details').forEach((one) => (one.open = true))")
        for width, height in ((1440, 900), (1920, 1080)):
            person.page.set_viewport_size({"width": width, "height": height})
            assert person.settles().ask(SCROLLING) == [], query
            person.at("#answers > :not([hidden]) >> nth=-1").evaluate("one => one.scrollIntoView({ block: 'end' })")
            canvas = person.box("#canvas")
            assert canvas["y"] >= 0, query
            assert canvas["y"] + canvas["height"] <= height, query


def _the_tab_key_goes_through_numbers_and_answers_as_they_stand(person):
    for width, order in (
        (1440, ["controls", "answers"]),
        (900, ["controls", "answers"]),
        (390, ["answers", "controls"]),
    ):
        person.page.set_viewport_size({"width": width, "height": 900})
        boxes = [person.settles().box(f"#{one}") for one in order]
        assert boxes[0]["x"] < boxes[1]["x"] or boxes[0]["y"] < boxes[1]["y"]
        person.focuses("#rate")
        seen = [person.strikes("Tab").ask(COLUMN) for _ in range(40)]
        assert list(dict.fromkeys(filter(None, seen))) == order


@thorough
def test_on_a_phone_each_door_has_its_tabs_and_a_picture_of_a_third_of_the_height(open_page):
    person = open_page("?door=all", **PHONE)
    for query, presses in STATES:
        person.opens(query).presses(*presses)
        for width, height in ((390, 844), (360, 640)):
            person.page.set_viewport_size({"width": width, "height": height})
            picture = person.settles("look").ask(PICTURE)
            assert 0.25 < picture["share"] <= 0.351
            assert picture["stage"] > 0.18
            assert (picture["covered"], picture["cut"], picture["wide"]) == (False, [], False)
    person.page.set_viewport_size(PHONE["viewport"])
    for door, words in (
        ("contest", "Picture Numbers Answers Save"),
        ("village", "Picture People Answers Save"),
        ("look", "Picture Numbers Answers"),  # Behind this door nothing is kept.
    ):
        person.opens(f"?door={door}&path=route&benches=3")
        assert person.text("#tabs").split() == words.split()
        assert person.ask(NARROW, FINGER) == []
        assert set(person.ask(SIZES)) <= FOUR
        person.presses("#tabs button:visible >> nth=1").views("#controls")
    person.opens(f"{VILLAGE}&door=village").reaches_below()
    person.at("[data-section=people]:visible").tap()
    person.views("#people > h2", "#people #tolerance:visible", "#people #cues button:visible")


def test_the_language_is_that_of_the_browser_until_another_is_chosen_and_keys_alone_lead_everywhere(open_page):
    person = open_page("?benches=40&time=end", locale="zh-CN").has("html", lang="zh-Hans")
    person.sees({"#first-contact .value": "时碰撞", "#minimum-pitch": "最小螺距"})
    assert "Pitch" not in person.text("main")
    person.at("#rows").evaluate("box => box.scrollTo(0, box.scrollHeight)")
    person.sees({"#rows tr:has-text('龙尾（后）')": True}).speaks("en").arrives("**lang=en")
    person.page.reload()
    person.reads({"h1 a, h1": "Bench Dragon"})
    _keys_alone_lead_everywhere(person.settles().reaches_below())


def _keys_alone_lead_everywhere(person):
    person.ask(FOCUSED)
    assert person.strikes("Tab").ask("focused[0][0]") == "skip"
    person.strikes("Enter").focuses("#canvas")
    person.strikes("]").sees({"tr.chosen": "0 · head"}).strikes("+", "ArrowLeft").arrives("**view=**")
    person.strikes("0", "f").sees({"#follow[aria-pressed=true]": True}).strikes(" ").sees({"#play": "Pause"})
    person.strikes(" ").sees({"#play": "Play"}).ask("focused = []")
    focused = person.strikes(*["Tab"] * 170).ask("focused")
    assert [name for name, is_outlined in focused if not is_outlined] == []
    wanted = {"play", "time", "rate", "pitch", "benches", "margin", "rows", "share", "follow", "keepTrajectory-CSV"}
    assert wanted <= {name for name, _ in focused}


def test_no_word_of_the_page_is_outside_the_catalogues(open_page, pseudo_house, tmp_path):
    with serving(tmp_path / "server.log", house=pseudo_house, deadline_seconds=60) as service:
        person = open_page(base=service.url, failing=True).speaks(CODE)
        for place in SPOKEN:
            person.page.goto(f"{service.url}/{place}&lang={CODE}")
            if person.settles() and place not in SHORT:
                person.reaches_below()
            text = person.ask(READ)
            assert len(text) > 300
            assert left(text) == [], place


def test_a_verdict_is_told_with_its_reasons_and_a_picture_shows_its_direction(open_page):
    person = open_page("?path=route&route=*-40,0_0,0_30,5&benches=5&things=a.square..-30,-20_9,-20_9,20_-30,20")
    reasons = person.all("#judgement .failures span").all_text_contents()
    assert len(reasons) > 1
    expect(person.at("#heard")).to_have_text(re.compile(r"^Verdict Cannot be danced"))
    person.sees({"#heard": reasons})
    person.sees({"#judgement[aria-live], #first-contact[aria-live]": 0})
    _the_picture_has_its_direction_and_its_inset_gives_way(person.opens("?time=0&view=8.8,0,40"))


@thorough
def test_axe_finds_nothing_in_light_or_dark_and_marks_stay_visible_in_the_colours_of_the_system(open_page):
    person = open_page("?handle=3&stray=0.02&benches=20", failing=True, color_scheme="light")
    _axe_finds_nothing(person.looks_at("curve", "scan"))
    if DEEP:
        _axe_finds_nothing(person.opens("?pitch=2&start_turns=8&benches=20&lang=zh").looks_at("curve", "scan"))
    person.page.set_viewport_size(PHONE["viewport"])
    _axe_finds_nothing(person.opens("?pitch=55&benches=x&lang=en").sees({"#pitch-error": True}))
    person = open_page("?benches=20&time=end", forced_colors="active").reaches_below()
    person.presses("#crew summary", "#crew-ask").sees({"#crew .bars i": True})
    card = person.style("body", "backgroundColor")
    marks = {person.style(place, "backgroundColor") for place in ("#crew .bars i", "#contact-mark")}
    assert not marks & {card, "rgba(0, 0, 0, 0)"}


def _axe_finds_nothing(person):
    person.page.emulate_media(color_scheme="light")
    person.ask(OPEN)
    assert person.findings() == []
    person.speaks("zh").ask(OPEN)
    person.page.emulate_media(color_scheme="dark")
    assert person.findings(in_colours=True) == []


def _the_picture_has_its_direction_and_its_inset_gives_way(person):
    # The head is in the middle and moves down: its arrow crosses the row 20 pixels below.
    seen = "c => [...c.getContext('2d').getImageData(c.width / 2 - 8, c.height / 2 + 20, 16, 1).data]"
    row = person.at("#canvas").evaluate(seen)
    assert any(red > 150 > max(green, blue) for red, green, blue in zip(row[::4], row[1::4], row[2::4], strict=True))
    # The contact in the middle, then below the inset.
    person.opens("?time=end&view=1.474395,2.110665,40").sees({"#inset[data-corner=top-right]": True})
    person.opens("?time=end&view=-5.6,-3.1,40").sees({"#inset[data-corner=top-left]": True})
