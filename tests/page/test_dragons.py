"""Several dragons on the page: their list, their common verdict, picture and clock, and their address."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any
from urllib.parse import parse_qs, urlsplit

import pytest
from playwright.sync_api import expect

from tests.support import polite
from tests.support.axe import findings
from tests.support.pending import settled, with_below

ENCOUNTERS = Path(__file__).parent.parent / "reference" / "encounters.json"
PHONE: Any = {"width": 390, "height": 844}
ADDRESS_MOST = 500  # characters, so that chat programs keep it whole
# Share of the pixels of the picture that have the colour of a dragon.
COLOURED = """(colour) => {
  const canvas = document.querySelector("#canvas");
  const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
  const [r, g, b] = [1, 3, 5].map((at) => parseInt(colour.slice(at, at + 2), 16));
  let count = 0;
  for (let k = 0; k < data.length; k += 4) count += data[k] === r && data[k + 1] === g && data[k + 2] === b;
  return count;
}"""
COLOURS = ("#b3261e", "#0b5cad", "#1a6f33")


def begun(open_page: Any, preset: str, query: str = "?door=all&lang=en&time=0", **options: Any) -> Any:
    """The page with a performance to begin with."""
    page = open_page(query, **options)
    settled(page)
    page.locator("#several").click()
    page.locator(f"[data-dragons={preset}]").click()
    settled(page)
    return page


def saved(page: Any) -> Any:
    with page.expect_download() as download:
        page.locator("#dragons-save").click()
    return json.loads(Path(download.value.path()).read_bytes())


def judged(page: Any) -> str:
    return str(page.locator("#judgement").inner_text())


def test_two_in_one_spiral_meet_when_the_reference_says(open_page: Any) -> None:
    reference = json.loads(ENCOUNTERS.read_text("utf-8"))
    time = next(one["time"] for one in reference["cases"] if one["name"] == "two dragons in one spiral, opposite")
    page = begun(open_page, "spiral")
    expect(page.locator("#judgement")).to_contain_text(f"First meeting at {time:.6f} s")
    expect(page.locator(".failures li").first).to_contain_text("body 3 of red and the head of blue touch.")
    expect(page.locator("#contact-mark")).to_have_attribute("aria-label", f"Two dragons meet at {time:.6f} s")
    page.locator("#to-end").click()
    settled(page)
    expect(page.locator("#clock")).to_have_text(f"{time:.6f} s")
    expect(page.locator("#inset figcaption")).to_have_text("body 3 of red, the head of blue")
    assert all(page.evaluate(COLOURED, colour) > 200 for colour in COLOURS[:2])
    query = page.url.partition("?")[2]
    assert len(page.url) < ADDRESS_MOST
    other = open_page(f"?{query}")
    settled(other)
    assert judged(other) == judged(page)
    other.locator("[data-lang=zh]").click()
    settled(other)
    expect(other.locator("#judgement")).to_contain_text("红龙的第3节龙身与蓝龙的龙头相碰。")
    expect(other.locator("#inset figcaption")).to_contain_text("红龙的第3节龙身")


@pytest.mark.parametrize("preset", ["spiral", "streets", "parade"])
def test_a_file_of_the_page_is_judged_by_the_service_as_on_the_page(open_page: Any, server: str, preset: str) -> None:
    page = begun(open_page, preset)
    file = saved(page)
    report = polite.post(f"{server}/check", json=file | {"details": False}).raise_for_status().json()
    words = {"passes": "Can be danced", "fails": "Cannot be danced"}[report["verdict"]]
    assert words in judged(page)
    assert (report["verdict"] == "passes") is (preset == "parade")
    assert page.locator(".failures li").count() == len(report["failures"])
    assert len(file["dances"]) == page.locator("#dragons li").count() == (3 if preset == "parade" else 2)
    assert len(page.url) < ADDRESS_MOST
    assert all(page.evaluate(COLOURED, colour) > 20 for colour in COLOURS[: len(file["dances"])])


def test_a_parade_is_played_together(open_page: Any) -> None:
    page = begun(open_page, "parade", reduced_motion="no-preference")
    expect(page.locator("#judgement")).to_contain_text("No two dragons touch.")
    expect(page.locator("#contact-mark")).to_be_hidden()
    before = page.locator("#canvas").evaluate("canvas => canvas.toDataURL()")
    page.locator("#play").click()
    page.wait_for_function("() => Number(document.querySelector('#time').value) > 30")
    page.locator("#play").click()
    assert page.locator("#canvas").evaluate("canvas => canvas.toDataURL()") != before
    assert all(page.evaluate(COLOURED, colour) > 20 for colour in COLOURS)


def test_who_waits_is_let_pass_and_the_browser_leads_back(open_page: Any, server: str) -> None:
    page = begun(open_page, "streets")
    expect(page.locator("#judgement")).to_contain_text("Cannot be danced")
    page.locator("#dragon-delay-1").fill("30")
    page.locator("#dragon-delay-1").press("Enter")
    expect(page.locator("#judgement")).to_contain_text("Can be danced")
    assert saved(page)["dances"][1]["delay"] == 30
    page.locator("#dragon-delay-1").fill("soon")
    page.locator("#dragon-delay-1").press("Enter")
    expect(page.locator("#dragons [role=alert]")).to_have_text("“soon” is no number.")
    page.go_back()
    expect(page.locator("#judgement")).to_contain_text("Cannot be danced")
    expect(page.locator("#dragon-delay-1")).to_have_value("4")


def test_dragons_are_chosen_changed_copied_named_coloured_and_removed(open_page: Any) -> None:
    page = begun(open_page, "spiral")
    page.locator("#dragon-choose-1").click()
    expect(page.locator("#dragon-choose-1")).to_have_attribute("aria-pressed", "true")
    page.locator("#benches").fill("30")
    page.locator("#benches").press("Enter")
    settled(page)
    page.locator("#dragon-choose-0").click()
    expect(page.locator("#benches")).to_have_value("60")
    settled(page)
    file = saved(page)
    assert [one["dragon"]["benches"] for one in file["dances"]] == [60, 30]
    assert [one["path"].get("rotation", 0) for one in file["dances"]] == [0, math.pi]
    page.locator("#dragon-copy-1").click()
    expect(page.locator("#dragons li")).to_have_count(3)
    page.locator("#dragon-name-2").fill("blue")
    page.locator("#dragon-name-2").press("Enter")
    expect(page.locator("#dragons [role=alert]")).to_have_text("Another dragon is called “blue”.")
    page.locator("#dragon-name-2").fill("West!~1")
    page.locator("#dragon-name-2").press("Enter")
    page.locator("#dragon-colour-2").fill("#008080")
    settled(page)
    third = saved(page)["dances"][2]
    assert (third["name"], third["dragon"]["benches"], third["delay"]) == ("West!~1", 30, 30)
    other = open_page(f"?{page.url.partition('?')[2]}")
    settled(other)
    expect(other.locator("#dragon-name-2")).to_have_value("West!~1")
    expect(other.locator("#dragon-colour-2")).to_have_value("#008080")
    assert saved(other) == saved(page)
    page.locator("#dragon-remove-0").click()
    expect(page.locator("#dragons li")).to_have_count(2)
    expect(page.locator("#benches")).to_have_value("30")
    page.locator("#dragons-close").click()
    expect(page.locator("#dragons li")).to_have_count(0)
    expect(page.locator("#first-contact .value")).to_be_visible()
    settled(page)
    assert "dances" not in parse_qs(urlsplit(page.url).query)


def test_another_dragon_winds_into_the_spiral_from_the_other_side(open_page: Any) -> None:
    page = open_page("?benches=20&pitch=1.1&start_turns=6&lang=en&time=0")
    settled(page)
    page.locator("#several").click()
    expect(page.locator("#dragons li")).to_have_count(2)
    expect(page.locator("#dragon-turn-1")).to_have_value("180")
    settled(page)
    expect(page.locator("#judgement .value")).to_be_visible()


def test_a_refusal_names_the_dragon(open_page: Any) -> None:
    page = open_page("?benches=9&pitch=1.1&start_turns=6&dances=~pitch:55!benches:9&lang=en", failing=True)
    expect(page.locator("#judgement")).to_contain_text("blue: “Pitch” must be at most 10 m; it is 55 m")


def test_an_unreadable_address_opens_what_can_be_read(open_page: Any) -> None:
    page = open_page(
        "?benches=9&pitch=1.1&start_turns=6&dances=~rotation:180!benches:9!what:ever!pitch:1.1!%25&lang=en"
    )
    settled(page)
    expect(page.locator("#dragons li")).to_have_count(2)


@pytest.mark.parametrize("language", ["en", "zh"])
def test_on_a_phone_nothing_is_cut_off_and_everyone_can_use_it(open_page: Any, language: str) -> None:
    page = begun(
        open_page, "parade", f"?door=all&lang={language}&time=0", viewport=PHONE, is_mobile=True, has_touch=True
    )
    assert page.evaluate("document.documentElement.scrollWidth") == PHONE["width"]
    assert findings(page, "#dragons") == []
    small = """() => [...document.querySelectorAll("#dragons :is(button, input)")]
      .filter((one) => one.checkVisibility() && one.getBoundingClientRect().height < 44).map((one) => one.outerHTML)"""
    assert page.evaluate(small) == []


def test_a_row_of_the_list_is_one_tab_stop_in_which_arrow_keys_move(open_page: Any) -> None:
    page = begun(open_page, "spiral")
    page.locator("#dragon-choose-0").focus()

    def after(*keys: str) -> str:
        for key in keys:
            page.keyboard.press(key)
        return str(page.evaluate("document.activeElement.id"))

    assert [after("Tab") for _ in range(3)] == ["dragon-choose-1", "dragon-add", "dragons-save"]
    page.locator("#dragon-choose-0").focus()
    assert [after("ArrowRight") for _ in range(2)] == ["dragon-colour-0", "dragon-name-0"]
    page.keyboard.type("east")
    # Within a text they move in the text.
    assert after("ArrowLeft", "x", "ArrowRight") == "dragon-name-0"
    assert after("ArrowRight") == "dragon-copy-0"
    expect(page.locator("#dragon-name-0")).to_have_value("easxt")
    rest = ["dragon-remove-0", "dragon-delay-0", "dragon-turn-0", "dragon-turn-0"]
    assert [after("ArrowDown") for _ in rest] == rest
    assert after("ArrowUp") == "dragon-delay-0"
    assert [after(key) for key in ("Tab", "Shift+Tab")] == ["dragon-choose-1", "dragon-delay-0"]
    settled(page)
    assert findings(page) == []


@pytest.mark.parametrize("preset", ["spiral", "parade"])
def test_a_saved_file_opens_again(open_page: Any, tmp_path: Path, preset: str) -> None:
    page = begun(open_page, preset)
    page.locator("#margin").fill("0.02")
    page.locator("#margin").press("Enter")
    settled(page)
    file = saved(page)
    kept = tmp_path / "square.json"
    kept.write_text(json.dumps(file))
    other = open_page("?door=all&path=route&lang=en")
    settled(other)
    other.locator("#open-file").set_input_files(str(kept))
    expect(other.locator("#dragons li")).to_have_count(len(file["dances"]))
    settled(other)
    assert saved(other) == file
    assert judged(other) == judged(page)
    file["dances"][1]["path"] = {"kind": "spiral", "pitch": 1.1, "start_turns": 8, "clockwise": False}
    kept.write_text(json.dumps(file))
    if other.locator("#open-file").count():
        other.locator("#open-file").set_input_files(str(kept))
        expect(other.locator("#status")).to_contain_text("the page shows spirals around x = y = 0")


def test_a_turn_with_clothoids_and_a_dance_without_a_path_are_opened_as_they_are(
    open_page: Any, tmp_path: Path
) -> None:
    turn = {"kind": "turn", "pitch": 1.7, "turning_diameter": 9.0, "start_turns": 5.0, "middle": 1.0, "ends": 0.5}
    dances = [{"name": "turning", "dragon": {"benches": 3}, "path": turn, "delay": 100}, {"dragon": {"benches": 4}}]
    file = tmp_path / "two.json"
    file.write_text(json.dumps({"dances": dances}))
    page = open_page("?door=all&path=route&lang=en")
    settled(page)
    page.locator("#open-file").set_input_files(str(file))
    expect(page.locator("#dragons li")).to_have_count(2)
    settled(page)
    kept = saved(page)["dances"]
    assert kept[0]["path"] == turn
    assert (kept[1]["path"], kept[1]["dragon"]["benches"]) == ({"kind": "spiral", "pitch": 0.55, "start_turns": 16}, 4)


@pytest.mark.parametrize(
    ("language", "words"),
    [
        ("en", "Opened two.json. Left out: start, stop. The page shows a dance from beginning to end."),
        ("zh", "已打开 two.json。 已略去：start、stop。页面显示整场舞龙。"),
    ],
)
@pytest.mark.parametrize("several", [True, False], ids=["several", "one"])
def test_times_of_a_file_that_the_page_leaves_out_are_named(
    open_page: Any, tmp_path: Path, several: bool, language: str, words: str
) -> None:
    line = {"kind": "line", "start": [0, 0], "end": [60, 0]}
    dance = {"dragon": {"benches": 3}, "path": {"kind": "route", "pieces": [line]}}
    file = tmp_path / "two.json"
    content = {"dances": [dance, {**dance, "delay": 60}]} if several else dance
    file.write_text(json.dumps({**content, "start": 20, "stop": 40}))
    page = open_page(f"?door=village&path=route&lang={language}")
    settled(page)
    page.locator("#open-file").set_input_files(str(file))
    expect(page.locator("#status")).to_have_text(words)
    settled(page)


def test_a_bench_of_the_chosen_dragon_is_followed_and_the_view_closes_to_all(open_page: Any) -> None:
    page = open_page("?benches=9&pitch=1.1&start_turns=6&dances=~rotation:180&bench=3&lang=en")
    expect(page.locator("#carrier h1")).to_have_text("red: body 3")
    page.get_by_role("button", name="Close").click()
    expect(page.locator("#carrier")).to_be_hidden()
    expect(page.locator("#dragons li")).to_have_count(2)
    settled(with_below(page))
    page.get_by_role("button", name="Follow a bench").click()
    expect(page.locator("#carrier h1")).to_have_text("red: head")
    settled(page)


def test_the_film_the_plan_the_cues_and_the_map_are_of_all_dragons(open_page: Any) -> None:
    page = begun(open_page, "parade", "?door=village&lang=en&time=0")
    settled(with_below(page))
    rows = page.locator("#kept li:visible > span:first-child")
    names = ("The picture as it is", "Film of the dance", "Plan on paper, true to scale", "Map with chalk marks")
    expect(rows).to_have_text([*names])
    expect(page.locator("#cues")).to_contain_text("A cue card for each bench")
    expect(page.locator("#crew, #paper").locator("visible=true")).to_have_count(0)
    kept = {}
    for key in ("keepPlan-A3", "keepCues-CSV", "keepMap-GeoJSON"):
        with page.expect_download() as download:
            page.locator(f"#{key}").click()
        kept[key] = Path(download.value.path()).read_bytes()
    assert kept["keepPlan-A3"].startswith(b"%PDF")
    assert all(name in kept["keepCues-CSV"].decode() for name in ("red", "blue", "green"))
    assert all(name in kept["keepMap-GeoJSON"].decode() for name in ("red", "blue", "green"))
    dances: list[int] = []

    def small(route: Any) -> None:
        dances.append(len(route.request.post_data_json["dances"]))
        route.continue_(post_data=json.dumps({**route.request.post_data_json, "height": 90, "seconds": 1}))

    page.route("**/films", small)
    page.locator("#keepFilm-GIF").click()
    page.wait_for_function("() => document.querySelector('#kept img.film')?.naturalWidth === 160")
    assert dances == [3]


def test_every_command_of_several_is_about_all_and_one_dragon_has_its_own_again(open_page: Any) -> None:
    page = begun(open_page, "spiral")
    settled(with_below(page))
    options = page.locator("#curl-of option:not([hidden])")
    assert options.count() == 7
    for option in options.all():
        page.locator("#curl-of").select_option(option.get_attribute("value"))
        commands = page.locator("#curl").inner_text().splitlines()
        assert commands
        assert all('"dances":[{' in command for command in commands)
    page.locator("#dragons-close").click()
    settled(page)
    expect(page.locator("#keepKit-ZIP")).to_be_visible()
    expect(page.locator("#crew")).to_be_visible()
    assert options.count() > 12


def test_on_paper_stand_the_picture_the_verdict_and_the_end_of_several(open_page: Any) -> None:
    page = begun(open_page, "parade", "?door=village&lang=en&time=0&begin_clock=19%3A30")
    page.emulate_media(media="print")
    page.pdf()
    begin, end = (float(page.locator("#time").get_attribute(name)) for name in ("min", "max"))
    minutes, seconds = divmod(int(end - begin), 60)
    expect(page.locator("#printed")).to_contain_text(f"The dance ends at {end:.2f} s (19:{30 + minutes}:{seconds:02}")
    expect(page.locator("#printed")).to_contain_text("dances=")
    expect(page.locator("#canvas")).to_be_visible()
    expect(page.locator("#judgement .value")).to_be_visible()
    bordered = """[...document.querySelectorAll("button, select, input, a")].filter((one) => one.checkVisibility())
      .filter((one) => getComputedStyle(one).borderTopWidth !== "0px").map((one) => one.outerHTML)"""
    assert page.evaluate(bordered) == []


def test_behind_a_door_the_meeting_is_as_people_say_it_and_all_digits_are_with_the_evidence(open_page: Any) -> None:
    page = begun(open_page, "spiral", "?door=look&lang=en&time=0")
    expect(page.locator("#judgement > p", has_text="First meeting at 207.38 s.")).to_be_visible()
    assert "207.378361" not in judged(page)
    page.locator("#judgement summary").click()
    expect(page.locator("#judgement details p")).to_contain_text("First meeting at 207.378361 s, proven between")
    page.locator("[data-lang=zh]").click()
    settled(page)
    expect(page.locator("#judgement details p")).to_contain_text("首次相遇在 207.378361 s")


def test_another_colour_and_another_theme_change_the_picture_at_once(open_page: Any) -> None:
    page = begun(open_page, "streets")
    page.locator("#dragon-colour-1").fill("#008080")
    settled(page)
    assert page.evaluate(COLOURED, "#008080") > 20
    assert page.evaluate(COLOURED, COLOURS[1]) == 0
    assert page.evaluate(COLOURED, COLOURS[0]) > 20
    page.emulate_media(color_scheme="dark")
    settled(page)
    assert page.evaluate(COLOURED, COLOURS[0]) == 0
    assert page.evaluate(COLOURED, "#ff8b7c") > 20
    assert page.evaluate(COLOURED, "#008080") > 20
    expect(page.locator("#dragon-colour-0")).to_have_value("#ff8b7c")


def test_more_dragons_than_an_address_holds_are_there_after_the_page_is_loaded_again(open_page: Any) -> None:
    names = [f"{k:03}{'x' * 35}" for k in range(170)]
    dances = "~".join(f"name:{name}" for name in names)
    page = open_page(f"?lang=en&time=0&dances={dances}", failing=True)  # They are more benches than the service takes.
    settled(page)
    page.locator("#dragon-copy-169").click()
    expect(page.locator("#dragons li")).to_have_count(171)
    settled(page)
    assert len(page.url) < ADDRESS_MOST
    page.reload()
    expect(page.locator("#dragons li")).to_have_count(171)
    expect(page.locator("#dragon-name-169")).to_have_value(names[169])


# Answers the first question about several dragons though the next one is asked meanwhile.
OVERTAKEN = """() => {
  const { fetch } = window;
  window.fetch = (url, options) => {
    if (url !== "check" || !JSON.parse(options.body).dances) return fetch(url, options);
    window.fetch = fetch;
    document.querySelector("[data-dragons=spiral]").click();
    return fetch(url, { ...options, signal: undefined });
  };
}"""


def test_a_late_answer_about_other_dragons_asks_nothing_that_is_refused(open_page: Any) -> None:
    page = open_page("?door=all&lang=en&time=0")
    settled(page)
    page.evaluate(OVERTAKEN)
    page.locator("#several").click()
    expect(page.locator("#dragons li")).to_have_count(2)
    settled(page)
    expect(page.locator("#judgement")).to_contain_text("First meeting at 207.378361 s")
