"""Comfort of the page: on a phone, in motion, at a glance, in print, in both languages."""

from __future__ import annotations

import json
import re
import shlex
from pathlib import Path
from typing import Any

import numpy as np
import pypdfium2
import pytest
import shapely
from playwright.sync_api import expect

from core.shapes.engines import widest_place
from tests.support import polite
from tests.support.job_service import wait_for
from tests.support.pending import reached, settled

PHONE = {"width": 390, "height": 844}
TOUCH = {"viewport": PHONE, "has_touch": True, "is_mobile": True}
MESSAGE_TIME = 6_000  # [ms]: how long a message stays
FINGER = 44  # [px]: the least height of what a finger should hit
SMALL = """(least) => [...document.querySelectorAll("button, select, input, summary, nav a")]
  .filter((one) => one.checkVisibility() && !["checkbox", "file"].includes(one.type))
  .filter((one) => one.getBoundingClientRect().height < least - 0.5).map((one) => one.outerHTML)"""
# Latin letters that are not a unit, a name or a symbol.
ENGLISH = re.compile(r"[A-Za-z]{4,}")
# Claims in Chinese, as the page words them.
CHINESE = "claims => import('/page/proofs.js').then((one) => claims.map(one.claimInChinese))"


def shows(page: Any, selector: str, *words: str) -> None:
    for one in words:
        expect(page.locator(selector).first).to_contain_text(one)


def box(page: Any, selector: str) -> Any:
    return page.locator(selector).first.bounding_box()


def test_on_a_phone_the_picture_stays_in_sight_of_what_is_dragged_and_fingers_have_room(
    open_page: Any,
) -> None:
    page = open_page("?benches=20", **TOUCH)
    settled(page)
    assert page.evaluate(SMALL, FINGER) == []
    for name in ("pitch", "pin"):
        slider = page.locator(f"[data-field={name}] input[type=range]")
        slider.evaluate("one => one.scrollIntoView({ block: 'end' })")
        canvas, knob = box(page, "#canvas"), slider.bounding_box()
        assert canvas["y"] >= 0
        assert canvas["y"] + canvas["height"] <= knob["y"]
        assert knob["y"] + knob["height"] <= PHONE["height"] + 1
    expect(page.locator("#verdict")).to_contain_text("Contact at")
    inset, legend = box(page, "#inset"), box(page, "#legend")
    apart = inset["x"] >= legend["x"] + legend["width"] or inset["y"] + inset["height"] <= legend["y"]
    assert apart
    page.locator("[data-path=turn]").tap()
    shows(page, "#head-speed .value", "m/s")
    assert page.evaluate(SMALL, FINGER) == []
    assert page.evaluate("document.documentElement.scrollWidth") <= PHONE["width"]


def test_a_bare_address_moves_with_the_mouse_and_the_wheel_scrolls_until_the_picture_is_clicked(
    open_page: Any, server: str
) -> None:
    page = open_page("")
    settled(page)
    shows(page, "#play", "Play")
    page.mouse.move(300, 300)
    shows(page, "#play", "Pause")
    page.locator("#doors [data-door=all]").click()
    expect(page.locator("#clock")).to_have_text(re.compile(r"^[1-9]"))
    time = polite.get(f"{server}/collision-time").json()["time"]
    expect(page.locator("#contact-mark")).to_have_attribute("title", f"First contact, at {time:.6f} s")
    page.locator("#play").click()
    slider, mark = box(page, "#time"), box(page, "#contact-mark")
    assert slider["x"] + slider["width"] - mark["x"] < 20
    canvas = box(page, "#canvas")
    page.mouse.move(canvas["x"] + 300, canvas["y"] + 300)
    page.mouse.wheel(0, 200)
    wait_for(lambda: page.evaluate("scrollY") > 100)
    assert "view=" not in page.url
    page.evaluate("scrollTo(0, 0)")
    page.mouse.click(canvas["x"] + 300, canvas["y"] + 300)
    page.mouse.wheel(0, 200)
    page.wait_for_url("**view=**")
    assert page.evaluate("scrollY") == 0
    keys = open_page("")
    settled(keys)
    keys.keyboard.press("Tab")
    keys.mouse.move(300, 300)
    still = open_page("", reduced_motion="reduce")
    settled(still)
    still.mouse.move(300, 300)
    keys.mouse.move(320, 300)
    for one in (keys, still):
        settled(one)
        shows(one, "#clock", "0.00 s")
        shows(one, "#play", "Play")


def test_on_the_whole_screen_the_numbers_can_be_dragged_and_the_verdict_follows(open_page: Any) -> None:
    page = open_page("?door=contest&benches=60")
    settled(page)
    page.locator("#full").click()
    page.wait_for_function("() => document.fullscreenElement")
    slider = page.locator("[data-field=pitch] input[type=range]")
    expect(slider).to_be_in_viewport()
    expect(page.locator("#answers")).to_be_hidden()
    before = page.locator("#verdict").inner_text()
    slider.evaluate("one => { one.value = 0.7; one.dispatchEvent(new Event('input', { bubbles: true })); }")
    settled(page)
    expect(page.locator("#verdict")).to_be_in_viewport()
    expect(page.locator("#verdict")).not_to_have_text(before)
    # The verdict leads to its reasons, which are not on the whole screen.
    page.locator("#verdict").click()
    expect(page.locator("#answers")).to_be_in_viewport()
    assert page.evaluate("document.fullscreenElement") is None


def test_on_the_whole_screen_of_a_bare_address_there_are_numbers_too(open_page: Any) -> None:
    page = open_page("")
    settled(page)
    page.keyboard.press("Tab")  # so that nothing moves
    page.locator("#full").click()
    expect(page.locator("[data-field=pitch] input[type=range]")).to_be_in_viewport()


def test_a_gap_beside_an_instant_that_the_curve_does_not_have_says_so(open_page: Any) -> None:
    page = open_page("?door=contest&benches=20&time=100.2")
    settled(page)
    reading = page.locator("#clearance .reading")
    expect(reading).to_contain_text("s, the nearest time of the curve: gap")
    # It is the nearest one of 400 times.
    assert abs(float(reading.inner_text().split(" s")[0]) - 100.2) < 1.2
    page.locator("#to-end").click()
    settled(page)
    expect(reading).not_to_contain_text("nearest")


def test_a_link_below_the_answers_leads_to_the_files(open_page: Any) -> None:
    page = open_page("?door=contest&benches=20&time=end")
    settled(page)
    page.locator("#to-keep").click()
    expect(page.locator("#kept li").first).to_be_visible()
    settled(page)
    expect(page.locator("#keep-title")).to_be_in_viewport()
    expect(page.locator("#keep-title")).to_be_focused()
    page.locator("#keep [data-share]").click()
    expect(page.locator("#address")).to_have_value(page.url)


def test_a_name_stands_where_its_area_is_widest(visit: Any) -> None:
    page = visit("?time=0")
    # A square of 40 m with a street of 60 m, and a ring of 50,000 corners with two lobes.
    street = [[0, 0], [40, 0], [40, 18], [100, 18], [100, 22], [40, 22], [40, 40], [0, 40]]
    turns = np.linspace(0.0, 2.0 * np.pi, 50_000, endpoint=False)
    lobes = np.stack([(30.0 + 12.0 * np.cos(turns)) * np.cos(turns), 12.0 * np.sin(turns)], axis=1).tolist()
    script = "(areas) => import('/page/venue.js').then(({ widest }) => areas.map(widest))"
    for corners, (x, y, width) in zip((street, lobes), page.evaluate(script, [street, lobes]), strict=True):
        *_, radius = widest_place([[*corners, corners[0]]])
        square = shapely.Polygon(corners)
        assert square.contains(shapely.Point(x, y))
        room = shapely.distance(square.boundary, shapely.Point(x, y))
        assert 0.5 * width == pytest.approx(room, rel=0.01)
        assert room > 0.97 * radius


def test_the_picture_has_its_scale_its_direction_and_one_scale_of_colours(visit: Any) -> None:
    page = visit("?time=0&view=8.8,0,40")
    metres, pixels = page.evaluate(
        "import('/page/pen.js').then(({ scaleBar }) => [4e-3, 40, 41, 2e4].map((scale) => scaleBar(scale)))"
        ".then((all) => [all.map((one) => one.metres), all.map((one) => one.pixels)])"
    )
    assert metres == [20_000, 2, 2, 0.005]
    assert pixels == pytest.approx([80, 80, 82, 100])
    # The head is in the middle and moves down: its arrow crosses the row 20 pixels below.
    seen = "c => [...c.getContext('2d').getImageData(c.width / 2 - 8, c.height / 2 + 20, 16, 1).data]"
    pixels = page.locator("#canvas").evaluate(seen)
    assert any(
        red > 150 > max(green, blue) for red, green, blue in zip(pixels[::4], pixels[1::4], pixels[2::4], strict=True)
    )
    legend = page.locator("#legend").inner_text()
    settled(page)  # The end of the time is known.
    page.locator("#time").press("End")
    settled(page)
    corner = page.locator("#inset:visible").get_attribute("data-corner")
    assert page.locator("#legend").inner_text() == legend
    inset, canvas = box(page, "#inset"), page.locator("#canvas")
    # The point of contact moves below the inset, which gives way.
    wanted = (inset["x"] + inset["width"] / 2, inset["y"] + inset["height"] / 2)
    middle = canvas.bounding_box()
    x = 1.474395 - (wanted[0] - middle["x"] - middle["width"] / 2) / 40
    y = 2.110665 + (wanted[1] - middle["y"] - middle["height"] / 2) / 40
    visit(f"?view={x},{y},40")
    page.locator(f"#inset:not([data-corner={corner}])").wait_for()


def test_all_numbers_are_in_view_explained_and_their_sliders_reach_as_far_as_wanted(
    open_page: Any, server: str
) -> None:
    page = open_page("?path=turn&benches=20")
    settled(page)
    form = page.locator("#controls")
    assert form.evaluate("one => one.scrollHeight <= one.clientHeight")
    fields = page.locator(".field")
    assert fields.count() == 17
    for k in range(fields.count()):
        expect(fields.nth(k).locator(".help")).to_be_visible()
        assert fields.nth(k).locator(".what").evaluate("one => one.scrollWidth <= one.clientWidth + 1")
    expect(page.locator("#sketch")).to_have_attribute("aria-label", re.compile("^A bench from above"))
    pitch = page.locator("[data-field=pitch]")
    pitch.get_by_label("Slider of Pitch ends at").fill("9")
    pitch.get_by_label("Slider of Pitch ends at").press("Enter")
    pitch.locator("input[type=range]").press("End")
    assert page.locator("#pitch").input_value() == "9"
    page.locator(".field:has(#pitch) .reset").click()
    # The numbers of a turn, and what its answers offer.
    query = {"benches": 20, "ratio": 1.5, "speed_limit": 1.8}
    page.locator("#ratio").fill("1.5")
    page.locator("#speed_limit").fill("1.8")
    fastest = polite.get(f"{server}/maximum-head-speed", params=query).raise_for_status().json()
    shows(page, "#head-speed .value", f"{fastest['head_speed']:.9f} m/s")
    request = {"benches": 20, "ratio": 1.5, "pitch": 1.7}
    shortest = polite.get(f"{server}/shortest-turn", params=request).raise_for_status().json()
    shows(page, "#shortest-turn .value", f"{shortest['length']:.6f} m")
    # Boxes that are drawn anew under the mouse take no click; and another entry has another speed.
    settled(page)
    page.get_by_role("button", name="Dance at this speed").click()
    assert float(page.locator("#head_speed").input_value()) == pytest.approx(fastest["head_speed"], abs=1e-6)
    settled(page)
    page.get_by_role("button", name="Dance this turn").click()
    assert float(page.locator("#entry_radius").input_value()) == shortest["entry_radius"]
    assert float(page.locator("#exit_radius").input_value()) == shortest["exit_radius"]
    shows(page, "#first-contact .value", "Nothing touches")
    settled(page)
    # The colours have the highest speed of the answer, also above twice that of the head.
    fast = page.locator("#highest-speed .value").inner_text().removesuffix(" m/s")
    expect(page.locator("#legend span").nth(1)).to_have_text(re.compile(f"^{fast[:4]}"))
    page.get_by_role("button", name="Dance the quickest turn").click()
    settled(page)
    text = page.locator("#turn-time .value").inner_text()
    expect(page.locator("#quickest-turn .value")).to_have_text(text)
    assert float(page.locator("#entry_radius").input_value()) != shortest["entry_radius"]
    page.get_by_role("button", name="Dance the spiral of this pitch").click()
    page.locator("[data-path=spiral][aria-pressed=true]").wait_for()
    least = polite.get(f"{server}/minimum-pitch", params={"benches": 20}).json()
    assert float(page.locator("#pitch").input_value()) == least["pitch_bracket"][1]
    assert page.locator("#entry_radius").is_hidden()


def test_a_hanging_service_is_noticed_the_next_try_counts_down_and_messages_go_away(
    open_page: Any,
) -> None:
    page = open_page("?benches=20", failing=True)
    page.clock.install()
    tries: list[Any] = []

    def hang(route: Any) -> None:
        """Neither an answer nor an end; but the second try is refused at once."""
        tries.append(route)
        if len(tries) == 2:
            route.abort()

    page.route("**/healthz", hang)
    for words in ("next try in 1 s", "next try in 2 s", "next try in 1 s"):
        page.locator("#lost", has_text=words).wait_for()
        page.clock.fast_forward(1000)
    page.locator("#lost", has_text="trying again now").wait_for()
    for _ in range(1000):
        if len(tries) == 3:
            break
        page.wait_for_timeout(10)
    tries[2].continue_()
    page.locator("#lost").wait_for(state="hidden")
    shows(page, "#status", "The service is back.")
    page.clock.fast_forward(MESSAGE_TIME)
    page.locator("#status:empty").wait_for(state="attached")


def test_the_pitch_chart_has_a_first_look_before_its_jumps_are_known(open_page: Any) -> None:
    page = open_page("?benches=12")
    page.route(lambda url: "/pitch-scan" in url and "locate" not in url, lambda route: None)
    page.locator("#scan .plot").scroll_into_view_if_needed()
    page.locator("#scan.coarse .uplot").wait_for()
    shows(page, "#scan .reading", "first view; the jumps are still being located")
    # It is busy, but the view is of these numbers.
    assert page.locator("#scan[aria-busy=true] > .old").is_hidden()
    page.unroute_all()
    page.locator("#width").fill("0.29")
    settled(page)
    page.locator("#scan:not(.coarse) .uplot").wait_for()
    page.get_by_role("button", name="中文").click()
    expect(page.locator("#scan .reading")).to_contain_text("龙头停在")
    expect(page.locator("#scan.coarse, #scan[aria-busy=true]")).to_have_count(0)


def test_a_late_first_look_does_not_replace_the_pitch_chart(open_page: Any) -> None:
    page = open_page("?benches=11")
    late: list[Any] = []
    page.route(lambda url: "locate=false" in url, lambda route: late.append(route))
    page.locator("#scan .plot").scroll_into_view_if_needed()
    page.locator("html[data-pending=look]").wait_for()  # All the rest is answered.
    for look in late:
        look.continue_()
    settled(page)
    page.locator("#scan:not(.coarse) .uplot").wait_for(timeout=2_000)


def test_in_chinese_proofs_and_refusals_are_chinese(visit: Any, server: str) -> None:
    page = visit("?lang=zh&benches=9&stray=0.02&margin=0.01")
    for place in ("#first-contact", "#tolerance"):
        page.locator(f"{place} summary").click()
        proof = page.locator(f"{place} .method").inner_text()
        assert "证明" in proof
        assert not ENGLISH.search(proof)
    claims = [
        polite.get(f"{server}/collision-time", params=query).json()["certificate"]["claim"]
        for query in ({}, {"pitch": 0.3}, {"pitch": 2, "start_turns": 8, "benches": 9}, {"benches": 2})
    ]
    turn = {"path": {"kind": "turn", "pitch": 1.7}, "start": -10, "stop": 10, "dragon": {"benches": 5}}
    claims.append(polite.post(f"{server}/check", json=turn).json()["first_contact"]["certificate"]["claim"])
    proofs = page.evaluate(CHINESE, claims)
    assert [proof for proof in proofs if ENGLISH.search(proof)] == []


def test_on_paper_stand_the_picture_the_numbers_and_the_answers_in_dark_ink(open_page: Any) -> None:
    page = open_page("?benches=20", color_scheme="dark")
    settled(page)
    page.emulate_media(media="print", color_scheme="dark")
    # Charts that nobody has looked at are missing in the first print, and are there in the next one.
    for chart in ("#curve", "#scan"):
        expect(page.locator(chart)).to_be_hidden()
    page.pdf()
    for chart in ("#curve", "#scan:not(.coarse)"):
        expect(page.locator(f"{chart} .uplot")).to_be_visible()
    places = ("header nav", "#tabs", "#transport", "#views", "#sweeps", "#grade")
    for place in (*places, "#controls input[type=range] >> nth=0"):
        expect(page.locator(place)).to_be_hidden()
    for place in ("#canvas", "#pitch", "#first-contact .value", "#scan .plot"):
        expect(page.locator(place)).to_be_visible()
    ground = "one => getComputedStyle(one).backgroundColor"
    assert page.locator("#canvas").evaluate(ground) == page.locator("body").evaluate(ground) == "rgb(255, 255, 255)"


def test_a_print_from_a_wide_window_is_that_from_a_narrow_one(open_page: Any, look_at: Any) -> None:
    printed = []
    for width in (800, 2200):
        page = open_page("?benches=20&time=end", viewport={"width": width, "height": 900})
        look_at(page, "curve", "scan")
        document = pypdfium2.PdfDocument(page.pdf(format="A4"))
        printed.append([leaf.render().to_numpy().astype(int) for leaf in document])
    for narrow, wide in zip(*printed, strict=True):
        assert narrow.min() < 100  # it is not empty
        assert float((abs(narrow - wide).max(axis=-1) > 60).mean()) < 0.01


def test_a_message_changes_its_language_with_the_page(visit: Any) -> None:
    script = """async (selector) => {
      const status = document.querySelector("#status");
      document.querySelector(selector).click();
      while (!status.textContent) await new Promise(requestAnimationFrame);
      const first = status.textContent;
      document.querySelector("[data-lang=zh]").click();
      return [first, status.textContent];
    }"""
    page = visit()
    english, chinese = page.evaluate(script, "#copy-address")
    assert (english, chinese) in {("Copied", "已复制"), ("The browser did not allow copying", "浏览器不允许复制")}


def test_everything_can_be_kept_from_the_page(open_page: Any, server: str) -> None:
    page = open_page("?benches=9&pitch=0.5&start_turns=10")
    reached(page.locator("#keep"))
    kept = {}
    for name in (
        "Ground that benches sweep, GeoJSON",
        "Every handle, every second, XLSX",
        "Figure of this instant, PNG",
    ):
        with page.expect_download() as download:
            page.get_by_role("button", name=name).click()
        kept[download.value.suggested_filename] = Path(download.value.path()).read_bytes()
    assert json.loads(kept["envelope.geojson"])["type"] in ("Feature", "FeatureCollection", "Polygon", "MultiPolygon")
    assert kept["trajectory.xlsx"].startswith(b"PK")
    assert kept["instant.png"].startswith(b"\x89PNG")
    page.locator("#paper summary").click()
    shows(page, "#paper table", "406.43 s", "412.473837682 s", "The paper's rule adds angles")
    page.locator("[data-lang=zh]").click()
    shows(page, "#paper table", "412.473837682 s", "首次碰撞时刻", "论文的判据把夹角相加")
    page.locator("[data-lang=en]").click()
    choice = page.locator("#curl-of")
    commands = []
    for option in choice.locator("option").all():
        choice.select_option(option.get_attribute("value"))
        commands.append(page.locator("#curl").inner_text())
    assert len(set(commands)) == len(commands)
    assert commands[-1].startswith("bench-dragon prove collision-time --benches 9 ")
    assert all(command.startswith(f"curl '{server}/") for command in commands[:-1])
    (film,) = (command for command in commands if '"films"' in command)  # which takes too long for one answer
    answer = json.loads(shlex.split(film)[-1])
    assert (shlex.split(film)[1], answer["accept"], answer["question"]) == (f"{server}/jobs", "video/mp4", "films")
