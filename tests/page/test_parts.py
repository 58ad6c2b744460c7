"""The parts of the page that load when a person first needs them, and their words."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

from playwright.sync_api import expect

from app.service.pages import PAGE
from tests.support.pending import settled, with_below
from tests.support.serving import free_port, serving

PATIENT = 50.0  # longest computation of one answer [s], also on a busy machine
IMPORT = re.compile(r'(?:from|import) "(\.{1,2}/[\w./-]+\.js)"')
USE_OF_WORDS = re.compile(r'(?:\bsay(?:Of)?|\btitleOf|\btextButton)\("([\w-]+)"|"data-(?:text|label)": "([\w-]+)"')
WORD = re.compile(r'^  "?([\w-]+)"?: \[', re.MULTILINE)
# Parts with a file of each that tells that it has loaded.
LATER = {"qr.js", "below.js", "below.css", "grade.js", "map.js", "drawn.js", "place.css", "propose.js", "refusals.js"}
LATER |= {"proofs.js"}  # in Chinese


def first_view() -> set[Path]:
    """The modules that load with the page."""
    known: set[Path] = set()
    new = {PAGE / "main.js"}
    while new:
        known |= new
        new = {(one.parent / name).resolve() for one in new for name in IMPORT.findall(one.read_text("utf-8"))} - known
    return known


def test_the_words_of_the_first_view_come_with_it() -> None:
    modules = first_view()
    texts = [one.read_text("utf-8") for one in modules if one.parent == PAGE]
    words = {key for one in modules if one.parent.name == "words" for key in WORD.findall(one.read_text("utf-8"))}
    used = {key for text in texts for both in USE_OF_WORDS.findall(text) for key in both if key}
    assert len(used) > 100
    assert used - words == set()


def test_every_text_of_the_page_has_its_words_in_some_part() -> None:
    words = {key for file in (PAGE / "words").glob("*.js") for key in WORD.findall(file.read_text("utf-8"))}
    labels = set(re.findall(r'data-(?:text|label)="(\w+)"', (PAGE / "index.html").read_text("utf-8")))
    assert len(labels) > 100
    assert labels - words == set()


def test_a_part_loads_when_a_person_first_needs_it(open_page: Any) -> None:
    page = open_page("?benches=5&time=end", failing=True)
    names: list[str] = []
    page.on("request", lambda request: names.append(urlsplit(request.url).path.rpartition("/")[2]))
    settled(page)
    page.reload()
    settled(page)
    assert LATER & set(names) == set()
    page.locator("#share").click()
    expect(page.locator("#qr")).to_be_visible()
    page.keyboard.press("Escape")
    assert LATER & set(names) == {"qr.js"}
    settled(with_below(page))
    assert LATER & set(names) == {"qr.js", "below.js", "below.css", "grade.js", "map.js"}
    page.locator("#pitch").fill("55")
    page.locator("#pitch-error", has_text="“Pitch” must be at most 10 m").wait_for()
    page.get_by_role("button", name="Reset all").click()
    page.locator("[data-path=route]").click()
    expect(page.locator("#judgement .value")).to_be_visible()
    assert LATER - set(names) == {"proofs.js"}
    page.locator("[data-lang=zh]").click()
    settled(page)
    assert set(names) >= LATER


def test_what_a_person_does_while_the_service_is_lost_is_done_when_it_is_back(open_page: Any, tmp_path: Path) -> None:
    port = free_port()
    with serving(tmp_path / "first.log", port=port, deadline_seconds=PATIENT):
        page = open_page("?benches=5&time=end", base=f"http://127.0.0.1:{port}", failing=True)
        settled(page)
    page.locator("#share").click()
    expect(page.locator("#address")).to_have_value(page.url)
    page.keyboard.press("Escape")
    page.locator("[data-lang=zh]").click()
    expect(page.locator("h1")).to_have_text("板凳龙")
    page.locator("#typed-pitch").fill("0.450338")
    page.locator("#typed-pitch").press("Enter")
    expect(page.locator("#lost")).to_contain_text("服务没有响应")
    expect(page.locator("#typed-pitch")).to_have_value("0.450338")
    with serving(tmp_path / "second.log", port=port, deadline_seconds=PATIENT):
        expect(page.locator("#grades .value")).to_have_text("✓正确")
        expect(page.locator("#grade-title")).to_have_text("竞赛结果评阅")
        expect(page.locator("#edit")).to_have_text("✎ 绘制")
        settled(page)
