"""The page for everyone: two languages, keyboard, phone, dark, reduced motion, screen readers."""

from __future__ import annotations

import re
from typing import Any

import pytest
from playwright.sync_api import expect

from tests.support.axe import findings
from tests.support.pending import settled, with_below

PHONE = {"width": 390, "height": 844}


# Records, for every element that gets the focus from now on, its name, and whether an outline shows it.
FOCUSED = """window.focused = [];
  addEventListener("focusin", ({ target: one }) =>
    focused.push([one.id || one.className || one.tagName, getComputedStyle(one).outlineStyle !== "none"]))"""


def test_chinese_is_the_first_language_of_a_chinese_browser_with_the_terms_of_the_contest(open_page: Any) -> None:
    page = open_page("?benches=40&time=end", locale="zh-CN")
    page.locator("#first-contact .value", has_text="时碰撞").wait_for()
    words = page.locator("body").inner_text()
    for term in ("龙头", "龙身", "把手", "螺距", "调头空间"):
        assert term in words
    page.locator("#rows tr[data-handle]").first.wait_for()
    page.locator("#rows").evaluate("box => box.scrollTo(0, box.scrollHeight)")
    page.locator("#rows tr", has_text="龙尾（后）").wait_for()
    assert page.locator("html").get_attribute("lang") == "zh-Hans"


def test_the_language_is_switched_on_the_page_and_stays_in_the_address(visit: Any) -> None:
    page = visit()
    page.get_by_role("button", name="中文").click()
    page.locator("h1", has_text="板凳龙").wait_for()
    page.locator("#minimum-pitch", has_text="最小螺距").wait_for()
    assert "Pitch" not in page.locator("main").inner_text()
    page.wait_for_url("**lang=zh")
    page.reload()
    page.locator("h1", has_text="板凳龙").wait_for()
    page.get_by_role("button", name="English").click()
    page.locator("h1", has_text="Bench Dragon").wait_for()


def test_no_text_is_missing_in_either_language(visit: Any) -> None:
    page = visit()
    for language in ("English", "中文"):
        page.get_by_role("button", name=language).click()
        settled(page)
        empty = "[...document.querySelectorAll('[data-text]')].filter((one) => !one.textContent).length"
        assert page.evaluate(empty) == 0
        assert "undefined" not in page.locator("body").inner_text()
    keys = page.evaluate(
        """async () => {
          const names = ["dance", "answers", "more", "route", "square", "below"];
          const rooms = await Promise.all(names.map((one) => import(`/page/words/${one}.js`)));
          return rooms.flatMap(Object.values).flatMap(Object.keys);
        }"""
    )
    assert len(keys) == len(set(keys)) > 300


def test_the_page_is_used_by_keyboard_alone(open_page: Any) -> None:
    page = open_page("?time=100&benches=20")
    settled(with_below(page))
    page.evaluate(FOCUSED)
    page.keyboard.press("Tab")
    assert page.evaluate("focused[0][0]") == "skip"
    page.keyboard.press("Enter")
    page.locator("#canvas").focus()
    page.keyboard.press("]")
    page.locator("tr.chosen", has_text="0 · head").wait_for()
    page.keyboard.press("+")
    page.keyboard.press("ArrowLeft")
    page.wait_for_url("**view=**")
    page.keyboard.press("0")
    page.keyboard.press("f")
    page.locator("#follow[aria-pressed=true]").wait_for()
    page.keyboard.press(" ")
    page.locator("#play", has_text="Pause").wait_for()
    page.keyboard.press(" ")
    page.locator("#play", has_text="Play").wait_for()
    page.evaluate("focused = []")
    for _ in range(170):
        page.keyboard.press("Tab")
    focused = page.evaluate("focused")
    assert [name for name, is_outlined in focused if not is_outlined] == []
    seen = {name for name, _ in focused}
    assert {"play", "time", "rate", "pitch", "benches", "margin", "rows", "share", "follow"} <= seen
    assert "keepTrajectory-CSV" in seen
    page.locator("#pitch").focus()
    page.keyboard.press("ControlOrMeta+a")
    page.keyboard.type("0.5")
    page.locator("#scan .reading", has_text="0.5 m").wait_for()


def test_nothing_is_cut_off_at_390_pixels(visit: Any) -> None:
    page = visit("?stray=0.02", viewport=PHONE, locale="zh-CN", has_touch=True, is_mobile=True)
    settled(page)
    outside = """(width) => [...document.querySelectorAll("button, input, select, h1, h2, h3, .value")]
      .filter((one) => one.checkVisibility() && one.getBoundingClientRect().right > width + 1)
      .map((one) => one.outerHTML)"""
    for language in ("中文", "English"):
        page.get_by_role("button", name=language).tap()
        page.locator("#play", has_text={"中文": "播放", "English": "Play"}[language]).wait_for()
        assert page.evaluate("document.documentElement.scrollWidth") <= PHONE["width"]
        assert page.evaluate(outside, PHONE["width"]) == []
    page.locator("#play").tap()
    page.locator("#play", has_text="❚❚").wait_for()


def test_reduced_motion_moves_in_steps(open_page: Any) -> None:
    page = open_page("?benches=40&time=0&rate=1", reduced_motion="reduce")
    settled(page)
    page.locator("#play").click()
    count = """() => new Promise((resolve) => {
      const seen = new Set();
      const clock = document.querySelector("#clock");
      const look = () => {
        seen.add(clock.textContent);
        if (seen.size < 3) requestAnimationFrame(look);
        else resolve([...seen]);
      };
      look();
    })"""
    times = sorted(float(text.removesuffix(" s")) for text in page.evaluate(count))
    assert times[2] - times[1] >= 0.4


def test_a_verdict_is_told_with_its_reasons(open_page: Any) -> None:
    page = open_page("?path=route&route=*-40,0_0,0_30,5&benches=5&things=a.square..-30,-20_9,-20_9,20_-30,20")
    settled(page)
    reasons = page.locator("#judgement .failures span").all_text_contents()
    assert len(reasons) > 1
    expect(page.locator("#heard")).to_have_text(re.compile(r"^Verdict Cannot be danced"))
    for reason in reasons:
        expect(page.locator("#heard")).to_contain_text(reason)


def test_no_verdict_is_told_twice(open_page: Any) -> None:
    page = open_page("?path=route&route=-9,0_9,0_20,9&benches=3")
    settled(page)
    heard = page.locator("#heard")
    expect(heard).to_have_text(re.compile(r"^Verdict Can be danced The head walks"))
    page.evaluate("""() => {
      window.told = [];
      const heard = document.querySelector("#heard");
      new MutationObserver(() => window.told.push(heard.textContent)).observe(heard, { childList: true });
    }""")
    before = heard.inner_text()
    page.locator("#edit").click()
    page.locator(".knot").nth(2).focus()
    for _ in range(3):
        page.keyboard.press("Shift+ArrowRight")
    expect(heard).not_to_have_text(before)
    settled(page)
    # On a slow machine a verdict in between may stay long enough to be told too, but none is told twice.
    told = page.evaluate("window.told")
    assert told
    assert len(set(told)) == len(told)
    assert page.locator("#judgement[aria-live], #first-contact[aria-live]").count() == 0


@pytest.mark.parametrize(
    ("query", "options"),
    [
        ("?handle=3&stray=0.02&benches=20", {}),
        pytest.param("?pitch=2&start_turns=8&benches=20", {"locale": "zh-CN"}, marks=pytest.mark.deep),
        ("?pitch=55&benches=x", {"viewport": PHONE}),
    ],
    ids=["contact", "clear", "refused on a phone"],
)
def test_axe_finds_nothing_in_light_or_dark(open_page: Any, look_at: Any, query: str, options: dict[str, Any]) -> None:
    refused = "pitch=55" in query
    page = open_page(query, failing=refused, color_scheme="light", **options)
    page.locator("#pitch-error").wait_for() if refused else look_at(page, "curve", "scan")
    settled(page)
    opened = "document.querySelectorAll('details').forEach((one) => (one.open = true))"
    page.evaluate(opened)
    assert findings(page) == []
    page.locator("[data-lang=zh]").click()
    settled(page)
    page.evaluate(opened)
    page.emulate_media(color_scheme="dark")
    assert findings(page, in_colours=True) == []
