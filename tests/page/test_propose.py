"""From a square to a dance: its size, its corners and gates, proposals on cards, and the chosen one edited."""

from __future__ import annotations

import itertools
import math
import re
import time
from typing import Any
from urllib.parse import parse_qs, urlsplit

import pytest
from playwright.sync_api import expect

from app.questions.proposals import Lack
from app.wire.paths import RoutePath
from core import Dragon, Failure, FailureKind, Figure, Reason, ReasonKind
from core.proposal.designs import street_length
from core.proposal.needs import Needs
from tests.support.axe import findings
from tests.support.pending import settled, with_below
from tests.support.serving import serving

PHONE = {"viewport": {"width": 390, "height": 844}, "has_touch": True, "is_mobile": True}
EMPTY = "?door=village&path=route"
# A yard of 24 m by 20 m around the origin, with a tree.
YARD = f"{EMPTY}&benches=8&things=a.square..-12,-10_12,-10_12,10_-12,10~c.linden.0!5.3,4"
# The same in a view whose middle is the origin.
SCALE = 20.0  # [px/m]
SCALED = f"{YARD}&view=0,0,{SCALE:g}"
MINUTES = 120.0  # [s] from nothing to a certified dance
CARDS = "#cards button"
FINGER = 43.5  # [px]
ADDRESS = 1_200  # most characters that a phone reads from a screen
ROUNDED = 2e-6  # [m], by the numbers of a path in an address
NARROW = """(least) => [...document.querySelectorAll("#place :is(button, input, select, summary)")]
  .filter((one) => one.checkVisibility())
  .map((one) => [one, one.getBoundingClientRect()])
  .filter(([one, { height, right }]) => height < least || (!one.closest("#cards") && right > innerWidth + 1))
  .map(([one]) => one.outerHTML)"""


def proposed(page: Any) -> Any:
    page.locator("#propose").click()
    page.locator(CARDS).first.wait_for()
    return page.locator(CARDS)


def parts(page: Any) -> dict[str, str]:
    """The parts of the page's address."""
    settled(page, "address")
    return {name: values[0] for name, values in parse_qs(urlsplit(page.url).query).items()}


def tap_at(page: Any, x: float, y: float) -> None:
    """A tap at a place in metres, in the view of SCALED."""
    settled(page)
    box = page.locator("#canvas").bounding_box()
    page.mouse.click(box["x"] + box["width"] / 2 + SCALE * x, box["y"] + box["height"] / 2 - SCALE * y)


def test_from_nothing_to_a_certified_dance_on_a_phone_in_two_minutes(open_page: Any) -> None:
    page = open_page("", reduced_motion="reduce", **PHONE)
    begun = time.monotonic()
    page.locator("#arrival [data-door=village]").tap()
    page.locator("#place-width").fill("30")
    page.locator("#place-height").fill("40")
    page.locator("#take-rectangle").tap()
    page.locator("#place-width").fill("30")
    page.locator("#propose").tap()
    page.locator(CARDS).first.wait_for()
    page.locator(CARDS).first.tap()
    expect(page.locator("#judgement[data-outcome=clear] .value")).to_have_text("✓Can be danced")
    assert time.monotonic() - begun < MINUTES
    expect(page.locator("#verdict")).to_be_in_viewport()
    expect(page.locator("#verdict")).to_have_text(re.compile("✓ Can be danced"))
    expect(page.locator(CARDS).first).to_have_attribute("aria-pressed", "true")
    assert page.evaluate(NARROW, FINGER) == []
    for language in ("zh", "en"):
        page.locator(f"[data-lang={language}]").tap()
        settled(page)
        assert page.evaluate("document.documentElement.scrollWidth") <= 390
        assert "undefined" not in page.locator("#place").inner_text()
        assert "NaN" not in page.locator("#place").inner_text()
    assert findings(page) == []
    # What was chosen is in the address, to every digit, and the address in a QR code.
    words = page.locator("#judgement").inner_text()
    page.locator("#share").tap()
    assert len(page.locator("#address").input_value()) < ADDRESS
    page.locator("#qr").wait_for()
    page.keyboard.press("Escape")
    chosen = parts(page)
    page.reload()
    settled(page)
    assert page.locator("#judgement").inner_text() == words
    assert parts(page) == chosen


PIECES: list[dict[str, Any]] = [
    {"kind": "line", "start": [-3.25, 1.5], "end": [4.123456, 8.654321]},
    {"kind": "arc", "centre": [2.0, -1.0], "radius": 3.3333333333, "start_angle": 0.7, "sweep": 5.123456789},
    {"kind": "arc", "centre": [2.0, -1.0], "radius": 3.3333333333, "start_angle": 0.7, "sweep": -0.123456789},
    {"kind": "coil", "pitch": 1.7, "start_turns": 6.12, "end_turns": 1.5, "centre": [3.0, -2.0], "rotation": 0.7},
    {"kind": "coil", "pitch": 1.7, "start_turns": 1.2, "end_turns": 5.0, "centre": [3.0, -2.0], "rotation": -2.5},
]


@pytest.mark.parametrize("piece", PIECES, ids=["line", "left", "right", "inwards", "outwards"])
def test_a_path_in_an_address_goes_where_the_path_went(open_page: Any, piece: dict[str, Any]) -> None:
    written = "path => import('/page/walk.js').then(({ roundedRoute }) => roundedRoute(path))"
    page = open_page(EMPTY)
    rounded = page.evaluate(written, {"kind": "route", "pieces": [piece]})
    assert page.evaluate(written, rounded) == rounded
    before, after = (
        RoutePath.model_validate({"kind": "route", "pieces": pieces}).to_path()
        for pieces in ([piece], rounded["pieces"])
    )
    assert after.end - after.begin == pytest.approx(before.end - before.begin, abs=ROUNDED)
    for share in (0.0, 0.3, 1.0):
        places = [path.position(path.begin + share * (path.end - path.begin)) for path in (before, after)]
        assert places[1] == pytest.approx(places[0], abs=ROUNDED)


def test_a_card_says_what_is_good_and_what_is_tight_and_becomes_the_route(open_page: Any) -> None:
    page = open_page(YARD)
    settled(page)
    cards = proposed(page)
    expect(page.locator("#proposed")).to_have_text(re.compile(r"The best \d of \d+ tried; each has passed its check\."))
    assert 2 <= cards.count() <= 3
    for card in cards.all():
        expect(card.locator(".good")).to_have_text(re.compile(r"✓ (Most room: p|P)eople may be \d"))
        expect(card.locator(".near, .tight")).to_have_text(
            re.compile(
                r"[↔!] (nobody comes nearer than \d+\.\d\d m|benches that are not neighbours come as near as \d)"
            )
        )
        assert card.locator("svg .way").get_attribute("points")
    times = []
    for card in cards.all():
        card.click()
        expect(card).to_have_attribute("aria-pressed", "true")
        settled(page)
        expect(page.locator("#judgement[data-outcome=clear]")).to_be_visible()
        way = re.search(r"(\d+) m$", card.locator(".hint").inner_text())
        time_there = re.search(r"in ([\d.]+) s\.", page.locator("#judgement").inner_text())
        assert way
        assert time_there
        assert float(time_there[1]) == pytest.approx(float(way[1]), abs=0.6)  # at 1 m/s
        times.append(time_there[0])
    page.locator("#edit").click()
    # A tap now belongs to the path.
    expect(page.locator("[data-tool=path]")).to_have_attribute("aria-pressed", "true")
    page.locator("#undo").click()
    settled(page)
    expect(page.locator("#judgement")).to_contain_text(times[-2])


def test_a_chosen_dance_is_edited_like_any_route(open_page: Any) -> None:
    page = open_page(YARD)
    settled(page)
    proposed(page).first.click()
    settled(page)
    chosen = parts(page)
    assert "walk" in chosen
    page.locator("#edit").click()
    page.locator("[data-tool=path]").click()
    settled(page)
    knots = page.locator(".knot")
    assert knots.count() >= 8
    knots.nth(2).focus()
    page.keyboard.press("ArrowUp")
    settled(page)
    expect(page.locator("#judgement[data-outcome=clear]")).to_be_visible()
    edited = parts(page)
    assert "walk" not in edited
    # The points of what was chosen follow from its path.
    assert "route" in edited
    assert "route" not in chosen
    page.keyboard.press("ControlOrMeta+z")
    settled(page)
    assert parts(page) == chosen
    count = knots.count()
    page.reload()
    page.locator("#edit").click()
    page.locator("[data-tool=path]").click()
    expect(knots).to_have_count(count)


def test_gates_keep_their_share_of_the_sides_of_another_square(open_page: Any) -> None:
    page = open_page(f"{EMPTY}&things=a.square..-20,-15_20,-15_20,15_-20,15~g.gate..-20,5~g.out..10,15")
    settled(page)
    page.locator("#place-width").fill("24")
    page.locator("#place-height").fill("18")
    page.locator("#take-rectangle").click()
    settled(page)
    gates = [one.split(".")[3] for one in parts(page)["things"].split("~") if one.startswith("g.")]
    assert gates == ["-12,3", "6,9"]


def test_gates_lie_on_the_border_and_the_dance_begins_in_their_streets(open_page: Any, picture: Any) -> None:
    page = open_page(SCALED)
    settled(page)
    page.locator("[data-add=gate]").click()
    expect(page.locator("#draw-help")).to_contain_text("Tap the border")
    tap_at(page, -11, 1)
    tap_at(page, 11, -2)
    page.locator("#edit").click()
    settled(page)
    things = parts(page)["things"].split("~")
    gates = [one.split(".") for one in things if one.startswith("g.")]
    assert [(gate[1], gate[2]) for gate in gates] == [("gate", ""), ("gate-202", "")]
    places = [[float(one) for one in gate[3].replace("!", ".").split(",")] for gate in gates]
    assert [place[0] for place in places] == [-12.0, 12.0]
    assert [place[1] for place in places] == pytest.approx([1.0, -2.0], abs=0.15)
    with page.expect_request("**/proposals") as sent:
        page.locator("#propose").click()
    body = sent.value.post_data_json
    assert [gate["heading"] for gate in body["gates"]] == pytest.approx([0.0, math.pi], abs=1e-3)
    page.locator(CARDS).first.wait_for()
    expect(page.locator(CARDS).filter(has_text="From gate to gate")).to_have_count(1)
    page.locator(CARDS).first.click()
    settled(page)
    expect(page.locator("#judgement[data-outcome=clear]")).to_be_visible()
    # The square fills the picture; its streets are seen too where all is asked for twice.
    ground = page.evaluate("getComputedStyle(document.querySelector('#canvas')).getPropertyValue('--ground')").strip()
    wanted = [int(ground[k : k + 2], 16) / 255 for k in (1, 3, 5)]
    seen = []
    for _ in range(3):
        settled(page)
        seen.append(int((abs(picture(page)[..., :3] - wanted).max(axis=-1) < 0.02).sum()))
        page.locator("#show-all").click()
    assert seen[1] < 0.5 * seen[0]
    assert seen[2] == seen[0]
    # The square with its streets is danced in, and the square without them is asked about again.
    held = parts(page)
    assert len(page.url) < ADDRESS
    assert held["yard"] == "-12,-10_12,-10_12,10_-12,10"
    with page.expect_request("**/proposals") as again:
        page.locator("#propose").click()
    assert again.value.post_data_json["venue"] == body["venue"]
    page.locator(CARDS).first.wait_for()
    page.reload()
    expect(page.locator("#judgement[data-outcome=clear]")).to_be_visible()
    assert parts(page)["yard"] == held["yard"]


def test_corners_have_typed_coordinates_and_sides_typed_lengths(open_page: Any) -> None:
    page = open_page(YARD)
    settled(page)
    page.locator("[data-add=area]").click()
    fields = page.locator("#corners tbody tr").nth(1).locator("input")
    expect(page.locator("#corners summary")).to_have_text("Corners of “square”: 4")
    values = [field.input_value() for field in fields.all()]
    assert values == ["12", "-10", "20"]
    expect(page.locator("#corners tbody tr").nth(1).locator("td").nth(3)).to_have_text("90.0°")
    fields.nth(0).fill("14,5")
    fields.nth(0).press("Enter")
    fields.nth(2).fill("16")
    fields.nth(2).press("Enter")
    fields.nth(2).press("Tab")
    settled(page)
    corners = parts(page)["things"].split("~")[0].split(".")[3].replace("!", ".")
    after = [[float(one) for one in corner.split(",")] for corner in corners.split("_")]
    assert after[1] == [14.5, -10.0]
    assert math.dist(after[1], after[2]) == pytest.approx(16.0, abs=1e-3)
    assert after[0] == [-12.0, -10.0]
    fields.nth(0).fill("wide")
    fields.nth(0).press("Enter")
    expect(fields.nth(0)).to_have_attribute("aria-invalid", "true")
    expect(page.locator("#proposed")).to_contain_text("you typed “wide”")
    assert findings(page) == []


def test_a_square_is_drawn_by_its_size_and_a_wrong_size_is_named(open_page: Any) -> None:
    page = open_page(f"{EMPTY}&benches=8")
    settled(page)
    page.locator("#propose").click()
    expect(page.locator("#proposed")).to_have_text("First say how large your square is.")
    page.locator("#place-width").fill("-3")
    page.locator("#take-rectangle").click()
    expect(page.locator("#place-wrong")).to_contain_text("must be more than 0 m and at most 10,000 m; you typed “-3”")
    page.locator("#place-diameter").fill("26,5")
    page.locator("#place-diameter").press("Enter")
    settled(page)
    corners = parts(page)["things"].split("~")[0].split(".")[3].replace("!", ".").split("_")
    radii = [math.hypot(*map(float, corner.split(","))) for corner in corners]
    assert radii == pytest.approx([13.25] * len(corners), abs=1e-3)
    expect(page.locator("#place-width")).to_have_value("26.5")


@pytest.mark.parametrize(
    ("language", "words"),
    [
        (
            "en",
            "The widest free circle is at most 3.02 m across; a turn of the head needs 3.77 m. Make the square larger.",
        ),
        ("zh", "最大的空地圆直径至多 3.02 m，龙头转弯需要 3.77 m。请加大广场。"),
    ],
)
def test_why_none_fits_stands_in_one_sentence(open_page: Any, language: str, words: str) -> None:
    page = open_page(f"{EMPTY}&benches=8&lang={language}&things=a.square..0,0_30,0_30,3_0,3")
    settled(page)
    page.locator("#propose").click()
    expect(page.locator("#proposed")).to_have_text(words)
    assert page.locator(CARDS).count() == 0


# What a square without any dance that passes is answered with: the first failure of the nearest one.
LACK = Lack.of(
    Reason(ReasonKind.FAILS, 30, figure=Figure.EIGHT, failure=Failure(FailureKind.VENUE, 12.3456, (3,), "linden", "")),
    Dragon(8),
)
WHY = {"reason_kind": "fails", "reason_values": LACK.model_dump(mode="json")}
NONE = {"proposals": [], "tried": 30, "checked": 5, **WHY}


@pytest.mark.parametrize(
    ("language", "words"),
    [
        (
            "en",
            "None of 30 tried passes its check; the nearest, “Figure eight”, fails at 12.35 s: body 3 touches linden.",
        ),
        ("zh", "试过的 30 种均未通过检查；最接近的“8 字形”在 12.35 s 不合格：第3节龙身碰到linden。"),
    ],
)
def test_where_none_passes_the_first_failure_of_the_nearest_is_named(open_page: Any, language: str, words: str) -> None:
    page = open_page(f"{YARD}&lang={language}")
    settled(page)
    page.route("**/proposals", lambda route: route.fulfill(json=NONE))
    page.locator("#propose").click()
    expect(page.locator("#proposed")).to_have_text(words)


@pytest.mark.parametrize(
    ("language", "words"),
    [("en", r"By its area the square has room for at most \d+\."), ("zh", r"按面积，广场最多容纳 \d+ 节。")],
)
def test_as_many_benches_as_fit_stand_beside_what_the_area_bounds(open_page: Any, language: str, words: str) -> None:
    page = open_page(f"{EMPTY}&benches=3&lang={language}&things=a.square..0,0_9,0_9,9_0,9")
    settled(page)
    page.locator("#objective").select_option("benches")
    proposed(page)
    settled(page)
    expect(page.locator("#proposed")).to_have_text(re.compile(words))
    page.locator("#objective").select_option("turns")
    proposed(page)
    settled(page)
    expect(page.locator("#proposed")).not_to_have_text(re.compile(words))


def test_a_search_can_be_stopped(open_page: Any) -> None:
    page = open_page(YARD)
    settled(page)
    page.route("**/proposals", lambda route: None)
    page.locator("#propose").click()
    expect(page.locator("#propose")).to_be_disabled()
    expect(page.locator("#proposed")).to_have_text(re.compile(r"Looking for dances that fit: \d+ s"))
    page.locator("#place").get_by_role("button", name="Stop").click()
    expect(page.locator("#propose")).to_be_enabled()
    expect(page.locator("#proposed")).to_be_empty()
    settled(page)


def test_what_takes_longer_than_one_answer_comes_as_a_job(open_page: Any, tmp_path: Any) -> None:
    with serving(tmp_path / "server.log", deadline_seconds=1e-3, data=tmp_path / "data") as service:
        page = open_page(f"{EMPTY}&benches=8&things=a.square..0,0_30,0_30,3_0,3", base=service.url, failing=True)
        looks: list[Any] = []
        page.route(re.compile(r"/jobs/[^/]+$"), lambda route: looks.append(route))
        page.locator("#propose").click()
        # The search goes on until the first look at it is answered.
        expect(page.locator("#proposed")).to_have_text(re.compile(r"\d+ s, \d+ % of the kinds of dance tried"))
        with page.expect_request("**/jobs/*/result"):
            looks.pop().continue_()
            page.unroute_all()
        expect(page.locator("#proposed")).to_contain_text("The widest free circle is at most 3.02 m across")


def test_cards_come_while_the_search_goes_on_and_a_chosen_one_ends_it(open_page: Any, tmp_path: Any) -> None:
    # A long search, so that it still goes on when a slow browser has drawn the first cards.
    square = f"{EMPTY}&benches=100&things=a.square..0,0_80,0_80,70_0,70~c.linden.0!5.24,21~c.elm.0!5.56,45"
    with serving(tmp_path / "server.log", deadline_seconds=0.05, data=tmp_path / "data") as service:
        page = open_page(square, base=service.url, failing=True)
        page.locator("#propose").click()
        expect(page.locator("#proposed")).to_contain_text("found so far, the search goes on")
        with page.expect_request(lambda request: request.method == "DELETE"):
            page.locator(CARDS).first.click()
        expect(page.locator("#proposed")).to_contain_text("found so far.")
        settled(page)
        expect(page.locator(f"{CARDS}[aria-pressed=true]")).to_have_count(1)


ORDERS = """() => {
  window.orders = [];
  const ways = () => [...document.querySelectorAll("#cards .way")].map((way) => way.getAttribute("points"));
  new MutationObserver(() => window.orders.push(ways())).observe(document.querySelector("#cards"), { childList: true });
}"""


def test_cards_keep_their_places_until_the_search_ends(open_page: Any, tmp_path: Any) -> None:
    with serving(tmp_path / "server.log", deadline_seconds=0.05, data=tmp_path / "data") as service:
        page = open_page(YARD, base=service.url, failing=True)
        settled(page)
        page.evaluate(ORDERS)
        proposed(page)
        settled(page, "search")
        expect(page.locator("#proposed")).to_contain_text("each has passed its check")
        orders = [ways for ways in page.evaluate("window.orders") if ways]
    assert len(orders[-1]) >= 2
    for before, after in itertools.pairwise(orders):
        assert after[: len(before)] == before


def test_a_new_square_leaves_nothing_of_the_dance_before(open_page: Any) -> None:
    page = open_page(
        "?door=village&path=route&route=*-9,0_9,0&benches=2&width=-1&things=a.square..0,0_9,0_9,9_0,9", failing=True
    )
    settled(page)
    wrong = page.locator("#controls .error:visible")
    expect(wrong.first).to_be_visible()
    page.locator("#preset").click()
    page.locator("[data-begin=empty]").click()
    settled(page)
    expect(wrong).to_have_count(0)
    expect(page.locator("#inset")).to_be_hidden()


def test_what_a_smaller_square_leaves_outside_is_named(open_page: Any) -> None:
    page = open_page(YARD)
    settled(page)
    page.locator("#place-width").fill("12")
    page.locator("#take-rectangle").click()
    expect(page.locator("#proposed")).to_have_text("")
    page.locator("#place-width").fill("5")
    page.locator("#take-rectangle").click()
    expect(page.locator("#proposed")).to_contain_text("Outside the square now: linden.")


def test_a_tap_on_a_point_says_how_to_add_one_beside_it(open_page: Any) -> None:
    page = open_page(SCALED)
    settled(page)
    page.locator("[data-add=block]").click()
    tap_at(page, 5, 5)
    tap_at(page, 5.3, 5.2)
    expect(page.locator("#status")).to_have_text(re.compile(r"Point 1: drag it, .*enlarge the picture with \+ first\."))


def test_the_start_stands_beside_the_square_and_of_a_spiral_beside_the_speeds(open_page: Any) -> None:
    page = open_page(f"{YARD}&route=*-11,-8_11,-8&begin_clock=19:30")
    settled(page)
    expect(page.locator("#place #begin_clock")).to_have_value("19:30")
    for typed, shown in (("2015", "20:15"), ("8:45 pm", "20:45"), ("12:05am", "00:05"), ("19.30", "19:30")):
        page.locator("#begin_clock").fill(typed)
        page.locator("#begin_clock").press("Enter")
        expect(page.locator("#begin_clock")).to_have_value(shown)
    page.locator("#begin_clock").fill("20")
    page.locator("#begin_clock").press("Enter")
    expect(page.locator("#place #clock-error")).to_contain_text("Until then it starts at 19:30:00.")
    page.locator("[data-door=contest]:visible").first.click()
    settled(page)
    expect(page.locator("#pace #begin_clock")).to_have_count(1)


def test_while_a_point_is_dragged_the_stretches_that_fail_are_coloured(open_page: Any, picture: Any) -> None:
    page = open_page(f"{YARD}&route=*-11,-8_11,-8&benches=3&stray=0.05")
    settled(page)
    page.locator("#edit").click()
    page.locator("[data-tool=path]").click()
    settled(page)

    def failing() -> int:
        """Pixels in the colour of what is too near."""
        pixels = picture(page)[..., :3]
        near = page.evaluate("getComputedStyle(document.querySelector('#canvas')).getPropertyValue('--head')").strip()
        wanted = [int(near[k : k + 2], 16) / 255 for k in (1, 3, 5)]
        return int((abs(pixels - wanted).max(axis=-1) < 0.02).sum())

    before = failing()
    knot = page.locator(".knot").nth(1).bounding_box()
    x, y = knot["x"] + knot["width"] / 2, knot["y"] + knot["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    with page.expect_response("**/course") as answer:
        page.mouse.move(x + 12, y + 90, steps=3)
    body = answer.value.request.post_data_json
    assert (body["breaches"], body["stray"]) == (True, 0.05)
    settled(page, "course", "contact")
    during = failing()
    page.mouse.up()
    settled(page)
    assert during > before + 300
    expect(page.locator("#judgement")).to_have_attribute("data-outcome", "contact")
    page.keyboard.press("ControlOrMeta+z")
    settled(page)
    assert failing() == pytest.approx(before, abs=60)


def proposal_from(
    figure: str, around: list[list[float]], name: str = "square", distance: float = 0.5
) -> dict[str, Any]:
    """A proposal of a dance of 8 benches through these points, as the service writes it."""
    dance = {
        "dragon": {"benches": 8, "head_length": 3.41, "body_length": 2.2, "width": 0.3, "overhang": 0.275},
        "path": {"kind": "waypoints", "points": around, "start": 15.0},
        "head_speed": 1.0,
        "start": 0.0,
    }
    near = {"name": name, "distance": distance, "time": 1.0}
    sizes = {"tolerance": 0.3, "duration": 40.0, "length": 40.0, "area": 90.0, "turns": 1.0, "clearance": 2.0}
    return {"figure": figure, "dance": dance, "near": near, "sharpest_bend": 0.2, "gates": [], **sizes}


def ring(radius: float) -> list[list[float]]:
    """Points once around the origin."""
    turns = [2.0 * math.pi * k / 12.0 for k in range(13)]
    return [[round(radius * math.cos(turn), 3), round(radius * math.sin(turn), 3)] for turn in turns]


TWO_RINGS = {
    "proposals": [proposal_from("ring", ring(9.0)), proposal_from("ring", ring(6.0), "linden", 0.7)],
    "tried": 30,
    "checked": 5,
    "most_benches": None,
}


@pytest.mark.parametrize(
    ("language", "titles", "tight"),
    [
        (
            "en",
            ["Ring, 18 m wide", "Ring, 12 m wide"],
            [
                "↔ nobody comes nearer than 0.50 m to the border of the square",
                "↔ nobody comes nearer than 0.70 m to “linden”",
            ],
        ),
        ("zh", ["环形，宽 18 m", "环形，宽 12 m"], ["↔ 离广场边界最近 0.50 m", "↔ 离“linden”最近 0.70 m"]),
    ],
)
def test_two_rings_are_told_apart_and_the_second_card_is_seen(
    open_page: Any, language: str, titles: list[str], tight: list[str]
) -> None:
    page = open_page(f"{YARD}&lang={language}", **PHONE)
    settled(page)
    page.route("**/proposals", lambda route: route.fulfill(json=TWO_RINGS))
    cards = proposed(page)
    expect(page.locator("#cards-title")).to_have_text({"en": "2 dances", "zh": "2 种舞龙"}[language])
    assert [card.locator("> b").inner_text() for card in cards.all()] == titles
    assert [card.locator(".near").inner_text() for card in cards.all()] == tight
    second = cards.nth(1).bounding_box()
    assert second["x"] < 390 - 20
    assert page.evaluate("document.documentElement.scrollWidth") <= 390


def test_what_comes_next_is_said_once_and_vanishes_with_the_proposals(open_page: Any) -> None:
    page = open_page(EMPTY, **PHONE)
    settled(page)
    expect(page.locator("#verdict")).to_have_text(re.compile("Draw a path"))
    page.locator("#take-rectangle").tap()
    settled(page)
    expect(page.locator("#verdict")).to_have_text(re.compile("Propose a dance"))
    expect(page.locator("#judgement")).to_contain_text("“Propose a dance” finds dances that fit into it")
    button, tabs = page.locator("#propose").bounding_box(), page.locator("#tabs").bounding_box()
    picture = page.locator("#dance").bounding_box()
    assert picture["y"] + picture["height"] <= button["y"]
    assert button["y"] + button["height"] <= tabs["y"]
    answers: list[Any] = []
    page.route("**/proposals", lambda route: answers.append(route))
    page.locator("#propose").tap()
    for _ in range(2):
        expect(page.locator("#verdict")).to_be_hidden()
        expect(page.locator("#judgement")).to_be_hidden()
        if answers:
            answers.pop().fulfill(json=TWO_RINGS)
            page.locator(CARDS).first.wait_for()


def test_a_card_and_the_verdict_say_the_same_length_with_its_meaning(open_page: Any) -> None:
    page = open_page(YARD)
    settled(page)
    card = proposed(page).first
    card.click()
    settled(page)
    way = re.search(r"the head walks (\d+) m", card.inner_text())
    words = page.locator("#judgement").inner_text()
    walk = re.search(r"The head walks ([\d.]+) m in", words)
    stands = re.search(r"stands on the first ([\d.]+) m of its path of ([\d.]+) m", words)
    assert way
    assert walk
    assert stands
    assert float(walk[1]) == pytest.approx(float(way[1]), abs=0.6)
    assert float(walk[1]) + float(stands[1]) == pytest.approx(float(stands[2]), abs=0.11)


def test_proposals_for_an_earlier_square_are_marked_and_cannot_be_chosen(open_page: Any) -> None:
    page = open_page(SCALED)
    settled(page)
    page.route("**/proposals", lambda route: route.fulfill(json=TWO_RINGS))
    cards = proposed(page)
    cards.first.click()
    settled(page)
    expect(page.locator("#cards-old")).to_be_hidden()
    expect(page.locator("#judgement")).not_to_contain_text("earlier")
    page.locator("[data-add=gate]").click()
    tap_at(page, -11, 1)
    settled(page)
    expect(page.locator("#cards-old")).to_be_visible()
    expect(page.locator("#judgement")).to_contain_text("proposed for an earlier square, other gates")
    expect(cards.first).to_be_disabled()
    page.locator("#undo").click()
    expect(page.locator("#cards-old")).to_be_hidden()
    expect(page.locator("#judgement")).not_to_contain_text("earlier")
    expect(cards.first).to_be_enabled()


def test_the_verdict_on_a_drawn_path_says_that_gates_do_not_count(open_page: Any) -> None:
    page = open_page(f"{YARD}~g.gate..-12,0&route=*-11,-8_11,-8&benches=3")
    settled(page)
    expect(page.locator("#judgement")).to_contain_text("Gates do not count for it")


@pytest.mark.parametrize(("benches", "stray", "margin"), [(8, 0.0, 0.0), (24, 0.0, 0.0), (8, 0.05, 1.5)])
def test_a_gate_is_explained_with_the_street_that_is_added(
    open_page: Any, benches: int, stray: float, margin: float
) -> None:
    limits = f"&stray={stray}&margin={margin}"
    page = open_page(YARD.replace("benches=8", f"benches={benches}") + limits, **PHONE)
    settled(page)
    page.locator("[data-add=gate]").click()
    expect(page.locator("[data-add=gate]")).to_be_hidden()
    expect(page.locator("[data-tool=gate]")).to_have_attribute("aria-pressed", "true")
    words = page.locator("#add-help").inner_text()
    street = re.search(r"Beyond it a straight street of about (\d+) m is added, as long as your dragon", words)
    assert street
    assert int(street[1]) == math.ceil(street_length(Needs(Dragon(benches), stray, margin)))
    page.locator("#place-done").click()
    expect(page.locator("[data-add=gate]")).to_be_visible()
    expect(page.locator("[data-tool=gate]")).to_be_hidden()


def test_a_typed_size_is_never_changed_in_silence(open_page: Any) -> None:
    page = open_page(YARD)
    settled(page)
    across = page.locator("#place-diameter")
    across.fill("80")
    page.locator("#place-width").fill("26")
    page.locator("#take-rectangle").click()
    settled(page)
    expect(across).to_have_value("80")
    across.fill("20000")
    page.locator("#take-circle").click()
    expect(page.locator("#place-wrong")).to_have_text(
        "“Diameter of the square” must be more than 0 m and at most 10,000 m; you typed “20000”. "
        "The square stays as it was."
    )
    expect(across).to_have_value("20000")
    expect(page.locator("#place-width")).to_have_value("26")


@pytest.mark.parametrize(("language", "words"), [("en", "People may stray up to"), ("zh", "每人最多可离位")])
def test_in_the_village_the_stray_has_plain_words(open_page: Any, language: str, words: str) -> None:
    page = open_page(f"{YARD}&lang={language}")
    settled(page)
    expect(page.locator("label[for=stray]")).to_have_text(words)
    page.locator("#doors [data-door=contest]").click()
    expect(page.locator("label[for=stray]")).to_have_text({"en": "Stray", "zh": "离位距离"}[language])


def test_a_cue_card_is_said_to_be_made_and_then_to_be_saved(open_page: Any) -> None:
    page = open_page(f"{YARD}&route=*-11,-8_11,-8&benches=3")
    settled(page)
    with_below(page)
    held: list[Any] = []
    page.route("**/cues", lambda route: held.append(route), times=1)  # of a busy service, it is repeated
    page.locator("#keepCues-PDF").click()
    expect(page.locator("#status")).to_have_text(
        "Being made: “A cue card for each bench”. It is saved as soon as it is ready."
    )
    expect(page.locator("#keepCues-PDF")).to_have_attribute("aria-busy", "true")
    with page.expect_download():
        held.pop().continue_()
    expect(page.locator("#status")).to_have_text("Saved cues.pdf")
    expect(page.locator("#keepCues-PDF")).to_have_attribute("aria-busy", "false")
