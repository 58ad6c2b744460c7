"""Doors to the page: what a person came for decides which numbers and answers stand there; the village has most."""

import json
import re
from zipfile import ZipFile

import pytest
from playwright.sync_api import expect

from tests.support.job_service import wait_for
from tests.support.qr_reader import read_qr

thorough = pytest.mark.thorough
EASY = "?benches=5&time=end"
KIT = 300_000  # [ms]; a kit without films takes 6 s of a core
CONTEST = ["pitch", "turning_diameter", "benches", "stray"]
PEOPLE = ["benches", "body_length", "head_speed", "stray"]
ROUTE = "&path=route&route=*-40,0_40,0&begin=30&benches=9&start_clock=19:30&time=40"
BORDERED = """[...document.querySelectorAll("button, select, input, a")].filter((one) => one.checkVisibility())
  .filter((one) => getComputedStyle(one).borderTopWidth !== "0px").map((one) => one.outerHTML)"""
MODULES = """canvas => {
  const size = canvas.width / 4 - 8;
  const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
  const isDark = (x, y) => data[4 * ((4 * y + 18) * canvas.width + 4 * x + 18)] < 128;
  return Array.from({ length: size }, (_, y) => Array.from({ length: size }, (_, x) => isDark(x, y)));
}"""


def numbers(person):
    """Names of the numbers in sight."""
    return person.all(".field:visible").evaluate_all("all => all.map((one) => one.dataset.field)")


def without(**changes):
    """A handler of a request that changes its body."""

    def changed(route):
        route.continue_(post_data=json.dumps({**route.request.post_data_json, **changes}))

    return changed


def test_a_bare_address_offers_three_doors_and_the_choice_is_in_the_address(open_page):
    person = open_page("", reduced_motion="reduce").sees({"#arrival button": 3})
    assert numbers(person) == []
    person.presses("#arrival [data-door=contest]").arrives("**door=contest**")
    assert numbers(person.sees({"#arrival": False})) == CONTEST
    person.presses("#doors [data-door=village]").arrives("**path=route**")
    person.sees({"#judgement .value": re.compile("danced"), "#judgement h3": "Verdict on this example"})
    # The end counts from 0 s, the time of the verdict from where the dance begins.
    person.sees({"#run-end": "Times count from 0 s; the dance begins at -"})
    assert numbers(person) == PEOPLE
    person.at("#place-width").click()
    person.page.wait_for_function("() => getSelection().toString() === document.activeElement.value")
    person.types({"#place-width": "30"}).settles().reads({"#judgement h3": "Verdict"})
    for _ in range(2):
        person.page.go_back()
    person.has("#doors [data-door=contest]", aria_pressed="true")
    assert "route" not in person.page.url
    assert numbers(person) == CONTEST


@thorough
def test_behind_a_door_numbers_are_as_people_say_them_and_each_is_one_tab_stop(open_page):
    person = open_page("?door=contest&time=end")
    people = {
        "#first-contact .value": "✕Contact at 412.47 s",
        "#minimum-pitch .value": "45.04 cm",
        "#clock": "412.47 s",
    }
    person.reads(people).sees({"#minimum-pitch button": False}).presses("#first-contact summary")
    person.presses("#minimum-pitch summary").sees({"#minimum-pitch button": True})
    person.reads({"#first-contact dd": "412.473838 s", "#minimum-pitch dd": "0.450337393 m"})
    person.focuses("#pitch")
    for name in CONTEST[1:]:
        expect(person.strikes("Tab").at(f"#{name}")).to_be_focused()
    for key, value in (("ArrowUp", "224"), ("ArrowDown", "223"), ("ArrowDown", "222"), ("Escape", "223")):
        person.at("#benches").press(key)
        person.holds({"#benches": value})
    person = open_page("?door=look&benches=20")
    assert numbers(person) == ["pitch", "benches"]
    assert {"width", "margin", "hole"} <= set(numbers(person.presses("#more")))
    assert person.findings() == []
    # An address from before there were doors.
    assert len(numbers(open_page(EASY).sees({"#more": False}))) == 13


def test_in_the_village_the_verdict_comes_first_with_the_times_of_day(open_page):
    person = open_page(f"?door=village{ROUTE}&limit=0.5").sees(
        {
            "#judgement[data-outcome=contact]": "It starts at 19:29:46 and ends at 19:30:50",
            "#first-contact .value": "✓Benches with each other: never touch",
            "#sweeps, #keepKit-ZIP": False,
        }
    )
    # Nothing green stands beside a red verdict.
    assert person.style("#first-contact .value", "color") == person.style("body", "color")
    times = {"12,5": "12.50 s", "19:29:55": "-5.00 s", "999": "50.00 s", "soon": "50.00 s"}
    for typed, clock in times.items():
        person.presses("#clock").types({"#typed-time": typed}).sees({"#clock": clock})
    expect(person.at("#clock")).to_be_focused()
    # The dragon on a long route is no hairline: a bench is 0.3 m wide, one pixel at this scale.
    person = open_page(f"?door=village{ROUTE}&view=30,0,3")
    pixels = person.picture()
    column = pixels[:, pixels.shape[1] // 2, :3]
    red = (column[:, 0] > 0.4) & (column[:, 2] < 0.6 * column[:, 0])
    assert 5 <= red.sum() < 0.1 * len(column)
    assert person.findings() == []


@pytest.mark.parametrize(
    "query", [f"?door=village{ROUTE}", pytest.param("?benches=5&time=1", marks=thorough)], ids=["village", "short"]
)
def test_an_address_is_shared_without_a_clipboard_and_printed(open_page, query):
    person = open_page(query).presses("#share").sees({"#qr": True})
    address = person.at("#address").input_value()
    assert address == person.page.url
    assert len(address) < 500
    # It is selected, so that it can be copied by hand; and a phone can read it.
    assert person.ask("getSelection().toString() || document.activeElement.value") == address
    assert read_qr(person.at("#qr").evaluate(MODULES)) == address
    assert person.findings("#sharing") == []
    person.strikes("Escape").sees({"#sharing": False})
    if "village" in query:
        person.page.emulate_media(media="print")
        person.page.pdf()
        person.sees({"#printed": ["The dance ends at 50.00 s (19:30:50).", person.page.url], "#canvas": True})
        assert person.sees({"#judgement .value": True}).ask(BORDERED) == []


@thorough
def test_a_film_shows_its_progress_on_its_button_and_opens_below(open_page):
    person = open_page(f"?door=village{ROUTE}").reaches_below()
    person.sees({"#kept li:visible": 4, "#people #cues": True})
    assert person.saves("#keepCues-PDF", "cues.pdf").startswith(b"%PDF")
    person.page.route("**/films", without(height=90))
    person.presses("#keepFilm-GIF").sees({"#keepFilm-GIF": re.compile(r"^GIF \d+ %$")})
    person.page.wait_for_function("() => document.querySelector('#kept img.film')?.naturalWidth === 160")
    person.reads({"#keepFilm-GIF": "GIF"}).has("#kept img.film", alt="Film of the dance")


@thorough
def test_a_film_is_cancelled_and_the_cue_card_is_said_to_be_made(open_page):
    person = open_page(f"?door=village{ROUTE}").reaches_below()
    person.page.route("**/films", without(seconds=60.0))  # it is not whole before it is cancelled
    person.presses("#keepFilm-GIF", "#jobs li button").sees({"#jobs li": "cancelled", "#sweep": False})
    held = person.holds_back("**/cues")
    person.presses("#keepCues-CSV").has("#keepCues-CSV", aria_busy="true").sees({"#status": "Being made"})
    with person.page.expect_download():
        held.let_go()
    person.has("#keepCues-CSV", aria_busy="false")


@thorough
def test_the_contest_kit_is_one_button_with_its_progress_and_then_a_zip(open_page):
    person = open_page("?door=contest&benches=5&turning_diameter=8.5&margin=0.01&stray=0.02&time=end").reaches_below()
    person.page.route("**/contest-kit", without(films=False))  # which take a minute, and are tested elsewhere
    with person.page.expect_request("**/contest-kit") as sent, person.page.expect_download(timeout=KIT) as download:
        person.presses("#keepKit-ZIP").sees({"#keepKit-ZIP": re.compile(r"^The whole contest kit \d+ %$")})
        person.sees({"#status": "without: Margin, Stray.", "#jobs li": 1})
        assert person.findings("#keep") == []
        person.presses("#keepKit-ZIP")  # a second click starts no second job
    wanted = {"benches": 5, "turning_diameter": 8.5, "language": "en"}
    assert sent.value.post_data_json.items() >= wanted.items()
    with ZipFile(download.value.path()) as archive:
        assert "turning circle 8.5 m" in archive.read("report.md").decode()
    person.sees({"#jobs li[data-state=successful]": 1})
    person = open_page(f"?door=contest&time=0&csv={'%0A'.join(['2.2,0.3,0.2'] * 5)}").reaches_below()
    person.presses("#keepKit-ZIP").sees({"#status": "The kit is for equal benches"})


@thorough
def test_what_a_newer_page_wrote_is_named_once_and_the_rest_opens(open_page):
    for query, words in (
        (f"door=cel%3Cb%3Elar{'x' * 200}", f"“cel<b>lar{'x' * 31}”"),
        (f"{'x' * 90}=1", f"“{'x' * 40}”"),
    ):
        person = open_page(f"{EASY}&{query}", rest=False).sees({"#status": words}).settles().holds({"#benches": "5"})
    # It goes away by itself, and does not come back.
    person.reads({"#status": ""}).presses("#doors [data-door=look]").settles().reads({"#status": ""})


@thorough
def test_a_route_is_drawn_by_keyboard_from_nothing(open_page):
    person = open_page("?door=village&path=route&benches=3")
    person.focuses("#invite .main")
    person.strikes("Enter")
    expect(person.at("#canvas")).to_be_focused()
    for count in range(5):
        expect(person.strikes("n").all("#knots .knot").nth(count)).to_be_focused()
    person.strikes("Shift+ArrowUp").settles().sees({"#judgement .value": re.compile("[Cc]an be danced")})
    # A square around it, too: four corners turn to the left.
    person.at("[data-tool=area]").press("Enter")
    person.focuses("#canvas")
    person.strikes(*"nnnn").settles().sees({"#knots .knot": 4, "#judgement .failures li": True})


@thorough
@pytest.mark.chinese_font
def test_figures_have_the_language_of_the_page(open_page):
    for language, words in (("zh", ("没有碰撞", "首次碰撞", "各把手")), ("en", ())):
        person = open_page(f"{EASY}&lang={language}").reaches_below()
        text = person.saves("#keepContact-SVG").decode()
        assert any(one in text for one in words) is (language == "zh")


def test_a_bare_address_moves_with_the_mouse_and_the_wheel_scrolls_until_the_picture_is_clicked(open_page, server):
    person = open_page("").sees({"#play": "Play"})
    person.page.mouse.move(300, 300)
    person.sees({"#play": "Pause"}).presses("#doors [data-door=all]").sees({"#clock": re.compile(r"^[1-9].*")})
    canvas = person.presses("#play").box("#canvas")
    person.page.mouse.move(canvas["x"] + 300, canvas["y"] + 300)
    person.page.mouse.wheel(0, 200)
    wait_for(lambda: person.ask("scrollY") > 100)
    assert "view=" not in person.page.url
    person.ask("scrollTo(0, 0)")
    person.page.mouse.click(canvas["x"] + 300, canvas["y"] + 300)
    person.page.mouse.wheel(0, 200)
    person.arrives("**view=**")


@thorough
def test_a_touch_starts_the_dance_and_an_address_opens_its_door(open_page):
    person = open_page("", has_touch=True).sees({"#play": "Play"})
    person.page.touchscreen.tap(300, 300)
    person.sees({"#play": "Pause"})
    open_page("?door=village").arrives("**path=route**")


@thorough
def test_nothing_moves_for_keys_nor_with_reduced_motion_and_a_route_stands(open_page):
    keys, still = open_page(""), open_page("", reduced_motion="reduce")
    keys.strikes("Tab")
    for person in (keys, still):
        person.page.mouse.move(300, 300)
        person.settles().sees({"#clock": "0.00 s", "#play": "Play"})
    # The dance on the whole screen has numbers too, and its verdict leads to its reasons, which are not there.
    person = open_page("?door=contest&benches=60").presses("#full")
    person.page.wait_for_function("() => document.fullscreenElement")
    person.sees({"#answers": False}).views("[data-field=pitch] input[type=range]", "#verdict").presses("#verdict")
    assert person.views("#answers").ask("document.fullscreenElement") is None
    person = open_page("")
    person.page.mouse.move(300, 300)
    person.sees({"#play": "Pause"}).presses("#arrival [data-door=village]").settles().sees({"#play": "Play"})


@thorough
def test_a_reading_beside_an_instant_says_so_and_a_link_leads_to_the_files(open_page):
    person = open_page("?door=contest&benches=20&time=100.2")
    person.sees({"#clearance .reading": "s, the nearest time of the curve: gap"})
    person.presses("#to-end").settles().misses({"#clearance .reading": "nearest"}).presses("#to-keep")
    expect(person.sees({"#kept li": True}).settles().views("#keep-title").at("#keep-title")).to_be_focused()
    person = open_page("?pitch=0.6&benches=20&time=end")
    person.page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    person.presses("#reset-all").settles().presses("#share", "#copy-address").sees({"#status": "Copied"})
    assert person.ask("navigator.clipboard.readText()").endswith("/?door=all")
