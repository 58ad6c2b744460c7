"""From a square to a dance: its size, its corners and gates, proposals on cards, and the chosen one edited."""

import itertools
import math
import re

import pytest

from tests.support.person import PHONE
from tests.support.serving import serving

thorough = pytest.mark.thorough
EMPTY = "?door=village&path=route"
NARROW_YARD = f"{EMPTY}&benches=8&things=a.square..0,0_30,0_30,3_0,3"
# A yard of 24 m by 20 m around the origin, with a tree; and a view whose middle is the origin.
YARD = f"{EMPTY}&benches=8&things=a.square..-12,-10_12,-10_12,10_-12,10~c.linden.0!5.3,4"
SCALE = 20.0  # [px/m]
SCALED = f"{YARD}&view=0,0,{SCALE:g}"
CARDS = "#cards button"
CLEAR = "#judgement[data-outcome=clear]"
ADDRESS = 1_200  # most characters that a phone reads from a screen
NARROW = """() => [...document.querySelectorAll("#place :is(button, input, select, summary)")]
  .filter((one) => one.checkVisibility())
  .map((one) => [one, one.getBoundingClientRect()])
  .filter(([one, { height, right }]) => height < 43.5 || (!one.closest("#cards") && right > innerWidth + 1))
  .map(([one]) => one.outerHTML)"""
ORDERS = """() => {
  window.orders = [];
  const ways = () => [...document.querySelectorAll("#cards .way")].map((way) => way.getAttribute("points"));
  new MutationObserver(() => window.orders.push(ways())).observe(document.querySelector("#cards"), { childList: true });
}"""


def proposed(person):
    return person.presses("#propose").sees({CARDS: True})


def tap_at(person, x, y):
    """A tap at a place in metres, in the view of SCALED."""
    person.page.mouse.click(*person.settles().spot("#canvas", SCALE * x, -SCALE * y))


def corners(person):
    """Corners of the first thing in the address."""
    text = person.settles().address()["things"].split("~")[0].split(".")[3].replace("!", ".")
    return [[float(one) for one in corner.split(",")] for corner in text.split("_")]


def test_from_nothing_to_a_certified_dance_on_a_phone(open_page):
    person = open_page("", reduced_motion="reduce", **PHONE).presses("#arrival [data-door=village]")
    # A square is drawn as its size is typed.
    person.types({"#place-width": "30", "#place-height": "40"}, "Tab").settles()
    assert corners(person) == [[-15.0, -20.0], [15.0, -20.0], [15.0, 20.0], [-15.0, 20.0]]
    # How long it may last is said in minutes, or by the clock once it says when the dance starts.
    person.types({"#ends": "19:50"}, "Tab").sees({"#ends-wrong": "Say at “Starts at” when the dance starts"})
    person.types({"#begin_clock": "19:46"}, "Tab").sees({"#ends-wrong": False})
    # A second dragon needs the path of the first.
    person.sees({"#propose": True, "#several": False})
    # Without a path, the best of the dances is shown at once.
    proposed(person).reads({f"{CLEAR} .value": "✓Can be danced"}).has(CARDS, aria_pressed="true")
    person.sees({"#several": True, CARDS: re.compile(r"Ring.*, 3 min \d+ s;", re.DOTALL)})
    person.settles()
    assert person.ask(NARROW) == []
    for language in ("zh", "en"):
        assert not person.speaks(language).overflows(390)
        assert person.ask("document.querySelector('#cards button').offsetWidth") > 250
        assert not re.search("undefined|NaN", person.text("#place"))
    assert person.findings() == []
    # What was chosen is in the address, to every digit.
    words = person.text("#judgement")
    chosen = person.address()
    assert len(person.page.url) < ADDRESS
    person.page.reload()
    assert person.settles().text("#judgement") == words
    assert person.address() == chosen


@thorough
def test_a_card_says_what_is_good_and_tight_becomes_a_route_and_begins_in_the_streets_of_gates(open_page):
    person = proposed(open_page(SCALED)).presses(CARDS).settles()
    _cards_for_other_gates_cannot_be_chosen(person)
    person.opens(SCALED)
    _gates_lie_on_the_border_and_the_dance_begins_in_their_streets(person)
    proposed(person.opens(YARD))
    person.sees({"#proposed": re.compile(r"The best \d of \d+ tried; each has passed its check\. .*")})
    lengths = []
    for k in range(2):
        card = f"{CARDS} >> nth={k}"
        person.sees({f"{card} >> .near, .tight": True, f"{card} >> .good": True})
        person.presses(card).has(card, aria_pressed="true").settles().sees({CLEAR: True})
        # The card and the verdict say the same length.
        way, walk = (
            re.search(r"the head walks ([\d.]+) m", person.text(place), re.IGNORECASE) for place in (card, "#judgement")
        )
        assert way
        assert walk
        assert float(walk[1]) == pytest.approx(float(way[1]), abs=0.6)
        lengths.append(walk[0])
    # It is a figure, until it is freed; then its points follow from it.
    chosen = person.presses("#edit").has("[data-tool=path]", aria_pressed="true").settles().address()
    assert ("walk" in chosen, "route" in chosen) == (True, False)
    person.sees({".knot": 0}).presses("#free").sees({"#status": "The figure is now a path of"}).settles()
    # An eight, and half of it again: both ends, three corners for each loop, and two for the rest.
    assert 0 < person.counts(".knot:visible") <= 10
    person.focuses(".knot >> nth=2")
    edited = person.strikes("ArrowUp").settles().sees({CLEAR: True}).address()
    assert ("walk" in edited, "route" in edited) == (False, True)
    assert person.strikes("ControlOrMeta+z", "ControlOrMeta+z").settles().address() == chosen
    person.presses("#undo").settles().sees({"#judgement": lengths[0]})


def _cards_for_other_gates_cannot_be_chosen(person):
    person.sees({"#cards-old": False}).misses({"#judgement": "earlier"}).presses("[data-add=gate]")
    tap_at(person, -11, 1)
    person.settles().sees({"#cards-old": True, "#judgement": "proposed for an earlier square, other gates"})
    person.sees({f"{CARDS}:disabled": True, f"{CARDS}:enabled": 0}).presses("#undo")
    person.sees({"#cards-old": False, f"{CARDS}:enabled": True, f"{CARDS}:disabled": 0})


def _gates_lie_on_the_border_and_the_dance_begins_in_their_streets(person):
    person.presses("[data-add=gate]").sees({"#add-help": "a straight street of about"})
    person.sees({"#draw-help": "Tap the border", "[data-add=gate]": False})
    tap_at(person, -11, 1)
    person.holds({"#beside select": ""})
    tap_at(person, 11, -2)
    person.holds({"#beside select": "out"})
    # Who types how fast it goes needs neither the tools nor the numbers of the gate.
    person.types({"#place [data-label='Head speed']": "1.2"}).settles()
    person.sees({"[data-add=gate]": True, "#beside": False})
    with person.page.expect_request("**/proposals") as sent:
        person.presses("#propose")
    body = sent.value.post_data_json
    assert [gate["heading"] for gate in body["gates"]] == pytest.approx([0.0, math.pi], abs=1e-3)
    assert [(gate["point"][0], gate["use"]) for gate in body["gates"]] == [(-12.0, "in"), (12.0, "out")]
    assert body["head_speed"] == 1.2
    person.sees({f"{CARDS}:has-text('From gate to gate 2')": 3}).presses(CARDS).settles().sees({CLEAR: True})
    # The square with its streets is danced in, and the square without them is asked about again.
    assert person.address()["yard"] == "-12,-10_12,-10_12,10_-12,10"
    with person.page.expect_request("**/proposals") as again:
        person.presses("#propose")
    assert again.value.post_data_json["venue"] == body["venue"]


@thorough
def test_a_square_has_typed_sizes_corners_and_sides_and_nothing_changes_or_stays_in_silence(open_page):
    person = open_page(f"{EMPTY}&benches=8", failing=True).presses("#propose")
    person.reads({"#proposed": "First say how large your square is."}).types({"#place-width": "-3"})
    person.sees({"#place-wrong": "“-3”"})
    ring = corners(person.chooses({"#place-shape": "circle"}).types({"#place-diameter": "26,5"}))
    assert [math.hypot(*corner) for corner in ring] == pytest.approx([13.25] * len(ring), abs=1e-3)
    person.opens(YARD).types({"#place-width": "20000"}).sees({"#place-wrong": "“20000”"}).types({"#place-width": "5"})
    person.sees({"#proposed": "Outside the square now: linden."})
    person.opens(YARD).presses("[data-add=area]")
    row = "#corners tbody tr >> nth=1"
    x, side = (f"{row} >> input >> nth={k}" for k in (0, 2))
    person.holds({x: "12", side: "20"}).reads({f"{row} >> td >> nth=3": "90.0°"})
    person.types({x: "14,5", side: "16"}).at(side).press("Tab")
    after = corners(person)
    assert after[:2] == [[-12.0, -10.0], [14.5, -10.0]]
    assert math.dist(after[1], after[2]) == pytest.approx(16.0, abs=1e-3)
    person.types({x: "wide"}).has(x, aria_invalid="true")
    assert person.findings() == []
    _what_was_drawn_before_leaves_nothing(person)
    _while_a_point_is_dragged_the_stretches_that_fail_are_coloured(person)


@thorough
def test_why_none_fits_stands_in_one_sentence_and_a_search_can_be_stopped(open_page):
    person = open_page(NARROW_YARD).presses("#propose")
    person.sees({"#proposed": ["3.01 m", "3.77 m"], CARDS: 0}).speaks("zh").sees({"#proposed": "直径至多 3.01 m"})
    person.opens(f"{YARD}&lang=en")
    person.page.route("**/proposals", lambda route: None)
    person.presses("#propose").sees({"#propose:disabled": True})
    person.sees({"#proposed": re.compile(r"Looking for dances that fit: \d+ s")}).presses("#place button:text('Stop')")
    person.sees({"#propose:enabled": True}).reads({"#proposed": ""}).settles().page.unroute_all()
    person.opens(f"{EMPTY}&benches=3&things=a.square..0,0_9,0_9,9_0,9&lang=en").chooses({"#objective": "benches"})
    proposed(person).settles().sees({"#proposed": re.compile(r".*room for at most \d+\.")})


@thorough
def test_a_long_search_is_a_job_whose_cards_come_meanwhile_and_keep_their_places(open_page, tmp_path):
    with serving(tmp_path / "server.log", deadline_seconds=1e-3, data=tmp_path / "data") as service:
        person = open_page(YARD, base=service.url, failing=True)
        person.ask(ORDERS)
        proposed(person).settles("search").sees({"#proposed": "each has passed its check"})
        orders = [ways for ways in person.ask("window.orders") if ways]
        assert len(orders[-1]) >= 2
        for before, after in itertools.pairwise(orders):
            assert len(after) < len(before) or [one for one in before if one in after] == [
                one for one, now in zip(before, after, strict=False) if one == now
            ]
        # A long search, so that it still goes on when a slow browser has drawn the first cards; a chosen one ends it.
        things = "a.square..0,0_80,0_80,70_0,70~c.linden.0!5.24,21~c.elm.0!5.56,45"
        person = open_page(f"{EMPTY}&benches=100&things={things}", base=service.url, failing=True)
        person.presses("#propose").sees({"#proposed": "found so far, the search goes on"})
        with person.page.expect_request(lambda request: request.method == "DELETE"):
            person.presses(CARDS)
        person.sees({"#proposed": "found so far."}).settles().sees({f"{CARDS}[aria-pressed=true]": 1})
        # Where the time does not suffice, nothing is said to fail, and no number to be wrong.
        person = open_page("?path=route&route=*-3000,0_3000,0&benches=2000", base=service.url, failing=True)
        person.sees({"#judgement .value": "Undecided", "[aria-invalid=true]": 0})


def _what_was_drawn_before_leaves_nothing(person):
    """The time of its start stands beside the square."""
    wrong = "?door=village&path=route&route=*-9,0_9,0&benches=2&width=-1&things=a.square..0,0_9,0_9,9_0,9"
    person.opens(wrong).sees({"#controls .error:visible": True})
    person.presses("#preset", "[data-begin=empty]").settles().sees({"#controls .error:visible": 0, "#inset": False})
    person.opens(f"{YARD}~g.gate..-12,0&route=*-11,-8_11,-8&benches=3&begin_clock=19:30")
    person.sees({"#judgement": "Gates do not count for it"}).holds({"#place #begin_clock": "19:30"})
    person.presses("#doors [data-door=contest]").settles().sees({"#pace #begin_clock": 1})


def _while_a_point_is_dragged_the_stretches_that_fail_are_coloured(person):
    person.opens(f"{YARD}&route=*-11,-8_11,-8&benches=3&stray=0.05").presses("#edit", "[data-tool=path]")
    before = person.settles().coloured("head")
    x, y = person.spot(".knot >> nth=1")
    person.page.mouse.move(x, y)
    person.page.mouse.down()
    with person.page.expect_response("**/course") as answer:
        person.page.mouse.move(x + 12, y + 90, steps=3)
    body = answer.value.request.post_data_json
    assert (body["breaches"], body["stray"]) == (True, 0.05)
    during = person.settles("course", "contact").coloured("head")
    person.page.mouse.up()
    person.settles().has("#judgement", data_outcome="contact")
    assert during > before + 300
