"""Three doors: what a person came for decides which numbers and answers stand there, and the address keeps it."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any
from zipfile import ZipFile

import pytest
from playwright.sync_api import expect

from tests.support.axe import findings
from tests.support.pending import settled, with_below
from tests.support.qr_reader import read_qr

EASY = "?benches=5&time=end"
KIT = 300_000  # [ms]; a kit without films takes 6 s of a core
PHONE = {"viewport": {"width": 390, "height": 844}, "has_touch": True, "is_mobile": True}
FEW = {
    "contest": ["pitch", "turning_diameter", "benches", "stray"],
    "village": ["benches", "body_length", "head_speed", "stray"],
    "look": ["pitch", "benches"],
}
ROUTE = "&path=route&route=*-40,0_40,0&begin=30&benches=9&start_clock=19:30&time=40"


def numbers(page: Any) -> list[str]:
    """Names of the numbers in sight."""
    fields = page.locator(".field:visible")
    return fields.evaluate_all("all => all.map((one) => one.dataset.field)")


def test_a_bare_address_offers_three_doors_and_the_choice_is_in_the_address(open_page: Any) -> None:
    page = open_page("", reduced_motion="reduce")
    settled(page)
    expect(page.locator("#arrival button")).to_have_count(3)
    assert numbers(page) == []
    page.locator("#arrival [data-door=contest]").click()
    page.wait_for_url("**door=contest**")
    assert numbers(page) == FEW["contest"]
    expect(page.locator("#arrival")).to_be_hidden()
    page.locator("#doors [data-door=village]").click()
    page.wait_for_url("**path=route**")
    expect(page.locator("#judgement .value")).to_have_text(re.compile("danced"))
    assert numbers(page) == FEW["village"]
    page.go_back()
    expect(page.locator("#doors [data-door=contest]")).to_have_attribute("aria-pressed", "true")
    assert "route" not in page.url
    assert numbers(page) == FEW["contest"]


def test_a_spiral_in_motion_ends_when_the_village_is_chosen(open_page: Any) -> None:
    page = open_page("")
    settled(page)
    page.mouse.move(300, 300)
    expect(page.locator("#play")).to_contain_text("Pause")
    page.locator("#arrival [data-door=village]").click()
    settled(page)
    expect(page.locator("#clock")).to_have_text("75.00 s")
    expect(page.locator("#play")).to_contain_text("Play")


def test_an_old_address_opens_all_that_it_opened_and_an_unknown_door_does_too(visit: Any) -> None:
    for query in ("?benches=5&time=end", "?benches=5&time=end&door=cellar"):
        page = visit(query)
        expect(page.locator("#first-contact .value")).to_have_text(re.compile(r"\d\.\d{6} s|Nothing touches"))
        assert len(numbers(page)) == 13
        expect(page.locator("#more")).to_be_hidden()


def test_an_unknown_door_is_named_in_a_sentence_once(open_page: Any) -> None:
    page = open_page(f"{EASY}&door=cel%3Cb%3Elar{'x' * 200}")
    expect(page.locator("#status")).to_have_text(f"The page has no door “cel<b>lar{'x' * 31}”: here is everything.")
    settled(page)
    expect(page.locator("#status")).to_be_empty()  # it closes by itself
    page.locator("#doors [data-door=look]").click()
    settled(page)
    expect(page.locator("#status")).to_be_empty()


@pytest.mark.parametrize(
    ("query", "text", "kept"),
    [("&helix=3", "helix=3", True), ("&path=helix", "path=helix", False), (f"&{'x' * 90}=1", "x" * 40, True)],
    ids=["name", "value", "long"],
)
def test_what_a_newer_page_wrote_is_named_once_and_the_rest_opens(
    open_page: Any, query: str, text: str, kept: bool
) -> None:
    page = open_page(f"{EASY}{query}")
    words = f"This page does not know “{text}” in the address: here is the rest."
    expect(page.locator("#status")).to_have_text(words)
    expect(page.locator("#benches")).to_have_value("5")
    page.locator("#benches").fill("6")
    page.locator("#benches").press("Enter")
    settled(page)
    assert "benches=6" in page.url
    assert (query in page.url) is kept  # A newer page opens all of it.
    expect(page.locator("#status")).to_be_empty()


def test_a_printed_route_has_its_picture_its_end_and_its_address_and_no_buttons(open_page: Any) -> None:
    page = open_page(f"?door=village{ROUTE}&limit=0.5")
    settled(page)
    page.emulate_media(media="print")
    page.pdf()
    expect(page.locator("#printed")).to_contain_text("The dance ends at 50.00 s (19:30:50).")
    expect(page.locator("#printed")).to_contain_text(page.url)
    expect(page.locator("#canvas")).to_be_visible()
    expect(page.locator("#judgement .value")).to_be_visible()
    flat = """[...document.querySelectorAll("button, select, input, a")].filter((one) => one.checkVisibility())
      .filter((one) => getComputedStyle(one).borderTopWidth !== "0px").map((one) => one.outerHTML)"""
    assert page.evaluate(flat) == []


def test_a_printed_route_that_begins_at_a_time_of_day_ends_at_one(open_page: Any) -> None:
    page = open_page(f"?door=village{ROUTE.replace('start_clock', 'begin_clock')}")
    settled(page)
    page.emulate_media(media="print")
    page.pdf()
    # The dance begins at -13.94 s.
    expect(page.locator("#printed")).to_contain_text("The dance ends at 50.00 s (19:31:03")


def test_a_route_is_drawn_by_keyboard_from_nothing(open_page: Any) -> None:
    page = open_page("?door=village&path=route&benches=3")
    settled(page)
    page.locator("#invite .main").focus()
    page.keyboard.press("Enter")
    expect(page.locator("#canvas")).to_be_focused()
    for count in range(1, 6):
        page.keyboard.press("n")
        expect(page.locator(f"#knots .knot >> nth={count - 1}")).to_be_focused()
    page.keyboard.press("Shift+ArrowUp")
    settled(page)
    expect(page.locator("#judgement .value")).to_have_text(re.compile("[Cc]an be danced"))
    points = re.search(r"route=([^&]*)", page.url)
    assert points
    assert len(points[1].split("_")) == 5
    # A square around it, too: four corners turn to the left.
    page.locator("[data-tool=area]").focus()
    page.keyboard.press("Enter")
    page.locator("#canvas").focus()
    for _ in range(4):
        page.keyboard.press("n")
    settled(page)
    expect(page.locator("#knots .knot")).to_have_count(4)
    expect(page.locator("#judgement .failures li").first).to_be_visible()
    page.keyboard.press("Control+z")
    expect(page.locator("#knots .knot")).to_have_count(3)


@pytest.mark.parametrize("door", FEW)
def test_behind_a_door_stand_few_numbers_and_more_on_demand(visit: Any, door: str) -> None:
    page = visit(f"?door={door}{ROUTE if door == 'village' else '&benches=20'}")
    settled(page)
    assert numbers(page) == FEW[door]
    page.locator("#more").click()
    assert {"width", "margin", "hole"} <= set(numbers(page))
    page.locator("#more").click()
    assert numbers(page) == FEW[door]
    assert findings(page) == []


def test_numbers_are_as_people_say_them_and_all_digits_are_with_the_evidence(visit: Any) -> None:
    page = visit("?door=contest&time=end")
    expect(page.locator("#first-contact .value")).to_have_text("✕Contact at 412.47 s")
    expect(page.locator("#minimum-pitch .value")).to_have_text("45.04 cm")
    expect(page.locator("#clock")).to_have_text("412.47 s")
    expect(page.locator("#minimum-pitch button")).to_be_hidden()
    for box, digits in (("#first-contact", "412.473838 s"), ("#minimum-pitch", "0.450337393 m")):
        page.locator(f"{box} summary").click()
        expect(page.locator(f"{box} dd").first).to_have_text(digits)
    expect(page.locator("#minimum-pitch button")).to_be_visible()
    page.locator("[data-door=all]:visible").click()
    expect(page.locator("#first-contact .value")).to_have_text("✕Contact at 412.473838 s")


def test_in_the_village_the_verdict_comes_first_with_the_times_of_day(visit: Any) -> None:
    page = visit(f"?door=village{ROUTE}&limit=0.5")
    expect(page.locator("#judgement")).to_have_attribute("data-outcome", "contact")
    expect(page.locator("#judgement")).to_contain_text("It starts at 19:29:46 and ends at 19:30:50")
    expect(page.locator("#first-contact .value")).to_have_text("✓Benches with each other: never touch")
    # Nothing green stands beside a red verdict.
    colour = "one => getComputedStyle(one).color"
    text = page.locator("body").evaluate(colour)
    assert page.locator("#first-contact .value").evaluate(colour) == text
    order = page.evaluate("[...document.querySelectorAll('#judgement, #benches')].map((one) => one.id)")
    assert order == ["judgement", "benches"]


def test_a_village_begins_with_an_example_that_says_so_until_another_square_is_drawn(open_page: Any) -> None:
    page = open_page("")
    page.locator("[data-door=village]:visible").first.click()
    settled(page)
    expect(page.locator("#judgement h3")).to_have_text("Verdict on this example")
    # The end counts from 0 s, the time of the verdict from where the dance begins.
    expect(page.locator("#run-end")).to_contain_text(
        re.compile(r"Times count from 0 s; the dance begins at -\d+\.\d\d s\.")
    )
    width = page.locator("#place-width")
    width.click()
    page.wait_for_function("() => getSelection().toString() === document.activeElement.value")
    width.press_sequentially("30")
    width.press("Enter")
    settled(page)
    expect(page.locator("#judgement h3")).to_have_text("Verdict")


def test_a_village_keeps_film_plan_cues_and_map_and_sees_there_how_far_they_are(open_page: Any) -> None:
    page = open_page(f"?door=village{ROUTE}")
    settled(with_below(page))
    rows = page.locator("#kept li:visible > span:first-child")
    names = ("The picture as it is", "Film of the dance", "Plan on paper, true to scale", "Map with chalk marks")
    expect(rows).to_have_text([*names])
    expect(page.locator("#people #cues")).to_contain_text("A cue card for each bench")
    for form, begin in (("PDF", b"%PDF"), ("CSV", b"bench,")):
        with page.expect_download() as download:
            page.locator(f"#keepCues-{form}").click()
        assert download.value.suggested_filename == f"cues.{form.lower()}"
        assert Path(download.value.path()).read_bytes().startswith(begin)
    expect(page.locator("#sweeps")).to_be_hidden()

    def longer(route: Any) -> None:
        """A film that is not whole before it is cancelled."""
        route.continue_(post_data=json.dumps({**route.request.post_data_json, "seconds": 60.0}))

    page.route("**/films", longer)
    page.locator("#keepFilm-GIF").click()
    expect(page.locator("#jobs li")).to_be_visible()
    page.locator("#jobs li button", has_text="Cancel").click()
    expect(page.locator("#jobs li")).to_contain_text("cancelled")
    expect(page.locator("#sweep")).to_be_hidden()


def test_the_contest_kit_is_one_button_with_its_progress_and_then_a_zip(open_page: Any) -> None:
    page = open_page("?door=contest&benches=5&turning_diameter=8.5&margin=0.01&stray=0.02&time=end")
    settled(with_below(page))
    button, jobs = page.locator("#kept li:visible button").first, page.locator("#jobs li", has_text="contest kit")
    expect(button).to_have_text("The whole contest kit")

    def without_films(route: Any) -> None:
        """Films take a minute, and are tested elsewhere."""
        assert route.request.post_data_json.items() >= {"benches": 5, "turning_diameter": 8.5, "language": "en"}.items()
        route.continue_(post_data=json.dumps({**route.request.post_data_json, "films": False}))

    page.route("**/contest-kit", without_films)
    with page.expect_download(timeout=KIT) as download:
        button.click()
        expect(button).to_have_text(re.compile(r"^The whole contest kit \d+ %$"))
        expect(button).to_have_accessible_name(re.compile(r"^The whole contest kit, ZIP \d+ %$"))
        expect(page.locator("#status")).to_contain_text("without: Margin, Stray.")
        assert findings(page, "#keep") == []
        expect(jobs).to_have_count(1)
        button.click()  # a second click starts no second job
    assert download.value.suggested_filename == "contest-kit.zip"
    with ZipFile(download.value.path()) as archive:
        assert {"result1.xlsx", "figures/positions.pdf", "report.md"} <= set(archive.namelist())
        assert "turning circle 8.5 m" in archive.read("report.md").decode()
    expect(button).to_have_text("The whole contest kit")
    expect(jobs).to_have_attribute("data-state", "successful")


def test_the_kit_is_for_equal_benches_and_behind_no_village(visit: Any) -> None:
    page = with_below(visit(f"?door=village{ROUTE}"))
    expect(page.locator("#keepKit-ZIP")).to_be_hidden()
    page = visit(f"?door=contest&time=0&csv={'%0A'.join(['2.2,0.3,0.2'] * 5)}")
    settled(page)
    wanted: list[str] = []
    page.on("request", lambda request: wanted.append(request.url))
    page.locator("#keepKit-ZIP").click()
    expect(page.locator("#status")).to_contain_text("The kit is for equal benches")
    assert [url for url in wanted if "contest-kit" in url] == []


@pytest.mark.chinese_font
def test_figures_have_the_language_of_the_page(visit: Any) -> None:
    for language in ("zh", "en"):
        page = with_below(visit(f"{EASY}&lang={language}"))
        for button in ("keepContact-SVG", "keepInstant-SVG", "keepStairs-SVG"):
            with page.expect_download() as download:
                page.locator(f"#{button}").click()
            text = download.value.path().read_text(encoding="utf-8")
            assert ("没有碰撞" in text or "首次碰撞" in text or "各把手" in text) is (language == "zh"), button


def test_a_film_shows_its_progress_on_its_button_and_opens_below(open_page: Any) -> None:
    page = open_page(f"?door=village{ROUTE}")
    settled(with_below(page))
    page.route(
        "**/films", lambda route: route.continue_(post_data=json.dumps({**route.request.post_data_json, "height": 90}))
    )
    page.locator("#keepFilm-GIF").click()
    expect(page.locator("#keepFilm-GIF")).to_have_text(re.compile(r"^GIF \d+ %$"))
    film = page.locator("#kept li:has(#keepFilm-GIF) img")
    film.wait_for()
    page.wait_for_function("document.querySelector('#kept img').naturalWidth === 160")
    expect(page.locator("#keepFilm-GIF")).to_have_text("GIF")
    expect(film).to_have_attribute("alt", "Film of the dance")
    page.locator("[data-lang=zh]:visible").click()
    expect(film).to_have_attribute("alt", "舞龙影片")


def test_the_dragon_on_a_long_route_is_no_hairline(visit: Any, picture: Any) -> None:
    page = visit(f"?door=village{ROUTE}&view=30,0,3")
    settled(page)
    pixels = picture(page)
    height, width = pixels.shape[:2]
    # A bench is 0.3 m wide, one pixel at this scale; it is drawn at least 5 pixels wide.
    column = pixels[:, width // 2, :3]
    red = (column[:, 0] > 0.4) & (column[:, 2] < 0.6 * column[:, 0])
    assert 5 <= red.sum() < 0.1 * height


def test_on_a_phone_every_door_fits_and_a_finger_hits_every_control(visit: Any) -> None:
    narrow = """[...document.querySelectorAll("button, select, input, a")]
      .filter((one) => one.checkVisibility() && !one.matches(".skip, [type=checkbox], [type=file]"))
      .filter((one) => one.getBoundingClientRect().height < 43.5 || one.getBoundingClientRect().right > innerWidth + 1)
      .map((one) => one.outerHTML)"""
    for door in ("contest", "village", "look", "arrival"):
        page = visit(f"?door={door}{ROUTE if door == 'village' else '&benches=20&time=0'}", **PHONE)
        settled(page)
        for language in ("zh", "en"):
            page.locator(f"[data-lang={language}]").tap()
            assert page.evaluate("document.documentElement.scrollWidth") <= 390, door
            assert page.evaluate(narrow) == [], door
            assert "undefined" not in page.locator("body").inner_text()


MODULES = """canvas => {
  const size = canvas.width / 4 - 8;
  const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
  const isDark = (x, y) => data[4 * ((4 * y + 18) * canvas.width + 4 * x + 18)] < 128;
  return Array.from({ length: size }, (_, y) => Array.from({ length: size }, (_, x) => isDark(x, y)));
}"""


@pytest.mark.parametrize("query", ["?benches=5&time=1", f"?door=village{ROUTE}"], ids=["short", "village"])
def test_an_address_is_shared_without_a_clipboard(open_page: Any, query: str) -> None:
    page = open_page(query)
    settled(page)
    page.locator("#share").click()
    address = page.locator("#address").input_value()
    assert address == page.url
    assert len(address) < 500
    # It is selected, so that it can be copied by hand; and a phone can read it.
    assert page.evaluate("getSelection().toString() || document.activeElement.value") == address
    page.locator("#qr").wait_for()
    assert read_qr(page.locator("#qr").evaluate(MODULES)) == address
    assert findings(page, "#sharing") == []
    page.keyboard.press("Escape")
    expect(page.locator("#sharing")).to_be_hidden()


def test_qr_codes_of_every_length_can_be_read_and_a_too_long_text_has_none(visit: Any) -> None:
    code = "text => import('/page/qr.js').then(({ qrCode }) => qrCode(text))"
    for length in (1, 17, 18, 107, 135, 155, 231, 272, 369, 500, 584, 640):
        text = "https://dragon.example/?a=1,2_龙".ljust(length, "x")[:length]
        assert read_qr(visit(EASY).evaluate(code, text)) == text
    assert visit(EASY).evaluate(code, "x" * 1300) is None


def test_a_time_can_be_typed_in_seconds_or_as_a_time_of_day(visit: Any) -> None:
    page = visit(f"?door=village{ROUTE}")
    settled(page)
    for typed, clock in (("12,5", "12.50 s"), ("19:30:20", "20.00 s"), ("19:29:55", "-5.00 s"), ("999", "50.00 s")):
        page.locator("#clock").click()
        page.locator("#typed-time").fill(typed)
        page.locator("#typed-time").press("Enter")
        expect(page.locator("#clock")).to_contain_text(clock)
        expect(page.locator("#clock")).to_be_focused()
    page.locator("#clock").click()
    page.locator("#typed-time").fill("soon")
    page.locator("#typed-time").press("Enter")
    expect(page.locator("#status")).to_contain_text("in seconds, such as 300, or as 19:31:00")
    expect(page.locator("#clock")).to_contain_text("50.00 s")


def test_a_number_is_one_tab_stop_with_arrow_keys_for_its_slider(visit: Any) -> None:
    page = visit("?door=contest&benches=20")
    settled(page)
    page.locator("#pitch").focus()
    for name in FEW["contest"][1:]:
        page.keyboard.press("Tab")
        expect(page.locator(f"#{name}")).to_be_focused()
    page.locator("#benches").press("ArrowUp")
    expect(page.locator("#benches")).to_have_value("21")
    page.locator("#benches").press("ArrowDown")
    page.locator("#benches").press("ArrowDown")
    expect(page.locator("#benches")).to_have_value("19")
    page.locator("#benches").press("Escape")
    expect(page.locator("#benches")).to_have_value("223")
