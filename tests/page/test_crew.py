"""The people of a dance on the page: who carries when, who is where, and the same on paper and as a table."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from playwright.sync_api import expect

from tests.support import polite
from tests.support.axe import findings
from tests.support.pending import settled, with_below

PHONE: Any = {"width": 390, "height": 844}
ROUTE = "path=route&route=*-40,0_40,0&begin=30&benches=9&time=20&start_clock=19%3A30"
BODY = {
    "dragon": {"benches": 9, "head_length": 3.41, "body_length": 2.2, "width": 0.3, "overhang": 0.275},
    "path": {"kind": "waypoints", "points": [[-40, 0], [40, 0]], "straight": [0], "start": 30},
    "start_clock": "19:30",
}


def opened(page: Any) -> Any:
    """The page with the form of the crew."""
    settled(with_below(page))
    page.locator("#crew summary").first.click()
    expect(page.locator("#crew-at")).to_have_value("20")
    return page


def crew(server: str, **fields: Any) -> Any:
    answer = polite.post(f"{server}/crew", json=BODY | fields)
    return answer.raise_for_status().json()


def cells(page: Any, table: int) -> list[list[str]]:
    rows = page.locator("#crew-result table").nth(table).locator("tbody tr")
    return [[*row.locator("th, td").all_inner_texts()] for row in rows.all()]


def test_people_minutes_metres_and_places_are_those_of_the_service(open_page: Any, server: str) -> None:
    page = opened(open_page(f"?door=village&lang=en&{ROUTE}"))
    for name, number in (("spares", "6"), ("shift", "15"), ("rest", "10"), ("x", "0"), ("y", "0,5")):
        page.locator(f"#crew-{name}").fill(number)
    page.locator("#crew-ask").click()
    answer = crew(server, spares=6, shift=15, rest=10, points=[{"x": 0, "y": 0.5}], at=20)
    assert answer["changes"] > 6
    expect(page.locator("#crew-result p").first).to_contain_text(f"{answer['people']} people, 6 of them spare")
    roll = [[", ".join(one["people"]), f"{one['mark']:g}"] for one in answer["at"]["benches"]]
    assert [row[1:] for row in cells(page, 0)] == roll
    expect(page.locator("#crew-result")).to_contain_text("Who is where at 19:30:20")
    carried = [[one["label"], f"{one['way']:.0f}"] for one in answer["carriers"]]
    assert [[row[0], row[2]] for row in cells(page, 1)] == carried
    bars = [len(one["spells"]) for one in answer["carriers"]]
    counted = "tables => [...tables[1].tBodies[0].rows].map((row) => row.querySelectorAll('i').length)"
    assert page.locator("#crew-result table").evaluate_all(counted) == bars
    for form, begin in (("PDF", b"%PDF"), ("CSV", b"person,label")):
        with page.expect_download() as download:
            page.locator(f"#crew-{form}").click()
        assert Path(download.value.path()).read_bytes().startswith(begin)


def test_who_is_where_at_a_time_of_day_and_what_cannot_be_is_refused(open_page: Any, server: str) -> None:
    page = opened(open_page(f"?door=village&lang=en&{ROUTE}", failing=True))
    page.locator("#crew-spares").fill("4")
    page.locator("#crew-shift").fill("20")
    page.locator("#crew-at").fill("19:30:30")
    page.locator("#crew-ask").click()
    expect(page.locator("#crew-result")).to_contain_text("Who is where at 19:30:30")
    resting = crew(server, spares=4, shift=20, at=30)["at"]["resting"]
    expect(page.locator("#crew-result")).to_contain_text(f"Resting: {', '.join(resting)}.")
    page.locator("#crew-shift").fill("600")
    page.locator("#crew-ask").click()
    expect(page.locator("#crew-result .error")).to_contain_text("it is 600 s")
    page.locator("#crew-shift").fill("20")
    page.locator("#crew-ask").click()
    expect(page.locator("#crew-result table")).to_have_count(2)
    page.locator("[data-lang=zh]").click()
    expect(page.locator("#crew-result p").first).to_contain_text("其中替补 4 人")
    page.locator("#benches").fill("8")
    page.locator("#benches").press("Enter")
    expect(page.locator("#crew-result table")).to_have_count(0)  # Those people were of another dance.


def test_on_a_phone_the_crew_fits_and_everyone_can_use_it(open_page: Any) -> None:
    page = opened(open_page(f"?door=village&lang=en&{ROUTE}", viewport=PHONE, is_mobile=True, has_touch=True))
    page.locator("#crew-ask").click()
    expect(page.locator("#crew-result table")).to_have_count(2)
    assert page.evaluate("document.documentElement.scrollWidth") == PHONE["width"]
    assert findings(page, "#crew") == []


def test_a_spiral_has_its_crew_up_to_its_first_contact(open_page: Any) -> None:
    page = opened(open_page("?benches=5&time=20&lang=en"))
    page.locator("#crew-ask").click()
    expect(page.locator("#crew-result table")).to_have_count(2)
