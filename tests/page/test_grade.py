"""The page grades dropped workbooks and typed answers, in both languages, on a phone, and forgets them on request."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from playwright.sync_api import expect

from core import Dragon
from tests.support.axe import findings
from tests.support.pending import settled
from tests.support.students import CONTACT, SPIRAL_TIMES, contact_workbook, spiral, workbook

# Instants of a workbook that is soon read.
FEW = SPIRAL_TIMES[:21]
PHONE = {"width": 390, "height": 844}
# A short dragon: this is not about its dance.
EASY = "?benches=5&time=end"


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> list[str]:
    folder = tmp_path_factory.mktemp("student")
    for name, data in (
        ("result1.xlsx", workbook(spiral(FEW, Dragon(overhang=0.0)), FEW)),
        ("result2.xlsx", contact_workbook(spiral(np.array([CONTACT])))),
        ("result4.xlsx", b"PK, but no workbook"),
    ):
        (folder / name).write_bytes(data)
    return [str(folder / name) for name in ("result1.xlsx", "result2.xlsx", "result4.xlsx")]


@pytest.fixture
def page(visit: Any) -> Iterator[Any]:
    """The page, where nothing is graded yet."""
    page = visit(EASY)
    yield page
    page.evaluate("document.querySelector('#grade-clear').click()")


def test_chosen_files_are_graded_each_for_itself_and_accessibly(page: Any, files: list[str]) -> None:
    page.locator("#files").set_input_files(files)
    boxes = page.locator("#grades .answer")
    expect(boxes).to_have_count(3)
    first, second, third = (boxes.nth(k) for k in range(3))
    expect(first.locator(".value")).to_have_text("✕wrong")
    expect(first.locator(".finding")).to_contain_text(
        "The length of a bench was used as the distance between its handles"
    )
    expect(first.locator(".evidence")).to_contain_text("cells that are wrong by more agree within")
    expect(first.locator("canvas.marks")).to_have_count(2)
    expect(first.locator(".legend").first).to_contain_text("■ wrong")
    expect(page.locator("#grades [role=status]")).to_have_count(0)
    expect(second.locator(".value")).to_have_text("✓right")
    expect(third.locator(".value")).to_have_text("✕unreadable")
    assert findings(page, "#grade") == []


def test_an_empty_file_is_reported_as_such(page: Any) -> None:
    page.locator("#files").set_input_files({"name": "result1.csv", "mimeType": "text/csv", "buffer": b""})
    expect(page.locator("#grades .answer")).to_contain_text("The file is empty.")


def test_a_dropped_file_is_graded(page: Any, files: list[str]) -> None:
    data = list(Path(files[1]).read_bytes())
    drop = """data => {
        const files = new DataTransfer();
        files.items.add(new File([new Uint8Array(data)], "result2.xlsx"));
        const event = new DragEvent("drop", { dataTransfer: files, bubbles: true, cancelable: true });
        document.querySelector("#drop").dispatchEvent(event);
        return event.defaultPrevented;
    }"""
    assert page.evaluate(drop, data)
    expect(page.locator("#grades .value")).to_have_text("✓right")


def test_typed_answers_are_graded_and_cleared(page: Any) -> None:
    page.locator("#typed-pitch").fill("0,4202")
    page.locator("#typed-speed").fill("1.246266")
    page.keyboard.press("Enter")
    boxes = page.locator("#grades .answer")
    expect(boxes).to_have_count(2)
    expect(boxes.nth(0)).to_contain_text("Possibly: Only the pose with the head on the circle was checked")
    expect(boxes.nth(0)).to_contain_text("numbers with as many digits fits a known error by chance.")
    expect(boxes.nth(1).locator(".value")).to_have_text("✓right")
    expect(boxes.nth(1)).to_contain_text("Graded to its significant digits: 7.")
    page.get_by_role("button", name="Clear", exact=True).click()
    expect(boxes).to_have_count(0)


def test_a_number_that_is_rounded_the_other_way_is_not_wrong(page: Any) -> None:
    page.locator("#typed-pitch").fill("0.4503")
    page.locator("#typed-turn_length").fill("11.7915")
    page.keyboard.press("Enter")
    boxes = page.locator("#grades .answer")
    expect(boxes.nth(0).locator(".value")).to_have_text("✓rounded")
    expect(boxes.nth(0)).to_contain_text("0.4504 m is the smallest of as many digits")
    expect(boxes.nth(1).locator(".value")).to_have_text("✓right")
    expect(boxes.nth(1)).to_contain_text("the answer is right if the ratio and both places are stated")


def test_an_invalid_number_is_refused_in_words(page: Any, visit: Any) -> None:
    visit(EASY, failing=True)
    page.locator("#typed-pitch").fill("0.45x")
    page.locator("#typed-speed").fill("1.246266")
    page.keyboard.press("Enter")
    words = "Minimum pitch must be a number such as 0.450338: you typed “0.45x”."
    expect(page.locator("#grades .error")).to_have_text(words)
    expect(page.locator("#grades .value")).to_have_text("✓right")


def test_the_page_shows_that_it_grades(open_page: Any, files: list[str]) -> None:
    page = open_page(EASY)
    page.route("**/grade?*", lambda route: None)  # no answer comes
    page.locator("#files").set_input_files(files[:2])
    expect(page.locator("#grades [role=status]")).to_have_text("Grading result1.xlsx (1 of 2) …")


def test_the_language_of_the_verdicts_follows_that_of_the_page(page: Any, files: list[str]) -> None:
    page.locator("#files").set_input_files(files[:2])
    expect(page.locator("#grades .answer")).to_have_count(2)
    page.get_by_role("button", name="中文").click()
    expect(page.locator("#grades .finding")).to_contain_text("把板长当作把手间距")
    expect(page.locator("#grades .answer").nth(1).locator(".value")).to_have_text("✓正确")
    size = page.viewport_size
    page.set_viewport_size(PHONE)
    settled(page)
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
    page.set_viewport_size(size)
    settled(page)
