"""Doors to the page: what a person came for decides which numbers and answers stand there; the village has most."""

import json
import re
from io import BytesIO
from zipfile import ZipFile

import pytest
import zxingcpp
from PIL import Image
from playwright.sync_api import expect

from app.files.addresses import short_form
from tests.support import polite
from tests.support.job_service import wait_for

thorough = pytest.mark.thorough
EASY = "?benches=5&time=end"
KIT = 300_000  # [ms]; a kit without films takes 6 s of a core
CONTEST = ["pitch", "turning_diameter", "benches", "stray"]
PEOPLE = ["benches", "body_length", "head_speed", "stray"]
ROUTE = "&path=route&route=*-40,0_40,0&begin=30&benches=9&start_clock=19:30&time=40"
BORDERED = """[...document.querySelectorAll("button, select, input, a")].filter((one) => one.checkVisibility())
  .filter((one) => getComputedStyle(one).borderTopWidth !== "0px").map((one) => one.outerHTML)"""


def numbers(person):
    """Names of the numbers in sight."""
    return person.all(".field:visible").evaluate_all("all => all.map((one) => one.dataset.field)")


def without(**changes):
    """A handler of a request that changes its body."""

    def changed(route):
        route.continue_(post_data=json.dumps({**route.request.post_data_json, **changes}))

    return changed


STANDS = {"#clock": "0.00 s", "#play": "Play"}


def test_a_bare_address_offers_three_doors_and_the_choice_is_in_the_address(open_page):
    person = open_page("", reduced_motion="reduce").sees({"#arrival button": 3})
    person.page.mouse.move(300, 300)
    assert numbers(person.settles().sees(STANDS)) == []
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
    assert numbers(person.settles()) == CONTEST
    asked = []
    person.page.on("request", lambda one: asked.append(one.url))
    person.opens("?door=village").arrives("**path=route**").sees({"#judgement h3": "Verdict on this example"})
    person.settles()
    assert [url for url in asked if any(one in url for one in ("collision-time", "minimum-pitch", "pitch-scan"))] == []


def test_a_bare_address_moves_with_the_mouse_or_a_touch_and_the_wheel_scrolls_until_the_picture_is_clicked(open_page):
    person = open_page("").strikes("Tab")
    person.page.mouse.move(300, 300)
    person.settles().sees(STANDS)
    # A route stands, at the time at which it is shown first.
    moves(person.opens(""), 310).presses("#arrival [data-door=village]").settles()
    person.sees({"#play": "Play", "#clock": "75.00 s"})
    moves(person.opens(""), 320).presses("#doors [data-door=all]").sees({"#clock": re.compile(r"^[1-9].*")})
    canvas = person.presses("#play").box("#canvas")
    person.page.mouse.move(canvas["x"] + 300, canvas["y"] + 300)
    person.page.mouse.wheel(0, 200)
    wait_for(lambda: person.ask("scrollY") > 100)
    assert "view=" not in person.page.url
    person.ask("scrollTo(0, 0)")
    person.page.mouse.click(canvas["x"] + 300, canvas["y"] + 300)
    person.page.mouse.wheel(0, 200)
    person.arrives("**view=**")
    person = open_page("", has_touch=True).sees({"#play": "Play"})
    person.page.touchscreen.tap(300, 300)
    person.sees({"#play": "Pause"})


def moves(person, x):
    """The dance, once the mouse is there."""
    person.sees({"#play": "Play"}).page.mouse.move(x, 300)
    return person.sees({"#play": "Pause"})


def test_who_just_looks_is_asked_for_the_tightest_spiral_and_gets_a_card_of_it(open_page, server):
    wide = ["At 0.5500 m the head gets to", "Tighter?"]
    person = open_page("?door=look&lang=en&time=end").sees({"#challenge-words": wide})
    person.types({"#pitch": "0.4502"}, "Tab")
    gone = polite.answer(server, "collision-time", pitch=0.4502)["head"]["radius"] - 4.5
    words = f"two benches touch while the head is still {gone:.2f} m outside the circle. Your tightest: 0.5500 m"
    person.sees({"#challenge-words": words, "#challenge-card[disabled]": True})
    # A finger hits a slider to some millimetres: buttons go on in single ones.
    person.presses("#challenge button:has-text('1 mm wider')").holds({"#pitch": "0.4512"})
    # At the limit benches touch too, but only inside the circle: the answers beside it say when.
    limit = ["Two benches touch only after that", "from 0.4504 m on, every wider spiral gets there"]
    person.types({"#pitch": "0.4504"}, "Tab").sees({"#challenge-words": limit, "#first-contact .value": "Contact at"})
    card = person.settles().saves("#challenge-card", "bench-dragon-0.4504.png")
    assert Image.open(BytesIO(card)).size == (1080, 1080)
    assert person.findings() == []
    person.presses("[data-path=turn]").sees({"#challenge": False})
    # Nothing is won where the head begins inside the circle.
    inside = {"#challenge-words": "already begins inside the circle", "#challenge-card[disabled]": True}
    query = "?door=look&lang=en&pitch=0.5&start_turns=8&benches=60"
    assert "limit" not in open_page(query, failing=True).settles().sees(inside).text("#challenge-words")
    person.opens("?door=look&lang=en&pitch=0.44").sees({"#challenge-words": "A wider one gets there"})
    # Several dragons are no game; one again has the start and the benches of before.
    person.opens("?door=look&lang=en&benches=100").settles().presses("#several", "[data-dragons=spiral]")
    person.settles().sees({"#challenge": False}).presses("#dragons-close").settles().sees({"#challenge": True})
    assert person.holds({"#benches": "100"}).address().get("start_turns", "16") == "16"


@thorough
def test_behind_a_door_numbers_are_as_people_say_them_and_the_rest_is_one_step_away(open_page):
    person = open_page("?door=contest&time=end")
    people = {
        "#first-contact .value": "✕Contact at 412.47 s",
        "#minimum-pitch .value": "45.04 cm",
        "#clock": "412.47 s",
    }
    # What limits it, and the button that uses it, stand beside the number; the evidence is one step away.
    limits = "At a smaller pitch the head and body 19"
    person.reads(people).sees({"#minimum-pitch button": True, "#minimum-pitch": limits})
    person.sees({"#minimum-pitch dd": False}).presses("#first-contact summary", "#minimum-pitch summary")
    person.reads({"#first-contact dd": "Contact at 412.473838 s", "#minimum-pitch dd": "0.450337393 m"})
    # Each number is one Tab stop.
    person.focuses("#pitch")
    for name in CONTEST[1:]:
        expect(person.strikes("Tab").at(f"#{name}")).to_be_focused()
    for key, value in (("ArrowUp", "224"), ("ArrowDown", "223"), ("ArrowDown", "222"), ("Escape", "223")):
        person.at("#benches").press(key)
        person.holds({"#benches": value})
    leaves_the_whole_screen_and_an_instant(person)
    assert numbers(person.presses("#doors [data-door=look]").settles()) == ["pitch", "benches"]
    assert {"width", "margin", "hole"} <= set(numbers(person.presses("#more")))
    assert person.findings() == []
    # An address from before there were doors; and what a newer page wrote is named once, and the rest opens.
    assert len(numbers(person.opens(EASY).sees({"#more": False}))) == 13
    for query, words in (
        (f"door=cel%3Cb%3Elar{'x' * 200}", f"“cel<b>lar{'x' * 31}”"),
        (f"{'x' * 90}=1", f"“{'x' * 40}”"),
    ):
        person = open_page(f"{EASY}&{query}", rest=False).sees({"#status": words}).settles().holds({"#benches": "5"})
    # It goes away by itself, and does not come back.
    person.reads({"#status": ""}).presses("#doors [data-door=look]").settles().reads({"#status": ""})


def leaves_the_whole_screen_and_an_instant(person):
    """The dance on the whole screen has numbers too, and its verdict leads to its reasons, which are not there."""
    person.presses("#full").page.wait_for_function("() => document.fullscreenElement")
    person.sees({"#answers": False}).views("[data-field=pitch] input[type=range]", "#verdict").presses("#verdict")
    assert person.views("#answers").ask("document.fullscreenElement") is None
    # A reading beside an instant says so, and a link leads to the files.
    person.presses("#clock").types({"#typed-time": "100.2"})
    person.sees({"#clearance .reading": "s, the nearest time of the curve: gap"})
    person.presses("#to-end").settles().misses({"#clearance .reading": "nearest"}).presses("#to-keep")
    expect(person.sees({"#kept li": True}).settles().views("#keep-title").at("#keep-title")).to_be_focused()


def test_in_the_village_the_verdict_comes_first_and_its_address_is_shared_and_printed(open_page):
    person = open_page(f"?door=village{ROUTE}&limit=0.5").sees(
        {
            "#judgement[data-outcome=contact]": "It starts at 19:29:46 and ends at 19:30:50",
            "#first-contact .value": "✓Benches with each other: never touch",
            "#sweeps, #keepKit-ZIP": False,
        }
    )
    person.types({"#stray": "1"}, "Tab").sees({"#first-contact .value": "✓Benches with each other: nothing can touch"})
    # Nothing green stands beside a red verdict.
    assert person.style("#first-contact .value", "color") == person.style("body", "color")
    times = {"12,5": "12.50 s", "19:29:55": "-5.00 s", "999": "50.00 s", "soon": "50.00 s"}
    for typed, clock in times.items():
        person.presses("#clock").types({"#typed-time": typed}).sees({"#clock": clock})
    expect(person.at("#clock")).to_be_focused()
    # The dragon on a long route is no hairline: a bench is 0.3 m wide, one pixel at this scale.
    pixels = person.opens(f"?door=village{ROUTE}&view=30,0,3").picture()
    column = pixels[:, pixels.shape[1] // 2, :3]
    red = (column[:, 0] > 0.4) & (column[:, 2] < 0.6 * column[:, 0])
    assert 5 <= red.sum() < 0.1 * len(column)
    assert person.findings() == []
    shares_without_a_clipboard(person)
    person.page.emulate_media(media="print")
    person.page.pdf()
    person.sees({"#printed": ["The dance ends at 50.00 s (19:30:50).", person.page.url], "#canvas": True})
    assert person.sees({"#judgement .value": True}).ask(BORDERED) == []


def shares_without_a_clipboard(person):
    """The address is selected, so that it can be copied by hand; and a phone can read it."""
    address = person.presses("#share").sees({"#qr": True}).at("#address").input_value()
    assert address == person.page.url
    assert len(address) < 500
    assert person.ask("getSelection().toString() || document.activeElement.value") == address
    seen = zxingcpp.read_barcodes(Image.open(BytesIO(person.at("#qr").screenshot())))
    assert [one.text for one in seen] == [short_form(address)]
    assert person.findings("#sharing") == []
    person.strikes("Escape").sees({"#sharing": False})
    # An address without the drawing is not offered.
    points = [[k / 7, 1 / 7] for k in range(950)]
    text = json.dumps({"path": {"kind": "waypoints", "points": points}, "dragon": {"benches": 2}})
    person.takes({"name": "long.json", "mimeType": "application/json", "buffer": text.encode()})
    person.presses("#instead").sees({"#status": "Opened long.json"}).settles().presses("#share")
    person.sees({"#sharing-help": "save it as a file", "#address, #qr, #copy-address": False}).strikes("Escape")
    person.presses("#undo").settles()


@thorough
def test_a_film_is_cancelled_then_shows_its_progress_and_opens_below_and_cue_cards_are_made(open_page):
    person = open_page(f"?door=village{ROUTE}").reaches_below()
    person.sees({"#kept li:visible": 5, "#people #cues": True})
    assert person.saves("#keepCues-A4", "cues-a4.pdf").startswith(b"%PDF")
    person.presses("#keepMap-KML").sees({"#status": "KML is in degrees", "#latitude": True})
    person.presses("#more").settles()
    person.page.route("**/films", without(seconds=60.0))  # it is not whole before it is cancelled
    person.presses("#keepFilm-GIF", "#jobs li button").sees({"#jobs li": "cancelled", "#sweep": False})
    held = person.holds_back("**/cues")
    person.presses("#keepCues-CSV").has("#keepCues-CSV", aria_busy="true").sees({"#status": "Being made"})
    with person.page.expect_download():
        held.let_go()
    person.has("#keepCues-CSV", aria_busy="false").page.route("**/films", without(height=90))
    person.presses("#keepFilm-GIF").sees({"#keepFilm-GIF": re.compile(r"^GIF \d+ %$")})
    person.page.wait_for_function("() => document.querySelector('#kept img.film')?.naturalWidth === 160")
    person.reads({"#keepFilm-GIF": "GIF"}).has("#kept img.film", alt="Film of the dance")


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
    person.opens(f"?door=contest&time=0&csv={'%0A'.join(['2.2,0.3,0.2'] * 5)}").reaches_below()
    person.presses("#keepKit-ZIP").sees({"#status": "The kit is for equal benches"})


@thorough
def test_a_route_is_drawn_by_keyboard_from_nothing(open_page):
    person = open_page("?door=village&path=route&benches=2")
    person.focuses("#invite .main")
    person.strikes("Enter")
    expect(person.at("#canvas")).to_be_focused()
    for count in range(5):
        expect(person.strikes("n").all("#knots .knot").nth(count)).to_be_focused()
    person.strikes("Shift+ArrowUp").settles().sees({"#judgement .value": re.compile("[Cc]an be danced")})
    person.sees({"#clearance[aria-busy=false] .reading": "it takes three of them"})
    # A square around it, too: four corners turn to the left.
    person.at("[data-tool=area]").press("Enter")
    person.focuses("#canvas")
    person.strikes(*"nnnn").settles().sees({"#knots .knot": 4, "#judgement .failures li": True})
