"""Time from a move of a dragged waypoint to the verdict on it, in a real Chromium on the real service.

`.venv/bin/python -m benchmarks.drag [ADDRESS]`, while `bench-dragon serve` runs there: 60 benches on a path of 20
waypoints, without a square and in one with three obstacles, then by the same moves again, whose answers the service has
kept. A verdict counts for a move if it was asked for at the move
or after it, so a move that a newer one replaced waits for the newer one's verdict. The time of the service, from the
request to its answer, is printed after it, and so is the machine's load, because other work makes all of it slower.
"""

from __future__ import annotations

import math
import os
import sys

from playwright.sync_api import Page, sync_playwright

from tests.page.conftest import ARGUMENTS, WIDE
from tests.support.browser import browser_path
from tests.support.pending import settled

MOVES = 200
ROUNDS = ("new", "again")
POINTS = [(-170.0, 0.0), *((8.0 * k - 70.0, round(6.0 * math.sin(0.9 * k), 2)) for k in range(19))]
ROUTE = "_".join(f"{x:g},{y:g}" for x, y in POINTS)
SQUARE = (
    "&things=a.square..-200,-30_200,-30_200,30_-200,30"
    "~c.oak.0!5.10,20~c.elm.0!5.30,20~b.stage..-17,15_-6,15_-6,19_-17,19"
)
# A move every 16 ms, as a mouse makes them. The box of the verdict is filled anew by each answer of /check.
DRAG = """async (moves) => {
  const knot = document.querySelectorAll(".knot")[9];
  const box = knot.getBoundingClientRect();
  const [left, top] = [box.x + box.width / 2, box.y + box.height / 2];
  const fire = (type, dx, dy) =>
    knot.dispatchEvent(new PointerEvent(type, { clientX: left + dx, clientY: top + dy, bubbles: true }));
  Element.prototype.setPointerCapture = () => {};
  const [real, asked, found, service] = [window.fetch, [], [], []];
  let waiting = [];
  window.fetch = async (url, options) => {
    const sent = performance.now();
    const response = await real(url, options);
    if (url === "check") {
      service.push(performance.now() - sent);
      const json = response.json.bind(response);
      response.json = async () => (asked.push(sent), json());
    }
    return response;
  };
  new MutationObserver(() => {
    const sent = Math.max(...asked.splice(0), -1);
    found.push(...waiting.filter((time) => time <= sent).map((time) => performance.now() - time));
    waiting = waiting.filter((time) => time > sent);
  }).observe(document.querySelector("#judgement"), { childList: true });
  fire("pointerdown", 0, 0);
  for (let k = 0; k < moves; k++) {
    waiting.push(performance.now());
    fire("pointermove", 12 * Math.sin(k / 5), 6 + 4 * Math.cos(k / 7));
    await new Promise((resolve) => setTimeout(resolve, 16));
  }
  await new Promise((resolve) => setTimeout(resolve, 1000));
  fire("pointerup", 0, 0);
  window.fetch = real;
  return [found, service].map((times) => times.sort((a, b) => a - b));
}"""


def measure(page: Page, base: str, square: str) -> list[tuple[list[float], list[float]]]:
    """In each round: times of verdicts, and of the service's answers, each in order [ms]."""
    page.goto(f"{base}/?path=route&benches=60&limit=1.5&route={ROUTE}{square}")
    settled(page)
    page.locator("#edit").click()
    settled(page)
    rounds = []
    for _ in ROUNDS:
        rounds.append(page.evaluate(DRAG, MOVES))
        settled(page)
    return rounds


def quantiles(times: list[float]) -> str:
    p50, p95 = times[len(times) // 2], times[len(times) * 19 // 20]
    return f"p50 {p50:.0f} ms, p95 {p95:.0f} ms, most {times[-1]:.0f} ms"


def load() -> str:
    return f"load {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores"


def main() -> None:
    base = sys.argv[1] if len(sys.argv) > 1 else "http://127.0.0.1:8000"
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=browser_path(), args=ARGUMENTS)
        for words, square in (("no square", ""), ("a square with three obstacles", SQUARE)):
            rounds = measure(browser.new_page(viewport=WIDE), base, square)
            for name, (verdicts, service) in zip(ROUNDS, rounds, strict=True):
                times = f"{quantiles(verdicts)}; service {quantiles(service)}"
                print(f"{words}, {name}: {len(verdicts)} moves, {times}; {load()}")
        browser.close()


if __name__ == "__main__":
    main()
