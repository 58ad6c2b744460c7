"""The page "How it works": its figures show the service's own numbers while they are dragged, in both languages."""

import contextlib
import io
import re

import pytest
from playwright.sync_api import expect

from core import Turn
from tests.support import polite
from tests.support.person import PHONE

thorough = pytest.mark.thorough
SECTIONS = {"chord", "staircase", "step", "graze", "proof", "stray", "turn", "speed"}
# A drag by this many pixels moves a number by a quarter of its range.
QUARTER = 70


def answer_of(server, call, **request):
    return polite.answer(server, call, request)


def dial(person, section, name):
    return person.page.locator(f"#{section}").get_by_role("slider", name=name)


def drawn(person):
    """The page, once all its figures are drawn to the end."""
    expect(person.settles().at("#staircase .jump")).to_be_attached()
    return person


def test_dragged_numbers_get_the_answers_of_the_service_also_after_it_was_lost(open_page, server):
    person = drawn(open_page("how?lang=en", failing=True))
    length = dial(person, "chord", "Chord of the head bench")
    length.scroll_into_view_if_needed()
    box = length.bounding_box()
    person.drags_from(box["x"] + 5, box["y"] + 5, -QUARTER, 0)
    expect(length).to_have_text("2.01 m")
    spiral = {"kind": "spiral", "pitch": 0.55, "start_turns": 5}
    pose = answer_of(server, "trajectory", dragon={"benches": 11, "head_length": 2.56}, path=spiral, times=[0])
    place = f"({pose['x'][0][1]:.3f} m, {pose['y'][0][1]:.3f} m)"
    person.sees({"#chord .verdict": place})
    person.at("#chord .knob").scroll_into_view_if_needed()
    person.drags("#chord .knob", -48, 0)
    person.misses({"#chord .verdict": place}).settles()
    # Keys move the numbers too.
    dial(person, "staircase", "Pitch of the spiral").press("ArrowUp")
    contact = answer_of(server, "collision-time", path={"kind": "spiral", "pitch": 0.4504})
    person.sees({"#staircase .lead": [f"{contact['head']['radius']:.4f} m", f"body {contact['benches'][1]}."]})
    dial(person, "step", "Length of the interval").press("PageUp")
    proof = answer_of(server, "collision-time", dragon={"benches": 40}, start=409.7, stop=409.86, cross_check="none")
    steps = proof["certificate"]["steps"]
    assert steps > 1
    person.sees({"#step .verdict": f"The service takes {steps} shorter steps"})
    # The lowest curve spans the interval.
    span = person.box("#step .span")
    arch = person.box("#step .arch")
    assert [arch["x"], arch["width"]] == pytest.approx([span["x"], span["width"]], abs=12.0)
    person.sees({"#graze .lead": "Every look finds all benches apart", "#stray .exhibit": 0})
    person.presses("#graze .try").sees({"#graze .lead": "In 1 of them benches overlap"})
    free = int(1e4 * polite.answer(server, "tolerance", pitch=0.55)["stray"]) / 100
    for _ in range(2):
        dial(person, "stray", "How far every handle may stray").press("PageUp")
    first = answer_of(server, "collision-time", stray=0.05, cross_check="none")["time"]
    person.sees({"#stray .more": f"may stray by {free} cm", "#stray .exhibit": 2})
    person.sees({"#stray .verdict": f"From {first:.6f} s on benches may touch"})
    # Figure and sentence of a refusal agree: there is no second handle.
    dial(person, "chord", "Place of the head").press("Home")
    person.sees({"#chord .verdict": "there is no second handle", "#chord .label": 1, "#chord .bench": 0})
    # All stands in one column on a wide screen; and a lost service is reported.
    person.page.set_viewport_size({"width": 1920, "height": 1080})
    parts = person.all(".article > :is(h1, p, section)")
    lefts = parts.evaluate_all("all => all.map((one) => one.getBoundingClientRect().left)")
    assert len(lefts) > len(SECTIONS)
    assert len(set(lefts)) == 1
    person.page.route("**/*", lambda route: route.abort())
    length.press("ArrowUp")
    person.sees({"#lost:visible": "does not answer", "#chord .note": "the figure is older than your numbers"})
    person.reads({"#step .note": ""})
    person.page.unroute("**/*")
    # The page tries again by itself too; where that came first, a click of the mouse would wait for the button.
    person.at("#lost button").evaluate("button => button.click()")
    person.reads({"#chord .note": ""}).sees({"#lost": False})
    # A number that waits for the service that is back is not said to be older, in any language.
    held = person.holds_back("**/trajectory*")
    with person.page.expect_request("**/trajectory*"):
        length.press("ArrowUp")
    person.presses("[data-lang=zh]").sees({"#chord figure[aria-busy=true]:not(.stale)": True})
    person.reads({"#chord .note": ""})
    held.let_go()
    person.settles()


def test_the_turn_keeps_its_length_at_every_ratio_and_jams_when_the_entry_is_too_deep(open_page):
    person = drawn(open_page("how?lang=en", failing=True)).sees({"#turn .lead": "13.621245 m"})
    ratio = dial(person, "turn", "Radius of the first arc")
    entry = dial(person, "turn", "Distance of the entry")
    ratio.press("PageDown")
    person.sees({"#turn .lead .dial": "1.90", "#turn .verdict": "go through: the tighter bend has a radius of 1.555 m"})
    person.sees({"#turn .lead": "13.621245 m"})
    for _ in range(2):
        entry.press("PageDown")
    length = Turn(1.7, ratio=1.9, entry_radius=4.3, exit_radius=4.5).length
    person.sees({"#turn .lead": f"{length:.6f} m", "#turn .verdict": "go through"})
    # The two turns of question 4, to the digits of its card; a shared address keeps them.
    person.presses(*(f"#turn .try >> nth={k}" for k in range(3)))
    person.sees({"#turn .lead": ["2.00", "4.29 m", "11.799152 m"], "#turn .verdict": "go through"})
    person.presses(*(f"#turn .try >> nth={k}" for k in range(3, 6))).arrives("**turn_exit=3.93378849**")
    person.sees({"#turn .lead": "8.223984 m", "#turn .verdict": "go through", "#turn .bench": True})
    person.page.reload()
    drawn(person).sees({"#turn .lead": "8.223984 m"})
    # The knob of the exit moves the exit alone.
    person.at("#turn .knob >> nth=0").scroll_into_view_if_needed()
    person.drags("#turn .knob >> nth=0", 3, 20).sees({"#turn .lead": "It enters 4.50 m"})
    person.misses({"#turn .lead": "8.223984 m"})
    entry.press("Home")
    dial(person, "turn", "Distance of the exit").press("Home")
    person.sees({"#turn .verdict": "The benches jam", "#turn .bench": 0, "#turn .arc": 2})
    # Looks once a second see nothing of a contact.
    person.sees({"#proof .verdict": "Of 24 stretches", "#proof .more": ["0.865 mm", "409.83 s"]})
    person.presses("#proof .try >> nth=0").sees({"#proof .verdict": "Of 6 stretches between two looks, 0 are proven"})
    person.presses("#proof .try >> nth=1").sees({"#proof .verdict": ["touch at 409.77", "no look sees it"]})
    # Over the joint the bench of the head makes the next handle half as fast again.
    person.sees({"#speed .lead": "1.5542 m/s", "#speed .verdict": "55.4 % faster"}).presses("#speed .try")
    person.sees({"#speed .lead": ["1.6048 m/s", "1.5542 m/s"], "#speed .more": "1.246266 m/s"})


def test_the_lines_of_python_beside_each_figure_compute_what_it_shows(open_page):
    person = drawn(open_page("how?lang=en"))
    shown = {
        "chord": "0.99635490",
        "staircase": "0.450337393",
        "step": "clear 1 1.257",
        "graze": "0 of 11 looks",
        "proof": "0.000865",
        "stray": "0.04664",
        "turn": "13.621244",
        "speed": "1.55424",
    }
    assert set(shown) == SECTIONS
    for section, words in shown.items():
        code = person.page.locator(f"#{section} .python code").text_content()
        assert 3 <= code.count("\n") <= 10
        output = io.StringIO()
        with contextlib.redirect_stdout(output):
            exec(code, {})
        assert words in output.getvalue(), (section, output.getvalue())


def test_a_refused_refinement_leaves_the_curve_as_it_was(open_page):
    person = open_page("how?lang=en", failing=True)
    whole = re.compile("pitch-scan(?!.*locate)")
    person.page.route(whole, lambda route: route.fulfill(status=503, headers={"Retry-After": "60"}))
    with person.page.expect_response(whole):
        person.page.reload()
    person.settles().sees({"#staircase .lead": "4.57", "#staircase .jump": 0})


@thorough
def test_an_address_keeps_the_numbers_the_look_is_kept_on_both_pages_and_answers_lead_to_ideas(open_page, server):
    address = "how?lang=en&staircase_pitch=0.5&chord_turns=soup&step_time=1e9&graze_step=0.26"
    person = drawn(open_page(address, viewport={"width": 1366, "height": 768}))
    values = [(section, name) for section, name in (("staircase", "Pitch"), ("chord", "Place"), ("step", "Start"))]
    assert [dial(person, *one).inner_text() for one in values] == ["0.5000 m", "5.00 turns", "412.40 s"]
    dial(person, "staircase", "Pitch of the spiral").press("ArrowUp")
    person.arrives("**staircase_pitch=0.5001**#staircase")
    person.presses("[data-lang=zh]").arrives("**lang=zh**")
    kept = {"staircase_pitch": "0.5001", "step_time": "412.4", "graze_step": "0.3"}
    assert person.address().items() >= kept.items()
    person.page.reload()
    drawn(person).reads({"#staircase .lead .dial": "0.5001 m"})
    keeps_the_look(drawn(person.opens("?lang=en")), f"{server}/?lang=zh&benches=12&time=end&pitch=0.6&door=all")
    # Every answer of the dance leads to the idea behind it, and back.
    expect(person.at("#run-end details a")).to_be_attached()
    hashes = "links => links.map((link) => new URL(link.href).hash.slice(1))"
    assert set(person.all("#answers details a").evaluate_all(hashes)) == SECTIONS - {"graze", "proof", "turn"}
    person.presses("#tolerance summary", "#tolerance details a").sees({"#stray .ground": True})
    person.presses("#name a").sees({"#first-contact .value": True})
    assert person.address().items() >= {"benches": "12", "pitch": "0.6", "lang": "zh"}.items()


def keeps_the_look(person, dance):
    """Also on the page of a dance, which has this address."""

    def look(name):
        """The ground of the page with a look of this name."""
        person.presses(f"#look button:has-text('{name}')")
        return person.style("body", "backgroundColor")

    usual = person.style("body", "backgroundColor")
    height = person.box(".article")["height"]
    dark = look("Dark") if person.presses("#look-open") else ""
    look("Large type, for a projector")
    assert person.findings() == []
    assert dark != usual
    assert person.box(".article")["height"] > 1.15 * height
    person.page.goto(dance)
    assert person.settles().style("body", "backgroundColor") == dark
    assert not person.overflows(1366)
    person.presses("#look-open").page.emulate_media(color_scheme="dark")
    assert [look("浅色"), look("跟随系统")] == [usual, dark]
    person.page.emulate_media(color_scheme="light")
    expect(person.at("body")).to_have_css("background-color", usual)


@thorough
def test_a_dark_phone_in_chinese_is_served(open_page):
    person = drawn(open_page("how", locale="zh-CN", color_scheme="dark", **PHONE)).reads({"h1": "原理"})
    person.at("#staircase .try >> nth=-1").tap()
    person.sees({"#staircase .lead": "第16节龙身", "#proof .lead": "0.25 s"})
    assert not person.overflows(390)
    assert "undefined" not in person.text("body")
    assert person.findings() == []
