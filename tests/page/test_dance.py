"""A spiral and a turn on the page: what a person sees, moves and keeps, against the service's own answers."""

import json
import re
import shlex
from decimal import ROUND_CEILING, ROUND_FLOOR, Decimal

import pypdfium2
import pytest
from playwright.sync_api import expect

from core import Dragon, minimum_pitch
from core.design.pitch_bands import BORDER_WIDTH
from tests.support import polite
from tests.support.person import alike

thorough = pytest.mark.thorough
TOUCHING = re.compile(r"touch|meet|contact|overlap|碰|重叠", re.IGNORECASE)
SURE = re.compile("Contact at|Nothing touches|touch at|meet at|时碰撞|无碰撞")
IN_CM = ("stray", "hole", "pin")  # shown to people in centimetres; the service takes metres
HALF_A_CHORD = "half of the shortest distance between two handles"
POLICY = "default-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
INLINE = "document.querySelectorAll('script:not([src]), style, [style*=url], [onclick]').length"
SHADES = "c => new Set(new Uint32Array(c.getContext('2d').getImageData(0, 0, c.width, c.height).data.buffer)).size"
LIMITS = """() => Object.fromEntries([...document.querySelectorAll(".field")].map((one) =>
  [one.dataset.field, [one.querySelector("[id$=-limits]").textContent, one.querySelector(".unit").textContent]]))"""
# A colour of the page by its name.
COLOUR = """name => {
  const probe = document.body.appendChild(document.createElement("i"));
  probe.style.color = `var(--${name})`;
  const { color } = getComputedStyle(probe);
  probe.remove();
  return color;
}"""
ALL_OPEN = "document.querySelectorAll('#answers details').forEach((one) => (one.open = true))"
# The hand does not rest: what the page does after a pause of input waits for rest().
HELD = """() => {
  const { setTimeout } = window;
  window.setTimeout = (act, milliseconds) => {
    if (milliseconds !== 250) return setTimeout(act, milliseconds);
    window.rest = () => {
      window.setTimeout = setTimeout;
      act();
    };
    return -1;
  };
}"""
# Three instants that the clock shows one after another.
THREE = """() => new Promise((resolve) => {
  const seen = new Set();
  const clock = document.querySelector("#clock");
  const look = () => {
    seen.add(clock.textContent);
    if (seen.size < 3) requestAnimationFrame(look);
    else resolve([...seen]);
  };
  look();
})"""


def answer_of(server, call, **query):
    return polite.answer(server, call, **query)


def collision_time(server, **query):
    return answer_of(server, "collision-time", **query)


def time_of(server, **query):
    """Time of the first contact as the page writes it."""
    return f"{collision_time(server, **query)['time']:.6f} s"


def bounded(value, decimals, way=ROUND_CEILING):
    """A bound rounded to one side, by default up."""
    return str(Decimal(value).quantize(Decimal(1).scaleb(-decimals), way))


def ends(bracket, decimals):
    """The bounds of a bracket rounded away from it."""
    return bounded(bracket[0], decimals, ROUND_FLOOR), bounded(bracket[1], decimals)


def clock(person):
    return float(person.text("#clock").removesuffix(" s"))


def watched(person, server):
    """Calls of the service from now on."""
    calls = []
    person.page.on("request", lambda request: calls.append(request.url.removeprefix(f"{server}/")))
    return calls


def test_the_first_view_shows_the_contact_its_proof_its_limits_and_how_every_answer_is_known(open_page, server):
    person = open_page()
    answer = collision_time(server)
    least = answer_of(server, "minimum-pitch")
    person.presses("#first-contact summary", "#minimum-pitch summary").sees(
        {
            "#first-contact[data-outcome=contact] .value": f"{answer['time']:.6f} s",
            "#first-contact": [*answer["sentences"], answer["certificate"]["method"]],
            "#first-contact tbody tr": len(answer["cross_check"]["engines"]),
            "#first-contact caption": "judged all 223 benches. They agree.",
            "#inset figcaption": ["gap 0.000 mm", "front-outer corner of the head meets inner edge of body 8"],
            "#minimum-pitch .value": f"{least['pitch']:.9f} m",
            "#minimum-pitch dl": [
                f"from {bounded(least['proven_from'], 9)} m on, without limit",
                str(least["evaluations"]),
            ],
            ".answer:not([hidden])": 5,
            ".answer:not([hidden]) details": 5,
            "#legend": "m/s",
        }
    )
    assert person.at("#canvas").evaluate(SHADES) > 40
    assert polite.get(server).headers["content-security-policy"] == POLICY
    assert person.ask(INLINE) == 0
    limits = person.ask(LIMITS)
    schemas = polite.answer(server, "openapi.json")["paths"]["/collision-time"]["get"]["parameters"]
    for name, schema in ((one["name"], one["schema"]) for one in schemas if "enum" not in one["schema"]):
        scale, unit = (100, "cm") if name in IN_CM else (1, schema.get("x-unit", ""))
        low = schema.get("minimum", schema.get("exclusiveMinimum"))
        high = HALF_A_CHORD if name == "stray" else f"{scale * schema['maximum']:.15g}"
        assert f"{scale * low:.15g} to {high}" in limits[name][0]
        assert limits[name][1] == unit


def test_the_dance_plays_to_the_contact_and_a_dragged_number_has_the_answers_of_the_service(open_page, server):
    person = open_page("?benches=40&time=400&rate=10").reads({"#clock": "400.000000 s"}).sees({"#inset": False})
    plays_while_a_row_is_chosen(person, server)
    person.presses("#to-end", "#minimum-pitch summary", "#first-contact summary")
    person.sees({"#minimum-pitch caption": "judged all 40 benches. They agree."}).settles()
    drags_the_width(person, server)
    person.types({"#pitch": "0.45"}, "Tab")
    answer = collision_time(server, pitch=0.45, benches=40, width=0.295)
    time = f"{answer['time']:.6f} s"
    person.sees(dict.fromkeys(("#first-contact .value", "#clock", "#table-time"), time))
    person.sees({"#rows tbody tr:not([hidden])": f"{answer['head']['x']:.6f}"}).settles()
    # The chart of the clearance and the dance have one time.
    plot = person.box("#clearance .u-over")
    person.at("#clearance .u-over").click(position={"x": plot["width"] / 2, "y": 20})
    person.settles()
    assert clock(person) == pytest.approx(answer["time"] / 2, rel=0.02)
    person.sees({"#table-time": person.text("#clock")})
    # Reduced motion moves in steps.
    person.page.emulate_media(reduced_motion="reduce")
    person.chooses({"#rate": "1"}).presses("#play")
    times = sorted(float(text.removesuffix(" s")) for text in person.ask(THREE))
    assert times[2] - times[1] >= 0.4


def plays_while_a_row_is_chosen(person, server):
    """Rows stay under the mouse in motion, which ends at the contact."""
    row = person.at("#rows tr[data-handle='5']").element_handle()
    text = row.inner_text()
    person.presses("#play").sees({"#play": "Pause"})
    expect(person.at("#rows tr[data-handle='5']")).not_to_have_text(text, use_inner_text=True)
    row.evaluate("row => row.cells[1].click()")
    time = collision_time(server, benches=40)["time"]
    person.sees({"#rows tr.chosen": "5 · body 5", "#clock": f"{time:.6f} s", "#play": "Play", "#inset": True})
    person.presses("#back").reads({"#clock": f"{time - 1:.6f} s"}).sees({"#inset": False})


def drags_the_width(person, server):
    """The engines judge a pair while a hand drags, and all benches when it rests."""
    calls = watched(person, server)
    person.ask(HELD)
    person.at("#controls input[type=range][aria-label^=Width]").press("ArrowLeft")
    person.sees(dict.fromkeys(("#minimum-pitch caption", "#first-contact caption"), "alone. They agree."))
    person.ask("rest()")
    person.sees(dict.fromkeys(("#minimum-pitch caption", "#first-contact caption"), "judged all 40 benches"))
    contacts, minima = ([url for url in calls if url.startswith(call)] for call in ("collision-time", "minimum-pitch"))
    assert contacts
    assert all("cross_check=pair" in url for url in contacts)
    assert ["cross_check=pair" in url for url in (minima[0], minima[-1])] == [True, False]


FOLD = "?benches=40&pitch=1.2&start_turns=8"
VERDICTS = {
    "?benches=5&pitch=9&start_turns=3&margin=0.1": ("clear", "✓", "clear"),
    "?benches=20&margin=0.05": ("contact", "✕", "contact"),
    "?benches=40&margin=0.2": ("contact_at_start", "✕", "contact"),
    FOLD: ("folds", "!", "undecided"),
}


def test_a_dance_passes_in_green_alone_and_a_fold_is_as_clear_as_a_contact(open_page, server):
    person = open_page()
    for query, (outcome, mark, tone) in VERDICTS.items():
        person.opens(query)
        person.sees({f"#first-contact[data-outcome={outcome}] .value": re.compile(f"^{mark} ?.+")})
        expect(person.at("#first-contact .value")).to_have_css("color", person.ask(COLOUR, tone))
    time = f"{collision_time(server, benches=40, pitch=1.2, start_turns=8)['end']['time']:.6f} s"
    places = "#first-contact", "#table-time", "#table-fold"
    person.sees({**dict.fromkeys(places, time), "#legend": "m/s → ∞", "#inset": False})
    # One event has one time.
    text = " ".join(person.text(place) for place in ("#answers", "#handles", "#dance", "#charts"))
    assert {f"{one} s" for one in re.findall(r"238\.2149\d*", text)} == {time}
    person.speaks("zh").sees({"#first-contact": [f"{time} 时队伍折叠", "舞龙在此失败"]})


@thorough
def test_overlaps_margins_undecided_searches_and_extreme_dragons_are_told(open_page, server):
    person = open_page("?benches=40&pitch=0.3")
    tells_an_overlap(person, server, 0)
    tells_an_overlap(person.opens("?benches=40&pitch=0.3&margin=0.2"), server, 0.2)
    pitch = minimum_pitch(Dragon(60)).pitch_bracket[1] - BORDER_WIDTH
    person.opens(f"?benches=60&pitch={pitch!r}")
    person.sees({"#first-contact[data-outcome=undecided]": ["216.338", "226.78"]})
    # The answer, with its details, is replaced when the words of the proof have loaded.
    person.speaks("zh").page.locator("#first-contact .method", has_text="之前无法判定").wait_for(state="attached")
    # Two thousand benches are drawn and listed, and two cannot touch.
    person.opens("?benches=2000&time=0").sees({"#table-time": "0.000000"}).at("#rows").press("ArrowUp")
    person.at("#rows").evaluate("box => box.scrollTo(0, box.scrollHeight)")
    last = polite.answer(server, "trajectory", {"dragon": {"benches": 2000}, "times": [0]})["x"][0][-1]
    person.sees({"#rows tr[data-handle='2000']": f"{last:.6f}"})
    refused = open_page("?benches=2", failing=True)
    refused.sees({"#clearance .reading": "it takes three of them"})
    speaks_of_a_margin(refused.opens("?path=turn&benches=20&margin=0.35"))


def tells_an_overlap(person, server, margin):
    """In both languages, and at the start."""
    depth = f"{-1000 * collision_time(server, benches=40, pitch=0.3, margin=margin)['gap']:.3f} mm"
    person.presses("#first-contact summary")
    person.sees({"#clock": "0.000000 s"}).misses({"#first-contact": "up to 0"})
    for language, words in (("en", f"overlap by {depth}"), ("zh", f"重叠 {depth}")):
        for place in ("#first-contact", "#inset figcaption", "#clearance .reading"):
            assert not re.search(r"[-−]\d+\.\d+ mm", person.speaks(language).sees({place: words}).text(place))


def speaks_of_a_margin(person):
    """With a margin no answer speaks of a touch; with this one no turn can begin on the circle, as it then says."""
    for language, near in (("en", "ithin 0.35 m"), ("zh", "间距不超过 0.35 m")):
        person.speaks(language).sees(dict.fromkeys(("#first-contact h3", "#inset figcaption", "#scan .hint"), near))
        person.ask(ALL_OPEN)
        # The stray at which benches touch is another question, which knows no margin.
        for place in (".answer:not(#tolerance, [hidden])", "#inset figcaption", "#scan", "#clearance"):
            assert not TOUCHING.search(" ".join(person.texts(place)))


def test_with_a_stray_the_answers_say_what_may_happen_in_both_languages_and_the_ground_is_drawn(open_page, server):
    person = open_page("?benches=40&stray=0.02")
    contact = collision_time(server, benches=40, stray=0.02)
    pitch = f"{answer_of(server, 'minimum-pitch', benches=40, stray=0.02)['pitch']:.9f} m"
    free = answer_of(server, "tolerance", benches=40)
    low, high = ends([100 * Decimal(end) for end in free["stray_bracket"]], 7)
    time = f"{contact['time']:.6f} s"
    gap = f"{1000 * contact['gap']:.3f} mm"
    safe = int(1e4 * free["stray"]) / 100
    person.ask(ALL_OPEN)
    person.sees({"#tolerance dl": f"up to {low} cm; a pose with {high} cm overlaps", "#inset figcaption": gap})
    for language, words in (("zh", f"{time} 起可能相碰"), ("en", f"May touch from {time}")):
        person.speaks(language).sees({"#first-contact": [words, "2 cm", gap], "#minimum-pitch": pitch})
        person.sees({"#tolerance": f"{safe:.2f} cm"})
        assert not SURE.search(person.text("#first-contact"))
    # Strays, margins and play stand in one sentence.
    person.types({"#margin": "0.03", "#hole": "5.5", "#pin": "4.5"}, "Tab")
    time = time_of(server, benches=40, margin=0.03, stray=0.025)
    person.sees({"#first-contact": ["2.5 cm", f"May come within 0.03 m from {time}"]})
    person.opens("?benches=20&time=0&view=8,0,200").sees({"#halo": False})
    before = person.picture()
    person.types({"#stray": "5"}).sees({"#halo": True}).settles()
    assert not alike(person.picture(), before)
    person.presses(".field:has(#stray) .reset").sees({"#halo": False}).settles()
    assert alike(person.picture(), before)


ON_A_TURN = "#shortest-turn", "#quickest-turn", "#turn-time"


def test_the_turn_has_the_answers_of_the_service_which_are_danced_and_none_of_them_stays_on_a_spiral(open_page, server):
    person = open_page("?head_speed=1.5&benches=20").presses("[data-path=turn]").holds({"#pitch": "1.7"})
    begins_a_turn(person, server)
    person.at("#time").press("Home")
    person.reads({"#clock": f"{-100 / 1.5:.6f} s"}).presses("[data-path=spiral]")
    person.sees(
        {"#first-contact .value": time_of(server, head_speed=1.5, benches=20), **dict.fromkeys(ON_A_TURN, False)}
    )
    person.presses("[data-path=turn]").sees(dict.fromkeys(ON_A_TURN, True)).settles()
    dances_what_is_offered(person, server)


def begins_a_turn(person, server):
    times = {"start": -100 / 1.5, "stop": 100 / 1.5}
    body = {"dragon": {"benches": 20}, "path": {"kind": "turn", "pitch": 1.7}, "head_speed": 1.5, **times}
    report = polite.answer(server, "check", body)
    shortest = answer_of(server, "shortest-turn", pitch=1.7, benches=20)
    quickest, time = (answer_of(server, call, benches=20) for call in ("quickest-turn", "turn-time"))
    assert quickest["time"] < time["time"]
    person.sees(
        {
            "#first-contact .value": "Nothing touches",
            "#highest-speed .value": f"{report['highest_speed']['speed']:.6f} m/s",
            "#clock": "0.000000 s",  # where the turn begins
            "#shortest-turn .value": f"{shortest['length']:.6f} m",
            "#quickest-turn .value": f"{quickest['time']:.6f} s",
            "#turn-time .value": f"{time['time']:.6f} s",
            ".field .help:visible": 17,
            ".field .what:empty": 0,
        }
    )
    # The figure of a dance without a contact is of the part that is shown.
    person.reaches_below().chooses({"#curl-of": "keepContact"})
    request = json.loads(shlex.split(person.text("#curl"))[5])
    assert {name: request[name] for name in times} == pytest.approx(times)


def dances_what_is_offered(person, server):
    person.types({"#ratio": "1.5", "#speed_limit": "1.8"}, "Tab")
    fastest = answer_of(server, "maximum-head-speed", benches=20, ratio=1.5, speed_limit=1.8)["head_speed"]
    shortest = answer_of(server, "shortest-turn", benches=20, ratio=1.5, pitch=1.7)
    person.sees({"#head-speed .value": f"{fastest:.9f} m/s", "#shortest-turn .value": f"{shortest['length']:.6f} m"})
    # Boxes that are drawn anew under the mouse take no click; and another entry has another speed.
    person.settles().presses("#head-speed button").settles().presses("#shortest-turn button")
    assert float(person.at("#head_speed").input_value()) == pytest.approx(fastest, abs=1e-6)
    radii = {f"#{name}": f"{shortest[name]}" for name in ("entry_radius", "exit_radius")}
    person.holds(radii).sees({"#first-contact .value": "Nothing touches"}).settles()
    person.presses("#quickest-turn button").settles()
    person.sees({"#quickest-turn .value": person.text("#turn-time .value")}).presses("#minimum-pitch button")
    person.sees({"[data-path=spiral][aria-pressed=true]": True, "#entry_radius": False})
    person.holds({"#pitch": str(answer_of(server, "minimum-pitch", benches=20)["pitch_bracket"][1])})


@thorough
def test_slow_charts_are_asked_for_when_somebody_scrolls_to_them_and_have_a_first_look(open_page, server):
    person = open_page("?benches=20&time=end")
    calls = watched(person, server)
    person.types({"#width": "0.29"}, "Tab").settles()
    names = {url.partition("?")[0] for url in calls}
    assert "tolerance" in names
    assert not {"pitch-scan", "tolerance-curve"} & names
    person.sees({"#curve .uplot, #scan .uplot": 0}).looks_at("curve", "scan")
    asked = [url.partition("?")[0] for url in calls]
    assert (asked.count("pitch-scan"), asked.count("tolerance-curve")) == (2, 1)
    sets_the_pitch_by_a_click(person, server)
    looks_before_the_jumps_are_located(person)


def sets_the_pitch_by_a_click(person, server):
    plot = person.at("#scan .u-over")
    plot.click(position={"x": plot.bounding_box()["width"] / 4, "y": 40})
    pitch = person.at("#pitch").input_value()
    assert float(pitch) < 0.5
    time = time_of(server, pitch=pitch, width=0.29, benches=20)
    person.sees({"#first-contact .value": time}).types({"#pitch": "0.55"}, "Tab").looks_at("curve")
    plot = person.at("#curve .u-over")
    plot.click(position={"x": 0.9 * plot.bounding_box()["width"], "y": 20})
    pitch = person.at("#pitch").input_value()
    assert 0.8 < float(pitch) < 0.9
    free = answer_of(server, "tolerance", benches=20, pitch=pitch, width=0.29)["stray"]
    person.sees({"#curve .reading": [pitch, f"{int(1e4 * free) / 100:.2f} cm"]})


def looks_before_the_jumps_are_located(person):
    """The first look at the chart of the pitch never replaces its jumps."""
    person.opens("?benches=12").page.route(lambda url: "/pitch-scan" in url and "locate" not in url, lambda route: None)
    person.at("#scan .plot").scroll_into_view_if_needed()
    # It is busy, but the view is of these numbers.
    person.sees({"#scan.coarse .uplot": True, "#scan .reading": "first view; the jumps are still being located"})
    person.sees({"#scan[aria-busy=true] > .old": False})
    person.page.unroute_all()
    late = person.holds_back(lambda url: "locate=false" in url)
    person.types({"#width": "0.29"}, "Tab")
    person.at("html[data-pending=look]").wait_for()  # All the rest is answered.
    late.let_go()
    person.settles().sees({"#scan:not(.coarse) .uplot": True})


def test_what_is_chosen_and_changed_is_shared_and_opens_as_the_same_state(open_page):
    person = open_page("?benches=12&time=0&view=8.8,0,40").sees({"#table-time": "0.000000"})
    # Rows that move or are drawn anew under the mouse take no click: the charts above them are drawn first.
    person.reaches("#handles")
    box = person.box("#canvas")
    person.at("#canvas").click(position={"x": box["width"] / 2, "y": box["height"] / 2})
    person.sees({"#rows tr.chosen": "0 · head"}).presses("#rows tr[data-handle='5']")
    person.sees({"#rows tr.chosen": "5 · body 5"}).types({"#pitch": "0.5", "#width": "0.25"}, "Tab").presses("#share")
    person.arrives(re.compile("width=0.25"))
    person.strikes("Escape").speaks("zh").reaches_below()
    other = open_page(f"?{person.page.url.partition('?')[2]}").reaches_below()
    for place in ("#first-contact", "#clock", "#table-time", "tr.chosen", "#minimum-pitch", "#curl"):
        assert other.text(place) == person.text(place)
    assert other.address() == person.address()
    assert alike(other.picture(), person.picture())
    other.presses("#reset-all").settles()
    assert {"pitch", "width"} & other.address().keys() == set()
    other.page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    other.presses("#share", "#copy-address").sees({"#status": "已复制"})
    assert other.ask("navigator.clipboard.readText()") == other.page.url


@thorough
def test_everything_can_be_kept_and_printed_and_every_command_gives_what_the_page_shows(open_page, server):
    person = open_page("?benches=9&pitch=0.5&start_turns=10")
    prints_in_dark_ink(person)
    person.reaches()
    answer = collision_time(server, benches=9, pitch=0.5, start_turns=10)
    files = {"Trajectory-XLSX": b"PK", "Picture-PNG": b"\x89PNG", "Instant-PNG": b"\x89PNG", "Contact-SVG": b"<?xml"}
    files |= {"Ground-GeoJSON": b"{"}
    assert [name for name, begin in files.items() if not person.saves(f"#keep{name}").startswith(begin)] == []
    assert person.saves("#keepTrajectory-CSV").count(b"\n") == 1 + 10 * (int(answer["time"]) + 1)
    assert json.loads(person.saves("#keepAnswer-JSON")) | {"words": None} == answer
    commands = {one.get_attribute("value"): "" for one in person.all("#curl-of option").all()}
    for name in commands:
        commands[name] = person.chooses({"#curl-of": name}).text("#curl")
    gives_what_is_shown(list(commands.values()), server, answer)
    person.presses("#paper summary").sees({"#paper table": "412.473837682 s"}).speaks("zh")
    person.sees({"#paper table": "首次碰撞时刻"})
    # Figures have the language of the page.
    assert "language=en" in commands["keepContact"]
    person.chooses({"#curl-of": "keepContact"}).sees({"#curl": "language=zh"})


def prints_in_dark_ink(person):
    """Also a dark page. Charts that nobody has looked at are missing in the first print, and are there in the next."""
    person.page.emulate_media(media="print", color_scheme="dark")
    person.sees({"#curve": False, "#scan": False}).page.pdf()
    person.sees({"#curve .uplot": True, "#scan:not(.coarse) .uplot": True})
    hidden = ("header nav", "#tabs", "#transport", "#views", "#sweeps", "#grade", "#controls input[type=range]")
    person.sees(dict.fromkeys(hidden, False))
    person.sees(dict.fromkeys(("#canvas", "#pitch", "#first-contact .value", "#scan .plot"), True))
    assert {person.style(place, "backgroundColor") for place in ("#canvas", "body")} == {"rgb(255, 255, 255)"}
    leaves = pypdfium2.PdfDocument(person.page.pdf(format="A4"))
    assert [leaf.render().to_numpy().min() < 100 for leaf in leaves] == [True] * len(leaves)
    person.page.emulate_media(media="null", color_scheme="light")


def gives_what_is_shown(commands, server, answer):
    assert len(set(commands)) == len(commands)
    assert commands[-1].startswith("bench-dragon prove collision-time --benches 9 ")
    assert all(command.startswith(f"curl '{server}/") for command in commands[:-1])
    get, post = (shlex.split(line) for line in commands[0].splitlines())
    assert polite.get(get[1]).json() == answer
    table = polite.post(post[1], content=post[-1], headers=dict([post[3].split(": ")])).raise_for_status().json()
    assert len(table["x"][0]) == 10
    (film,) = (shlex.split(command) for command in commands if '"films"' in command)  # too long for one answer
    request = json.loads(film[-1])
    assert (film[1], request["accept"], request["question"]) == (f"{server}/jobs", "video/mp4", "films")
