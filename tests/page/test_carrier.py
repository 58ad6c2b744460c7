"""The view of one carrier: its bench, its cues, its clock, and a network that goes away."""

import csv
import json
import math
import re
from datetime import datetime, timedelta

import pytest
from playwright.sync_api import Error, expect

from tests.support import paper, polite
from tests.support.person import PHONE
from tests.support.serving import PATIENT, free_port, serving

thorough = pytest.mark.thorough
DRAGON = {"benches": 20}
SLACK = 45  # from the last press to the cue [s], so that a slow machine is not late
TOUCHING = "path=route&benches=40&route=*-100,0_0,0_12,8_0,14_-4,0_0,-20&begin=88"
BEFORE_ZERO = "path=route&route=*-40,0_40,0&benches=9&begin=30"
CUE = "#carrier .cue"
HINT = "#card-more .hint"
LIST = "#card-more li"
# Two dragons in one spiral, by the list in the address; the chosen one is that of the other numbers.
TWO = "dances=name:A!benches:20!pitch:1.1!start_turns:8~rotation:180&dragon=1&benches=20&pitch=1.1&start_turns=8"
SPIRALS = [{"kind": "spiral", "pitch": 1.1, "start_turns": 8, **more} for more in ({}, {"rotation": math.pi})]
# Pixels in the colour of the chosen bench in the middle of the picture; it is 7 px wide.
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
SMALL = """() => [...document.querySelectorAll("#carrier :is(button, input), #card-more button")]
  .filter((one) => one.checkVisibility() && one.getBoundingClientRect().height < 24).map((one) => one.outerHTML)"""
SIZES = """() => [...new Set([...document.querySelectorAll("body *")].filter((one) => {
  const isField = one.matches("input:not([type=range], [type=color], [type=checkbox]), select, textarea");
  const hasText = [...one.childNodes].some((node) => node.nodeType === 3 && node.data.trim());
  const isSeen = one.checkVisibility({ visibilityProperty: true }) && !one.matches("option, .unseen");
  return (isField || hasText) && isSeen;
}).map((one) => getComputedStyle(one).fontSize))]"""
KEPT = "async () => [(await caches.keys()).length, (await navigator.serviceWorker.getRegistrations()).length]"
AHEAD = "presses => { for (let k = 0; k < presses; k++) document.querySelector(\"[data-correct='5']\").click(); }"


def card(server, language="en", **more):
    """The card of bench 7 of the spiral with 20 benches, up to its first contact."""
    stop = polite.answer(server, "collision-time", benches=20)["time"]
    body = {
        "dragon": DRAGON,
        "path": {"kind": "spiral"},
        "start": 0,
        "stop": stop,
        "cards": [7],
        "language": language,
    } | more
    return polite.answer(server, "cues", body)["cards"][0]


def card_of_two(server):
    """The card of bench 7 of the first of two dragons, up to their encounter."""
    own = [{"name": name, "dragon": DRAGON, "path": path} for name, path in zip(("A", "blue"), SPIRALS, strict=True)]
    report = polite.answer(server, "check", {"dances": own})
    span = {"start": report["start"], "stop": report["encounter"]["time"] or report["stop"] - 1e-6}
    return polite.answer(server, "cues", {"dances": own, **span, "cards": [7], "part": 0, "language": "en"})["cards"][0]


def words_of(cues):
    return [cue["words"] for cue in cues]


def cues_of(person):
    return person.texts(f"{LIST} span:last-child")


def held(person):
    person.at("#carrier[data-held=true]").wait_for()
    return person


def seconds(clock):
    """A duration such as 6:06 in seconds."""
    return sum(int(part) * 60**k for k, part in enumerate(reversed(clock.split(":"))))


def test_a_carrier_has_its_own_card_and_its_bench_in_the_middle(open_page, server):
    """The language is changed on the way; in both the screen stays on if the browser lets it."""
    person = held(open_page("?benches=20&bench=7&lang=en", permissions=["screen-wake-lock"], **PHONE))
    own = card(server)
    assert cues_of(person) == words_of(own["cues"])
    steps = abs(own["start"]["steps"])
    mark = round(own["start"]["mark"])
    stand = [str(mark), str(steps) if steps else str(mark)]
    person.sees({"#carrier h1": "body 7", "#card-more .stand": stand, HINT: "The screen stays on."})
    person.has("#carrier", data_awake="true").sees({CUE: "Press Start when the dance begins."})
    assert person.ask(MIDDLE) > 100
    rest = ("header", "#controls", "#answers", "#transport", "#tabs", "#keep")
    assert not person.sees(dict.fromkeys(rest, False)).overflows(390)
    assert person.findings("#front") == person.ask(SMALL) == []
    assert person.box("#stage")["height"] <= 0.35 * 844 + 1
    assert len(person.ask(SIZES)) <= 4
    # The next cue is counted down, and the pressed start outlives the page.
    person.presses("#card-start")
    late = next(cue for cue in own["cues"] if cue["since"] > 100)
    person.ask(AHEAD, int((late["since"] - SLACK) // 5))
    person.reads({CUE: late["words"]}).sees(
        {"#carrier .when": re.compile(r"^in 0:\d\d$"), "#card-more .stand": "Now: "}
    )
    expect(person.at(f"{LIST} >> nth={own['cues'].index(late)}")).to_have_class("following")
    assert 0 < int(person.text("#carrier .when")[-2:]) <= SLACK + 5
    gone = seconds(person.text("#carrier .clock"))
    person.page.reload()
    held(person).sees({"button:text('Start again')": True})
    assert seconds(person.text("#carrier .clock")) >= gone


@thorough
@pytest.mark.parametrize("path", ["", "/dance"])
def test_without_a_network_the_card_goes_on_and_opens_again_in_both_languages_until_it_is_removed(
    open_page, server, tmp_path, path
):
    port = free_port()
    base = f"http://127.0.0.1:{port}{path}"
    with serving(tmp_path / "gone.log", port=port, deadline_seconds=PATIENT, root_path=path):
        person = held(open_page("?benches=20&bench=7&lang=en", base=base, failing=True, **PHONE))
        person.at("#carrier[data-kept=true]").wait_for()
        person.sees({HINT: "stays on this device"})
    person.presses("#card-start")
    before = person.picture()
    person.ask(AHEAD, 5)
    cues = {lang: card(server, lang)["cues"] for lang in ("en", "zh")}
    expected = next(k for k, cue in enumerate(cues["en"]) if cue["since"] > 27)
    person.sees({f"{LIST}.following": cues["en"][expected]["words"]})
    assert (person.picture() != before).any(axis=-1).mean() > 0.01
    gone = seconds(person.text("#carrier .clock"))
    person.page.reload()
    held(person).at("#carrier[data-kept=true]").wait_for()
    person.sees({HINT: "opens again from this device"})
    assert seconds(person.text("#carrier .clock")) >= gone
    person.presses("role=button[name=中文]").reads({"#carrier h1": "第7节龙身"}).sees({HINT: "没有网络"})
    assert cues_of(person) == words_of(cues["zh"])
    person.presses("#card-remove").sees({"#card-remove": False})
    assert person.ask(KEPT) == [0, 0]


def test_the_next_day_in_flight_mode_the_card_opens_in_a_new_tab_and_nothing_else_does(open_page):
    person = held(open_page("?benches=20&bench=7&lang=en", failing=True, **PHONE))
    person.at("#carrier[data-kept=true]").wait_for()
    context = person.page.context
    address = person.page.url
    context.set_offline(True)
    tab = context.new_page()
    tab.clock.install(time=datetime.now() + timedelta(days=1))
    tab.goto(address)
    tab.locator("#carrier[data-kept=true]").wait_for()
    assert tab.locator(f"{LIST} span:last-child").all_inner_texts() == cues_of(person)
    with pytest.raises(Error, match="ERR_INTERNET_DISCONNECTED"):
        tab.goto(address.partition("?")[0])


@thorough
def test_the_view_opens_from_the_page_chooses_benches_and_dragons_closes_where_it_was_and_goes_by_the_clock(
    open_page, server
):
    person = open_page("?benches=20&time=100&handle=4&lang=en").reaches_below().presses("#card-follow")
    assert held(person).address()["bench"] == "4"
    person.types({"#card-bench": "12"}).reads({"#carrier h1": "body 12"}).arrives("**bench=12**")
    person.reads({"#card-more .beside": "Before you: 11. Behind you: 13."}).types({"#card-bench": "300"})
    person.reads({CUE: "This dragon has no bench 300: its tail is bench 19."}).page.go_back()
    held(person.sees({"#carrier": False}).presses("#card-follow")).presses("#carrier [aria-label=Close]")
    person.sees({"#carrier": False}).settles()
    person.reads({"#clock": "100.000000 s"}).sees({"#table-time": "100.000000 s"})
    assert "bench" not in person.address()
    paper_and_phone_tell_of_the_dance_from_its_beginning(person)
    held(person.opens(f"?{TWO}&bench=7&lang=en")).chooses({"#card-dragon": "A"})
    person.reads({"#carrier h1": "A: body 7"}).arrives(lambda url: "dragon=" not in url)
    assert cues_of(held(person)) == words_of(card_of_two(server)["cues"])
    # On paper stand the bench, its picture and all cues without buttons.
    person.page.emulate_media(media="print")
    person.page.pdf()
    person.sees({"button:visible, input:visible": 0, "#canvas": True, "#carrier h1": "A: body 7", LIST: True})
    goes_by_the_time_of_day(open_page, server)


def printed_cues(person):
    """Lines of the cards of bench 7 that the page saves."""
    cards = csv.DictReader(person.saves("#keepCues-CSV").decode().splitlines())
    return [one for one in cards if one["bench"] == "7"]


def paper_and_phone_tell_of_the_dance_from_its_beginning(person):
    """The head is in the square at time 0, and the dragon begins earlier."""
    person.opens(f"?door=all&lang=en&{BEFORE_ZERO}&time=0").reaches_below()
    own = printed_cues(person)
    verdict = json.loads(person.saves("#keepVerdict-JSON"))
    length = verdict["stop"] - verdict["start"]
    longest = f"nobody carries longer than {int(length // 60)}:{int(length % 60):02d}"
    person.presses("#crew summary", "#crew-ask").sees({"#crew-result p": longest})
    for item in ("#keepPlan-A4", "#keepSafety-A4"):
        assert "from -0:13.9 to" in " ".join(paper.sheets_of(person.saves(item)))
    held(person.opens(f"?door=all&lang=en&{BEFORE_ZERO}&bench=7"))
    assert cues_of(person) == [one["words"] for one in own[1:]]
    mark, x, y = (float(own[0][name]) for name in ("mark", "x", "y"))
    person.sees({"#card-more .stand": [f"chalk mark {mark:g} m", f"(x {x:.1f} m, y {y:.1f} m)"]})
    # Where benches touch, the cues of both end, and both say so.
    person.opens(f"?door=all&lang=en&{TOUCHING}").reaches_below()
    own = printed_cues(person)
    verdict = json.loads(person.saves("#keepVerdict-JSON"))
    assert float(own[-1]["time"]) == pytest.approx(verdict["failures"][0]["time"], abs=1e-3)
    first, *_ = paper.pages_of(person.saves("#keepCues-A4"))
    assert "the cues end where benches touch." in paper.words_of(first)
    held(person.opens(f"?door=all&lang=en&{TOUCHING}&bench=7"))
    assert cues_of(person) == [one["words"] for one in own[1:]]
    person.sees({HINT: "Benches touch in this dance: the cues end there."})


def goes_by_the_time_of_day(open_page, server):
    """Its times are the printed ones."""
    begun = datetime.now() - timedelta(seconds=30)
    clock = begun.strftime("%H:%M:%S")
    person = held(open_page(f"?benches=20&bench=7&lang=en&start_clock={clock.replace(':', '%3A')}", rest=False))
    own = card(server, start_clock=clock)["cues"]
    gone = (datetime.now() - begun).total_seconds()
    assert person.text(CUE) in {cue["words"] for cue in own if gone - 10 < cue["since"]}
    person.reads({f"{LIST} span": own[0]["clock"]}).sees({"#carrier .clock": re.compile(r"^\d\d:\d\d:\d\d$")})
    person.presses("button:text('Start again')").sees({f"{LIST}.past": 0}).presses("#card-clock")
    person.sees({f"{LIST}.past": True})
