"""The page "How it works": its figures show the service's own numbers while they are dragged, in both languages."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

import pytest
from playwright.sync_api import expect

from tests.support import polite
from tests.support.axe import findings
from tests.support.pending import settled

PHONE = {"viewport": {"width": 390, "height": 844}, "has_touch": True, "is_mobile": True}
SECTIONS = ("chord", "staircase", "step", "graze", "stray")
# A drag by this many pixels moves a number by a quarter of its range.
QUARTER = 70


def answer_of(server: str, call: str, **request: Any) -> Any:
    return polite.post(f"{server}/{call}", json=request).raise_for_status().json()


def dial(page: Any, section: str, name: str) -> Any:
    return page.locator(f"#{section}").get_by_role("slider", name=name)


def drawn(page: Any) -> Any:
    """The page, once all its figures are drawn to the end."""
    settled(page)
    expect(page.locator("#staircase .jump").first).to_be_attached()
    return page


@pytest.fixture(scope="module")
def figures(tabs: Any, server: str) -> Iterator[Any]:
    """A page, and what it complains of, for tests of which none minds the numbers that another one has set."""
    one = tabs.opened("how?lang=en", server)
    drawn(one.page)
    yield one
    tabs.take_back(one, server)


def test_dragged_numbers_get_the_answers_of_the_service(figures: Any, server: str) -> None:
    page = figures.page
    length = dial(page, "chord", "Chord of the head bench")
    length.scroll_into_view_if_needed()
    box = length.bounding_box()
    page.mouse.move(box["x"] + 5, box["y"] + 5)
    page.mouse.down()
    page.mouse.move(box["x"] + 5 - QUARTER, box["y"] + 5, steps=4)
    page.mouse.up()
    expect(length).to_have_text("2.01 m")
    pose = answer_of(
        server,
        "trajectory",
        dragon={"benches": 11, "head_length": 2.56},
        path={"kind": "spiral", "pitch": 0.55, "start_turns": 5},
        times=[0],
    )
    place = f"({pose['x'][0][1]:.3f} m, {pose['y'][0][1]:.3f} m)"
    expect(page.locator("#chord .verdict")).to_contain_text(place)
    knob = page.locator("#chord .knob")
    knob.scroll_into_view_if_needed()
    box = knob.bounding_box()
    page.mouse.move(box["x"] + 8, box["y"] + 8)
    page.mouse.down()
    page.mouse.move(box["x"] - 40, box["y"] + 8, steps=4)
    page.mouse.up()
    assert float(length.get_attribute("aria-valuenow")) > 2.01
    expect(page.locator("#chord .verdict")).not_to_contain_text(place)
    settled(page)
    figures.check()


def test_keys_move_the_numbers_and_a_refusal_stands_in_the_figure(open_page: Any, server: str) -> None:
    page = drawn(open_page("how?lang=en", failing=True))
    dial(page, "staircase", "Pitch of the spiral").press("ArrowUp")
    contact = answer_of(server, "collision-time", path={"kind": "spiral", "pitch": 0.4504})
    head, bench = contact["benches"]
    assert head == 0
    stops = f"At a pitch of 0.4504 m the head stops {contact['head']['radius']:.4f} m from the centre: there the head"
    expect(page.locator("#staircase .lead")).to_have_text(
        f"How far in does the dragon get before two benches touch? {stops} touches body {bench}."
    )
    length = dial(page, "step", "Length of the interval")
    length.press("PageUp")
    proof = answer_of(server, "collision-time", dragon={"benches": 40}, start=409.7, stop=409.86, cross_check="none")
    steps = proof["certificate"]["steps"]
    assert steps > 1
    expect(page.locator("#step .verdict")).to_contain_text(f"The service takes {steps} shorter steps")
    length.press("Home")
    expect(page.locator("#step .verdict")).to_contain_text("The service proves it in one step")
    expect(page.locator("#graze .lead")).to_contain_text("Every look finds all benches apart")
    page.locator("#graze .try").first.click()
    expect(page.locator("#graze .lead")).to_contain_text("In 1 of them benches overlap")
    free = polite.get(f"{server}/tolerance", params={"pitch": 0.55}).json()
    expect(page.locator("#stray .more")).to_contain_text(f"may stray by {int(1e4 * free['stray']) / 100} cm")
    expect(page.locator("#stray .exhibit")).to_have_count(0)
    for _ in range(2):
        dial(page, "stray", "How far every handle may stray").press("PageUp")
    first = answer_of(server, "collision-time", stray=0.05, cross_check="none")
    expect(page.locator("#stray .verdict")).to_contain_text(f"From {first['time']:.6f} s on benches may touch")
    expect(page.locator("#stray .exhibit")).to_have_count(2)
    dial(page, "chord", "Place of the head").press("Home")
    # Figure and sentence agree: there is no second handle, and the limit is of a number on this page.
    expect(page.locator("#chord .verdict")).to_contain_text("so there is no second handle")
    expect(page.locator("#chord .verdict")).to_contain_text("the head must be more than 2.34509 turns from the centre")
    expect(page.locator("#chord .label")).to_have_text(["head"])
    expect(page.locator("#chord .bench")).to_have_count(0)
    expect(page.locator("#chord .note")).to_be_empty()
    dial(page, "chord", "Place of the head").press("End")
    expect(page.locator("#chord .label")).to_have_text(["head", "second handle"])


def test_an_address_keeps_the_numbers_and_the_language(open_page: Any) -> None:
    page = drawn(open_page("how?lang=en&staircase_pitch=0.5&chord_turns=soup&step_time=1e9&graze_step=0.26"))
    values = [(section, name) for section, name in (("staircase", "Pitch"), ("chord", "Place"), ("step", "Start"))]
    assert [dial(page, *one).inner_text() for one in values] == ["0.5000 m", "5.00 turns", "412.40 s"]
    expect(dial(page, "graze", "Time between")).to_have_text("0.3 s")
    dial(page, "staircase", "Pitch of the spiral").press("ArrowUp")
    page.wait_for_url("**staircase_pitch=0.5001**#staircase")
    page.locator("[data-lang=zh]").click()
    page.wait_for_url("**lang=zh**")
    for part in ("staircase_pitch=0.5001", "step_time=412.4", "graze_step=0.3"):
        assert part in page.url
    assert "chord" not in page.url
    page.reload()
    expect(drawn(page).locator("#staircase .lead .dial")).to_have_text("0.5001 m")
    # A number changed a moment ago is in what is shared.
    dial(page, "staircase", "螺距").press("ArrowUp")
    page.locator("#share").click()
    expect(page.locator("#address")).to_have_value(re.compile("staircase_pitch=0.5002"))
    expect(page.locator("#qr")).to_be_visible()
    assert findings(page, "#sharing") == []


def test_the_look_is_kept_on_both_pages(browser: Any, server: str) -> None:
    context = browser.new_context(locale="en-GB", viewport={"width": 1366, "height": 768})
    page = context.new_page()
    page.goto(f"{server}/how")
    drawn(page)
    box = page.locator(".article")
    usual = [
        page.locator("body").evaluate("one => getComputedStyle(one).backgroundColor"),
        box.bounding_box()["height"],
    ]
    page.locator("#look-open").click()
    for name in ("Dark", "Large type, for a projector"):
        page.locator("#look button", has_text=name).click()
        expect(page.locator("#look button", has_text=name)).to_have_attribute("aria-pressed", "true")
    assert findings(page) == []
    dark = page.locator("body").evaluate("one => getComputedStyle(one).backgroundColor")
    assert dark != usual[0]
    assert box.bounding_box()["height"] > 1.15 * usual[1]
    page.goto(f"{server}/?benches=5&time=end")
    settled(page)
    assert page.locator("body").evaluate("one => getComputedStyle(one).backgroundColor") == dark
    assert page.locator("h2:visible").first.evaluate("one => parseFloat(getComputedStyle(one).fontSize)") == 19.5
    assert page.evaluate("document.documentElement.scrollWidth") <= 1366
    page.locator("#look-open").click()
    page.locator("#look button", has_text="Light").click()
    page.emulate_media(color_scheme="dark")
    assert page.locator("body").evaluate("one => getComputedStyle(one).backgroundColor") == usual[0]
    page.locator("#look button", has_text="As the system").click()
    assert page.locator("body").evaluate("one => getComputedStyle(one).backgroundColor") == dark
    page.emulate_media(color_scheme="light")
    assert page.locator("body").evaluate("one => getComputedStyle(one).backgroundColor") == usual[0]
    context.close()


def test_a_browser_without_storage_has_a_look_while_the_page_lasts(open_page: Any) -> None:
    page = open_page("how?lang=en")
    page.evaluate("Object.defineProperty(window, 'localStorage', { get() { throw new Error('refused') } })")
    page.locator("#look-open").click()
    page.locator("#look button", has_text="Dark").click()
    expect(page.locator("html")).to_have_attribute("data-theme", "dark")


def test_a_phone_in_chinese_and_a_dark_screen_are_served_too(open_page: Any) -> None:
    page = drawn(open_page("how", locale="zh-CN", color_scheme="dark", **PHONE))
    expect(page.locator("h1")).to_have_text("原理")
    assert page.evaluate("document.documentElement.scrollWidth") <= PHONE["viewport"]["width"]
    expect(page.locator("#step .verdict")).to_contain_text("服务一步就证明了它")
    page.locator("#staircase .try").last.tap()
    expect(page.locator("#staircase .lead")).to_contain_text("第16节龙身")
    assert "undefined" not in page.locator("body").inner_text()
    assert findings(page) == []
    page.locator("[data-lang=en]").tap()
    expect(page.locator("#staircase .lead")).to_contain_text("At a pitch of 0.4504 m the head stops 4.40")
    page.wait_for_url("**lang=en**")
    assert findings(page) == []


def test_a_wide_screen_has_one_column_too(figures: Any) -> None:
    page = figures.page
    page.set_viewport_size({"width": 1920, "height": 1080})
    settled(page)
    parts = page.locator(".article > :is(h1, p, section)")
    assert parts.count() > len(SECTIONS)
    assert len(set(parts.evaluate_all("all => all.map((one) => one.getBoundingClientRect().left)"))) == 1


def test_a_lost_service_is_reported_in_the_figure_that_waits_for_it(figures: Any) -> None:
    page, figures.failing = figures.page, True
    page.route("**/*", lambda route: route.abort())
    dial(page, "chord", "Chord of the head bench").press("ArrowUp")
    expect(page.locator("#chord .note")).to_contain_text("the figure is older than your numbers")
    expect(page.locator("#step .note")).to_be_empty()
    page.unroute("**/*")
    # The page tries again by itself too; where that came first, a click of the mouse would wait for the button.
    page.locator("#lost button").evaluate("button => button.click()")
    expect(page.locator("#chord .note")).to_be_empty()
    expect(page.locator("#lost")).to_be_hidden()


def test_every_answer_of_the_dance_leads_to_the_idea_behind_it(open_page: Any) -> None:
    page = open_page("?lang=zh&benches=12&time=end")
    expect(page.locator("nav a[href='how?lang=zh']")).to_have_text("原理")
    settled(page)
    for box in ("first-contact", "minimum-pitch", "tolerance", "run-end"):
        expect(page.locator(f"#{box} details a")).to_be_attached()
    links = page.locator("#answers details a")
    ideas = links.evaluate_all("links => links.map((link) => new URL(link.href).hash.slice(1))")
    assert set(ideas) == {"chord", "staircase", "step", "stray"} < set(SECTIONS)
    assert len(ideas) == page.locator("#answers details").count()
    page.locator("#tolerance summary").click()
    page.locator("#tolerance details a").click()
    expect(page.locator("#stray h2")).to_be_in_viewport()
    expect(page.locator("#stray .ground").first).to_be_visible()


def test_how_it_works_leads_back_to_the_dance_from_which_it_was_opened(open_page: Any) -> None:
    page = open_page("?benches=9&pitch=0.6&door=contest&lang=zh")
    page.locator("[data-how]:visible").first.click()
    expect(page.locator("#name a")).to_have_attribute("href", re.compile("benches=9"))
    page.locator("#name a").click()
    expect(page.locator("#first-contact .value")).to_be_visible()
    assert "benches=9" in page.url
    assert "pitch=0.6" in page.url
    assert "door=contest" in page.url
