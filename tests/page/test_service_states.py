"""The page and the states of the service: refusals, slow answers, loss, parts, weight."""

from urllib.parse import urlencode, urlsplit

import pytest

from tests.support import polite
from tests.support.person import alike
from tests.support.serving import PATIENT, free_port, serving

thorough = pytest.mark.thorough
OWN_MAX, ALL_MAX, FILES_MAX = 125_000, 1_600_000, 60  # [bytes] over the wire, and requests until all is shown
SHORT = "?benches=20&time=end"
CONTACT = "#first-contact .value"
OLD = (CONTACT, "#run-end .value", "#canvas", "#clearance .plot", "#rows")
TITLES = ("#first-contact h3", "#run-end h3", "#clearance h2")
# Parts with a file of each that tells that it has loaded.
LATER = {"below.js", "below.css", "grade.js", "map.js", "drawn.js", "place.css", "propose.js"}
LATER |= {"sharing.js"}

# Address and bytes of all that was loaded.
WEIGHTS = """() => performance.getEntries().filter((one) => "transferSize" in one)
  .map((one) => [one.name, one.transferSize])"""
# Keeps the messages of the page, which leave by themselves.
TOLD = """() => {
  window.told = [];
  const box = document.querySelector("#status");
  new MutationObserver(() => told.push(box.textContent)).observe(box, { childList: true });
}"""


def contact(server, **query):
    return f"{polite.answer(server, 'collision-time', **query)['time']:.6f}"


def test_a_lost_service_is_reported_and_what_a_person_does_meanwhile_is_done_when_it_is_back(
    open_page, server, tmp_path
):
    """The last service ends every longer computation at once, so that a file of it becomes a job."""
    numbers = {"benches": 20, "stray": 0.02}
    port = free_port()
    with serving(tmp_path / "first.log", port=port, deadline_seconds=PATIENT):
        person = open_page(f"?{urlencode(numbers)}", base=f"http://127.0.0.1:{port}", failing=True)
        answer = person.text(CONTACT)
        before = person.picture()
    # An idle page notices it too.
    person.sees({"#lost:visible": ["does not answer", "next try in "]})
    person.types({"#pitch": "0.5"}, "Tab")
    assert person.text(CONTACT) == answer
    assert alike(person.picture(), before)
    person.presses("[data-lang=zh]").sees({"#lost:visible": "does not answer"}).ask(TOLD)
    person.types({"#typed-pitch": "0.450338"})
    with serving(tmp_path / "second.log", port=port, deadline_seconds=PATIENT):
        person.sees(
            {"#lost": False, CONTACT: contact(server, **numbers, pitch=0.5), "#grades .value": "✓正确", "h1": "板凳龙"}
        )
        person.page.wait_for_function("() => told.some((words) => /The service is back|服务已恢复/.test(words))")
        person.speaks("en").reaches_below()
    person.sees({"#lost": "does not answer"})
    with serving(tmp_path / "hurried.log", port=port, deadline_seconds=1e-9) as hurried:
        person.sees({"#lost": False}).presses("#keepGround-JSON").has("#jobs li", data_state="successful")
        assert polite.answer(hurried.url, person.at("#jobs a[download]").get_attribute("href"))["area"] > 0.0


def right_again(person, name):
    """Reset the number that was wrong before the present one: no dance is computed between two refusals."""
    if name:
        person.at(f".field:has(#{name}) .reset").press("Enter")
        person.sees({f"#{name}-error": False})


def test_a_wrong_value_is_reported_once_in_a_sentence_beside_its_control(open_page):
    person = open_page(SHORT, failing=True)
    before = None
    for name, text, words in (
        ("pitch", "55", "“Pitch” must be at most 10 m, got 55 m"),
        ("turning_diameter", "wide", 'got "wide".'),
    ):
        person.at(f"#{name}").fill(text)
        right_again(person, before)
        label = person.text(f"label[for={name}]")
        box = "minimum-pitch" if "diameter" in name else "first-contact"
        person.sees({f"#{name}-error": words, f"#{box}": f"An answer appears as soon as “{label}” is right."})
        person.has(f"#{name}", aria_invalid="true")
        assert person.text("body").count(words) == 1
        before = name
    # The label and the unit of a refusal have the language of the page.
    person.presses("#reset-all").sees({"#controls .error:visible": 0}).speaks("zh").types({"#pin": "10"}, "Tab")
    person.sees({"#pin-error": "（0 cm），现为 10 cm。", "#first-contact": "改正“插销直径”后即有结果。"})
    # A refusal about a turn goes with the turn.
    person.opens(f"{SHORT}&path=turn&speed_limit=0&lang=en").sees({"#controls .error:visible": True})
    person.presses("[data-path=spiral]").sees({"#controls .error:visible": 0})


@thorough
def test_old_answers_turn_pale_until_new_ones_come(open_page, server):
    person = open_page(SHORT, failing=True)
    assert {person.style(place, "opacity") for place in OLD} == {"1"}
    person.page.route("**/collision-time*", lambda route: None)
    person.types({"#pitch": "0.5"}, "Tab").sees({"#first-contact[aria-busy=true]": True})
    for place in OLD:
        pale = "place => Math.abs(getComputedStyle(document.querySelector(place)).opacity - 0.5) < 0.2"
        person.page.wait_for_function(pale, arg=place)
    assert {person.style(place, "opacity") for place in TITLES} == {"1"}
    person.page.unroute_all()
    problem = '{"title": "Internal Server Error", "status": 500, "detail": "The service failed here.", "errors": []}'
    person.page.route("**/collision-time*", lambda route: route.fulfill(status=500, body=problem))
    person.types({"#pitch": "0.51"}, "Tab").sees({"#first-contact": "The service failed here."})
    person.page.unroute_all()
    person.types({"#pitch": "0.52"}, "Tab").sees({CONTACT: contact(server, benches=20, pitch=0.52)}).settles()
    assert {person.style(place, "opacity") for place in OLD} == {"1"}


@thorough
def test_what_a_service_refuses_to_play_stops(open_page, tmp_path):
    with serving(tmp_path / "small.log", cells_max=1_500) as small:
        person = open_page("?benches=100&time=10", base=small.url, failing=True).presses("#play")
        words = ["The dance cannot be played: step through it, or move the time."]
        person.sees({"#status": [*words, "must be at most 1500 here"]}).reads({"#play": "▶ Play"})


@pytest.mark.parametrize("locale", ["en-GB", "zh-CN"])
def test_the_page_is_light_and_its_parts_load_when_a_person_first_needs_them(open_page, locale):
    """Bytes as a browser with an empty cache counts them."""
    person = open_page("?benches=5&time=end", failing=True, locale=locale).sees({CONTACT: True})
    weights = person.ask(WEIGHTS)
    own = [size for url, size in weights if ("/page-" in url and "uPlot" not in url) or "/?benches=" in url]
    assert 1 < len(weights) < FILES_MAX
    assert 0 < sum(own) < OWN_MAX
    assert sum(size for _, size in weights) < ALL_MAX

    def later():
        return LATER & {urlsplit(url).path.rpartition("/")[2] for url, _ in person.ask(WEIGHTS)}

    assert later() == set()
    person.presses("#share").sees({"#qr": True}).strikes("Escape")
    assert later() == {"sharing.js"}
    person.reaches_below()
    assert later() == {"sharing.js", "below.js", "below.css", "grade.js", "map.js"}
    person.types({"#pitch": "55"}, "Tab").sees({"#pitch-error": "10 m"})
    person.presses("#reset-all", "[data-path=route]").sees({"#judgement .value": True})
    assert later() == LATER
    person.speaks("zh")
    assert later() == LATER
