"""People who stray: the words, the picture and the answers of the page, against the service's own."""

from __future__ import annotations

import math
import shlex
from typing import Any

import numpy as np
from playwright.sync_api import expect

from tests.support import polite
from tests.support.pending import settled, with_below

SURE = ("Contact at", "Nothing touches", "touch at", "meet at", "时碰撞", "无碰撞")
CHORD, OVERHANG, WIDTH, STRAY = 1.65, 0.275, 0.3, 0.05
# For a bench anywhere on the canvas: whether each of these points, in the frame of the bench, is on its ground.
ON_GROUND = """async ([stray, chord, overhang, width, points]) => {
  const { addGround } = await import("/page/pen.js");
  const pen = document.createElement("canvas").getContext("2d");
  const [x, y, ux, uy] = [3, -2, 0.6, -0.8];
  const holes = [chord / 2, -chord / 2];
  const pose = { x: holes.map((along) => x + along * ux), y: holes.map((along) => y + along * uy) };
  const path = new Path2D();
  addGround(path, pose, { overhang, width }, 0, stray);
  return points.map(([along, left]) => pen.isPointInPath(path, x + along * ux - left * uy, y + along * uy + left * ux));
}"""


def answer_of(server: str, call: str, **query: Any) -> Any:
    return polite.get(f"{server}/{call}", params=query).raise_for_status().json()


def shows(page: Any, selector: str, *words: str) -> None:
    """Wait until the element holds all these words."""
    for one in words:
        expect(page.locator(selector).first).to_contain_text(one)


def test_with_a_stray_the_answers_say_what_may_happen_in_both_languages(visit: Any, server: str) -> None:
    page = visit("?benches=40&stray=0.02")
    contact = answer_of(server, "collision-time", benches=40, stray=0.02)
    least = answer_of(server, "minimum-pitch", benches=40, stray=0.02)
    free = answer_of(server, "tolerance", benches=40)
    time, pitch, gap = f"{contact['time']:.6f} s", f"{least['pitch']:.9f} m", f"{1000 * contact['gap']:.3f} mm"
    safe = f"{int(10_000 * free['stray']) / 100:.2f} cm"
    shows(page, "#first-contact", "First contact, everybody within 2 cm of their place", f"May touch from {time}", gap)
    shows(page, "#minimum-pitch", "everybody within 2 cm of their place", pitch, "no two benches can touch, at every")
    shows(page, "#tolerance", safe, f"everybody may be {safe} from their place", f"at {free['time']:.6f} s")
    page.evaluate("document.querySelectorAll('#answers details').forEach((one) => (one.open = true))")
    low, high = free["stray_bracket"]
    low, high = f"{math.floor(1e9 * low) / 1e7:.7f} cm", f"{math.ceil(1e9 * high) / 1e7:.7f} cm"
    shows(page, "#tolerance dl", f"nothing touches up to {low}; a pose with {high} overlaps")
    shows(
        page,
        "#first-contact",
        "nothing can touch up to",
        "each in its place, by the gap at this contact; shapely",
    )
    shows(page, "#inset figcaption", "is nearest to", gap)
    shows(page, "#clearance .hint", "from then on two may touch")
    assert not [word for word in SURE if word in page.locator("#first-contact").inner_text()]
    page.locator("[data-lang=zh]").click()
    shows(page, "#first-contact", "首次碰撞（每人离位不超过 2 cm）", f"{time} 起可能相碰", gap)
    shows(page, "#minimum-pitch", pitch, "任何两节板凳都不可能相碰")
    shows(page, "#tolerance", f"每人随时都可离位 {safe}", "已证明的步")
    assert not [word for word in SURE if word in page.locator("#first-contact").inner_text()]
    get = shlex.split(with_below(page).locator("#curl").inner_text().splitlines()[0])
    assert polite.get(get[1]).json() == contact


def test_a_margin_and_a_stray_stand_in_one_sentence_and_play_counts(visit: Any, server: str) -> None:
    page = visit("?benches=12&margin=0.03&stray=0.02&hole=0.055&pin=0.045")
    query = {"benches": 12, "margin": 0.03, "stray": 0.025}
    time = f"{answer_of(server, 'collision-time', **query)['time']:.6f} s"
    title = "First time within 0.03 m, every hole within 2.5 cm of its place"
    shows(page, "#first-contact", title, f"May come within 0.03 m from {time}")
    shows(
        page,
        "#minimum-pitch",
        f"{answer_of(server, 'minimum-pitch', **query)['pitch']:.9f} m",
        "come within 0.03 m, at",
    )
    page.locator("[data-lang=zh]").click()
    shows(page, "#first-contact", "首次间距不超过 0.03 m（每个孔离位不超过 2.5 cm）", f"{time} 起可能间距不超过 0.03 m")


def test_a_turn_stays_clear_and_has_its_own_tolerance(open_page: Any, server: str) -> None:
    # The shortest turn takes seconds, and what follows it is not asked.
    page = open_page("?path=turn&benches=20&stray=0.03", without="**/shortest-turn*")
    shows(page, "#first-contact[data-outcome=clear]", "Stays clear: nothing can touch", "No two benches can")
    body = {"dragon": {"benches": 20}, "path": {"kind": "turn", "pitch": 1.7}, "start": -100, "stop": 100}
    free = polite.post(f"{server}/tolerance", json=body).raise_for_status().json()["stray"]
    shows(page, "#tolerance", f"{int(10_000 * free) / 100:.2f} cm", "In this part of the dance everybody may be")
    with_below(page)
    with page.expect_download() as download:
        page.get_by_role("button", name="Figure of the first contact, SVG").click()
    assert download.value.suggested_filename == "first-contact.svg"


def test_the_curve_shows_the_tolerance_of_the_dance_and_a_click_sets_its_pitch(
    open_page: Any, look_at: Any, server: str
) -> None:
    page = open_page("?benches=20&stray=0.02")
    look_at(page, "curve")
    plot = page.locator("#curve .u-over")
    before = page.locator("#curve .now").bounding_box()["x"]
    plot.click(position={"x": 0.9 * plot.bounding_box()["width"], "y": 20})
    pitch = page.locator("#pitch").input_value()
    assert 0.8 < float(pitch) < 0.9
    free = answer_of(server, "tolerance", benches=20, pitch=pitch)["stray"]
    shows(page, "#curve .reading", f"pitch {pitch} m: everybody may be {int(10_000 * free) / 100:.2f} cm from")
    assert page.locator("#curve .now").bounding_box()["x"] > before + 100


def test_the_ground_of_the_benches_is_drawn_only_with_a_stray(visit: Any, picture: Any, alike: Any) -> None:
    page = visit("?benches=20&time=0&view=8,0,200")
    expect(page.locator("#halo")).to_be_hidden()
    before = picture(page)
    page.locator("#stray").fill("5")
    expect(page.locator("#halo")).to_be_visible()
    settled(page)
    assert not alike(picture(page), before)
    page.locator(".field:has(#stray) .reset").click()
    expect(page.locator("#halo")).to_be_hidden()
    settled(page)
    assert alike(picture(page), before)


def strayed_points(stray: float) -> np.ndarray:
    """Corners and sides of a bench in 200 poses that keep its chord and have each hole within the stray."""
    chance = np.random.default_rng(0)
    angle, turn = chance.uniform(0, 2 * np.pi, 800), chance.uniform(-2, 2, 800) * np.arcsin(stray / CHORD)
    front = np.stack([CHORD / 2 + stray * np.cos(angle), stray * np.sin(angle)], axis=-1)
    along = np.stack([np.cos(turn), np.sin(turn)], axis=-1)
    allowed = np.hypot(*(front - CHORD * along + [CHORD / 2, 0]).T) <= stray
    front, along = front[allowed][:200], along[allowed][:200]
    left = np.stack([-along[:, 1], along[:, 0]], axis=-1)
    places = [(at, side) for at in np.linspace(-CHORD - OVERHANG, OVERHANG, 9) for side in (-WIDTH / 2, WIDTH / 2)]
    return np.concatenate([front + at * along + side * left for at, side in places])


def test_the_drawn_ground_is_what_strayed_benches_cover_and_little_more(visit: Any) -> None:
    def on_ground(points: Any) -> list[bool]:
        return list(page.evaluate(ON_GROUND, [STRAY, CHORD, OVERHANG, WIDTH, np.asarray(points).tolist()]))

    page = visit()
    covered = strayed_points(STRAY)
    assert len(covered) == 3_600
    assert all(on_ground(covered * (1 - 1e-6)))
    beside, end = WIDTH / 2 + 1.01 * STRAY, CHORD / 2 + OVERHANG + 1.37 * STRAY
    assert not any(on_ground([(along * CHORD / 2, way * beside) for along in (-1, 0, 1) for way in (-1, 1)]))
    assert not any(on_ground([(end, 0), (-end, 0)]))
