"""Sweeps on the page: the form starts a job of the real service, the list follows it, the map shows its table."""

from __future__ import annotations

import re
import subprocess
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import expect

from app.sweeps.columns import answer_columns
from app.sweeps.questions import question_of
from tests.support import polite
from tests.support.axe import findings
from tests.support.job_service import PATIENCE, SHORT, JobService, wait_for
from tests.support.pending import reached, settled, with_below

PHONE = {"width": 390, "height": 844}
WIDE = {"width": 1440, "height": 900}
TOKEN = "correct horse"
# The middle of the map: its margins are 64 px on the left, 16 on the right, 12 above and 44 below.
MARGINS = {"left": 64, "right": 16, "top": 12, "bottom": 44}


@pytest.fixture(scope="module")
def service(tmp_path_factory: pytest.TempPathFactory) -> Iterator[JobService]:
    with JobService(tmp_path_factory.mktemp("page"), sweep_processes=1, deadline_seconds=50) as service:
        yield service


def base(service: JobService) -> str:
    return f"http://127.0.0.1:{service.port}"


def ask(page: Any, question: str, *axes: tuple[str, float, float, int]) -> None:
    """Fill the form and start the sweep."""
    with_below(page).select_option("#sweep-question", question)
    for k in range(2):
        page.select_option(f"#sweep-name-{k}", axes[k][0] if k < len(axes) else "")
    for k, (_, *numbers) in enumerate(axes):
        for key, number in zip(("sweepFrom", "sweepTo", "sweepCount"), numbers, strict=True):
            page.locator(f"#sweep-{key}-{k}").fill(str(number))
    page.locator("#sweep button").click()


def middle(page: Any) -> dict[str, float]:
    box = page.locator("#map canvas").bounding_box()
    left, top = MARGINS["left"], MARGINS["top"]
    return {
        "x": left + (box["width"] - left - MARGINS["right"]) / 2,
        "y": top + (box["height"] - top - MARGINS["bottom"]) / 2,
    }


def drawn(page: Any) -> set[tuple[int, ...]]:
    """The colours of the map, without its margins."""
    code = """canvas => {
      const { data, width } = canvas.getContext("2d").getImageData(70, 20, canvas.width - 100, canvas.height - 80);
      return [...new Set(Array.from({ length: data.length / 4 }, (_, k) => data.slice(4 * k, 4 * k + 4).join(" ")))];
    }"""
    return {tuple(map(int, text.split())) for text in page.locator("#map canvas").evaluate(code)}


def test_a_sweep_of_two_parameters_becomes_a_map_whose_designs_open(open_page: Any, service: JobService) -> None:
    page = open_page("?benches=40&margin=0.05", base=base(service))
    ask(page, "collision_time", ("pitch", 0.5, 0.6, 5), ("width", 0.2, 0.3, 3))
    page.locator("#jobs li[data-state=successful]", has_text="First contact over Pitch and Width").wait_for()
    for form, begin in (("CSV", b"design,"), ("Parquet", b"PAR1"), ("Arrow", b"ARROW1")):
        with page.expect_download() as download:
            page.locator(f"#map-save [data-save={form}]").click()
        assert download.value.suggested_filename.endswith(f".{form.lower()}")
        assert Path(download.value.path()).read_bytes().startswith((begin, b'"' + begin[:-1]))
    page.locator("#map canvas").hover(position=middle(page))
    query = {"pitch": 0.55, "width": 0.25, "benches": 40, "margin": 0.05, "cross_check": "none"}
    answer = polite.get(f"{base(service)}/collision-time", params=query).json()
    reading = page.locator("#map .reading")
    expect(reading).to_have_text(f"Pitch [m] 0.55, Width [m] 0.25: first contact [s] {answer['time']:.6g}")
    assert len(drawn(page)) > 10
    page.select_option("#map-value", "head.radius")
    page.locator("#map canvas").hover(position=middle(page))
    expect(reading).to_contain_text(f"head · radius [m] {answer['head']['radius']:.6g}")
    page.locator("#map canvas").click(position=middle(page))
    expect(page.locator("#pitch")).to_have_value("0.55")
    expect(page.locator("#width")).to_have_value("0.25")
    page.locator("#first-contact .value", has_text=f"{answer['time']:.6f}").wait_for()
    # Back leads to the numbers before; a new map has nothing of the one before.
    page.go_back()
    expect(page.locator("#width")).to_have_value("0.3")
    expect(reading).not_to_be_empty()
    ask(page, "collision_time", ("pitch", 0.5, 0.52, 2))
    expect(reading).to_be_empty()


@pytest.mark.curl
def test_the_commands_of_a_sweep_save_the_table_of_the_page(
    open_page: Any, service: JobService, tmp_path: Path
) -> None:
    page = open_page("?benches=12", base=base(service))
    ask(page, "collision_time", ("pitch", 0.5, 0.52, 3), ("width", 0.2, 0.3, 2))
    page.locator("#jobs li[data-state=successful]", has_text="First contact over Pitch and Width").wait_for()
    page.locator("#sweep summary").click()
    expect(page.locator("#sweep code")).to_contain_text("-o sweep.csv")
    commands = page.locator("#sweep code").inner_text()
    subprocess.run(["sh", "-ec", commands], check=True, cwd=tmp_path, capture_output=True, timeout=PATIENCE)
    with page.expect_download() as download:
        page.locator("#map-save [data-save=CSV]").click()
    table = Path(download.value.path()).read_bytes()
    assert (tmp_path / "sweep.csv").read_bytes() == table
    assert table.count(b"\n") == 7


def test_every_value_of_a_map_has_its_name_in_chinese(visit: Any) -> None:
    page = visit("?benches=5&time=end")
    left: set[str] = set()
    for name in ("collision_time", "minimum_pitch", "least_clearance", "shortest_turn", "quickest_turn", "tolerance"):
        question = question_of(name, ["benches"])
        columns = answer_columns(question.answer, question.left_out)
        left |= {one.name for one in columns if one.kind in (int, float) and not one.as_json}
    assert len(left) > 50
    script = """async (names) => {
      const { columnName, setLanguage } = await import("/page/text.js");
      await import("/page/below.js");
      setLanguage("zh");
      const words = names.map(columnName);
      setLanguage("en");
      return words;
    }"""
    words = page.evaluate(script, sorted(left))
    assert [one for one in words if re.search("[a-z]{4}|_", one)] == []
    assert len(set(words)) == len(words)


def test_a_switch_of_the_question_keeps_the_axes_that_it_can(visit: Any) -> None:
    page = with_below(visit("?benches=5&time=end"))
    page.select_option("#sweep-name-0", "pitch")
    page.select_option("#sweep-name-1", "width")
    page.locator("#sweep-sweepFrom-0").fill("0.51")
    page.locator("#sweep-sweepTo-1").fill("0.33")

    def axes() -> list[str]:
        ids = ("name-0", "sweepFrom-0", "name-1", "sweepTo-1")
        return [page.locator(f"#sweep-{one}").input_value() for one in ids]

    assert axes() == ["pitch", "0.51", "width", "0.33"]
    page.select_option("#sweep-question", "minimum_pitch")  # which has no pitch
    first, _, *second = axes()
    assert (first not in ("pitch", "width"), second) == (True, ["width", "0.33"])
    page.select_option("#sweep-question", "least_clearance")
    assert axes() == ["pitch", "0.51", "width", "0.33"]
    page.select_option("#sweep-name-1", "")
    page.select_option("#sweep-question", "collision_time")
    assert axes()[::2] == ["pitch", ""]


def test_the_map_of_one_parameter_is_read_by_keyboard_in_chinese_and_its_minimum_pitch_is_danced(
    open_page: Any, service: JobService
) -> None:
    page = open_page("?benches=30", base=base(service), locale="zh-CN")
    ask(page, "minimum_pitch", ("turning_diameter", 8, 10, 3))
    page.locator("#jobs li[data-state=successful]", has_text="最小螺距，变化：调头空间直径").wait_for()
    canvas = page.locator("#map canvas")
    canvas.wait_for()
    canvas.focus()
    for key in ("ArrowRight", "ArrowRight", "ArrowRight"):
        page.keyboard.press(key)
    query = {"turning_diameter": 10, "benches": 30, "cross_check": "none"}
    pitch = polite.get(f"{base(service)}/minimum-pitch", params=query).json()["pitch"]
    expect(page.locator("#map .reading")).to_have_text(f"调头空间直径 [m] 10：最小螺距 [m] {pitch:.6g}")
    page.keyboard.press("Enter")
    expect(page.locator("#pitch")).to_have_value(str(pitch))
    expect(page.locator("#turning_diameter")).to_have_value("10")


def test_the_list_outlives_the_page_and_jobs_are_cancelled_and_removed(open_page: Any, service: JobService) -> None:
    page = open_page("?benches=41", base=base(service), timezone_id="UTC")
    ask(page, "shortest_turn", ("pitch", 1.6, 1.8, 90))
    running = page.locator("#jobs li[data-state=running]")
    expect(running.locator("progress")).to_be_visible()
    expect(running).to_contain_text("of 90 designs")
    page.reload()
    with_below(page)
    expect(running).to_contain_text("Shortest turn over Pitch")
    address = running.locator("button").get_attribute("id").replace("jobCancel-", "/jobs/")
    assert service.status(address)["total"] == 90
    running.get_by_role("button", name="Cancel").press("Enter")
    gone = page.locator("#jobs li[data-state=dismissed]")
    expect(gone).to_contain_text("cancelled")
    gone.get_by_role("button", name="Remove").press("Enter")
    expect(page.locator("#no-jobs")).to_be_visible()
    assert service.client.get(address).status_code == 404
    wait_for(lambda: not list((service.folder / "sweeps").iterdir()))
    page.reload()
    expect(with_below(page).locator("#no-jobs")).to_be_visible()


def refuses_in_words(page: Any) -> None:
    """Below the form stands what is wrong with it."""
    ask(page, "collision_time", ("pitch", 0.5, 0.6, 11), ("width", 0.2, 0.3, 11))
    expect(page.locator("#sweep-error")).to_have_text(
        "A sweep may have at most 100 designs here, and this one has 121."
    )
    ask(page, "collision_time", ("pitch", 0.5, 0.6, 11), ("pitch", 0.2, 0.3, 11))
    expect(page.locator("#sweep-error")).to_have_text("The two parameters must differ.")


def is_for_everyone(page: Any) -> None:
    """Form, list and map are accessible in light and dark, and nothing is cut off in either language."""
    page.locator("[data-lang=zh]").click()
    assert findings(page, "#sweeps") == []
    page.emulate_media(color_scheme="dark")
    assert findings(page, "#sweeps", in_colours=True) == []
    # A job's name and state stand beside its buttons, never below them, and are not cut off.
    row = page.locator("#jobs li").first
    (name, state), buttons = (
        (row.locator(part).bounding_box() for part in (".title", ".state")),
        row.locator(".buttons"),
    )
    right = buttons.bounding_box()["x"]
    assert max(name["x"] + name["width"], state["x"] + state["width"]) <= right
    assert row.locator(".title").evaluate("(one) => one.scrollWidth <= one.clientWidth || !one.clientWidth")
    outside = """(width) => [...document.querySelectorAll("#sweeps *")]
      .filter((one) => one.checkVisibility() && one.getBoundingClientRect().right > width + 1)
      .map((one) => one.outerHTML)"""
    for language, size in (("zh", PHONE), ("en", WIDE)):
        page.locator(f"[data-lang={language}]").click()
        page.set_viewport_size(size)
        settled(page)
        assert page.evaluate("document.documentElement.scrollWidth") <= size["width"]
        assert page.evaluate(outside, size["width"]) == []


def test_who_has_the_token_sees_all_jobs_and_everyone_can_use_it(open_page: Any, tmp_path: Path) -> None:
    limits = {"token": TOKEN, "sweep_processes": 1, "sweep_designs_max": 100, "deadline_seconds": 50}
    with JobService(tmp_path, **limits) as guarded:
        guarded.client.headers["Authorization"] = f"Bearer {TOKEN}"
        address = guarded.post(SHORT)
        page = open_page("?benches=12", base=base(guarded), failing=True, viewport=PHONE, is_mobile=True)
        ask(page, "least_clearance", ("pitch", 0.7, 0.9, 2), ("benches", 8, 10, 2))
        expect(page.locator("#sweep-error")).to_contain_text("Jobs and uploads need the token of this service")
        expect(page.locator("#no-jobs")).to_be_visible()
        sheet = {"name": "result1.csv", "mimeType": "text/csv", "buffer": b"1,2"}
        page.locator("#files").set_input_files(sheet)
        expect(page.locator("#grades .error")).to_contain_text("Jobs and uploads need the token of this service")
        page.locator("#sweeps details:has(#token) summary").click()
        page.locator("#token").fill(TOKEN)
        page.locator("#token").press("Enter")
        page.locator("#files").set_input_files(sheet)
        expect(page.locator("#grades .answer .value")).to_contain_text("unreadable")
        expect(page.locator("#jobs li", has_text="First contact with its certificate")).to_be_visible()
        page.locator("#sweep button").click()
        page.locator("#jobs li[data-state=successful]", has_text="Least clearance over Pitch and Benches").wait_for()
        page.locator("#map:visible").wait_for()
        guarded.client.delete(address)
        is_for_everyone(page)
        refuses_in_words(page)


def test_a_film_is_a_job_whose_result_is_a_file(open_page: Any, service: JobService) -> None:
    page = open_page("?path=route&benches=3&route=-5,0_6,0", base=base(service))
    page.locator("#judgement .value", has_text="Can be danced").wait_for()
    reached(page.locator("#keep"))
    page.get_by_role("button", name="Film of the dance, GIF").click()
    row = page.locator("#jobs li[data-state=successful]", has_text="Film of the dance")
    with page.expect_download() as download:
        row.get_by_role("link", name="Result").click()
    assert download.value.suggested_filename.endswith(".gif")
    expect(row.get_by_role("button")).to_have_text(["Remove"])


def test_a_film_can_be_cancelled(open_page: Any, service: JobService) -> None:
    page = open_page("?head_speed=0.1", base=base(service))  # A long film.
    reached(page.locator("#keep"))
    page.get_by_role("button", name="Film of the dance, GIF").click()
    row = page.locator("#jobs li", has_text="Film of the dance").first  # the newest
    row.get_by_role("button", name="Cancel").click()
    expect(row).to_have_attribute("data-state", "dismissed")
