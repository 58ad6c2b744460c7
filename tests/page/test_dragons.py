"""Several dragons on the page: their list, their common verdict, picture and clock, and their address."""

import json
from pathlib import Path
from urllib.parse import urlencode

import pytest

from tests.support import paper, polite
from tests.support.person import PHONE

thorough = pytest.mark.thorough
ENCOUNTERS = Path(__file__).parent.parent / "reference" / "encounters.json"
ADDRESS_MOST = 500  # characters, so that chat programs keep it whole
COLOURS = ("#b3261e", "#0b5cad", "#1a6f33")
ALERT = "#dragons [role=alert]"
SMALL = """() => [...document.querySelectorAll("#dragons :is(button, input)")]
  .filter((one) => one.checkVisibility() && one.getBoundingClientRect().height < 44).map((one) => one.outerHTML)"""
# Answers the first question about several dragons though the next one is asked meanwhile.
OVERTAKEN = """() => {
  const { fetch } = window;
  window.fetch = (url, options) => {
    if (url !== "check" || !JSON.parse(options.body).dances) return fetch(url, options);
    window.fetch = fetch;
    document.querySelector("[data-dragons=spiral]").click();
    return fetch(url, { ...options, signal: undefined });
  };
}"""


BARE = "?door=all&lang=en&time=0&benches=9"


def begun(person, preset):
    """A performance to begin with, of somebody who has one dragon."""
    return person.presses("#several").settles().presses(f"[data-dragons={preset}]").settles()


def file_of(person):
    return json.loads(person.saves("#dragons-save"))


OWN = {"things": "a.yard..-150,-90_150,-90_150,90_-150,90~c.well.1.0,80", "route": "0,0_60,5", "limit": "1.5"}


def test_a_second_dragon_comes_in_behind_the_first_or_the_page_says_what_can_be_done(open_page):
    person = open_page("?door=village&lang=en&path=route&route=*-40,0_40,0&begin=16&benches=9").presses("#several")
    person.sees({"#judgement": "Can be danced", "#dragons-apart": False}).settles()
    # A tap on its head chooses the other one.
    path = file_of(person)["dances"][1]["path"]
    person.opens(f"?{urlencode(person.address() | {'view': '0,0,10', 'time': '0'})}").sees({"#dragons li": 2})
    person.page.mouse.click(*person.settles().spot("#canvas", 10 * (path["points"][0][0] + path["start"])))
    person.has("#dragon-choose-1", aria_pressed="true").presses("#undo").has("#dragon-choose-0", aria_pressed="true")
    # A copy of the first one stands behind both.
    person.presses("#dragon-copy-0").sees({"#dragons li": 3, "#judgement": "Can be danced"}).settles()
    assert len({one["path"]["points"][0][0] for one in file_of(person)["dances"]}) == 3
    # Who comes back along the street of entry is let out first.
    person.opens("?door=all&lang=en&path=route&route=*0,0_30,0_38,8_30,16_*15,-20_15,-60&begin=8&benches=3")
    person.presses("#several").sees({"#judgement": "Can be danced", "#dragons li": 2}).settles()
    square = "a.square..-12,-10_12,-10_12,10_-12,10"
    person.opens(f"?door=village&lang=en&path=route&route=*-11,0_11,0&begin=8&benches=3&things={square}")
    person.presses("#several").sees({"#dragons-apart": "No delay of blue"}).speaks("zh")
    person.sees({"#dragons-apart": "另画路线"})


def test_the_first_of_two_dragons_takes_a_proposed_dance_and_stays_in_front(open_page):
    square = "a.square..-12,-10_12,-10_12,10_-12,10~g.in.,in.-12,1~g.out.,out.12,-2"
    person = open_page(f"?door=village&lang=en&path=route&benches=8&things={square}")
    person.presses("#propose").sees({"#cards button": True}).presses("#cards button").settles()
    person.presses("#several").sees({"#judgement": "Can be danced", "#dragons li": 2}).settles()
    person.presses("#propose").sees({"#cards button": True}).presses("#cards button")
    person.sees({"#status": "blue need not wait", "#judgement": "Can be danced"}).settles()
    red, blue = (one["path"]["pieces"][0]["start"][0] for one in file_of(person)["dances"])
    assert blue < red - 14


def test_dragons_to_begin_with_leave_what_a_person_has_drawn_and_who_waits_is_let_pass(open_page, server):
    person = open_page(f"?door=all&path=route&benches=3&{urlencode(OWN)}").presses("#several").settles()
    for preset in ("parade", "streets"):
        now = person.presses(f"[data-dragons={preset}]").settles().address()
        assert (now["things"], now["limit"]) == (OWN["things"], OWN["limit"])
        goes_back_to_what_is_drawn(person)
    takes_back_what_it_began_with(person)
    # One undo of the list of several, whatever the browser's buttons took back before.
    person.presses("#undo").sees({"#dragons li": 0, "#undo": True}).settles()
    assert {name: person.address().get(name) for name in OWN} == OWN
    # A square too small for an example stays, and the verdict says so.
    small = {"things": "a.yard..-20,-15_20,-15_20,15_-20,15", "route": "*-19,0_19,0"}
    person.opens(f"?door=all&lang=en&path=route&benches=3&begin=8&{urlencode(small)}").presses("#several").settles()
    now = person.presses("[data-dragons=streets]").settles().address()
    assert now["things"] == small["things"]
    person.sees({"#judgement": "starts outside yard"}).presses("#undo").settles()
    person.opens("?door=village&lang=zh").settles().opens(f"?{urlencode(person.address() | {'door': 'all'})}")
    person.presses("#several").settles().presses("[data-dragons=parade]").sees(
        {"#status": "已取代原有的路线和广场；撤销"}
    )
    begun(person.opens(BARE), "streets").sees({"#judgement": "Cannot be danced"})
    report = polite.answer(server, "check", file_of(person) | {"details": False})
    assert (report["verdict"], len(report["failures"])) == ("fails", person.counts(".failures li"))
    person.types({"#dragon-delay-1": "30"}).sees({"#judgement": "Can be danced"})
    assert file_of(person)["dances"][1]["delay"] == 30
    person.types({"#dragon-delay-1": "soon"}).reads({ALERT: "“soon” is no number."}).page.go_back()
    person.sees({"#judgement": "Cannot be danced"}).holds({"#dragon-delay-1": "4"})
    # Another theme changes the picture at once.
    person.page.emulate_media(color_scheme="dark")
    person.settles().holds({"#dragon-colour-0": "#ff8b7c"})
    assert [person.coloured(one) > 0 for one in ("#ff8b7c", COLOURS[0])] == [True, False]
    person.presses("#dragon-wait-1").sees({"#status": "blue waits ", "#judgement": "Can be danced"})


def takes_back_what_it_began_with(person):
    """Undo and redo are wholes, also of a dance without a drawing, which no tool of drawing stands beside."""
    before = person.address()
    now = person.presses("[data-dragons=spiral]").settles().sees({"#edit": False}).address()
    assert (now["benches"], now["pitch"], "route" in now) == ("60", "1.1", False)
    assert person.presses("#undo").settles().address() == before
    assert person.strikes("ControlOrMeta+y").settles().address() == now
    assert person.strikes("ControlOrMeta+z").settles().address() == before


def goes_back_to_what_is_drawn(person):
    person.page.go_back()
    assert {name: person.settles().address().get(name) for name in OWN} == OWN


def test_two_in_one_spiral_meet_when_the_reference_says_also_after_a_late_answer_about_others(open_page):
    cases = json.loads(ENCOUNTERS.read_text("utf-8"))["cases"]
    time = next(f"{one['time']:.6f} s" for one in cases if one["name"] == "two dragons in one spiral, opposite")
    person = open_page("?door=all&lang=en&time=0")
    person.ask(OVERTAKEN)
    person.presses("#several").sees({"#dragons li": 2}).settles()
    failure = "Body 3 of red and the head of blue touch."
    person.sees({".failures li": failure})
    person.has("#contact-mark", aria_label=f"Two dragons meet at {time}").presses("#to-end").settles()
    person.reads({"#clock": time, "#inset figcaption": failure})
    assert all(person.coloured(colour) > 200 for colour in COLOURS[:2])
    assert len(person.page.url) < ADDRESS_MOST
    # The same address, opened by somebody else.
    other = open_page(f"?{person.page.url.partition('?')[2]}")
    assert other.text("#judgement") == person.text("#judgement")
    other.speaks("zh").sees({"#judgement": "红龙的第3节龙身与蓝龙的龙头相碰。"})


@thorough
def test_a_parade_is_judged_played_filmed_printed_and_listed_on_a_phone_with_all_dragons(open_page, server):
    person = begun(open_page("?door=village&lang=en&time=0&begin_clock=19%3A30"), "parade").reaches_below()
    file = file_of(person.sees({"#judgement": ["Can be danced", "No two dragons touch."], "#contact-mark": False}))
    report = polite.answer(server, "check", file | {"details": False})
    assert report["verdict"] == "passes"
    assert len(file["dances"]) == person.counts("#dragons li") == 3
    person.presses("#play").page.wait_for_function("() => Number(document.querySelector('#time').value) > 30")
    assert all(person.presses("#play").coloured(colour) > 20 for colour in COLOURS)
    person.sees({"#cues": "A cue card for each bench", ":is(#crew, #paper):visible": 0})
    assert person.saves("#keepPlan-A3").startswith(b"%PDF")
    (sheet,) = paper.sheets_of(person.saves("#keepSafety-A4"))
    assert [words for words in ("Safety sheet: 3 dragons", "It can be danced", " of red") if words not in sheet] == []
    for content in (person.saves("#keepCues-CSV"), person.saves("#keepMap-GeoJSON")):
        assert [name for name in (b"red", b"blue", b"green") if name not in content] == []
    person.page.route("**/films", lambda route: None)
    with person.page.expect_request("**/films") as sent:
        person.presses("#keepFilm-GIF")
    assert len(sent.value.post_data_json["dances"]) == 3
    person.page.emulate_media(media="print")
    person.page.pdf()
    person.sees({"#printed": ["The dance ends at ", "dances="], "#canvas": True, "#judgement .value": True})
    person = begun(open_page(BARE, **PHONE), "parade")
    for language in ("en", "zh"):
        assert not person.speaks(language).overflows(390)
        assert person.findings("#dragons") == person.ask(SMALL) == []


@thorough
def test_dragons_are_walked_by_keys_chosen_changed_copied_named_coloured_and_removed(open_page):
    person = begun(open_page("?door=look&lang=en&time=0&benches=9"), "spiral").focuses("#dragon-choose-0")
    walks_by_keys(person)
    person.presses("#judgement summary").sees(
        {"#judgement details p": "Proven in steps of time for all benches at once"}
    )
    begun(person.opens(BARE), "spiral").presses("#dragon-choose-1").has("#dragon-choose-1", aria_pressed="true")
    person.types({"#benches": "30"}).settles().presses("#dragon-choose-0").holds({"#benches": "60"}).settles()
    person.presses("#dragon-copy-1").sees({"#dragons li": 3}).types({"#dragon-name-2": "blue"})
    person.reads({ALERT: "Another dragon is called “blue”."}).types({"#dragon-name-2": "West!~1"})
    person.at("#dragon-colour-2").fill("#008080")
    third = file_of(person.settles())["dances"][2]
    assert (third["name"], third["dragon"]["benches"], third["delay"]) == ("West!~1", 30, 30)
    person.presses("#dragon-remove-0").sees({"#dragons li": 2}).holds({"#benches": "30"}).reaches_below()
    person.presses("#dragons-close").sees({"#dragons li": 0, "#first-contact .value": True, "#crew": True}).settles()
    assert "dances" not in person.address()


def walks_by_keys(person):
    def after(*keys):
        return str(person.strikes(*keys).ask("document.activeElement.id"))

    assert [after("Tab") for _ in range(3)] == ["dragon-choose-1", "dragon-add", "dragons-save"]
    person.focuses("#dragon-choose-0")
    assert [after("ArrowRight") for _ in range(2)] == ["dragon-colour-0", "dragon-name-0"]
    # Within a text they move in the text.
    person.page.keyboard.type("east")
    assert after("ArrowLeft") == "dragon-name-0"
    assert person.settles().findings() == []


@thorough
def test_a_refusal_names_the_dragon_and_an_address_opens_what_can_be_read(open_page):
    few = "?benches=9&pitch=1.1&start_turns=6&lang=en&dances="
    person = open_page(f"{few}~rotation:180&bench=3").sees({"#carrier h1": "red: body 3"})
    person.presses("#carrier [aria-label=Close]").sees({"#carrier": False, "#dragons li": 2}).reaches_below()
    person.presses("#card-follow").sees({"#carrier h1": "red: head"}).settles()
    person = open_page(f"{few}~pitch:55!benches:9", failing=True)
    a_delay_that_is_not_found_says_why(person)
    person.opens(f"{few}~pitch:55!benches:9")
    person.sees({"#judgement": "blue: “Pitch” must be at most 10 m, got 55 m"})
    names = [f"{k:03}{'x' * 35}" for k in range(170)]
    person.opens(f"?lang=en&time=0&dances={'~'.join(f'name:{name}' for name in names)}")
    person.presses("#dragon-copy-169").sees({"#dragons li": 171}).settles()  # more benches than the service takes
    assert len(person.page.url) < ADDRESS_MOST
    person.page.reload()
    person.sees({"#dragons li": 171}).holds({"#dragon-name-169": names[169]})


def a_delay_that_is_not_found_says_why(person):
    def too_long(route):
        route.continue_(post_data=json.dumps({**route.request.post_data_json, "most": 1e9}))

    person.opens("?door=all&lang=en&path=route&route=*-40,0_40,0&begin=16&benches=3")
    person.page.route("**/safe-delay", too_long)
    why = "How long blue has to wait was not found: The longest wait must be at most 1000000 s"
    person.presses("#several").sees({"#dragons-apart": [why, "type one"]}).speaks("zh").sees(
        {"#dragons-apart": ["最长等待时间最多为 1000000 s", "请自行填写延迟"]}
    )
    person.page.unroute_all()
    # Where the search takes too long, whoever waits until the others have ended is safe.
    refusal = {"type": "urn:problem-type:bench-dragon:too-much-work", "status": 422, "detail": "too long", "errors": []}

    def long_search(route):
        body = route.request.post_data_json
        if body["most"] - body["least"] > 1.0:
            route.fulfill(status=422, content_type="application/problem+json", body=json.dumps(refusal))
        else:
            route.continue_()

    person.page.route("**/safe-delay", long_search)
    person.speaks("en").presses("#dragon-wait-1").sees({"#status": "then the others have ended"})
    person.sees({"#judgement": "Can be danced"})
    person.page.unroute_all()
    assert float(person.settles().at("#dragon-delay-1").input_value()) > 20.0
    person.presses("#undo").settles()
    # Another drawing is another dance.
    path = {"type": "LineString", "coordinates": [[-40, 0], [60, 0]]}
    line = {"type": "Feature", "properties": {"name": "path"}, "geometry": path}
    file = {"name": "path.geojson", "mimeType": "application/geo+json", "buffer": json.dumps(line).encode()}
    person.takes(file).presses("#instead").sees({"#status": "path.geojson", "#dragons-apart": False})
    person.types({"#dragon-delay-1": "40"}).sees({"#dragons-apart": False})


@thorough
def test_a_saved_file_opens_again_and_what_the_page_leaves_out_is_named(open_page, tmp_path):
    file = tmp_path / "two.json"

    def opened(content, words="Opened two.json", language="en"):
        file.write_text(json.dumps(content))
        person.opens(f"?door=all&path=route&lang={language}").takes(file)
        return person.sees({"#status": words}).settles()

    person = begun(open_page(BARE), "parade")
    content = file_of(person.types({"#margin": "0.02"}).settles())
    assert file_of(opened(content).sees({"#dragons li": 3})) == content
    content["dances"][1]["path"] = {"kind": "spiral", "pitch": 1.1, "start_turns": 8, "clockwise": False}
    opened(content, "the page shows spirals around x = y = 0")
    dance = {"dragon": {"benches": 3}, "path": {"kind": "waypoints", "points": [[0, 0], [60, 0]]}}
    for part, left in ((dance, "：stop"), ({"dances": [dance, {**dance, "delay": 60}]}, "：start、stop")):
        opened({**part, "start": 20, "stop": 40}, left, "zh")
