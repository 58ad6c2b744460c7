"""The page and the states of the service: refusals, slow answers, superseded questions, loss, safety, weight."""

from __future__ import annotations

from pathlib import Path
from typing import Any
from urllib.parse import urlencode

from playwright.sync_api import expect

from tests.support import polite
from tests.support.pending import settled, with_below
from tests.support.serving import free_port, serving

PATIENT = 50.0  # longest computation of one answer [s], also on a busy machine
OWN_MAX, ALL_MAX = 125_000, 1_600_000  # [bytes] over the wire
FIRST_MAX = 2_000  # [ms] from the request for the page to first contact shown
IN_CM = ("stray", "hole", "pin")  # shown to people in centimetres; the service takes metres
HALF_A_CHORD = "half of the shortest distance between two handles"
SHORT = "?benches=20&time=end"
LOADS = 3  # one that is quick enough counts: others share the machine
# A loop, and how long it takes where nothing else runs [ms]: where it takes n times as long, so may all else.
LOOP, LOOP_MS = (
    """() => {
  const begun = performance.now();
  let sum = 0;
  for (let k = 0; k < 2e7; k++) sum = (sum * 31 + k) | 0;
  return [performance.now() - begun, sum];
}""",
    21,
)


def test_a_lost_service_is_reported_the_page_recovers_by_itself_and_a_file_that_takes_long_becomes_a_job(
    open_page: Any, picture: Any, alike: Any, server: str, tmp_path: Path
) -> None:
    """Two patient services, one after the other; then one that ends every longer computation at once."""
    numbers, port = {"benches": 20, "stray": 0.02}, free_port()
    with serving(tmp_path / "first.log", port=port, deadline_seconds=PATIENT):
        page = open_page(f"?{urlencode(numbers)}", base=f"http://127.0.0.1:{port}", failing=True)
        wire = page.context.new_cdp_session(page)
        wire.send("Network.enable")
        # Else the browser would give what the page has asked before.
        wire.send("Network.setCacheDisabled", {"cacheDisabled": True})
        settled(page)
        answer = page.locator("#first-contact .value").inner_text()
        before = picture(page)
    page.locator("#pitch").fill("0.5")
    page.locator("#lost", has_text="does not answer").wait_for()
    assert page.locator("#first-contact .value").inner_text() == answer
    assert alike(picture(page), before)
    with serving(tmp_path / "second.log", port=port, deadline_seconds=PATIENT):
        page.locator("#lost").wait_for(state="hidden")
        end = polite.get(f"{server}/collision-time", params=numbers | {"pitch": 0.5}).json()["time"]
        page.locator("#first-contact .value", has_text=f"{end:.6f}").wait_for()
        settled(page)
    # An idle page notices it too.
    page.locator("#lost", has_text="does not answer").wait_for()
    with serving(tmp_path / "hurried.log", port=port, deadline_seconds=1e-9) as hurried:
        page.locator("#lost").wait_for(state="hidden")
        settled(with_below(page))  # The service refuses a file while it is busy with what the page asks.
        page.get_by_role("button", name="Ground that benches sweep, JSON").click()
        expect(page.locator("#jobs li")).to_have_attribute("data-state", "successful")
        result = page.locator("#jobs a[download]").get_attribute("href")
        ground = polite.get(f"{hurried.url}/{result}").json()
    path = {"kind": "spiral", "pitch": 0.5}
    whole = {"dragon": {"benches": 20}, "path": path, "start": 0.0, "stop": end}
    assert ground == polite.post(f"{server}/envelope", json=whole).raise_for_status().json()


def right_again(page: Any, name: str | None) -> None:
    """Reset the number that was wrong before the present one: no dance is computed between two refusals."""
    if name:
        page.locator(f".field:has(#{name}) .reset").press("Enter")
        page.locator(f"#{name}-error").wait_for(state="hidden")


def test_a_wrong_value_is_reported_once_in_a_sentence_beside_its_control(visit: Any) -> None:
    page = visit(SHORT, failing=True)
    bench = "where the head of this dragon folds; it is 0.5 turns."
    before = None
    for name, text, words in (
        ("pitch", "55", "“Pitch” must be at most 10 m; it is 55 m. Lengths are in metres, and 55 cm is 0.55 m."),
        ("benches", "0", "“Benches” must be at least 1; it is 0."),
        ("start_turns", "0.5", f"“Start” must be more than 2.34509 turns, {bench}"),
        ("turning_diameter", "wide", "“Turning circle” must be a number of metres, such as 9; you typed “wide”."),
    ):
        page.locator(f"#{name}").fill(text)
        right_again(page, before)
        page.locator(f"#{name}-error", has_text=words).wait_for()
        box = "#minimum-pitch" if name == "turning_diameter" else "#first-contact"
        label = page.locator(f"label[for={name}]").inner_text()
        page.locator(box, has_text=f"An answer appears as soon as “{label}” is right.").wait_for()
        assert page.locator("body").inner_text().count(words) == 1
        assert page.locator(f"#{name}").get_attribute("aria-invalid") == "true"
        before = name
    page.get_by_role("button", name="Reset all").click()
    page.locator("#controls .error:visible").wait_for(state="hidden")
    page.locator("#first-contact .value", has_text="412.473838").wait_for()


def test_a_refusal_that_comes_late_is_not_shown_beside_numbers_that_are_right_again(visit: Any) -> None:
    page = visit(SHORT, failing=True)
    held: list[Any] = []
    passing: list[bool] = []
    page.route("**/minimum-pitch*", lambda one: one.continue_() if passing else held.append(one))

    def await_request(count: int) -> None:
        while len(held) < count:
            page.wait_for_timeout(10)

    page.locator("#turning_diameter").fill("wide")
    await_request(1)
    page.get_by_role("button", name="Reset all").click()
    held[0].continue_()
    await_request(2)  # the question about the numbers that are right again follows the refusal of the former
    assert page.locator("#turning_diameter-error").is_hidden()
    passing.append(True)
    held[1].continue_()
    settled(page)
    assert page.locator("#turning_diameter-error").is_hidden()


def test_a_refusal_about_a_turn_goes_with_the_turn_and_comes_back_with_it(visit: Any) -> None:
    page = visit(f"{SHORT}&path=turn&speed_limit=0", failing=True)
    error = page.locator("#controls .error:visible")
    error.wait_for()
    page.locator("[data-path=spiral]").click()
    error.wait_for(state="hidden")
    page.locator("[data-path=turn]").click()
    error.wait_for()


def test_a_refusal_names_the_controls_in_the_language_of_the_page(visit: Any) -> None:
    page = visit("?lang=zh&overhang=3&benches=20", failing=True)
    words = "“孔心距板头”应小于“龙头板长”的一半（3.41 m / 2 = 1.705 m），现为 3 m。"
    page.locator("#overhang-error:lang(zh)", has_text=words).wait_for()
    page.locator("#first-contact p", has_text="改正“孔心距板头”后即有结果。").wait_for()
    before = "overhang"
    for name, text, words in (
        ("pitch", "55", "“螺距”最多为 10 m，现为 55 m（长度以米为单位，55 cm 即 0.55 m）。"),
        ("start_turns", "0.2", "“起始圈数”应大于 2.34509 圈（龙头在该处折叠），现为 0.2 圈。"),
        (
            "margin",
            "1.2",
            "“安全间距”应小于 1.1 m，现为 1.2 m（在直线上，因而在足够宽的螺线上，龙头与第2节龙身相距 1.1 m）。",
        ),
        ("stray", "100", "“离位距离”最多为第1节龙身孔距的一半（82.5 cm），现为 100 cm。"),
        ("pin", "10", "“插销直径”不得大于板孔直径（0 cm），现为 10 cm。"),
        ("margin", "x", "“安全间距”应为数字（单位 m），例如 0.55，现为“x”。"),
        ("benches", "2.5", "“板凳节数”应为整数，现为 2.5。"),
    ):
        page.locator(f"#{name}").fill(text)
        right_again(page, before)
        page.locator(f"#{name}-error", has_text=words).wait_for()
        before = name
    page.get_by_role("button", name="全部重置").click()
    page.get_by_role("button", name="调头", exact=True).click()
    page.locator("#turning_diameter").fill("4")
    words = "“调头空间直径”应大于 4 m（调头的弯曲半径为 0.6727 m，而龙头至少需要"
    page.locator("#turning_diameter-error", has_text=words).wait_for()
    page.locator("[data-lang=en]").click()
    words = "“Turning circle” must be larger than 4 m. The turn bends to a radius of 0.6727 m, and the head"
    page.locator("#turning_diameter-error:lang(en)", has_text=words).wait_for()


def test_limits_and_units_are_the_services_own(visit: Any, server: str) -> None:
    page = visit()
    parameters = polite.get(f"{server}/openapi.json").json()["paths"]["/collision-time"]["get"]["parameters"]
    words = [one["name"] for one in parameters if "enum" in one["schema"]]
    assert words == ["cross_check"]
    for one in (one for one in parameters if one["name"] not in words):
        low = one["schema"].get("minimum", one["schema"].get("exclusiveMinimum"))
        scale, unit = (100, "cm") if one["name"] in IN_CM else (1, one["schema"].get("x-unit", ""))
        high = HALF_A_CHORD if one["name"] == "stray" else f"{scale * one['schema']['maximum']:.15g}"
        limits = f"{scale * low:.15g} to {high}"
        page.locator(f"#{one['name']}-limits", has_text=limits).wait_for(state="attached")
        assert page.locator(f".field:has(#{one['name']}) .unit").text_content() == unit


# Answers about first contact take this long [ms], and aborted questions are counted.
SLOW = """(milliseconds) => {
  window.quick = window.fetch;
  window.aborted = 0;
  window.fetch = async (url, options) => {
    if (!String(url).startsWith("collision-time")) return quick(url, options);
    await new Promise((resolve, reject) => {
      setTimeout(resolve, milliseconds);
      options.signal.addEventListener("abort", () => {
        window.aborted++;
        reject(options.signal.reason);
      });
    });
    return quick(url, options);
  };
}"""
QUICK = "() => void (window.fetch = quick)"


def test_superseded_questions_are_aborted_and_the_slider_does_not_wait(visit: Any, server: str) -> None:
    page = visit(SHORT)
    page.evaluate(SLOW, 600)
    slider = page.locator("#controls input[type=range]").first
    for _ in range(20):
        slider.press("ArrowLeft")
    assert page.locator("#pitch").input_value() == "0.53"
    wanted = polite.get(f"{server}/collision-time?benches=20&pitch=0.53").json()["time"]
    page.locator("#first-contact .value", has_text=f"{wanted:.6f}").wait_for()
    assert page.evaluate("window.aborted") >= 1
    page.evaluate(QUICK)


def test_a_dragged_slider_sees_answers_of_a_service_that_takes_longer_than_the_grace(visit: Any) -> None:
    page = visit(SHORT)
    page.evaluate(SLOW, 400)
    value = page.evaluate("""async () => {
      let shown = 0;
      const answers = document.querySelector("#first-contact");
      new MutationObserver(() => shown++).observe(answers, { childList: true });
      const slider = document.querySelector("#controls input[type=range]");
      for (let k = 0; k < 60 && shown < 2; k++) {
        slider.value = 0.6 + 0.001 * k;
        slider.dispatchEvent(new Event("input", { bubbles: true }));
        await new Promise((resolve) => setTimeout(resolve, 50));
      }
      return shown;
    }""")
    page.evaluate(QUICK)
    assert value >= 2


def test_a_wait_of_more_than_half_a_second_shows_its_progress(visit: Any) -> None:
    page = visit(SHORT)
    page.route("**/minimum-pitch*", lambda route: None)
    page.locator("#width").fill("0.28")
    box = page.locator("#minimum-pitch[aria-busy=true]")
    box.wait_for()
    assert box.evaluate("box => getComputedStyle(box, '::after').animationDelay") == "0.5s, 0.5s"
    page.wait_for_function("box => getComputedStyle(box, '::after').opacity > 0", arg=box.element_handle())


def opacity(page: Any, place: str) -> float:
    return float(page.locator(place).first.evaluate("one => getComputedStyle(one).opacity"))


OLD = ("#first-contact .value", "#run-end .value", "#canvas", "#clearance .plot", "#rows")


def test_old_answers_turn_pale_while_new_ones_are_computed(visit: Any, server: str) -> None:
    page = visit(SHORT)
    assert {place: opacity(page, place) for place in OLD} == dict.fromkeys(OLD, 1.0)
    page.route("**/collision-time*", lambda route: None)
    page.locator("#pitch").fill("0.5")
    page.locator("#first-contact[aria-busy=true]").wait_for()
    for place in OLD:
        page.wait_for_function("place => getComputedStyle(document.querySelector(place)).opacity < 1", arg=place)
        assert 0.3 < opacity(page, place) < 0.7, place
    titles = ("#first-contact h3", "#run-end h3", "#clearance h2")
    assert {place: opacity(page, place) for place in titles} == dict.fromkeys(titles, 1.0)
    page.unroute("**/collision-time*")
    page.locator("#pitch").fill("0.52")
    wanted = polite.get(f"{server}/collision-time?benches=20&pitch=0.52").json()["time"]
    page.locator("#first-contact .value", has_text=f"{wanted:.6f}").wait_for()
    settled(page)
    assert {place: opacity(page, place) for place in OLD} == dict.fromkeys(OLD, 1.0)


def test_a_failure_of_the_service_is_reported_in_its_own_words(visit: Any) -> None:
    page = visit(f"{SHORT}&pitch=0.5", failing=True)
    problem = '{"title": "Internal Server Error", "status": 500, "detail": "The service failed here.", "errors": []}'
    page.route("**/collision-time*", lambda route: route.fulfill(status=500, body=problem))
    page.locator("#pitch").fill("0.51")
    page.locator("#first-contact", has_text="The service failed here.").wait_for()
    page.unroute("**/collision-time*")
    page.locator("#pitch").fill("0.52")
    page.locator("#first-contact[data-outcome=contact]").wait_for()


def test_a_busy_service_is_asked_again(visit: Any) -> None:
    page = visit(f"{SHORT}&pitch=0.5", failing=True)
    refused = []

    def once(route: Any) -> None:
        refused.append(route.request.url)
        route.fulfill(status=503, headers={"Retry-After": "1"}, body="{}") if len(refused) == 1 else route.continue_()

    page.route("**/collision-time*", once)
    page.locator("#pitch").fill("0.45")
    page.locator("#first-contact .value", has_text="215.337253").wait_for()
    assert len(refused) >= 2  # a service with much to do refuses by itself, too


def test_a_dance_whose_samples_are_refused_says_so_and_is_not_played_for_ever(open_page: Any, tmp_path: Path) -> None:
    with serving(tmp_path / "small.log", cells_max=1_500) as small:
        page = open_page("?benches=100&time=10", base=small.url, failing=True)
        settled(page)
        page.locator("#play").click()
        expect(page.locator("#status")).to_contain_text(
            "The dance cannot be played: step through it, or move the time."
        )
        expect(page.locator("#status")).to_contain_text("instants times handles, and there may be 1500")
        expect(page.locator("#play")).to_have_text("▶ Play")


# Counts checks of the service, each of which takes longer here.
COUNT_REQUESTS = """() => {
  const real = window.fetch;
  Object.assign(window, { checks: 0, most: 0 });
  let running = 0;
  window.fetch = async (...request) => {
    if (request[0] !== "healthz") return real(...request);
    window.checks++;
    window.most = Math.max(window.most, ++running);
    await new Promise((resolve) => setTimeout(resolve, 300));
    return real(...request).finally(() => running--);
  };
}"""


def test_one_check_at_a_time_asks_whether_the_service_lives(visit: Any) -> None:
    page = visit("?benches=5&time=end", failing=True)
    page.evaluate(COUNT_REQUESTS)
    page.route("**/{collision-time*,healthz}", lambda route: route.abort())
    page.locator("#pitch").fill("0.6")
    page.locator("#lost").wait_for()
    for _ in range(3):
        page.locator("#lost button").click()
    page.wait_for_function("() => checks > 2")
    assert page.evaluate("most") == 1
    page.unroute_all()
    settled(page)
    expect(page.locator("#lost")).to_be_hidden()


def test_the_policy_lets_the_page_load_from_its_service_alone(visit: Any, server: str) -> None:
    policy = polite.get(server).headers["content-security-policy"]
    assert policy == "default-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
    page = visit()
    assert page.evaluate("document.querySelectorAll('script:not([src]), style, [style*=url], [onclick]').length") == 0


def loaded(browser: Any, server: str) -> tuple[dict[str, int], float]:
    """Bytes that a browser with an empty cache receives, by its own count; time of first contact on a quiet machine
    [ms]."""
    context = browser.new_context(viewport={"width": 1440, "height": 900}, locale="en-GB")
    page = context.new_page()
    wire = context.new_cdp_session(page)
    wire.send("Network.enable")
    urls: dict[str, str] = {}
    weights: dict[str, int] = {}
    wire.on("Network.requestWillBeSent", lambda event: urls.update({event["requestId"]: event["request"]["url"]}))
    wire.on("Network.loadingFinished", lambda event: weights.update({event["requestId"]: event["encodedDataLength"]}))
    before = page.evaluate(LOOP)[0]
    page.goto(f"{server}/?time=end")
    page.locator("#first-contact .value").wait_for()
    value = page.evaluate("performance.now()")
    after = page.evaluate(LOOP)[0]
    settled(page)
    context.close()
    slower = max(1.0, (before + after) / 2 / LOOP_MS)
    return {f"{urls[one]} {one}": weight for one, weight in weights.items()}, value / slower


def test_the_page_is_light_and_quick(browser: Any, server: str) -> None:
    for _ in range(LOADS):
        weights, seconds = loaded(browser, server)
        files = [one for one in weights if ("/page-" in one and "uPlot" not in one) or "?time=end" in one]
        assert len(files) > 1
        assert sum(weights[one] for one in files) < OWN_MAX
        assert sum(weights.values()) < ALL_MAX
        if seconds < FIRST_MAX:
            break
    assert seconds < FIRST_MAX
