"""Sights and actions of a person on the page, against the service's own answers."""

from __future__ import annotations

import json
import re
import shlex
from decimal import ROUND_CEILING, ROUND_FLOOR, Decimal
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import expect

from tests.support import polite
from tests.support.pending import reached, settled, with_below

PNG_SIGNATURE = b"\x89PNG\r\n\x1a\n"
# Between two samples the picture may be off by this much [m]; a bench is 0.3 m wide.
SMOOTH_TOLERANCE = 1e-3
ON_TOP = """(one) => {
  const { x, y, width, height } = one.getBoundingClientRect();
  return one.contains(document.elementFromPoint(x + width / 2, y + height / 2));
}"""
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
TRACK = """async ([times, step]) => {
  const { Track } = await import("/page/track.js");
  const ask = async (_, times, decimals) => {
    const headers = { "Content-Type": "application/json" };
    return (await fetch("/trajectory", { method: "POST", headers, body: JSON.stringify({ times, decimals }) })).json();
  };
  let ready;
  const track = new Track(ask, [0, 412], 224, 1, () => ready());
  const found = [];
  for (const time of times) {
    while (!track.at(time)) await new Promise((resolve) => (ready = resolve));
    const { x, y } = track.at(time);
    found.push([[...x], [...y]]);
  }
  return found;
}"""


def collision_time(server: str, **query: Any) -> Any:
    return polite.get(f"{server}/collision-time", params=query).raise_for_status().json()


def text_of(page: Any, selector: str, wanted: str) -> None:
    """Wait until the element holds the wanted text."""
    page.locator(selector, has_text=wanted).first.wait_for()


def bounded(value: float, decimals: int, way: str) -> str:
    """A bound rounded to one side."""
    return str(Decimal(value).quantize(Decimal(1).scaleb(-decimals), way))


def clock(page: Any) -> float:
    return float(page.locator("#clock").inner_text().removesuffix(" s"))


def test_the_first_view_shows_the_contact_its_certificate_and_the_four_engines(visit: Any, server: str) -> None:
    page, answer = visit(), collision_time(server)
    text_of(page, "#first-contact .value", f"{answer['time']:.6f} s")
    assert page.locator("#first-contact").get_attribute("data-outcome") == "contact"
    page.locator("#first-contact summary").click()
    low, high = (
        bounded(end, 10, way) for end, way in zip(answer["time_bracket"], (ROUND_FLOOR, ROUND_CEILING), strict=True)
    )
    text_of(page, "#first-contact dl", f"clear up to {low} s, overlapping at {high} s")
    text_of(page, "#first-contact dl", f"nothing touches up to {low} s, rounded down")
    text_of(page, "#first-contact dl", f"{answer['certificate']['steps']} proven steps")
    assert page.locator("#first-contact tbody tr").count() == len(answer["cross_check"]["engines"])
    text_of(page, "#first-contact caption", "judged all 223 benches. They agree.")
    text_of(page, "#inset figcaption", "gap 0.000 mm")
    text_of(page, "#inset figcaption", "front outer corner of the head meets inner edge of body 8")


def test_the_picture_is_drawn_in_the_colours_of_its_speeds(visit: Any) -> None:
    page = visit()
    text_of(page, "#legend", "m/s")
    count = "c => new Set(new Uint32Array(c.getContext('2d').getImageData(0, 0, c.width, c.height).data.buffer)).size"
    assert page.locator("#canvas").evaluate(count) > 40


def test_every_answer_stands_with_how_it_is_known(visit: Any, server: str) -> None:
    page = visit()
    least = polite.get(f"{server}/minimum-pitch").json()
    text_of(page, "#minimum-pitch .value", f"{least['pitch']:.9f} m")
    page.locator("#minimum-pitch summary").click()
    assert (
        f"from {bounded(least['proven_from'], 9, ROUND_CEILING)} m on, without limit"
        in page.locator("#minimum-pitch dl").inner_text()
    )
    assert (
        page.locator("#minimum-pitch dt").last.inner_text()
        == "Runs to the circle that were computed, for single pitches and for bands of pitches"
    )
    assert page.locator("#minimum-pitch dd").last.inner_text() == str(least["evaluations"])
    assert page.locator(".answer:not([hidden]) details").count() == page.locator(".answer:not([hidden])").count() == 5


def test_the_highest_speed_on_a_spiral_is_the_proven_one(visit: Any, server: str) -> None:
    page = visit("?pitch=0.5&benches=4")
    dance = {"dragon": {"benches": 4}, "path": {"kind": "spiral", "pitch": 0.5}}
    fastest = polite.post(f"{server}/check", json=dance).raise_for_status().json()["highest_speed"]
    assert fastest["speed"] > 1
    text_of(page, "#highest-speed .value", f"{fastest['speed']:.6f} m/s")
    page.locator("#highest-speed summary").click()
    text_of(page, "#highest-speed dl", f"{bounded(fastest['speed_bracket'][1], 9, ROUND_CEILING)} m/s never exceeded")


def test_the_engines_judge_the_pair_while_a_hand_drags_and_the_whole_dragon_when_it_rests(visit: Any) -> None:
    page = visit("?benches=40&time=end")
    page.locator("#minimum-pitch summary").click()
    page.locator("#first-contact summary").click()
    text_of(page, "#minimum-pitch caption", "judged all 40 benches. They agree.")
    query: list[str] = []
    page.on("request", lambda request: query.append(request.url))
    page.evaluate(HELD)
    page.locator("#controls input[type=range][aria-label^=Width]").press("ArrowLeft")
    text_of(page, "#minimum-pitch caption", "alone. They agree.")
    text_of(page, "#first-contact caption", "alone. They agree.")
    page.evaluate("rest()")
    text_of(page, "#first-contact caption", "judged all 40 benches")
    text_of(page, "#minimum-pitch caption", "judged all 40 benches. They agree.")
    contacts = [url for url in query if "/collision-time" in url]
    assert contacts
    assert all("cross_check=pair" in url for url in contacts)
    minima = [url for url in query if "/minimum-pitch" in url]
    assert "cross_check=pair" in minima[0]
    assert "cross_check" not in minima[-1]
    page.locator("[data-lang=zh]").click()
    text_of(page, "#first-contact caption", "检验全部 40 节板凳。")
    text_of(page, "#minimum-pitch caption", "检验全部 40 节板凳。")


def test_dragging_the_pitch_to_045_shows_the_numbers_of_the_service(visit: Any, server: str) -> None:
    page = visit("?benches=40&time=end")
    slider = page.locator("#controls input[type=range]").first
    box = slider.bounding_box()
    page.mouse.move(box["x"] + box["width"] * 0.147, box["y"] + box["height"] / 2)
    page.mouse.down()
    for pitch_share in range(14, 8, -1):
        page.mouse.move(box["x"] + box["width"] * pitch_share / 100, box["y"] + box["height"] / 2)
    page.mouse.up()
    assert float(page.locator("#pitch").input_value()) < 0.5
    slider.fill("0.449")
    slider.press("ArrowRight")
    assert page.locator("#pitch").input_value() == "0.45"
    answer = collision_time(server, pitch=0.45, benches=40)
    text_of(page, "#first-contact .value", f"{answer['time']:.6f} s")
    text_of(page, "#clock", f"{answer['time']:.6f} s")
    text_of(page, "#table-time", f"{answer['time']:.6f} s")
    text_of(page, "#rows tbody tr:not([hidden])", f"{answer['head']['x']:.6f}")


def test_the_dance_plays_to_the_contact_and_stops_there(visit: Any, server: str) -> None:
    page = visit("?benches=40&time=400&rate=10")
    text_of(page, "#clock", "400.000000 s")
    page.locator("#inset").wait_for(state="hidden")
    page.locator("#play").click()
    text_of(page, "#play", "Pause")
    text_of(page, "#clock", f"{collision_time(server, benches=40)['time']:.6f} s")
    text_of(page, "#play", "Play")
    page.locator("#inset").wait_for()
    page.locator("#back").click()
    text_of(page, "#clock", "411.473838 s")
    page.locator("#inset").wait_for(state="hidden")


def test_motion_between_samples_is_true_to_a_millimetre(visit: Any, server: str) -> None:
    times = [0.1, 57.33, 299.9, 411.77]
    drawn = visit().evaluate(TRACK, [times, 0.5])
    table = polite.post(f"{server}/trajectory", json={"times": times}).json()
    for k, rows in enumerate(drawn):
        for row, axis in zip(rows, "xy", strict=True):
            assert row == pytest.approx(table[axis][k], abs=SMOOTH_TOLERANCE)


def test_the_clearance_chart_and_the_dance_have_one_time(visit: Any, server: str) -> None:
    page = visit("?benches=40&time=end")
    plot = page.locator("#clearance .u-over")
    box = plot.bounding_box()
    plot.click(position={"x": box["width"] / 2, "y": 20})
    settled(page)
    time = clock(page)
    assert time == pytest.approx(collision_time(server, benches=40)["time"] / 2, rel=0.02)
    text_of(page, "#table-time", page.locator("#clock").inner_text())
    page.locator("#time").press("End")
    text_of(page, "#clock", f"{collision_time(server, benches=40)['time']:.6f} s")
    before = page.locator("#clearance .now").bounding_box()["x"]
    page.locator("#time").press("Home")
    text_of(page, "#clock", "0.000000 s")
    assert page.locator("#clearance .now").bounding_box()["x"] == pytest.approx(
        before - box["width"], abs=box["width"] / 50
    )


def test_slow_charts_are_asked_for_when_somebody_scrolls_to_them_and_a_click_sets_the_pitch(
    open_page: Any, look_at: Any, server: str
) -> None:
    page = open_page("?benches=20&time=end")
    query: list[str] = []
    page.on("request", lambda request: query.append(request.url.removeprefix(f"{server}/").partition("?")[0]))
    page.locator("#width").fill("0.29")
    settled(page)
    assert "tolerance" in query
    assert not {"pitch-scan", "tolerance-curve"} & set(query)
    assert page.locator("#curve .uplot, #scan .uplot").count() == 0
    look_at(page, "curve", "scan")
    assert (query.count("pitch-scan"), query.count("tolerance-curve")) == (2, 1)
    for kind in ("curve", "scan"):
        assert page.locator(f"#{kind} h2").evaluate(ON_TOP)
    plot = page.locator("#scan .u-over")
    plot.click(position={"x": plot.bounding_box()["width"] / 4, "y": 40})
    pitch = page.locator("#pitch").input_value()
    assert float(pitch) < 0.5
    text_of(
        page, "#first-contact .value", f"{collision_time(server, pitch=pitch, width=0.29, benches=20)['time']:.6f} s"
    )


def test_a_fold_is_as_clear_as_a_contact(visit: Any, server: str) -> None:
    page = visit("?benches=40&pitch=2&start_turns=8")
    text_of(page, "#first-contact .value", "The dragon folds at")
    assert page.locator("#first-contact").get_attribute("data-outcome") == "folds"
    end = collision_time(server, benches=40, pitch=2, start_turns=8)["end"]
    text_of(page, "#first-contact p", f"{end['time']:.6f} s")
    text_of(page, "#run-end", "the chain folds")
    text_of(page, "#highest-speed .value", "Grows without bound")
    page.locator("#inset").wait_for(state="hidden")


def test_contact_at_the_start_has_its_picture_and_its_depth(visit: Any) -> None:
    page = visit("?benches=40&pitch=0.3")
    text_of(page, "#first-contact .value", "Touching already at the start")
    text_of(page, "#inset figcaption", "overlap by ")
    text_of(page, "#clock", "0.000000 s")


@pytest.mark.parametrize("margin", [0, 0.2])
def test_overlapping_benches_of_any_answer_are_reported_as_overlapping(visit: Any, server: str, margin: float) -> None:
    answer = collision_time(server, benches=40, pitch=0.3, margin=margin)
    depth = f"{-1000 * answer['gap']:.3f} mm"
    page = visit(f"?benches=40&pitch=0.3&margin={margin}")
    for language, words in (("English", f"overlap by {depth}"), ("中文", f"重叠 {depth}")):
        page.get_by_role("button", name=language).click()
        for place in ("#first-contact p", "#inset figcaption", "#clearance .reading"):
            text_of(page, place, words)
        for place in ("#first-contact", "#inset figcaption", "#clearance .reading"):
            assert not re.search(r"[-−]\d+\.\d+ mm", page.locator(place).inner_text())


def test_two_benches_cannot_touch_and_the_chart_says_so_in_the_services_words(visit: Any, server: str) -> None:
    page = visit("?benches=2", failing=True)
    text_of(page, "#first-contact p", "No two benches touch before.")
    words = polite.get(f"{server}/clearance?benches=2").json()["detail"]
    words = words.replace("benches must", "“Benches” must", 1).replace(", got 2", "; it is 2.")
    text_of(page, "#clearance .reading", words)


def test_a_handle_chosen_in_the_picture_is_chosen_in_the_table_and_back(open_page: Any) -> None:
    page = open_page("?benches=12&time=0&view=8.8,0,40")
    text_of(page, "#table-time", "0.000000")
    # Rows that move or are drawn anew under the mouse take no click: the charts above them are drawn first.
    reached(page.locator("#handles"))
    box = page.locator("#canvas").bounding_box()
    page.locator("#canvas").click(position={"x": box["width"] / 2, "y": box["height"] / 2})
    text_of(page, "#rows tr.chosen", "0 · head")
    page.locator("#rows tr[data-handle='5']").click()
    text_of(page, "#rows tr.chosen", "5 · body 5")
    page.wait_for_url(re.compile("handle=5"))


def test_rows_stay_in_motion_so_that_none_is_replaced_under_the_mouse(visit: Any) -> None:
    page = visit("?time=0&benches=40&rate=1")
    text_of(page, "#table-time", "0.000000")
    row = page.locator("#rows tr[data-handle='5']").element_handle()
    text = row.inner_text()
    page.locator("#play").click()
    expect(page.locator("#rows tr[data-handle='5']")).not_to_have_text(text, use_inner_text=True)
    assert row.evaluate("row => row.isConnected")
    row.evaluate("row => row.cells[1].click()")
    text_of(page, "#rows tr.chosen", "5 · body 5")


def test_two_thousand_benches_are_drawn_and_listed(visit: Any, server: str) -> None:
    page = visit("?benches=2000&time=0")
    text_of(page, "#table-time", "0.000000")
    page.locator("#rows").press("ArrowUp")
    page.locator("#rows").evaluate("box => box.scrollTo(0, box.scrollHeight)")
    last = polite.post(f"{server}/trajectory", json={"dragon": {"benches": 2000}, "times": [0]}).json()["x"][0][-1]
    text_of(page, "#rows tr[data-handle='2000']", f"{last:.6f}")


def test_a_shared_link_opens_the_same_state(visit: Any, open_page: Any, picture: Any, alike: Any) -> None:
    page = with_below(visit("?pitch=0.5&benches=40&margin=0.01&time=120.5&rate=5&handle=7&lang=zh&view=1,2,35"))
    page.locator("#width").fill("0.25")
    page.locator("#share").click()
    page.wait_for_url(re.compile("width=0.25"))
    settled(page)
    other = open_page(page.url.split("/")[-1])
    settled(with_below(other))
    for place in ("#first-contact", "#clock", "#table-time", "tr.chosen", "#minimum-pitch", "#curl"):
        assert other.locator(place).inner_text() == page.locator(place).inner_text()
    assert other.url.split("?")[1] == page.url.split("?")[1]
    assert alike(picture(other), picture(page))


def test_the_files_hold_what_the_service_answers(open_page: Any, server: str) -> None:
    page = open_page("?pitch=0.5&benches=12")
    reached(page.locator("#keep"))
    kept = {}
    buttons = {"csv": "Every handle, every second, CSV", "png": "The picture as it is, PNG"}
    buttons |= {"figure": "Figure of the first contact, SVG", "json": "First contact with its certificate, JSON"}
    for kind, name in buttons.items():
        with page.expect_download() as download:
            page.get_by_role("button", name=name).click()
        kept[kind] = Path(download.value.path()).read_bytes()
    answer = collision_time(server, pitch=0.5, benches=12)
    assert json.loads(kept["json"]) == answer
    rows = kept["csv"].decode().split("\n")
    assert rows[0] == "time,handle,x,y,speed"
    assert len(rows) == 1 + 13 * (int(answer["time"]) + 1) + 1
    assert kept["png"].startswith(PNG_SIGNATURE)
    assert b"<svg" in kept["figure"]


def test_the_commands_give_what_the_page_shows(visit: Any, server: str) -> None:
    page = with_below(visit("?benches=40&pitch=0.5"))
    text_of(page, "#curl", "pitch=0.5")
    get, post = (shlex.split(line) for line in page.locator("#curl").inner_text().splitlines())
    assert polite.get(get[1]).json() == collision_time(server, benches=40, pitch=0.5)
    table = polite.post(post[1], content=post[-1], headers=dict([post[3].split(": ")])).raise_for_status().json()
    assert len(table["x"][0]) == 41


def test_the_turn_shows_the_verdict_of_the_service(open_page: Any, server: str) -> None:
    page = open_page("?head_speed=1.5&benches=20")
    settled(page)
    page.get_by_role("button", name="Turn", exact=True).click()
    text_of(page, "#first-contact .value", "Nothing touches")
    times = {"start": -100 / 1.5, "stop": 100 / 1.5}
    body = {"dragon": {"benches": 20}, "path": {"kind": "turn", "pitch": 1.7}, "head_speed": 1.5, **times}
    report = polite.post(f"{server}/check", json=body).raise_for_status().json()
    text_of(page, "#highest-speed .value", f"{report['highest_speed']['speed']:.6f} m/s")
    text_of(page, "#clock", f"{report['stop']:.6f} s")
    shortest = polite.get(f"{server}/shortest-turn", params={"pitch": 1.7, "benches": 20}).raise_for_status().json()
    text_of(page, "#shortest-turn .value", f"{shortest['length']:.6f} m")
    timed = [
        polite.get(f"{server}/{call}", params={"benches": 20}).raise_for_status().json()
        for call in ("quickest-turn", "turn-time")
    ]
    for box, answer in zip(("#quickest-turn", "#turn-time"), timed, strict=True):
        text_of(page, f"{box} .value", f"{answer['time']:.6f} s")
    assert timed[0]["time"] < timed[1]["time"]
    reached(page.locator("#keep"))
    with page.expect_download() as download:
        page.get_by_role("button", name="Figure of the first contact, SVG").click()
        expect(page.locator("#status")).to_contain_text("first-contact.svg")
    assert b"<svg" in Path(download.value.path()).read_bytes()
    page.locator("#time").press("Home")
    text_of(page, "#clock", f"{report['start']:.6f} s")
    page.get_by_role("button", name="Spiral", exact=True).click()
    text_of(page, "#first-contact .value", f"{collision_time(server, head_speed=1.5, benches=20)['time']:.6f} s")
    for box in ("#shortest-turn", "#quickest-turn", "#turn-time"):
        page.locator(box).wait_for(state="hidden")


def test_a_link_to_the_turn_opens_at_the_pitch_of_the_contest(visit: Any) -> None:
    page = visit("?path=turn&benches=20")
    assert page.locator("#pitch").input_value() == "1.7"
    page.locator("#pitch").fill("1.8")
    page.wait_for_url(re.compile("pitch=1.8"))
    page.get_by_role("button", name="Reset all").click()
    assert page.locator("#pitch").input_value() == "1.7"
    page.wait_for_url(re.compile("path=turn$"))
    # The figure of a dance without a contact is of the part that is shown.
    settled(with_below(page))
    page.locator("#curl-of").select_option("keepContact")
    request = json.loads(shlex.split(page.locator("#curl").inner_text())[5])
    assert (request["start"], request["stop"]) == (-100, 100)


def test_a_link_to_the_end_of_the_dance_opens_there_and_not_in_motion(open_page: Any) -> None:
    page = open_page("?pitch=0.6&benches=20&time=end")
    page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    page.get_by_role("button", name="Reset all").click()
    settled(page)
    page.locator("#share").click()
    page.locator("#copy-address").click()
    page.locator("#status", has_text="Copied").wait_for()
    assert page.evaluate("navigator.clipboard.readText()").endswith("/?door=all")
