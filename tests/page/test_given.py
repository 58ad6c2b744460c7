"""Inputs in addition to the numbers: benches one by one, passages, the time of day; and a printed plan."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import expect

from app.wire.benches import bench_table
from tests.support import polite
from tests.support.axe import findings
from tests.support.pending import reached, settled

PHONE = {"width": 390, "height": 844}
S_CURVE = "?path=route&route=*-80,-16_0,-16_16,-8_0,0_-16,8_*0,16_80,16&benches=8"
TABLE = (
    "name,length,width,overhang\nZhou,3.41,0.3,0.275\nLi,2.2,0.3,0.275\nWu,1.8,0.7,0.2\nSun,2.2,0.3,0.275\nHe,2,0.3,0.2"
)
PASSAGES = [{"speed": 0.5, "until_s": 20}, {"speed": 0, "until_time": 100}, {"speed": 1.5, "until_s": 60}]
SPIRAL = {"kind": "spiral", "pitch": 0.55, "start_turns": 16}
A3_WIDE = 420 / 25.4 * 72  # [points]


def put(page: Any, table: str) -> None:
    page.locator("#csv").fill(table)
    page.locator("#csv").press("Tab")


def contact_of(server: str, **request: Any) -> str:
    """Time of first contact by the service, in the words of the page."""
    result = polite.post(f"{server}/collision-time", json={"path": SPIRAL, **request}).raise_for_status().json()
    return f"{result['time'] if result['time'] is not None else result['end']['time']:.6f} s"


def test_benches_one_by_one_are_danced_drawn_named_shared_and_refused_by_line(
    open_page: Any, picture: Any, alike: Any, server: str
) -> None:
    page = open_page("?time=0&benches=5&view=8,-3,40", failing=True)
    page.locator("#one-by-one summary").click()
    put(page, TABLE)
    answer = page.locator("#first-contact .value")
    expect(answer).to_contain_text(contact_of(server, dragon={"csv": TABLE}))
    page.locator("#rows tr", has_text="2 · body 2 (Wu)").wait_for()
    settled(page)
    wide = picture(page)
    # One bench narrower: its chord, and so the whole pose, stays; the picture does not.
    put(page, TABLE.replace("1.8,0.7", "1.8,0.2"))
    page.wait_for_url("**csv=*0.2,0.2*")
    settled(page)
    assert not alike(wide, picture(page))
    reached(page.locator("#keep"))
    with page.expect_download() as download:
        page.locator("[data-keep=keepTrajectory][data-form=CSV]").click()
    assert Path(download.value.path()).read_text().splitlines()[2].endswith(",Li")
    assert "Wu,1.8,0.2" in page.locator("#curl").inner_text()
    page.reload()
    expect(page.locator("#csv")).to_have_value(TABLE.replace("1.8,0.7", "1.8,0.2"))
    page.locator("#rows tr", has_text="2 · body 2 (Wu)").wait_for()
    put(page, TABLE.replace("2.2,0.3", "2.2,30", 1))
    expect(page.locator("#csv-error")).to_have_text(
        "Line 3: “Width” must be from 0.001 to 5 m; it is 30 m. Lengths are in metres, and 30 cm is 0.3 m."
    )
    page.locator("[data-lang=zh]").click()
    expect(page.locator("#csv-error")).to_have_text(re.compile("^第 3 行：“板宽”应在 0.001 至 5 m 之间"))
    page.locator("#csvClear").click()
    expect(answer).to_contain_text(contact_of(server, dragon={"benches": 5}))


@pytest.mark.parametrize(
    "table",
    [
        TABLE,
        "length\twidth\toverhang\n3,41\t0,3\t0,275\n\n2,2\t0,3\t0,275",
        'Width [m];NAME;overhang (m);长度\r\n0,3;"a;""b""";0,275;3.41\r\n0,3;;0,275;2,2',
        ' name , length,width,overhang\n"Zhou, Li",3.41, 0.3 ,0.275\n,,,\n O\'Neil,2.2,.3,2e-1',
    ],
    ids=["commas", "tabs", "semicolons", "spaces"],
)
def test_the_page_reads_the_sizes_of_a_table_as_the_service_does(visit: Any, table: str) -> None:
    read = visit().evaluate("table => import('/page/benches.js').then(({ benchesOf }) => benchesOf(table))", table)
    result = bench_table(table)._asdict()
    del result["lines"]
    assert read == result


def test_passages_and_the_time_of_day_change_every_time_and_are_shared(visit: Any, server: str) -> None:
    page = visit("?benches=30&time=50", failing=True)
    page.locator("#passages summary").click()
    for k, (until, unit, speed) in enumerate([("20", "m", "0.5"), ("100", "s", "0"), ("60", "m", "1.5")]):
        page.locator("#passageAdd").click()
        row = page.locator("#passages li").nth(k)
        row.locator("select").select_option(unit)
        for field, value in zip(row.locator("input").all(), (until, speed), strict=True):
            field.fill(value)
            field.press("Tab")
    page.locator("#begin_clock").fill("7.30 AM")
    page.locator("#begin_clock").press("Tab")
    contact = contact_of(server, dragon={"benches": 30}, passages=PASSAGES)
    expect(page.locator("#first-contact .value")).to_contain_text(contact)
    expect(page.locator("#clock")).to_have_text(re.compile(r"^50.000000 s\s*07:30:50$"))
    # The head rests, and so does everybody.
    expect(page.locator("#rows tbody td").nth(3)).to_have_text("0.000000")
    page.wait_for_url("**passages=0.5@20m_0@100s_1.5@60m*begin_clock=*")
    page.reload()
    expect(page.locator("#first-contact .value")).to_contain_text(contact)
    expect(page.locator("#passages li")).to_have_count(3)
    page.locator("#begin_clock").fill("25 o'clock")
    page.locator("#begin_clock").press("Tab")
    expect(page.locator("#clock-error")).to_have_text(
        "Write the time of day as 19:30 or 19:30:15. Until then it starts at 07:30:00."
    )
    page.locator("#passages li").nth(1).locator("select").select_option("m")
    expect(page.locator("#passages .error")).to_contain_text("“until, in seconds” must be given.")


def test_faster_passages_end_earlier_and_at_the_same_places(visit: Any) -> None:
    quickened = "passages => import('/page/passages.js').then(({ quickened }) => quickened(passages, 2))"
    assert visit().evaluate(quickened, PASSAGES) == [
        {"speed": 1, "until_s": 20}, {"speed": 0, "until_time": 50}, {"speed": 3, "until_s": 60},
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("time", "clock", "time_of_day"),
    [
        (50.9, "07:30", "07:30:50"),
        (3600, "23:30", "00:30:00"),
        (-1, "00:00", "23:59:59"),
        (1e5, "23:59:59", "03:46:39"),
    ],
)
def test_the_time_of_day_begins_anew_at_midnight(visit: Any, time: float, clock: str, time_of_day: str) -> None:
    script = "([time, clock]) => import('/page/passages.js').then(({ timeOfDay }) => timeOfDay(time, clock))"
    assert visit().evaluate(script, [time, clock]) == time_of_day


def test_a_pause_lies_at_the_instant_shown(visit: Any) -> None:
    page = visit("?benches=30&time=50")
    page.locator("#passages summary").click()
    page.locator("#pauseAdd").click()
    page.wait_for_url("**passages=1@50s_0@10d*")
    page.locator("#passageAdd").click()
    page.wait_for_url("**passages=1@50s_0@10d_1@80s*")


def test_a_drawn_dance_takes_them_too_and_its_failures_tell_the_time_of_day(visit: Any, server: str) -> None:
    page = visit(f"{S_CURVE}&limit=0.9&passages=0.5@20m_0@100s&start_clock=19:30")
    body = {
        "path": {"kind": "waypoints", "straight": [0, 5]},
        "head_speed": 1,
        "speed_limit": 0.9,
        "start_clock": "19:30",
    }
    body["path"]["points"] = [[-80, -16], [0, -16], [16, -8], [0, 0], [-16, 8], [0, 16], [80, 16]]
    body |= {"dragon": {"benches": 8}, "passages": PASSAGES[:2]}
    failure = polite.post(f"{server}/check", json=body).raise_for_status().json()["failures"][0]
    button = page.locator(".failures button").first
    expect(button).to_have_text(f"{failure['time']:.6f} s · {failure['clock']}")
    reached(page.locator("#keep"))
    with page.expect_download() as download:
        page.locator("[data-keep=keepPlan][data-form=A3]").click()
    plan = Path(download.value.path()).read_bytes()
    assert plan.startswith(b"%PDF")
    sides = re.findall(rb"/MediaBox \[ 0 0 ([\d.]+) ([\d.]+) \]", plan)
    assert max(map(float, sides[0])) == pytest.approx(A3_WIDE, abs=1)


def test_a_route_without_a_drawing_invites_to_draw_and_waits_for_nothing(visit: Any) -> None:
    page = visit("?path=route", viewport=PHONE, has_touch=True, is_mobile=True, locale="zh-CN")
    page.locator("#invite").wait_for()
    settled(page)
    expect(page.locator("[aria-busy=true]:visible")).to_have_count(0)
    expect(page.locator("#old")).to_be_hidden()
    assert findings(page) == []
    page.locator("#one-by-one summary").tap()
    page.locator("#passages summary").tap()
    page.locator("#passageAdd").tap()
    assert page.evaluate("document.documentElement.scrollWidth") <= PHONE["width"]
    assert "undefined" not in page.locator("body").inner_text()
    page.locator("[data-preset=eight]").tap()
    expect(page.locator("#judgement .value")).to_have_text(re.compile("表演"))
    expect(page.locator("#invite")).to_be_hidden()


def test_a_dance_that_begins_later_is_begun_at_once_also_with_a_pause(visit: Any) -> None:
    page = visit("?path=route&route=*-40,0_40,0&benches=9&passages=0.5@30m_0@20d&begin_clock=19:30")
    settled(page)
    hint = page.locator("#route .hint", has_text="The dance begins at")
    expect(hint).to_be_visible()
    expect(page.locator("#judgement")).to_contain_text("It starts at 19:30:00")
    before = page.locator("#judgement").inner_text()
    hint.locator("button").click()
    settled(page)
    expect(hint).to_be_hidden()
    page.wait_for_url(
        re.compile(r"passages=0\.5@1\d(\.\d+)?m_0@20d.*begin=1\d|begin=1\d.*passages=0\.5@1\d(\.\d+)?m_0@20d")
    )
    # Up to the ten centimetres to which the place is rounded, the dance is the same.
    ends = [re.search(r"ends at 19:(\d+):(\d+)", text) for text in (before, page.locator("#judgement").inner_text())]
    assert all(ends)
    first, second = (60 * int(one[1]) + int(one[2]) for one in ends if one)
    assert abs(first - second) <= 1


def test_an_old_address_with_the_time_of_day_at_time_0_shows_when_the_dance_starts(visit: Any) -> None:
    page = visit("?path=route&route=*-40,0_40,0&benches=9&start_clock=19:30")
    settled(page)
    expect(page.locator("#judgement")).to_contain_text("It starts at 19:30:16")
    expect(page.locator("#begin_clock")).to_have_value("19:30:16")
    # Head and first bench lead by 16 s of the 80 s of the path.
    expect(page.locator("#clock-help")).to_have_text(
        "The file or the address says 19:30 at 0 s; the dance starts at 19:30:16. It ends at 19:31:20."
    )
    page.locator("#begin_clock").fill("20:00")
    page.locator("#begin_clock").press("Tab")
    settled(page)
    expect(page.locator("#judgement")).to_contain_text("It starts at 20:00:00")
    expect(page.locator("#clock-help")).to_have_text("It ends at 20:01:03.")
    page.wait_for_url(re.compile("begin_clock=20:00"))
    assert "start_clock" not in page.url
