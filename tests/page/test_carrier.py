"""The view of one carrier: its bench, its cues, its clock, and a network that goes away."""

from __future__ import annotations

import math
import re
from datetime import datetime, timedelta
from pathlib import Path
from typing import Any
from urllib.parse import parse_qs, urlsplit

import pytest
from playwright.sync_api import expect

from tests.support import polite
from tests.support.axe import findings
from tests.support.pending import settled, with_below
from tests.support.serving import free_port, serving

PATIENT = 50.0  # longest computation of one answer [s], also on a busy machine
PHONE: Any = {"width": 390, "height": 844}
ON_PHONE = {"viewport": PHONE, "is_mobile": True, "has_touch": True}
# A street, an S and a straight end: its carriers meet nobody, but they walk, and are done at different places.
STREET = "path=route&route=*-40,0_0,0_20,10_*40,0_80,0&begin=30&benches=9&door=village"
DRAGON = {"benches": 20, "head_length": 3.41, "body_length": 2.2, "width": 0.3, "overhang": 0.275}
SPIRAL = {"kind": "spiral", "pitch": 0.55, "start_turns": 16}
CORRECTION = 5.0  # of one press [s]
SLACK = 45  # from the last press to the cue [s], so that a slow machine is not late


def card(server: str, bench: int, language: str = "en", **more: Any) -> Any:
    """The card of a bench of the spiral with 20 benches, up to its first contact."""
    stop = polite.get(f"{server}/collision-time", params={"benches": 20}).json()["time"]
    body = {"dragon": DRAGON, "path": SPIRAL, "start": 0, "stop": stop, "cards": [bench], "language": language} | more
    return polite.post(f"{server}/cues", json=body).raise_for_status().json()["cards"][0]


# Two dragons in one spiral, by the list in the address; the chosen one is that of the other numbers.
OF_TWO = "benches=20&pitch=1.1&start_turns=8"
TWO = "{}~{}".format("name:A!benches:20!pitch:1.1!start_turns:8", "rotation:180")
SPIRALS = [{"kind": "spiral", "pitch": 1.1, "start_turns": 8, **more} for more in ({}, {"rotation": math.pi})]


def card_of_two(server: str, bench: int, dragon: int, language: str) -> Any:
    """The card of a bench of two dragons, up to their encounter."""
    names = ["A", {"en": "blue", "zh": "蓝龙"}[language]]
    own = [{"name": name, "dragon": DRAGON, "path": path} for name, path in zip(names, SPIRALS, strict=True)]
    report = polite.post(f"{server}/check", json={"dances": own}).raise_for_status().json()
    span = {"start": report["start"], "stop": report["encounter"]["time"] or report["stop"] - 1e-6}
    body = {"dances": own, **span, "cards": [bench], "part": dragon, "language": language}
    return polite.post(f"{server}/cues", json=body).raise_for_status().json()["cards"][0]


def words_of(page: Any) -> list[str]:
    return page.locator("#card-more li span:last-child").all_inner_texts()


def test_the_dance_is_shown_again_where_it_was_before_the_card(open_page: Any) -> None:
    page = open_page("?benches=20&time=100")
    settled(with_below(page))
    page.locator("#card-follow").click()
    held(page)
    page.locator("#carrier").get_by_role("button", name="Close").click()
    settled(page)
    expect(page.locator("#clock")).to_have_text("100.000000 s")
    expect(page.locator("#table-time")).to_contain_text("100.000000 s")


def goes_on_in_both_languages(page: Any, picture: Any, cues: dict[str, Any], heading: str) -> None:
    """Start the card without a network: cues, picture and, in Chinese, the heading follow the clock."""
    expect(page.locator("#card-more .hint")).to_contain_text("No network: the card goes on.")
    page.locator("#card-start").click()
    before = picture(page)
    ahead(page, 5)
    expected = next(k for k, cue in enumerate(cues["en"]) if cue["since"] > 27)
    expect(page.locator("#card-more li.following")).to_contain_text(cues["en"][expected]["words"])
    page.get_by_role("button", name="中文").click()
    expect(page.locator("#carrier h1")).to_have_text(heading)
    expect(page.locator("#card-more .hint")).to_contain_text("没有网络")
    assert words_of(page) == [cue["words"] for cue in cues["zh"]]
    assert page.evaluate(MIDDLE) > 100
    assert (picture(page) != before).any(axis=-1).mean() > 0.01


def held(page: Any) -> Any:
    page.locator("#carrier[data-held=true]").wait_for()
    return page


def ahead(page: Any, presses: int) -> None:
    """Press the button of those who are ahead, as quickly as the page takes it."""
    code = "presses => { for (let k = 0; k < presses; k++) document.querySelector(\"[data-correct='5']\").click(); }"
    page.evaluate(code, presses)


def seconds(clock: str) -> int:
    """A duration such as 6:06 in seconds."""
    return sum(int(part) * 60**k for k, part in enumerate(reversed(clock.split(":"))))


MIDDLE = """() => {
  const canvas = document.querySelector("#canvas");
  const { data } = canvas.getContext("2d").getImageData(canvas.width / 2 - 20, canvas.height / 2 - 20, 40, 40);
  const probe = Object.assign(document.createElement("canvas"), { width: 1, height: 1 }).getContext("2d");
  probe.fillStyle = getComputedStyle(canvas).getPropertyValue("--pick");
  probe.fillRect(0, 0, 1, 1);
  const [r, g, b] = probe.getImageData(0, 0, 1, 1).data;
  const has = (k) => data[4 * k] === r && data[4 * k + 1] === g && data[4 * k + 2] === b;
  return [...Array(1600).keys()].filter(has).length;
}"""


def test_the_times_are_those_of_the_printed_card_in_their_order(open_page: Any) -> None:
    # Benches pass for a while, and are nearest at one moment of it.
    path = "*-67,-8_-12,-8_-3,-9_6,-8_10.5,-3_7,2.5_0,3.5_-4.5,7_-1,10.5_6,10.5_*12,15_12,62"
    with (page := open_page(f"?path=route&route={path}&bench=17", **ON_PHONE)).expect_response("**/cues") as sent:
        page.reload()
    held(page)
    cues = sent.value.json()["cards"][0]["cues"]
    assert any(cue["since"] < cue["time"] for cue in cues)
    shown = page.locator("#card-more li span:first-child").all_inner_texts()
    seconds = [60.0 * float(minutes) + float(rest) for minutes, rest in (text.split(":") for text in shown)]
    assert seconds == pytest.approx([cue["time"] for cue in cues], abs=0.051)
    assert seconds == sorted(seconds)


@pytest.mark.parametrize("language", ["en", "zh"])
def test_a_carrier_has_its_own_card_and_its_bench_in_the_middle(open_page: Any, server: str, language: str) -> None:
    allowed = {"en": ["screen-wake-lock"], "zh": []}[language]
    page = held(open_page(f"?benches=20&bench=7&lang={language}", permissions=allowed, **ON_PHONE))
    own = card(server, 7, language)
    assert words_of(page) == [cue["words"] for cue in own["cues"]]
    expect(page.locator("#carrier h1")).to_have_text({"en": "body 7", "zh": "第7节龙身"}[language])
    steps, mark = abs(own["start"]["steps"]), round(own["start"]["mark"])
    expect(page.locator("#card-more .stand")).to_contain_text(str(mark))
    expect(page.locator("#card-more .stand")).to_contain_text(str(steps) if steps else str(mark))
    assert page.evaluate(MIDDLE) > 100  # Its bench is 7 px wide.
    expect(page.locator("#carrier")).to_have_attribute("data-awake", str(bool(allowed)).lower())
    awake = "The screen stays on." if allowed else "请将设备设为屏幕常亮。"
    expect(page.locator("#card-more .hint")).to_contain_text(awake)
    for place in ("header", "#controls", "#answers", "#transport", "#tabs", "#keep"):
        expect(page.locator(place).first).to_be_hidden()
    assert page.evaluate("document.documentElement.scrollWidth") == PHONE["width"]
    assert findings(page, "#front") == []
    small = """() => [...document.querySelectorAll("#carrier :is(button, input), #card-more button")]
      .filter((one) => one.checkVisibility() && one.getBoundingClientRect().height < 24).map((one) => one.outerHTML)"""
    assert page.evaluate(small) == []


def test_the_next_cue_is_counted_down_and_the_pressed_start_outlives_the_page(open_page: Any, server: str) -> None:
    page = held(open_page("?benches=20&bench=7&lang=en", **ON_PHONE))
    cues = card(server, 7)["cues"]
    expect(page.locator("#carrier .cue")).to_contain_text("Press Start when the dance begins.")
    page.locator("#card-start").click()
    late = next(cue for cue in cues if cue["since"] > 100)
    ahead(page, int((late["since"] - SLACK) // CORRECTION))
    expect(page.locator("#carrier .cue")).to_have_text(late["words"])
    when, clock = page.locator("#carrier .when"), page.locator("#carrier .clock")
    expect(when).to_have_text(re.compile(r"^in 0:\d\d$"))
    expect(page.locator("#card-more li").nth(cues.index(late))).to_have_class("following")
    assert 0 < int(when.inner_text()[-2:]) <= SLACK + CORRECTION
    gone = seconds(clock.inner_text())
    page.reload()
    held(page)
    expect(page.get_by_role("button", name="Start again")).to_be_visible()
    assert seconds(clock.inner_text()) >= gone
    while when.inner_text().startswith("in") and int(when.inner_text()[-2:]) > 2 * CORRECTION:
        ahead(page, 1)
        page.wait_for_timeout(100)
    expect(when).to_have_text("Now")  # The moment comes by itself.


def test_without_a_network_the_card_and_its_picture_go_on_in_both_languages(
    open_page: Any, server: str, picture: Any, tmp_path: Path
) -> None:
    port = free_port()
    with serving(tmp_path / "gone.log", port=port, deadline_seconds=PATIENT):
        page = open_page("?benches=20&bench=7&lang=en", base=f"http://127.0.0.1:{port}", failing=True, **ON_PHONE)
        held(page)
    expect(page.locator("#lost")).to_be_hidden()
    cues = {language: card(server, 7, language)["cues"] for language in ("en", "zh")}
    goes_on_in_both_languages(page, picture, cues, "第7节龙身")
    ahead(page, 100)
    expect(page.locator("#carrier .cue")).to_have_text("舞龙已结束。")


def test_with_a_time_of_day_the_card_goes_by_the_clock(open_page: Any, server: str) -> None:
    begun = datetime.now() - timedelta(seconds=30)
    clock = begun.strftime("%H:%M:%S")
    page = held(open_page(f"?benches=20&bench=7&lang=en&start_clock={clock.replace(':', '%3A')}"))
    own = card(server, 7, start_clock=clock)
    first = page.locator("#card-more li span:first-child").first
    expect(first).to_have_text(own["cues"][0]["clock"])
    gone = (datetime.now() - begun).total_seconds()
    wanted = {cue["words"] for cue in own["cues"] if gone - 10 < cue["since"]}
    assert page.locator("#carrier .cue").inner_text() in wanted
    expect(page.locator("#carrier .clock")).to_have_text(re.compile(r"^\d\d:\d\d:\d\d$"))
    page.get_by_role("button", name="Start again").click()
    expect(page.locator("#card-more li.past")).to_have_count(0)
    page.locator("#card-clock").click()
    expect(page.locator("#card-more li.past").first).to_be_visible()


def test_another_bench_is_chosen_and_one_that_is_not_there_is_named(open_page: Any) -> None:
    page = held(open_page("?benches=20&bench=7&lang=en"))
    page.locator("#card-bench").fill("12")
    page.locator("#card-bench").press("Enter")
    expect(page.locator("#carrier h1")).to_have_text("body 12")
    page.wait_for_url("**bench=12**")
    expect(page.locator("#card-more .beside")).to_have_text("Before you: body 11. Behind you: body 13.")
    page.locator("#card-bench").fill("300")
    page.locator("#card-bench").press("Enter")
    expect(page.locator("#carrier .cue")).to_have_text("This dragon has no bench 300: its tail is bench 19.")
    page.go_back()


def test_a_dance_that_is_refused_says_why(open_page: Any) -> None:
    page = open_page("?pitch=55&bench=7&lang=en", failing=True)
    expect(page.locator("#carrier .cue")).to_contain_text("must be at most 10 m; it is 55 m")


def test_the_view_opens_from_the_page_and_closes_to_it(open_page: Any) -> None:
    page = open_page(f"?{STREET}&lang=en&handle=4")
    settled(with_below(page))
    page.get_by_role("button", name="Follow a bench").click()
    held(page)
    assert parse_qs(urlsplit(page.url).query)["bench"] == ["4"]
    page.get_by_role("button", name="Close").click()
    expect(page.locator("#carrier")).to_be_hidden()
    expect(page.locator("#judgement .value")).to_contain_text("Can be danced")
    settled(page)
    assert "bench=" not in page.url


def test_on_a_spiral_the_cards_end_where_the_dance_ends(open_page: Any) -> None:
    page = open_page("?benches=5&time=end")
    settled(with_below(page))
    with page.expect_download() as download:
        page.locator("#keepCues-CSV").click()
    assert Path(download.value.path()).read_bytes().startswith(b"bench,")


SIZES = """() => {
  const sizes = new Set();
  for (const one of document.querySelectorAll("body *")) {
    const isField = one.matches("input:not([type=range], [type=color], [type=checkbox]), select, textarea");
    const hasText = [...one.childNodes].some((node) => node.nodeType === 3 && node.data.trim());
    if ((isField || hasText) && one.checkVisibility({ visibilityProperty: true }) && !one.matches("option, .unseen"))
      sizes.add(getComputedStyle(one).fontSize);
  }
  return [...sizes];
}"""


@pytest.mark.parametrize("language", ["en", "zh"])
def test_on_a_phone_the_picture_takes_a_third_and_four_sizes_of_type_are_enough(open_page: Any, language: str) -> None:
    benches = {"en": 19, "zh": 18}[language]  # Another dance has not begun.
    page = held(open_page(f"?benches={benches}&bench=7&lang={language}", **ON_PHONE))
    assert page.locator("#stage").bounding_box()["height"] <= 0.35 * PHONE["height"] + 1
    before = set(page.evaluate(SIZES))
    page.locator("#card-start").click()
    assert len(before | set(page.evaluate(SIZES))) <= 4


def test_on_paper_stand_the_bench_its_picture_and_all_cues_without_buttons(open_page: Any, server: str) -> None:
    page = held(open_page("?benches=20&bench=7&lang=en"))
    page.emulate_media(media="print")
    page.pdf()
    expect(page.locator("button:visible, input:visible")).to_have_count(0)
    expect(page.locator("#canvas")).to_be_visible()
    expect(page.locator("#carrier h1")).to_have_text("body 7")
    assert words_of(page) == [cue["words"] for cue in card(server, 7)["cues"]]


def test_a_bench_of_the_chosen_one_of_several_dragons_goes_on_without_a_network(
    open_page: Any, server: str, picture: Any, tmp_path: Path
) -> None:
    port = free_port()
    with serving(tmp_path / "gone.log", port=port, deadline_seconds=PATIENT):
        address = f"?dances={TWO}&dragon=1&{OF_TWO}&bench=7&lang=en"
        page = open_page(address, base=f"http://127.0.0.1:{port}", failing=True, **ON_PHONE)
        held(page)
        expect(page.locator("#carrier h1")).to_have_text("blue: body 7")
        assert page.evaluate(MIDDLE) > 100
    cues = {language: card_of_two(server, 7, 1, language)["cues"] for language in ("en", "zh")}
    assert any(cue["nearest"] and cue["nearest"]["dragon"] == 0 for cue in cues["en"])
    assert words_of(page) == [cue["words"] for cue in cues["en"]]
    goes_on_in_both_languages(page, picture, cues, "蓝龙：第7节龙身")


def test_another_dragon_is_chosen_in_the_view(open_page: Any, server: str) -> None:
    page = held(open_page(f"?dances={TWO}&dragon=1&{OF_TWO}&bench=7&lang=en"))
    page.locator("#card-dragon").select_option("A")
    expect(page.locator("#carrier h1")).to_have_text("A: body 7")
    page.wait_for_url(lambda url: "dragon" not in parse_qs(urlsplit(url).query))
    held(page)
    assert words_of(page) == [cue["words"] for cue in card_of_two(server, 7, 0, "en")["cues"]]
