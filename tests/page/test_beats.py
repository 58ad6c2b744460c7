"""Beats of a FILE on the page: kept in the address, the FILE and the film until the speeds are changed."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any
from urllib.parse import parse_qs, urlsplit

import pytest
from playwright.sync_api import expect

from tests.support.pending import settled, with_below

BEATS = [
    {"bars": 4, "tempo": 96, "step": 0.6, "beats": 4},
    {"bars": 2, "tempo": 96, "step": 0, "beats": 4},
    {"bars": 6, "tempo": 120, "step": 0.5, "beats": 3},
]
TEXT = "4,96,0.6_2,96,0_6,120,0.5,3"
STREET = {"kind": "waypoints", "points": [[-40, 0], [0, 0], [20, 10], [40, 0], [80, 0]]}
FILE = {"dragon": {"benches": 9}, "path": STREET, "beats": BEATS}


def opened(open_page: Any, tmp_path: Path, content: dict[str, Any]) -> Any:
    file = tmp_path / "dance.json"
    file.write_text(json.dumps(content))
    page = open_page("?door=all&path=route&lang=en")
    settled(page)
    page.locator("#open-file").set_input_files(str(file))
    expect(page.locator("#status")).to_contain_text("dance.json")
    settled(with_below(page))
    return page


def film_of(page: Any) -> dict[str, Any]:
    """The body of the request for a film, as the command that the page shows."""
    page.locator("#curl-of").select_option("keepFilm")
    text = page.locator("#curl").text_content()
    body: dict[str, Any] = json.loads(text.partition("-d '")[2].rpartition("'")[0])["request"]
    return body


def saved(page: Any, button: str) -> dict[str, Any]:
    with page.expect_download() as download:
        page.locator(button).click()
    content: dict[str, Any] = json.loads(Path(download.value.path()).read_text())
    return content


def test_beats_of_a_file_are_in_the_film_the_address_and_the_saved_file(open_page: Any, tmp_path: Path) -> None:
    page = opened(open_page, tmp_path, FILE)
    expect(page.locator("#passages summary")).to_have_text("Speeds by the beats of a drum (12 bars)")
    assert film_of(page)["beats"] == BEATS
    kept = saved(page, "#save")
    assert kept["beats"] == BEATS
    assert "passages" not in kept
    page.wait_for_url("**beats=*")
    query = parse_qs(urlsplit(page.url).query)
    assert query["beats"] == [TEXT]
    assert "passages" not in query
    other = open_page(f"?{urlsplit(page.url).query}")
    settled(with_below(other))
    assert film_of(other)["beats"] == BEATS
    expect(other.locator("#passages li")).to_have_count(3)


@pytest.mark.parametrize("language", ["en", "zh"])
def test_other_speeds_take_the_place_of_the_beats_and_the_page_says_so(open_page: Any, language: str) -> None:
    route = "path=route&route=*-40,0_0,0_20,10_*40,0_80,0&begin=30&benches=9"
    page = open_page(f"?door=all&{route}&beats={TEXT}&lang={language}")
    settled(with_below(page))
    assert film_of(page)["beats"] == BEATS
    speed = page.locator("#passages li").nth(1).locator("input").nth(1)
    speed.fill("0.2")
    speed.press("Enter")
    said = {"en": "These speeds take the place of the beats", "zh": "新的速度取代了鼓点"}[language]
    expect(page.locator("#status")).to_contain_text(said)
    settled(page)
    film = film_of(page)
    assert "beats" not in film
    assert [one["speed"] for one in film["passages"]] == [0.96, 0.2, 1]
    page.wait_for_url("**passages=*")
    assert "beats" not in parse_qs(urlsplit(page.url).query)


def test_beats_of_several_dragons_are_kept_by_each(open_page: Any, tmp_path: Path) -> None:
    far = {"kind": "waypoints", "points": [[-40, 30], [80, 30]]}
    dances = [{"name": "A", **FILE}, {"name": "B", "dragon": {"benches": 9}, "path": far, "beats": BEATS[:1]}]
    page = opened(open_page, tmp_path, {"dances": dances})
    for body in (film_of(page), saved(page, "#dragons-save")):
        assert [one["beats"] for one in body["dances"]] == [BEATS, BEATS[:1]]
    page.locator("#dragon-choose-1").click()
    settled(page)
    assert [one["beats"] for one in film_of(page)["dances"]] == [BEATS, BEATS[:1]]


def test_beats_that_cannot_be_danced_are_refused_beside_the_speeds(open_page: Any) -> None:
    page = open_page("?door=all&benches=20&beats=4,0,0.6&lang=en", failing=True)
    expect(page.locator("#passages .error")).to_contain_text("must be at least 10")
